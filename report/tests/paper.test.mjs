// The paper's page in a real browser, from the data that test_paper_page wrote. KOSHI_PAPER_PAGE names them.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { openBrowser } from "../scripts/browser.mjs";
import { fill } from "../scripts/fill.mjs";

const source = process.env.KOSHI_PAPER_PAGE;
const options = { skip: source ? false : "KOSHI_PAPER_PAGE is not set" };
const template = process.env.KOSHI_REPORT_TEMPLATE ?? new URL("../dist/report.html", import.meta.url);
const folder = mkdtempSync(join(tmpdir(), "koshi-paper-"));
const errors = [];
let data;
let browser;
let page;

before(async () => {
  if (!source) return;
  data = JSON.parse(readFileSync(source, "utf8"));
  writeFileSync(join(folder, "paper.html"), fill(readFileSync(template, "utf8"), data));
  browser = await openBrowser({ viewport: { width: 1280, height: 900 } });
  page = browser.context.pages()[0];
  page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
  page.on("pageerror", (error) => errors.push(error.message));
  await page.goto(pathToFileURL(join(folder, "paper.html")).href);
  await page.waitForSelector("#figures .main-svg");
});

after(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true, force: true });
});

test("tables set paper and Koshi beside each other, in decimals and symbols", options, async () => {
  assert.deepEqual(errors, []);
  assert.equal(await page.locator("#tables table").count(), 3);
  const rows = page.locator("#tables .table").nth(1).locator("tbody tr");
  // -1e-9 is written as a plain zero; there is no deviation from a zero.
  assert.deepEqual(await rows.first().locator("td").allTextContents(), ["ν/ν0", "Cube-I", "0.000", "0.0000", "0.0000", "0.0000", "–", "yes"]);
  assert.equal(await rows.first().locator("td sub").textContent(), "0");
  const cantilever = await page.locator("#tables .table").nth(2).locator("tbody tr").first().locator("td").allTextContents();
  assert.deepEqual(cantilever.slice(2), ["0.0159", "0.01597", "0.01620", "0.00030", "1.89", "no"]);
});

test("Fig. 6 has a picture and a caption for each component and lattice", options, async () => {
  const captions = await page.locator("#figures .caption").evaluateAll((all) => all.map((node) => node.innerHTML));
  assert.deepEqual(captions, Array(3).fill(["(a) u<sub>x</sub>", "(b) u<sub>y</sub>", "(c) u<sub>z</sub>"]).flat());
  const sources = await page.locator("#figures img").evaluateAll((images) => images.map((image) => image.src));
  assert.equal(new Set(sources).size, 9);
  for (const address of sources) assert.ok(address.startsWith("data:image/png") && address.length > 5000, address.slice(0, 40));
});

test("Fig. 7 holds the curves of the three lattices, of the exact springs and of the theory", options, async () => {
  const traces = await page.locator("#figures .plot").first().evaluate((node) => node.data.map(({ name, y }) => ({ name, y: [...y] })));
  assert.deepEqual(traces.map(({ name }) => name), ["Cube-I", "Cube-II", "Cube-III", "exact springs", "Euler–Bernoulli"]);
  traces.forEach(({ y }, i) => assert.deepEqual(y, data.curves[0].series[i].y));
  // Plotly sets a subscript between zero-width spaces.
  const title = await page.locator("#figures .plot").first().locator(".ytitle").textContent();
  assert.equal(title.replaceAll("\u200b", ""), "ux [cm]");
});

test("the slider goes through the lattices", options, async () => {
  const names = [];
  const pictures = new Set();
  for (const sample of ["0", "1", "2", "3"]) {
    await page.fill("#sample", sample);
    names.push(await page.locator("output[for=sample]").textContent());
    pictures.add((await page.locator("#view canvas").screenshot()).toString("base64"));
  }
  assert.deepEqual(names, ["Cube-I", "Cube-II", "Cube-III", "exact springs"]);
  assert.equal(pictures.size, 4);
  assert.deepEqual(errors, []);
});
