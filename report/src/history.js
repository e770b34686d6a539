// Curves over the run: the plots the data ask for, one of the reader's own choice, and the convergence of a solve.
import { decode } from "./data.js";
import { element, section, select } from "./dom.js";
import { plot } from "./plot.js";

/** {node, start}; node is null when the data hold no history. */
export function history(block) {
  const columns = block?.columns ?? [];
  if (columns.length < 2) return { node: null, start() {} };
  const byName = new Map(columns.map((column) => [column.name, column]));
  const cards = (block.plots ?? []).map((wanted) => plot(chosen(wanted, byName)));
  const own = ownChoice(block, byName);
  const node = section("history", "History",
    element("div", { class: "cards" }, ...cards.map((card) => card.node), own.node));
  return { node, start: () => [...cards, own].forEach((card) => card.start()) };
}

// What names like "tip.displacement.x" and "tip.displacement.y" have in common, up to the last point.
function commonStart(names) {
  let length = 0;
  while (length < names[0].length && names.every((name) => name[length] === names[0][length])) ++length;
  return names[0].slice(0, names[0].lastIndexOf(".", length - 1) + 1);
}

// A plot of columns given by name; the y axis carries the first column's unit.
function chosen({ title, x, y, log }, byName) {
  const column = (name) => {
    if (!byName.has(name)) throw new Error(`the history has no column "${name}"`);
    return byName.get(name);
  };
  const [across, ...up] = [x, ...y].map(column);
  const common = up.length === 1 ? "" : commonStart(y);
  const label = up.length === 1 ? up[0].name : common.split(".").at(-2) ?? title.toLowerCase();
  return { title, x: { label: across.name, unit: across.unit }, y: { label, unit: up[0].unit, log },
    series: up.map(({ name, data }) => ({ name: name.slice(common.length), x: across.data, y: data })) };
}

function ownChoice({ columns, plots }, byName) {
  const names = columns.map(({ name }) => [name, name]);
  const x = select("Across", names, { id: "history-x" });
  const y = select("Up", names, { id: "history-y" });
  y.list.value = plots?.[0]?.y[0] ?? columns[1].name;
  const place = element("div", {});
  const show = () => {
    const title = `${y.list.value} against ${x.list.value}`;
    const card = plot(chosen({ title, x: x.list.value, y: [y.list.value] }, byName));
    place.replaceChildren(card.node);
    card.start();
  };
  for (const { list } of [x, y]) list.addEventListener("change", show);
  return { node: element("div", { class: "own-choice" }, element("div", { class: "inline" }, x.row, y.row), place), start: show };
}

/** {node, start} of the convergence section; node is null when the data hold none. */
export function convergence(block) {
  if (!block) return { node: null, start() {} };
  const residuals = Array.from(decode(block.residuals));
  const series = [{ name: "residual", x: residuals.map((_, i) => i), y: residuals, style: "line+points" }];
  if (block.tolerance > 0)
    series.push({ name: "tolerance", x: [0, residuals.length - 1], y: [block.tolerance, block.tolerance], style: "dashed" });
  const card = plot({ title: block.title ?? "Relative residual", x: { label: "iteration" }, y: { label: "residual", unit: "1", log: true }, series });
  return { node: section("convergence", "Convergence", element("div", { class: "cards" }, card.node)), start: card.start };
}
