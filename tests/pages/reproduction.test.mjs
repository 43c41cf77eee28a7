// The page of reproduce-paper on the small bridge, and query-field's pictures: their numbers against the database.
import assert from 'node:assert/strict';
import {readdirSync, readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {after, before, test} from 'node:test';

import {open, parseCsv, rowsOf, run, startBrowser, Workshop} from './workshop.mjs';

let shop, browser, made;

before(async () => {
  shop = new Workshop('--collapses', 'field');
  made = shop.reproduce('paper');
  browser = await startBrowser();
});
after(async () => {
  await browser?.close();
  shop?.remove();
});

const csv = name => parseCsv(readFileSync(join(made.folder, `${name}.csv`), 'utf8'));
const near = (a, b, relative = 1e-9) => Math.abs(a - b) <= relative * Math.max(Math.abs(a), Math.abs(b)) + 1e-12;
const points = scene => new Map(shop.control(scene).map(entry => [entry.point, entry.uy_m]));

test('The page loads without errors and fetches nothing, in light, dark and on a phone', async () => {
  for (const options of [{}, {colorScheme: 'dark'}, {viewport: {width: 390, height: 800}, isMobile: true}]) {
    const page = await open(browser, made.page, options);
    assert.deepEqual(page.faults, []);
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
  }
});

test('A database without fields of what falls is told at once that they are needed', () => {
  const outcomes = new Workshop();
  assert.throws(() => outcomes.reproduce('paper'), /of scene 0,6 .*expected one that stands, or a database built with --collapses field/);
  outcomes.remove();
});

test('Every figure has its CSV file, and its table on the page says the same', async () => {
  const page = await open(browser, made.page);
  const figures = await page.$$eval('figure', list => list.map(figure => figure.id));
  for (const wanted of ['figure-1', 'figure-2', 'figure-4', 'figure-6', 'figure-7', 'figure-8', 'figure-9', 'figure-10', 'table-2',
                        'table-3', 'table-2-posterior', 'table-3-posterior', 'operating-one', 'operating-two', 'findings-table'])
    assert.ok(figures.includes(wanted), wanted);
  let compared = 0;
  for (const id of figures) {
    const file = csv(id).map(row => Object.values(row));
    const table = await rowsOf(page, `#${id}`);
    assert.equal(table.length, file.length, id);
    for (let i = 0; i < file.length; ++i)
      for (let k = 0; k < file[i].length; ++k) {
        const number = file[i][k] !== '' && !Number.isNaN(Number(file[i][k]));
        assert.ok(number ? near(Number(table[i][k]), Number(file[i][k]), 1e-3) : table[i][k] === file[i][k],
                  `${id}: ${table[i][k]} is not ${file[i][k]}`);
        ++compared;
      }
  }
  assert.ok(compared > 1000);
});

test('Fig. 4 and the profiles of fields are the displacements in the database', () => {
  const intact = points('intact');
  for (const [figure, scene, name] of [['figure-4', '4,2', '(4,2)'], ['figure-8', '4,2', '(4,2)'], ['figure-9', '0,6', '(0,6)'],
                                       ['figure-10', '2,1+5,3', '(2,1) + (5,3)']]) {
    const damaged = points(scene);
    const rows = csv(figure);
    assert.equal(rows.length, intact.size);
    for (const row of rows) {
      assert.ok(near(Number(row['intact [mm]']), 1e3 * intact.get(row.point)), row.point);
      const uy = damaged.get(row.point);
      if (uy === null) assert.equal(row[`without ${name} [mm]`], '');
      else assert.ok(near(Number(row[`without ${name} [mm]`]), 1e3 * uy), row.point);
    }
  }
});

test('The noise of Fig. 4 stays within its 14 % and reaches beyond half of them', () => {
  const errors = csv('figure-4').filter(row => row['with 14 % noise [mm]'] !== '' && Math.abs(row['without (4,2) [mm]']) > 1e-6)
                     .map(row => Math.abs(row['with 14 % noise [mm]'] / row['without (4,2) [mm]'] - 1));
  assert.ok(errors.length > 20);
  assert.ok(Math.max(...errors) <= 0.14 + 1e-9);
  assert.ok(Math.max(...errors) > 0.07);
});

test('Fig. 6 is Eq. 1 of every block, computed anew from the displacements in the database', () => {
  const truth = points('4,2');
  const rows = csv('figure-6');
  assert.equal(rows.length, new Set(shop.field('intact').map(node => node.block)).size);
  for (const row of rows) {
    const other = points(row.block);
    let sum = 0;
    for (const [point, uy] of truth)
      if (uy !== null && other.get(point) !== null) sum += Math.abs(uy - other.get(point));
    assert.ok(near(Number(row.f_v), Math.log(sum + 1e-16), 1e-7), `${row.block}: ${row.f_v}, ${Math.log(sum + 1e-16)}`);
  }
  assert.equal(rows.reduce((best, row) => Number(row.f_v) < Number(best.f_v) ? row : best).block, '4,2');
});

test('The colour bars of the fields have even marks up to the ends of the displacements of all nodes', async () => {
  const page = await open(browser, made.page);
  for (const [figure, scene] of [['figure-8', '4,2'], ['figure-9', '0,6'], ['figure-10', '2,1+5,3']]) {
    const uy = shop.field(scene).map(node => 1e3 * node.uy_m);
    const marks = (await page.$$eval(`#${figure} .panorama text.small`, texts => texts.map(text => Number(text.textContent)))).sort((a, b) => b - a);
    const step = marks[0] - marks[1];
    assert.ok(step > 0 && marks.length > 2);
    marks.forEach((mark, i) => assert.ok(Math.abs(mark - (marks[0] - i * step)) < 1e-9 * Math.abs(marks[0]) + 1e-9, `${marks}`));
    const above = Math.max(...uy) - marks.at(0), below = marks.at(-1) - Math.min(...uy);
    assert.ok(above >= 0 && above < step && below >= 0 && below < step, `${marks} for ${Math.min(...uy)} to ${Math.max(...uy)}`);
    assert.equal(csv(`${figure}-field`).length, csv('figure-8-field').length);
  }
});

test('Shares are shares of the seeds, and at no noise every search finds the truth', () => {
  const runs = csv('figure-7');
  assert.equal(runs.length, 21);
  assert.equal(runs[0]['seeds that end at the truth'], runs[0].seeds);
  for (const table of ['table-2', 'table-3'])
    for (const row of csv(table)) assert.equal((Number(row['seeds that succeed [%]']) * 10) % 100, 0);
  for (const curve of ['operating-one', 'operating-two']) {
    const none = csv(curve)[0];
    assert.equal(none['noise [%]'], '0');
    assert.equal(none['Eq. 1: truth first [%]'], '100');
    assert.equal(none['posterior, noise unknown: truth first [%]'], '100');
  }
});

test('A second run gives the same files, byte for byte, on one thread', () => {
  const again = shop.reproduce('again', true);
  for (const file of readdirSync(made.folder))
    assert.ok(readFileSync(join(made.folder, file)).equals(readFileSync(join(again.folder, file))), file);
});

test('The page says of each finding of the paper whether it holds, by numbers', async () => {
  const page = await open(browser, made.page);
  const findings = await rowsOf(page, '#findings-table');
  assert.equal(findings.length, 4);
  for (const [claim, verdict, evidence] of findings) {
    assert.match(verdict, /^(holds|does not hold)$/, claim);
    assert.match(evidence, /\d/);
  }
});

test('Pointing at a block of a field shows its displacements', async () => {
  const page = await open(browser, made.page);
  const block = page.locator('#figure-8 [data-tip^="(5,1)"]');
  // Scrolling hides what is shown, and says so only with the next frame.
  await block.scrollIntoViewIfNeeded();
  await page.evaluate(() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done))));
  await block.hover();
  const uy = shop.field('4,2').filter(node => node.block === '5,1').map(node => 1e3 * node.uy_m);
  const text = (await page.locator('#tip:visible').textContent()).match(/uy (\S+) to (\S+) mm/);
  assert.ok(Math.abs(Number(text[1]) - Math.max(...uy)) < 5.1e-4);  // mm with three decimals
  assert.ok(Math.abs(Number(text[2]) - Math.min(...uy)) < 5.1e-4);
});

test("query-field's picture is an image of its own, in light and dark", async () => {
  writeFileSync(shop.path('field.svg'), run('query-field', '2,1+5,3', '-d', shop.database, '--format', 'svg'));
  writeFileSync(shop.path('field.html'), '<!DOCTYPE html><link rel="icon" href="data:,"><img src="field.svg">');
  for (const colorScheme of ['light', 'dark']) {
    const page = await open(browser, shop.path('field.html'), {colorScheme});
    assert.ok(await page.$eval('img', image => image.decode().then(() => image.naturalWidth)) > 500);
    assert.deepEqual(page.faults.filter(fault => !fault.endsWith('field.svg')), []);
  }
});
