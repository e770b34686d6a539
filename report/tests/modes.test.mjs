// The report of a search for modes in a real browser: its table, its samples, and the body that swings.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath, pathToFileURL } from "node:url";
import { openBrowser } from "../scripts/browser.mjs";

const program = process.env.KOSHI_PROGRAM;
const options = { skip: program ? false : "KOSHI_PROGRAM is not set" };
const fork = fileURLToPath(new URL("../../examples/50_tuning_fork/case.toml", import.meta.url));
const folder = mkdtempSync(join(tmpdir(), "koshi-modes-"));
const errors = [];
let browser;
let page;
let modes;

before(async () => {
  if (!program) return;
  execFileSync(program, ["run", fork, "--out", "out", "--quiet"], { cwd: folder });
  modes = JSON.parse(readFileSync(join(folder, "out/summary.json"), "utf8")).modes;
  browser = await openBrowser({ viewport: { width: 1280, height: 900 } });
  page = browser.context.pages()[0];
  page.on("pageerror", (error) => errors.push(error.message));
  await page.goto(pathToFileURL(join(folder, "out/report.html")).href);
});

after(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true, force: true });
});

const picture = async () => (await page.locator("#view canvas").screenshot()).toString("base64");

test("samples are modes by name, and their table is there", options, async () => {
  assert.equal(modes.length, 6);
  const label = (mode) => `mode ${mode.mode}, ${Number(mode.frequency.toPrecision(6))} Hz`;
  assert.equal(await page.locator("output[for=sample]").textContent(), label(modes[0]));
  await page.fill("#sample", "2");
  assert.equal(await page.locator("output[for=sample]").textContent(), label(modes[2]));
  const rows = await page.locator("#tables tbody tr").all();
  assert.equal(rows.length, 6);
  assert.equal(parseFloat(await rows[2].locator("td").first().textContent()), 3);
});

// The body is 0.14 m long, and the largest displacement of a shape 1 m: a tenth of the diagonal is what is drawn.
test("shapes are scaled to what can be seen", options, async () => {
  assert.equal(await page.inputValue("#scale-number"), "0.01");
  assert.equal(await page.getByTitle("True scale").count(), 0);
});

test("the body swings until it is stopped, then shows the whole shape", options, async () => {
  const whole = await picture();
  await page.getByRole("button", { name: "Let it swing" }).click();
  const seen = new Set();
  while (seen.size < 4) seen.add(await picture());
  await page.getByRole("button", { name: "Stop" }).click();
  assert.equal(await picture(), whole);
  assert.deepEqual(errors, []);
});
