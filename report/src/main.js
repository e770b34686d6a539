// The page: reads the data block, builds the sections it has data for, then starts what needs a place to measure.
import { readBlock } from "./data.js";
import { element, section } from "./dom.js";
import { figure } from "./figures.js";
import { convergence, history } from "./history.js";
import { files, header, model } from "./overview.js";
import { plot } from "./plot.js";
import { table, tables } from "./table.js";
import { viewer } from "./viewer.js";

function build(data) {
  document.title = `${data.title} – Koshi`;
  const body = viewer(data.mesh);
  const figures = (data.figures ?? []).map((block) => figure(block, body.body));
  const curves = (data.curves ?? []).map(plot);
  const cards = [...figures, ...curves];
  const past = history(data.history);
  const solve = convergence(data.convergence);
  const own = (data.tables ?? []).map(table);

  const sections = [
    body?.node,
    section("tables", "Tables", ...own),
    cards.length ? section("figures", "Figures", element("div", { class: "cards" }, ...cards.map(({ node }) => node))) : null,
    section("probes", "Probes", ...(data.probes ?? []).map(table)),
    past.node,
    solve.node,
    hasRows(data.materials, data.conditions, data.springs, data.achieved) ? model(data) : null,
    section("timing", "Run", tables(data.timing)),
    files(data),
  ].filter(Boolean);
  const links = sections.map((node) => [node.id, node.querySelector("h2").textContent]);
  document.getElementById("page").replaceChildren(header(data, links), element("main", {}, ...sections));
  for (const part of [body, ...cards, past, solve]) part?.start();
}

function hasRows(...tables) {
  return tables.some((block) => block?.rows?.length);
}

try {
  const data = readBlock();
  if (data) build(data);
  else document.getElementById("page").append(element("p", { text: "This is the empty template of a Koshi report; koshi report DIR fills it." }));
} catch (error) {
  document.getElementById("page").replaceChildren(element("p", { role: "alert", text: `This report cannot be shown: ${error.message}` }));
  throw error;
}
