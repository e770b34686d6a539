// node scripts/screenshot.mjs REPORT.html OUT.png [--select field=displacement:x]... [--look y] [--press ArrowLeft]...
//      [--only SELECTOR] [--width 1280] [--height 900] [--scale 2] [--margin 0] [--dark] [--full]
// Sets controls of the page (by id; field=NAME:COMPONENT sets both lists), looks along an axis, presses keys on the view,
// and saves a picture of the window, of the whole page (--full) or of the first element that matches a CSS selector
// (--only '#figures figure'); --scale gives the picture's pixels for each of the page's, --margin the element's border.
import { parseArgs } from "node:util";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { openBrowser } from "./browser.mjs";

const { values: options, positionals } = parseArgs({ allowPositionals: true, options: {
  select: { type: "string", multiple: true, default: [] }, press: { type: "string", multiple: true, default: [] },
  look: { type: "string" }, only: { type: "string" }, width: { type: "string", default: "1280" },
  height: { type: "string", default: "900" }, scale: { type: "string", default: "2" }, margin: { type: "string" },
  dark: { type: "boolean", default: false }, full: { type: "boolean", default: false } } });
if (positionals.length !== 2) throw new Error("usage: screenshot.mjs REPORT.html OUT.png [options]");

const browser = await openBrowser({ viewport: { width: Number(options.width), height: Number(options.height) },
  deviceScaleFactor: Number(options.scale), colorScheme: options.dark ? "dark" : "light" });
try {
  const page = browser.context.pages()[0];
  await page.goto(pathToFileURL(resolve(positionals[0])).href);
  for (const choice of options.select) await set(page, ...choice.split(/=(.*)/s));
  if (options.look) await page.getByTitle(`Look along ${options.look}`).click();
  for (const key of options.press) await page.locator("#view").press(key);
  await page.evaluate(() => document.activeElement?.blur());
  await page.waitForTimeout(500);  // transitions of the plots
  const target = options.only ? page.locator(options.only).first() : page;
  if (options.only && options.margin) await target.evaluate((node, margin) => (node.style.padding = `${margin}px`), options.margin);
  await target.screenshot({ path: positionals[1], ...(options.only ? {} : { fullPage: options.full }) });
} finally {
  await browser.close();
}

async function set(page, id, value) {
  const control = page.locator(`#${id}`);
  const kind = await control.evaluate((node) => (node.tagName === "SELECT" ? "select" : node.type));
  if (kind === "checkbox") await control.setChecked(value === "true");
  else if (kind !== "select") {
    await control.fill(value);
    await control.press("Enter");  // number boxes take effect then
  }
  else {
    const [name, component] = value.split(":");
    await control.selectOption(name);
    if (component) await page.locator("#component").selectOption(component);
  }
}
