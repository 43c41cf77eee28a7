// The page of `locate-damage --report` in a real browser.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {after, before, test} from 'node:test';

import {Eye, open, rowsOf, startBrowser, Workshop} from './workshop.mjs';

let shop, browser, eye, single, silent;

before(async () => {
  shop = new Workshop();
  single = shop.report('single', '4,2');
  silent = shop.report('silent', '5,3', {silent: '40%', seed: 3});
  browser = await startBrowser();
  eye = await Eye.of(browser);
});
after(async () => {
  await browser?.close();
  shop?.remove();
});

// Relative luminance and contrast as WCAG 2 defines them.
const contrastOfText = page => page.evaluate(() => {
  const luminance = colour => {
    const [r, g, b] = colour.match(/[\d.]+/g).map(Number).map(c => (c /= 255) <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const background = luminance(getComputedStyle(document.documentElement).backgroundColor);
  return Math.min(...[...document.querySelectorAll('p, td, th, dt, dd, figcaption, summary, svg text:not(.label)')].map(element => {
    const style = getComputedStyle(element);
    const text = luminance(element instanceof SVGElement ? style.fill : style.color);
    return (Math.max(text, background) + 0.05) / (Math.min(text, background) + 0.05);
  }));
});

test('The page loads without errors, fetches nothing and lists the candidates as the JSON answer does', async () => {
  const page = await open(browser, single.page);
  const rows = await rowsOf(page, '#candidates');
  assert.equal(rows[0][1], '4,2');
  assert.deepEqual(rows.map(row => row[1]), single.answer.candidates.map(candidate => candidate.scene));
  assert.match(await page.textContent('.verdict'), /Most likely: 4,2 \(/);
  assert.match(await page.textContent('#assumed'), new RegExp(single.answer.database.digest));
  assert.deepEqual(page.faults, []);
});

test('A page that tried to fetch something would be stopped, and noticed here', async () => {
  const page = await open(browser, single.page);
  await page.evaluate(() => { document.body.append(Object.assign(new Image(), {src: 'https://example.invalid/x.png'})); });
  await page.waitForTimeout(200);
  assert.ok(page.faults.some(fault => /Content Security Policy/.test(fault)), page.faults.join());
});

test('Pointing at a block shows its index, place and probability; touching does as well', async () => {
  const probability = single.answer.posterior.blocks.find(entry => entry.block === '4,2').probability;
  const wanted = probability > 0.999 ? /> 99\.9 %|100 %/ : new RegExp(`${(100 * probability).toFixed(1)} %`);
  for (const hasTouch of [false, true]) {
    const page = await open(browser, single.page, {hasTouch});
    const block = page.locator('#bridge [data-tip^="Block (4,2)"]');
    const box = await block.boundingBox();
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
    assert.ok(await page.locator('#tip').isHidden());
    await (hasTouch ? page.touchscreen.tap(x, y) : page.mouse.move(x, y));
    const text = await page.locator('#tip:visible').textContent();
    assert.match(text, /Block \(4,2\)/);
    assert.match(text, /course 4, 2nd from the left, x .* m, y .* m/);
    assert.match(text, wanted);
    if (!hasTouch) {
      await page.mouse.move(1, 1);
      assert.ok(await page.locator('#tip').isHidden());
    }
    assert.deepEqual(page.faults, []);
  }
});

test('Every control point is drawn, hollow where the sensor is silent', async () => {
  const page = await open(browser, silent.page);
  const points = shop.control('intact').length;
  const readings = readFileSync(silent.readings, 'utf8').split('\n').filter(line => /^[TA]\d+,-?\d/.test(line)).length;
  assert.equal(await page.locator('#bridge circle').count(), points);
  assert.equal(await page.locator('#bridge circle.silent').count(), points - readings);
  assert.ok(readings < points);
});

test('A table stands beside every picture, and the readings in it are those of the file', async () => {
  const page = await open(browser, silent.page);
  assert.deepEqual(await page.$$eval('figure', figures => figures.filter(f => f.querySelector('svg') && !f.querySelector('table')).map(f => f.id)), []);
  const inFile = new Map(readFileSync(silent.readings, 'utf8').split('\n').filter(line => /^[TA]\d/.test(line)).map(line => line.split(',')));
  let compared = 0;
  for (const row of [...await rowsOf(page, '#profile-top'), ...await rowsOf(page, '#profile-arch')]) {
    const reading = inFile.get(row[0]);
    const shown = 0.5 * 10 ** -(row[2].split('.')[1] ?? '').length;  // half of the last decimal
    if (reading) assert.ok(shown <= 0.5e-3 && Math.abs(Number(row[2]) - Number(reading)) <= shown + 1e-9, row.join());
    else assert.equal(row[2], '');
    ++compared;
  }
  assert.equal(compared, shop.control('intact').length);
  await page.click('#profile-top summary');
  assert.ok(await page.locator('#profile-top table').isVisible());
});

test('The missing block has the deepest colour, on a light and on a dark page', async () => {
  for (const colorScheme of ['light', 'dark']) {
    const page = await open(browser, single.page, {colorScheme});
    const block = page.locator('#bridge [data-tip^="Block (4,2)"]');
    const colour = await block.evaluate(element => getComputedStyle(element).fill);
    const deepest = await page.evaluate(() => getComputedStyle(document.querySelector('#bridge rect.m19')).fill);
    assert.equal(colour, deepest);
    assert.ok(await contrastOfText(page) >= 4.5, `contrast of ${colorScheme}`);
    const svg = page.locator('#bridge svg');
    const box = await block.boundingBox(), whole = await svg.boundingBox();
    const expected = (box.width * box.height) / (whole.width * whole.height);
    const drawn = await eye.shareOf(await svg.screenshot(), colour);
    assert.ok(drawn > 0.6 * expected && drawn < 2.5 * expected, `${drawn} of the picture, the block is ${expected}`);
  }
});

test('Two renderings of a page look the same, those of two answers do not', async () => {
  const render = async file => {
    const page = await open(browser, file);
    return page.locator('#bridge svg').screenshot();
  };
  const [first, again, other] = [await render(single.page), await render(single.page), await render(silent.page)];
  assert.ok(await eye.difference(first, again) < 0.002);
  assert.ok(await eye.difference(first, other) > 0.005);
});

test('On a phone nothing sticks out and all writing can be read', async () => {
  const page = await open(browser, silent.page, {viewport: {width: 390, height: 800}, isMobile: true, hasTouch: true, deviceScaleFactor: 2});
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
  const smallest = await page.$$eval('svg text', texts => Math.min(...texts.map(text => {
    const scale = text.ownerSVGElement.getBoundingClientRect().width / text.ownerSVGElement.viewBox.baseVal.width;
    return scale * parseFloat(getComputedStyle(text).fontSize);
  })));
  assert.ok(smallest >= 8, `the smallest writing is ${smallest} px high`);
  assert.deepEqual(page.faults, []);
});

test('On a phone every candidate says where it is, below its name', async () => {
  const page = await open(browser, silent.page, {viewport: {width: 390, height: 800}, isMobile: true, hasTouch: true});
  const rows = page.locator('#candidates tbody tr');
  for (let i = 0; i < await rows.count(); ++i) {
    const cells = rows.nth(i).locator('td');
    const scene = await cells.nth(1).boundingBox(), where = await cells.nth(6).boundingBox(), behind = await cells.nth(4).boundingBox();
    assert.ok(where.y >= scene.y + scene.height - 1 && where.x >= 0 && where.x + where.width <= 390, JSON.stringify(where));
    assert.ok(behind.x + behind.width <= 390, JSON.stringify(behind));
    assert.ok(await cells.nth(3).isHidden() && await cells.nth(5).isHidden());
  }
});

test('The bar beside the verdict has a colour of its own for what is found, on light and dark pages and on paper', async () => {
  const colour = (page, verdict) => page.evaluate(name => {
    const box = document.querySelector('.verdict');
    box.className = `verdict ${name}`;
    return getComputedStyle(box).borderLeftColor;
  }, verdict);
  for (const media of [{colorScheme: 'light'}, {colorScheme: 'dark'}, {media: 'print'}]) {
    const page = await open(browser, single.page);
    assert.match(await page.getAttribute('.verdict', 'class'), /^verdict located$/);
    await page.emulateMedia(media);
    const [found, intact, unknown] = [await colour(page, 'located'), await colour(page, 'intact'), await colour(page, 'cannot-tell')];
    assert.equal(new Set([found, intact, unknown]).size, 3);
    assert.equal(await colour(page, 'damaged-unlocated'), found);
    assert.equal(await colour(page, 'unexplained'), unknown);
  }
});

test('Printed on A4 all tables are there and nothing is cut off', async () => {
  const page = await open(browser, single.page, {viewport: {width: 680, height: 960}, colorScheme: 'dark'});
  await page.emulateMedia({media: 'print'});
  assert.equal(await page.evaluate(() => getComputedStyle(document.documentElement).backgroundColor), 'rgb(255, 255, 255)');
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
  for (const id of ['bridge', 'candidates', 'residual-top', 'residual-arch'])
    assert.ok((await page.locator(`#${id} table`).boundingBox()).height > 20, id);
  assert.ok(await page.$$eval('#bridge .scroll, #residual-arch .scroll', boxes => boxes.every(box => box.scrollHeight <= box.clientHeight)));
  const pdf = (await page.pdf({format: 'A4', preferCSSPageSize: true})).toString('latin1');
  const pages = (pdf.match(/\/Type\s*\/Page\b/g) ?? []).length;
  assert.ok(pages >= 2 && pages <= 8, `${pages} pages`);
});
