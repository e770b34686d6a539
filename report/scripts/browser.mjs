// Debian's Chromium without a screen: WebGL in software, nothing on the network.
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { chromium } from "playwright-core";

const FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
  "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"];

// Ends only what hangs; a busy machine may take its time [ms].
const PATIENCE = 600_000;

/**
 * Opens a browser with a new, empty profile.
 * @param {object} options of playwright's launchPersistentContext, e.g. {viewport, colorScheme}
 * @returns {Promise<{context, close}>}
 */
export async function openBrowser(options = {}) {
  const profile = mkdtempSync(join(tmpdir(), "koshi-report-"));
  const context = await chromium.launchPersistentContext(profile, {
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", headless: true, args: FLAGS, timeout: PATIENCE, ...options });
  context.setDefaultTimeout(PATIENCE);
  const close = async () => {
    await context.close();
    rmSync(profile, { recursive: true, force: true });
  };
  return { context, close };
}
