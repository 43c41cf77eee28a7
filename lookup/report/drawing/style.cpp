#include "lookup/report/drawing/style.h"

#include <fmt/format.h>

#include "lookup/report/drawing/colour_map.h"

namespace voussoir {
namespace {

// Series colours: Okabe and Ito, "Color universal design", 2008, darkened or lightened for contrast.
constexpr const char* kLight =
    "--page:#ffffff;--text:#1b1f24;--muted:#57606a;--grid:#d9dde3;--stone:#f3f1ec;--edge:#8b8f96;"
    "--s0:#1b1f24;--s1:#0072b2;--s2:#c44e00;--s3:#00805d;--s4:#8a4f9e;--s5:#8c6d00;";
constexpr const char* kDark =
    "--page:#14171b;--text:#e6e8eb;--muted:#a2a9b2;--grid:#343a42;--stone:#23272d;--edge:#7d848d;"
    "--s0:#e6e8eb;--s1:#56b4e9;--s2:#ff9a57;--s3:#3fc59c;--s4:#cf9fe0;--s5:#e3c04a;";

constexpr const char* kDrawing = R"(svg{display:block;width:100%;height:auto;color-scheme:light dark}
svg text{font:13px system-ui,"DejaVu Sans",sans-serif;fill:var(--text);stroke:none}
svg text.small{font-size:12px;fill:var(--muted)}
svg text.strong{font-weight:600}
.page{fill:var(--page)}
.grid{stroke:var(--grid);fill:none}
.axis{stroke:var(--muted);fill:none}
.stone{fill:var(--stone);stroke:var(--edge);stroke-width:.7}
.gone{fill:transparent;stroke:var(--text);stroke-width:1.4;stroke-dasharray:4 2.5}
.block{stroke:var(--edge);stroke-width:.7}
.outline{fill:transparent;stroke:var(--edge);stroke-width:.6}
.stripe{stroke:var(--text);stroke-width:1.6;opacity:.55}
.striped{fill:url(#stripes);stroke:var(--edge);stroke-width:.7;pointer-events:none}
.mark{fill:none;stroke:var(--text);stroke-width:2.2}
svg text.tiny{font-size:8.5px;fill:var(--muted);pointer-events:none}
.mesh{fill-opacity:.3;stroke:var(--edge);stroke-width:.6}
svg text.label{font-size:12px;font-weight:600;paint-order:stroke;stroke:var(--page);stroke-width:3.5px;pointer-events:none}
.joint-sticking{fill:var(--muted)}
.joint-sliding{fill:var(--s2)}
.joint-open{fill:none;stroke:var(--s4);stroke-width:1.4;stroke-dasharray:3 2}
.thrust{stroke:var(--s1);stroke-width:2.4}
.silent{fill:var(--page);stroke:var(--muted);stroke-width:1.2}
.line{fill:none;stroke-width:1.8;stroke-linejoin:round}
.dashed{stroke-dasharray:6 4}
.dotted{stroke-dasharray:1.5 3.5;stroke-linecap:round}
.band{stroke:none;opacity:.2}
path.tip:hover,circle.tip:hover{stroke:var(--text);stroke-width:2.2}
)";

constexpr const char* kPage = R"(*{box-sizing:border-box}
html{background:var(--page);color:var(--text);font:16px/1.5 system-ui,"DejaVu Sans",sans-serif;color-scheme:light dark}
body{max-width:1080px;margin:0 auto;padding:1.5rem 1.25rem 4rem;overflow-wrap:break-word}
h1{font-size:1.75rem;line-height:1.2;margin:.3em 0 .4em}
h2{font-size:1.3rem;margin:2.4em 0 .5em;padding-top:.6em;border-top:1px solid var(--grid)}
h3{font-size:1.02rem;margin:0 0 .3em}
p{margin:.5em 0;max-width:75ch}
.lead{font-size:1.12rem}
.muted,figcaption{color:var(--muted)}
a{color:var(--s1)}
figure{margin:0;min-width:0}
figcaption{font-size:.9rem;margin:.3em 0}
.figures{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,350px),1fr));gap:1.8rem 1.6rem;margin:1.2em 0}
.thirds{grid-template-columns:repeat(auto-fit,minmax(min(100%,300px),1fr))}
.wide{grid-column:1/-1}
.pictures{display:grid;gap:.8rem}
.legend{display:flex;flex-wrap:wrap;gap:.1rem 1.1rem;margin:.2em 0 .4em;padding:0;list-style:none;font-size:.85rem}
.legend svg{display:inline-block;width:34px;height:12px;margin-right:.4em;vertical-align:-1px}
.scroll{overflow-x:auto;background:linear-gradient(to right,var(--page) 40%,transparent) left/2.5rem 100% local,
linear-gradient(to left,var(--page) 40%,transparent) right/2.5rem 100% local,
linear-gradient(to right,var(--edge),transparent) left/.7rem 100%,linear-gradient(to left,var(--edge),transparent) right/.7rem 100%;background-repeat:no-repeat}
details .scroll{overflow-y:auto;max-height:30rem}
table{border-collapse:collapse;font-size:.88rem;font-variant-numeric:tabular-nums;margin:.4em 0}
th{text-align:left;vertical-align:bottom;font-weight:600;border-bottom:1px solid var(--edge);padding:.25em .8em .25em 0}
td{vertical-align:top;border-bottom:1px solid var(--grid);padding:.2em .8em .2em 0}
table{overflow-wrap:normal}td:last-child:not(.number){min-width:9rem}
td.number,th.number{text-align:right}
td.number{white-space:nowrap}
summary{cursor:pointer;color:var(--s1);font-size:.88rem}
dl{display:grid;grid-template-columns:max-content 1fr;gap:.2em 1.2em;margin:.6em 0}
dt{color:var(--muted)}
dd{margin:0;min-width:0;overflow-wrap:anywhere}
.verdict{border-left:4px solid var(--edge);padding:.2em 0 .2em 1em}
.verdict.located,.verdict.damaged-unlocated{border-left-color:var(--s2)}
.verdict.unexplained,.verdict.cannot-tell{border-left-color:var(--s4)}
#tip{position:fixed;z-index:9;max-width:min(22rem,90vw);padding:.35em .6em;border-radius:5px;font-size:.85rem;line-height:1.35;
white-space:pre-line;background:var(--text);color:var(--page);pointer-events:none}
#tip[hidden]{display:none}
@media(max-width:640px){td:last-child:not(.number){min-width:19rem}body{padding:1rem .9rem 3rem}h1{font-size:1.4rem}dl{grid-template-columns:1fr}dd{margin-bottom:.4em}
svg text{font-size:16px}svg text.small{font-size:15px}.panorama text{font-size:26px}.panorama text.small{font-size:25px}.panorama text.label{font-size:24px}.panorama text.tiny,.panorama text.sensor{display:none}
.pictures svg{overflow:visible}
#candidates :is(table,thead,tbody){display:block}#candidates tr{display:grid;grid-template-columns:2.4rem minmax(0,1fr) 5.6rem 6.4rem;border-bottom:1px solid var(--grid)}
#candidates :is(td,th){border:0;min-width:0}#candidates :is(td,th):is(:nth-child(4),:nth-child(6)),#candidates th:nth-child(7){display:none}
#candidates td:nth-child(7){grid-column:2/-1;grid-row:2;color:var(--muted)}}
@media(min-width:641px) and (max-width:960px){svg text,svg text.small{font-size:14px}.panorama text,.panorama text.small,.panorama text.label{font-size:16px}}
@media print{table{font-size:8.2pt}td,th{padding-right:.55em}@page{size:A4;margin:15mm}html{font-size:10.5pt}body{max-width:none;padding:0}
.figures{grid-template-columns:1fr 1fr;gap:1rem}figure,table tr{break-inside:avoid}h2,h3{break-after:avoid}
.scroll,details .scroll{overflow:visible;max-height:none;background:none}summary{display:none}details.printed::details-content{content-visibility:visible;display:block}
#tip{display:none}}
)";

constexpr const char* kScript = R"('use strict';
const tip=document.getElementById('tip');
for(const title of document.querySelectorAll('svg title')){
const shape=title.parentNode;shape.dataset.tip=title.textContent;shape.classList.add('tip');title.remove()}
const show=event=>{
const shape=event.target.closest?event.target.closest('[data-tip]'):null;
tip.hidden=!shape;
if(!shape)return;
tip.textContent=shape.dataset.tip;
const box=tip.getBoundingClientRect();
tip.style.left=Math.max(4,Math.min(event.clientX+14,innerWidth-box.width-4))+'px';
tip.style.top=(event.clientY+18+box.height>innerHeight?event.clientY-box.height-10:event.clientY+18)+'px'};
document.addEventListener('pointermove',show);
document.addEventListener('pointerdown',show);
document.addEventListener('scroll',()=>{tip.hidden=true},{passive:true});
)";

std::string level_colours(Colour (*colour)(int)) {
  std::string text;
  for (int level = 0; level < kColourLevels; ++level)
    text += fmt::format("--m{}:{};", level, to_string(colour(level)));
  return text;
}

std::string classes() {
  std::string text;
  for (int level = 0; level < kColourLevels; ++level)
    text += fmt::format(".m{0}{{fill:var(--m{0});stroke:var(--m{0});stroke-width:.6}}\n", level);
  for (int series = 0; series < kSeriesColours; ++series)
    text += fmt::format(".s{0}{{stroke:var(--s{0})}}.f{0}{{fill:var(--s{0})}}\n", series);
  return text;
}

}  // namespace

std::string drawing_style() {
  return fmt::format(":root{{{}{}}}\n@media screen and (prefers-color-scheme:dark){{:root{{{}{}}}}}\n",
                     kLight, level_colours(light_colour), kDark, level_colours(dark_colour)) +
         classes() + kDrawing;
}

std::string page_style() {
  return kPage;
}

std::string page_script() {
  return kScript;
}

}  // namespace voussoir
