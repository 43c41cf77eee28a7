// What the page tests share: the small bridge's database, pages made from it by the real programs, and a browser.
import {execFileSync} from 'node:child_process';
import {mkdtempSync, readFileSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {dirname, join} from 'node:path';
import {fileURLToPath, pathToFileURL} from 'node:url';

import {chromium} from 'playwright-core';

const here = dirname(fileURLToPath(import.meta.url));
const source = join(here, '..', '..');
const programs = process.env.VOUSSOIR_BIN_DIR ?? join(source, 'build', 'release', 'bin');

// Debian's chromium, run as root in CI, which fetches nothing of its own.
const browserOptions = {
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--headless', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking',
         '--disable-component-update', '--disable-sync', '--hide-scrollbars'],
};

export function run(program, ...args) {
  return execFileSync(join(programs, program), args, {encoding: 'utf8', maxBuffer: 1 << 28, stdio: ['ignore', 'pipe', 'pipe']});
}

// A folder with the small bridge's database, built with these options, and what the programs make of it.
export class Workshop {
  constructor(...options) {
    this.folder = mkdtempSync(join(tmpdir(), 'voussoir-pages-'));
    this.database = this.path('small.h5');
    run('build-database', join(source, 'examples', 'bridges', 'small.toml'), '-o', this.database, '--quiet', '--known-bridge',
        ...options);
  }
  path(name) { return join(this.folder, name); }
  read(name) { return readFileSync(this.path(name), 'utf8'); }

  // Readings of a scene, a report of them, and the answer that the report shows.
  report(name, scene, {noise = '1%', silent = '0%', seed = 1} = {}) {
    const readings = this.path(`${name}.csv`);
    run('make-measurements', scene, '-d', this.database, '--noise', noise, '--silent-sensors', silent, '--seed', String(seed),
        '-o', readings);
    const page = this.path(`${name}.html`);
    const answer = JSON.parse(run('locate-damage', readings, '-d', this.database, '--report', page, '--format', 'json'));
    return {page, readings, answer};
  }

  field(scene) { return JSON.parse(run('query-field', scene, '-d', this.database, '--format', 'json')); }
  control(scene) { return JSON.parse(run('query-field', scene, '-d', this.database, '--at', 'control', '--format', 'json')); }

  // The reproduction on this bridge; `oneProcessor`: on one thread.
  reproduce(name, oneProcessor = false) {
    const folder = this.path(name);
    const command = [join(programs, 'reproduce-paper'), '-d', this.database, '--cases', join(here, 'small-cases.json'), '-o', folder,
                     '--trials', '10', '--random-scenes', '10'];
    if (oneProcessor) command.unshift('taskset', '--cpu-list', '0');
    execFileSync(command[0], command.slice(1), {stdio: 'pipe'});
    return {folder, page: join(folder, 'index.html')};
  }
  remove() { rmSync(this.folder, {recursive: true, force: true}); }
}

// A browser with a fresh profile (playwright-core makes and removes one).
export async function startBrowser() { return chromium.launch(browserOptions); }

// Opens a file and notes what a page must not do: write errors to the console, throw, fetch.
export async function open(browser, file, options = {}) {
  const context = await browser.newContext({viewport: {width: 1100, height: 900}, ...options});
  const page = await context.newPage();
  page.faults = [];
  const address = pathToFileURL(file).href;
  page.on('console', message => { if (['error', 'warning'].includes(message.type())) page.faults.push(message.text()); });
  page.on('pageerror', error => page.faults.push(error.message));
  page.on('request', request => {
    if (request.url() !== address && !request.url().startsWith('data:')) page.faults.push(`fetched ${request.url()}`);
  });
  await page.goto(address);
  return page;
}

// The rows of a table on a page as lists of texts; the typographic minus reads as a hyphen.
export async function rowsOf(page, selector) {
  return page.$$eval(`${selector} tbody tr`,
                     rows => rows.map(row => [...row.cells].map(cell => cell.textContent.replaceAll('\u2212', '-'))));
}

// Rows of a CSV text as objects; quoted fields may hold commas.
export function parseCsv(text) {
  const [head, ...lines] = text.trim().split('\n').map(
      line => [...line.matchAll(/("(?:[^"]|"")*"|[^,]*)(?:,|$)/g)]
                  .slice(0, -1)
                  .map(match => match[1].startsWith('"') ? match[1].slice(1, -1).replaceAll('""', '"') : match[1]));
  return lines.map(line => Object.fromEntries(head.map((name, i) => [name, line[i] ?? ''])));
}

// Decodes screenshots and compares them, all within a page of the browser.
export class Eye {
  static async of(browser) {
    const eye = new Eye();
    eye.page = await browser.newPage();
    await eye.page.evaluate(() => {
      globalThis.decode = async base64 => {
        const bitmap = await createImageBitmap(await (await fetch(`data:image/png;base64,${base64}`)).blob());
        const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
        context.drawImage(bitmap, 0, 0);
        return context.getImageData(0, 0, bitmap.width, bitmap.height);
      };
    });
    return eye;
  }

  // The share of pixels within a dozen steps (each channel) of a colour such as "rgb(1, 2, 3)".
  shareOf(png, colour) {
    return this.page.evaluate(async ([image, wanted]) => {
      const {data} = await decode(image);
      let count = 0;
      for (let i = 0; i < data.length; i += 4) count += [0, 1, 2].every(c => Math.abs(data[i + c] - wanted[c]) <= 12);
      return 4 * count / data.length;
    }, [png.toString('base64'), colour.match(/\d+/g).map(Number)]);
  }

  // The share of pixels that differ clearly between two pictures of one width; what only one has is left out.
  difference(one, other) {
    return this.page.evaluate(async images => {
      const [a, b] = await Promise.all(images.map(image => decode(image)));
      if (a.width !== b.width) return 1;
      const size = Math.min(a.data.length, b.data.length);
      let count = 0;
      for (let i = 0; i < size; i += 4) count += [0, 1, 2].some(c => Math.abs(a.data[i + c] - b.data[i + c]) > 40);
      return 4 * count / size;
    }, [one.toString('base64'), other.toString('base64')]);
  }
}
