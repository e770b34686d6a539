// Real runs' reports in a real browser: what the page shows is what the files say. KOSHI_PROGRAM names the program.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { openBrowser } from "../scripts/browser.mjs";

const program = process.env.KOSHI_PROGRAM;
const options = { skip: program ? false : "KOSHI_PROGRAM is not set" };
const folder = mkdtempSync(join(tmpdir(), "koshi-run-"));
const errors = [];
let browser;
let page;
let summary;
let history;

// Two materials and a hole, pulled and held: probes of every size, eleven samples, a history.
const CASE = `
title = "Bar of <two> halves"
[lattice]
spacing = "1 cm"
[body]
size = ["4 cm", "12 cm", "4 cm"]
material = "soft"
[material.soft]
youngs_modulus = "1 GPa"
poissons_ratio = 0.2
density = 2000
[material.hard]
youngs_modulus = "5 GPa"
poissons_ratio = 0.3
density = 2500
[[region]]
shape = "box"
min = [0, "6 cm", 0]
max = ["4 cm", "12 cm", "4 cm"]
material = "hard"
[[region]]
shape = "box"
min = ["1 cm", "2 cm", 0]
max = ["3 cm", "4 cm", "4 cm"]
material = "void"
[[boundary]]
name = "root"
face = "y-min"
fix = ["x", "y", "z", "rx", "ry", "rz"]
[[boundary]]
name = "pull"
face = "y-max"
displacement = {y = "0.1 mm"}
ramp = "1 ms"
[analysis]
type = "dynamic"
duration = "4 ms"
damping = {kind = "local", factor = 0.5}
[[probe]]
name = "press"
face = "y-max"
quantity = "reaction"
[[probe]]
name = "side"
point = [0, "6 cm", "2 cm"]
quantity = "displacement"
[output]
fields = ["displacement", "velocity", "stress", "energy"]
every = "0.4 ms"
report = true
`;

before(async () => {
  if (!program) return;
  writeFileSync(join(folder, "case.toml"), CASE);
  // On two ranks, so that the fields lie in pieces.
  execFileSync(program, ["run", join(folder, "case.toml"), "--out", join(folder, "out"), "--quiet", "--ranks", "2"], { stdio: "inherit" });
  summary = JSON.parse(readFileSync(join(folder, "out/summary.json"), "utf8"));
  const rows = readFileSync(join(folder, "out/history.csv"), "utf8").trim().split("\n").map((row) => row.split(","));
  history = { names: rows[0], rows: rows.slice(1).map((row) => row.map(Number)) };
  browser = await openBrowser({ viewport: { width: 1280, height: 900 } });
  page = browser.context.pages()[0];
  page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
  page.on("pageerror", (error) => errors.push(error.message));
  await page.goto(pathToFileURL(join(folder, "out/report.html")).href);
});

after(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true, force: true });
});

test("the page opens with the run's title, sizes and no error", options, async () => {
  assert.equal(await page.locator("h1").textContent(), "Bar of <two> halves");
  assert.deepEqual(errors, []);
  const facts = await page.locator(".facts dd").allTextContents();
  // 4 x 12 x 4 cells less the hole of 2 x 2 x 4.
  assert.deepEqual(facts.slice(0, 3), ["40 × 120 × 40\u00a0mm", "10\u00a0mm", "176"]);
  assert.equal(await page.locator("#sample").getAttribute("max"), "10");
});

test("probes carry the summary's numbers", options, async () => {
  const shown = await page.locator("#probes td[data-value]").evaluateAll((cells) => cells.map((cell) => Number(cell.dataset.value)));
  const { press, side } = summary.probes;
  assert.deepEqual(shown, [...side.displacement, ...press.reaction]);
  // Sections in series, stresses even across each, bound the force from above: 0.1 mm over 40 mm of soft full section,
  // 20 mm of half of it, 60 mm of hard: 1739 N. Beside the hole stresses are uneven, which takes less than a quarter.
  assert.ok(press.reaction[1] > 1300 && press.reaction[1] < 1739, `${press.reaction[1]} N`);
});

test("curves end where the history ends", options, async () => {
  const last = history.rows.at(-1);
  const column = (name) => last[history.names.indexOf(name)];
  const { x, y } = await page.locator("#history .plot").first().evaluate((node) => {
    const [trace] = node.data;
    return { x: trace.x.at(-1), y: trace.y.at(-1) };
  });
  assert.equal(await page.locator("#history .plot").first().locator(".ytitle").textContent(), "press.reaction.y [kN]");
  assert.ok(Math.abs(y * 1e3 - column("press.reaction.y [N]")) < 1e-9 * Math.abs(y * 1e3));
  // The face is pulled by 0.1 mm.
  assert.equal(await page.locator("#history .plot").first().locator(".xtitle").textContent(), "pull displacement y [µm]");
  assert.ok(Math.abs(x - 100) < 1e-9, `${x} µm`);
  const side = await page.locator("#history .plot").nth(4).evaluate((node) => [node.data[1].name, node.data[1].y.at(-1)]);
  assert.equal(side[0], "y");
  assert.ok(Math.abs(side[1] * 1e-6 - column("side.displacement.y [m]")) < 1e-9 * Math.abs(side[1] * 1e-6));
  assert.ok(history.rows.length > 20);
});

test("the colour range is that of the field", options, async () => {
  // The pulled face moves by 0.1 mm along y, the root not at all; waves overshoot by less than the same again.
  await page.selectOption("#component", "y");
  const to = Number(await page.inputValue("#range-max"));
  assert.match(await page.locator("#key .bar-title").textContent(), /displacement, y \[µm\]/);
  assert.ok(to >= 100 && to < 200, `${to} µm`);
  await page.selectOption("#field", "material");
  assert.deepEqual(await page.locator("#key .swatch").allTextContents(), ["soft", "hard"]);
  await page.selectOption("#field", "energy");
  assert.match(await page.locator("#key .bar-title").textContent(), /energy \[k?J\/m³\]/);
  assert.deepEqual(errors, []);
});

test("the slider goes through the samples of the collection", options, async () => {
  const times = [...readFileSync(join(folder, "out/fields.pvd"), "utf8").matchAll(/timestep="([^"]*)"/g)].map((match) => Number(match[1]));
  assert.equal(times.length, 11);
  await page.selectOption("#field", "displacement");
  const pictures = new Set();
  for (const [sample, time] of times.entries()) {
    await page.fill("#sample", String(sample));
    const [, value, unit] = (await page.locator("output[for=sample]").textContent()).match(/^t = ([\d.]+)\u00a0(.*)$/);
    const seconds = value * { s: 1, ms: 1e-3, "µs": 1e-6 }[unit];
    assert.ok(Math.abs(seconds - time) <= 5e-4 * time, `${value} ${unit} for ${time} s`);
    pictures.add((await page.locator("#view canvas").screenshot()).toString("base64"));
  }
  assert.equal(pictures.size, times.length);
  assert.deepEqual(errors, []);
});

test("a static solve shows its residuals down to the tolerance", options, async () => {
  const out = join(folder, "static");
  execFileSync(program, ["run", new URL("../../examples/03_cantilever_exact/case.toml", import.meta.url).pathname, "--out", out, "--quiet",
    "--set", "output.report=true"], { stdio: "inherit" });
  const { analysis } = JSON.parse(readFileSync(join(out, "summary.json"), "utf8"));
  await page.goto(pathToFileURL(join(out, "report.html")).href);
  const [residual, tolerance] = await page.locator("#convergence .plot").evaluate((node) => node.data.map(({ x, y }) => ({ x: [...x], y: [...y] })));
  assert.deepEqual(residual.y, analysis.residual_history);
  assert.deepEqual(residual.x, analysis.residual_history.map((_, i) => i));
  assert.equal(residual.y.length, analysis.iterations + 1);
  assert.ok(residual.y.at(-1) < tolerance.y[0] && residual.y.at(-2) > tolerance.y[0], `${residual.y.slice(-2)} about ${tolerance.y[0]}`);
  assert.equal(await page.locator("#convergence .plot").evaluate((node) => node.layout.yaxis.type), "log");
  // One row is no history.
  assert.equal(await page.locator("#history").count(), 0);
  assert.deepEqual(errors, []);
});

test("a body with cut cells shows its true surface, and its cells on demand", options, async () => {
  const out = join(folder, "tube");
  execFileSync(program, ["run", new URL("../../examples/40_pressurised_tube/case.toml", import.meta.url).pathname, "--out", out, "--quiet",
    "--set", "output.report=true", "--set", "lattice.spacing=0.01"], { stdio: "inherit" });
  await page.goto(pathToFileURL(join(out, "report.html")).href);
  const picture = async () => (await page.locator("#view canvas").screenshot()).toString("base64");
  assert.equal(await page.inputValue("#surface"), "true");
  const smooth = await picture();
  await page.selectOption("#surface", "cells");
  const cells = await picture();
  assert.notEqual(cells, smooth);
  // Lines of cells and a cut go with both.
  await page.selectOption("#lines", "cells");
  await page.selectOption("#cut", "x");
  await page.selectOption("#surface", "true");
  assert.notEqual(await picture(), smooth);
  await page.selectOption("#lines", "edges");
  await page.selectOption("#cut", "");
  assert.equal(await picture(), smooth);
  assert.deepEqual(errors, []);
});
