// node scripts/make_sample.mjs OUT.html: the built template filled with the sample.
import { readFileSync, writeFileSync } from "node:fs";
import { fill } from "./fill.mjs";
import { makeSample } from "./sample.mjs";

const template = readFileSync(new URL("../dist/report.html", import.meta.url), "utf8");
writeFileSync(process.argv[2], fill(template, makeSample()));
