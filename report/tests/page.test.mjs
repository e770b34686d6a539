// The built page, filled with the sample, in a real browser.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { openBrowser } from "../scripts/browser.mjs";
import { fill } from "../scripts/fill.mjs";
import { displacement, LOAD, makeSample } from "../scripts/sample.mjs";

const template = process.env.KOSHI_REPORT_TEMPLATE ?? new URL("../dist/report.html", import.meta.url);
const folder = mkdtempSync(join(tmpdir(), "koshi-page-"));
const data = makeSample();
const errors = [];
const requests = [];
let browser;
let page;

before(async () => {
  writeFileSync(join(folder, "sample.html"), fill(readFileSync(template, "utf8"), data));
  browser = await openBrowser({ viewport: { width: 1280, height: 900 }, colorScheme: "light" });
  page = browser.context.pages()[0];
  page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
  page.on("pageerror", (error) => errors.push(error.message));
  page.on("request", (request) => requests.push(request.url()));
  await page.goto(pathToFileURL(join(folder, "sample.html")).href);
});

after(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true, force: true });
});

// The picture of the body as a PNG data address.
async function picture() {
  return `data:image/png;base64,${(await page.locator("#view canvas").screenshot()).toString("base64")}`;
}

// Calls `judge` in the page with the pixels of pictures, [r, g, b, a, …] each.
function withPixels(addresses, judge) {
  return page.evaluate(async ([sources, text]) => {
    const all = await Promise.all(sources.map(async (source) => {
      const image = new Image();
      image.src = source;
      await image.decode();
      const context = new OffscreenCanvas(image.width, image.height).getContext("2d");
      context.drawImage(image, 0, 0);
      return context.getImageData(0, 0, image.width, image.height).data;
    }));
    return new Function(`return (${text})(...arguments)`)(...all);
  }, [addresses, judge.toString()]);
}

// Part of the pixels in which two pictures differ.
function difference(a, b) {
  let count = 0;
  for (let i = 0; i < a.length; i += 4) if (a[i] !== b[i] || a[i + 1] !== b[i + 1] || a[i + 2] !== b[i + 2]) ++count;
  return a.length === b.length ? count / (a.length / 4) : NaN;
}

async function changes(act, least, most = 0.9) {
  const old = await picture();
  await act();
  const part = await withPixels([old, await picture()], difference);
  assert.ok(part > least && part < most, `${part} of the pixels changed`);
}

// A number as the page writes it.
const parse = (text) => Number(text.replaceAll("\u2009", "").replace("∞", "Infinity"));
const close = (value, expected) => Math.abs(value - expected) <= 1e-5 * Math.abs(expected);

test("loads without errors and without asking the network", async () => {
  await page.waitForSelector("#view canvas");
  await page.waitForSelector("#history .main-svg");
  assert.deepEqual(errors, []);
  assert.equal(requests.length, 1, requests.join());
  assert.equal(await page.locator("h1").textContent(), data.title);
});

test("the body is drawn in the colours of the map", async () => {
  const { empty, colours } = await withPixels([await picture()], (pixels) => {
    const seen = new Set();
    let background = 0;
    for (let i = 0; i < pixels.length; i += 4) {
      seen.add((pixels[i] << 16) | (pixels[i + 1] << 8) | pixels[i + 2]);
      if (pixels[i] > 245 && pixels[i + 1] > 245 && pixels[i + 2] > 245) ++background;
    }
    return { empty: background / (pixels.length / 4), colours: seen.size };
  });
  assert.ok(empty > 0.2 && empty < 0.8, `${empty} of the picture is empty`);
  assert.ok(colours > 100 && colours < 50000, `${colours} colours`);
});

test("field, component, sample, deformation, outline and lines change the picture", async () => {
  await changes(() => page.selectOption("#component", "y"), 0.1);
  await changes(() => page.selectOption("#field", "material"), 0.1);
  assert.equal(await page.locator("#key .swatch").count(), 2);
  await changes(() => page.selectOption("#field", "displacement"), 0.1);
  await changes(() => page.fill("#sample", "0"), 0.1);
  await changes(() => page.fill("#sample", "2"), 0.1);
  await changes(() => page.fill("#scale", "100"), 0.05);
  await changes(() => page.getByRole("button", { name: "auto", exact: true }).last().click(), 0.05);
  await changes(() => page.uncheck("#outline"), 0.001, 0.1);
  await changes(() => page.check("#outline"), 0.001, 0.1);
  await changes(() => page.selectOption("#lines", "cells"), 0.01);
  await changes(() => page.selectOption("#lines", "edges"), 0.01);
});

test("the colour range can be set and comes back", async () => {
  await changes(() => page.locator("#range-max").fill("80").then(() => page.keyboard.press("Enter")), 0.05);
  assert.match(await page.locator("#key .bar").getAttribute("aria-label"), /to 80 µm/);
  await changes(() => page.getByRole("button", { name: "auto", exact: true }).first().click(), 0.05);
});

test("the cut takes part of the body away and shows cell borders", async () => {
  await changes(() => page.selectOption("#cut", "y"), 0.05);
  await changes(() => page.fill("#cut-position", "50"), 0.02);
  // A quarter of 39 layers of 2 mm: the border nearest to 19.5 mm is at 20 mm.
  assert.equal(await page.locator("output[for=cut-position]").textContent(), "y = 20\u00a0mm");
  await changes(() => page.uncheck("#cut-flip"), 0.05);
  await changes(() => page.selectOption("#cut", ""), 0.05);
});

test("keys turn and zoom the body, buttons look along the axes", async () => {
  await page.focus("#view");
  await changes(() => page.keyboard.press("ArrowLeft"), 0.05);
  await changes(() => page.keyboard.press("+"), 0.05);
  await changes(() => page.getByRole("button", { name: "x", exact: true }).click(), 0.05);
  await changes(() => page.getByRole("button", { name: "oblique" }).click(), 0.05);
});

test("a click tells the value of the point under it", async () => {
  const { x, y, width, height } = await page.locator("#view").boundingBox();
  await page.mouse.click(x + width / 2, y + height / 2);
  const text = await page.locator(".readout").textContent();
  const [, value, place] = text.match(/^magnitude = ([\d.]+)\u00a0µm at \((.*)\)$/) ?? assert.fail(text);
  const metres = place.split(", ").map((part) => parseFloat(part) * (part.endsWith("mm") ? 1e-3 : 1));
  assert.equal(metres.length, 3);
  const expected = Math.hypot(...displacement(metres, LOAD)) * 1e6;
  assert.ok(Math.abs(value - expected) < 1e-5 * expected + 1e-3, `${text}: ${expected} expected`);
  await page.mouse.click(x + 5, y + 5);
  assert.equal(await page.locator(".readout").textContent(), "");
});

test("tables show the values of the data", async () => {
  const factors = { "": 1, n: 1e-9, µ: 1e-6, m: 1e-3, k: 1e3, M: 1e6, G: 1e9 };
  let checked = 0;
  for (const [id, block] of [["probes", data.probes[0]], ["tables", data.tables[0]]]) {
    const heads = await page.locator(`#${id} th`).allTextContents();
    const rows = await page.locator(`#${id} tbody tr`).all();
    assert.equal(rows.length, block.rows.length);
    for (const [r, row] of rows.entries()) {
      const texts = await row.locator("td").allTextContents();
      texts.forEach((text, c) => {
        const expected = block.rows[r][c];
        if (typeof expected !== "number") return assert.equal(text, expected);
        const { unit } = block.columns[c];
        const shown = heads[c].match(/\[(.*)\]$/)?.[1] ?? "";
        const factor = unit ? factors[shown.slice(0, shown.length - unit.length)] : 1;
        assert.ok(close(parse(text) * factor, expected), `${text} [${shown}] for ${expected}`);
        ++checked;
      });
    }
  }
  assert.equal(checked, 6 + 12);
  assert.deepEqual(await page.locator("#timing h3").allTextContents(), ["Analysis", "Energy", "Performance"]);
  assert.deepEqual(await page.locator("#timing td").allTextContents(), ["iterations", "8", "ended by", "relative residual below tolerance",
    "elastic", "780.856\u00a0µJ", "wall time", "830\u00a0ms", "peak memory", "34.5\u00a0MB"]);
  // Names keep their underscores, symbols have subscripts.
  assert.deepEqual(await page.locator("#model .table").nth(2).locator("tr").last().locator("td").allTextContents(),
    ["tip_load", "y-max", "force", "(9.8, 0, 0)\u00a0N", "constant"]);
  assert.equal(await page.locator("#model .table").nth(1).locator("th sub").allTextContents().then((parts) => parts.join()), "n,t");
  assert.equal(await page.locator(".facts dd").first().textContent(), "18 × 78 × 18\u00a0mm");
  for (const id of ["model", "convergence", "figures", "files"]) assert.equal(await page.locator(`#${id}`).count(), 1, id);
  assert.equal(await page.locator("#files pre").first().textContent(), data.case);
  assert.equal(await page.locator("#mesh-note").textContent(), data.mesh.note);
});

test("plots hold the data's points and answer the chooser", async () => {
  // Three asked for and the reader's own; each with axis titles that carry units.
  assert.equal(await page.locator("#history .plot .main-svg .xtitle").count(), 4);
  assert.equal(await page.locator("#history .plot").first().locator(".xtitle").textContent(), "tip displacement x [µm]");
  assert.equal(await page.locator("#history .plot").first().locator(".ytitle").textContent(), "end force x [N]");
  const curve = await page.locator("#figures .plot").evaluate((node) => ({ names: node.data.map((trace) => trace.name), last: node.data[3].y.at(-1) }));
  assert.deepEqual(curve.names, data.curves[0].series.map(({ name }) => name));
  assert.ok(close(curve.last * 1e-6, data.curves[0].series[3].y.at(-1)));
  await page.selectOption("#history-y", "strain energy");
  assert.equal(await page.locator(".own-choice .ytitle").textContent(), "strain energy [µJ]");
  assert.equal(await page.locator("#convergence .plot").evaluate((node) => node.data[0].y.length), data.convergence.residuals.length);
});

test("figures show a picture for each panel", async () => {
  const sizes = await page.locator("#figures img").evaluateAll((images) => images.map((image) => image.src.length));
  assert.equal(sizes.length, 3);
  for (const size of sizes) assert.ok(size > 5000 && size < 5e6, `${size}`);
  assert.notEqual(sizes[0], sizes[1]);
  assert.deepEqual(await page.locator("#figures .caption").evaluateAll((all) => all.map((p) => p.innerHTML)), ["x", "y", "z"].map((c) => `u<sub>${c}</sub>`));
  assert.match(await page.locator("#figures figure").first().locator(".note").textContent(), /^Displacements drawn [125]0*\.?\d* times as large/);
});

test("dark theme and phone width leave nothing behind the edge", async () => {
  await page.click("#theme");
  await page.click("#theme");
  const colour = await page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  assert.equal(colour, "rgb(20, 23, 27)");
  await page.setViewportSize({ width: 390, height: 844 });
  // The page is laid out anew, some of it by observers that run later.
  await page.waitForFunction(() => document.documentElement.scrollWidth <= 390 && document.documentElement.scrollWidth > 380);
  assert.deepEqual(errors, []);
  assert.equal(requests.filter((url) => !url.startsWith("data:")).length, 1);
});

test("every control has a name", async () => {
  const nameless = await page.locator("input, select, button").evaluateAll((controls) =>
    controls.filter((c) => !(c.labels?.[0]?.textContent.trim() || c.getAttribute("aria-label") || c.textContent.trim())).map((c) => c.outerHTML));
  assert.deepEqual(nameless, []);
  assert.ok((await page.locator("input, select, button").count()) >= 20);
});

test("a template without data and data of another format say so", async () => {
  const html = readFileSync(template, "utf8");
  writeFileSync(join(folder, "empty.html"), html);
  await page.goto(pathToFileURL(join(folder, "empty.html")).href);
  assert.match(await page.locator("#page").textContent(), /empty template/);
  writeFileSync(join(folder, "other.html"), fill(html, { format: "koshi-report/9" }));
  await page.goto(pathToFileURL(join(folder, "other.html")).href);
  assert.match(await page.locator("[role=alert]").textContent(), /koshi-report\/9/);
});
