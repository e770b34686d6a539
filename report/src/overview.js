// What was computed: headline, facts, materials, springs, and the files the run leaves.
import { element, section } from "./dom.js";
import { quantity } from "./format.js";
import { tables } from "./table.js";
import { themeButton } from "./theme.js";

/** The head of the page; `links` are [id, text] of the sections present. */
export function header({ title, subtitle, facts = [], version }, links) {
  const fact = ({ label, value, unit }) => element("div", {},
    element("dt", { text: label }),
    element("dd", { title: typeof value === "string" ? null : String(value), text: quantity(value, unit, 5) }));
  return element("header", {},
    element("div", { class: "masthead" }, element("span", { class: "brand", text: version ? `Koshi ${version}` : "Koshi" }), themeButton()),
    element("h1", { text: title }),
    subtitle ? element("p", { class: "subtitle", text: subtitle }) : null,
    facts.length ? element("dl", { class: "facts" }, ...facts.map(fact)) : null,
    element("nav", { "aria-label": "Sections" }, ...links.map(([id, text]) => element("a", { href: `#${id}`, text }))));
}

/** What the springs were made from and the body was put to. */
export function model({ materials, conditions, springs, achieved }) {
  const titled = { Materials: materials, Springs: springs, "Supports and loads": conditions && { ...conditions, broad: true }, "Elastic constants: asked and achieved": achieved };
  return section("model", "Model", tables(Object.entries(titled).filter(([, block]) => block).map(([title, block]) => ({ title, ...block }))));
}

/** Input and summary as they are on disk, folded away. */
export function files({ case: text, summary }) {
  const folded = (title, content) => element("details", {}, element("summary", { text: title }), element("pre", { tabindex: 0, text: content }));
  return section("files", "Input and summary",
    text ? folded("Resolved input (resolved.toml)", text) : null,
    summary ? folded("Summary (summary.json)", JSON.stringify(summary, null, 2)) : null);
}
