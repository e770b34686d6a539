// Curves with hover, zoom and a legend, drawn by Plotly.
import Plotly from "plotly.js-basic-dist-min";
import { decode } from "./data.js";
import { element, subscripted } from "./dom.js";
import { labelled, magnitudeOf, prefixed, subscripts } from "./format.js";
import { colourOf, onTheme } from "./theme.js";

const STYLES = {
  line: { mode: "lines" },
  dashed: { mode: "lines", line: { dash: "dash", width: 1.6 } },
  points: { mode: "markers" },
  "line+points": { mode: "lines+markers" },
};
const COLOURS = ["--curve-1", "--curve-2", "--curve-3", "--curve-4", "--curve-5", "--curve-6"];
const HEIGHT = 340;
const PRINT_WIDTH = 330;  // two beside each other on A4, in CSS pixels

/**
 * A plot card. Call `start` of the result once it is on the page: Plotly measures its place.
 * @param {object} plot {title, x: {label, unit}, y: {label, unit, log?}, series: [{name, x, y, style?}], note?};
 *                      x and y of a series are Arrays of the data format; `equal`: both axes have one scale
 */
export function plot({ title, x, y, series, equal, note }) {
  const decoded = series.map((one) => ({ ...one, x: decode(one.x), y: decode(one.y) }));
  const place = element("div", { class: "plot", role: "img", "aria-label": `${title}: ${series.map(({ name }) => name).join(", ")}` });
  const node = element("figure", { class: "card" }, element("h3", {}, ...subscripted(title)), place, note ? element("p", { class: "note", text: note }) : null);

  // One prefix per axis, fit for the largest value on it.
  const unitX = prefixed(Math.max(...decoded.map((one) => magnitudeOf(one.x))), x.unit);
  const unitY = y.log ? { factor: 1, unit: y.unit } : prefixed(Math.max(...decoded.map((one) => magnitudeOf(one.y))), y.unit);
  const traces = () => decoded.map((one, i) => {
    const colour = colourOf(COLOURS[i % COLOURS.length]);
    const style = STYLES[one.style ?? "line"];
    return { type: "scatter", name: markup(one.name), x: Array.from(one.x, (v) => v / unitX.factor), y: Array.from(one.y, (v) => v / unitY.factor),
      ...style, line: { color: colour, width: 2, ...style.line }, marker: { color: colour, size: 6 },
      hovertemplate: "%{x:.5~g}, %{y:.5~g}<extra>%{fullData.name}</extra>" };
  });
  const draw = (print) => Plotly.react(place, traces(),
    { ...layout({ ...x, unit: unitX.unit }, { ...y, unit: unitY.unit }, series.length > 1, equal), ...(print ? { width: PRINT_WIDTH } : { autosize: true }) },
    { displaylogo: false, responsive: true, modeBarButtonsToRemove: ["select2d", "lasso2d", "autoScale2d"], toImageButtonOptions: { filename: title } });
  return { node, start: () => onTheme(draw) };
}

// Plotly's own markup of a text: "u_x" gets a real subscript.
function markup(text) {
  return subscripts(text.replaceAll("&", "&amp;").replaceAll("<", "&lt;")).map((part, i) => (i % 2 ? `<sub>${part}</sub>` : part)).join("");
}

function layout(x, y, legend, equal) {
  const ink = colourOf("--ink");
  const line = colourOf("--line");
  const axis = (label, unit, log) => ({ title: { text: markup(labelled(label, unit)), standoff: 10, font: { size: 13 } }, type: log ? "log" : "linear", gridcolor: line,
    zerolinecolor: line, linecolor: colourOf("--muted"), ticks: "outside", ticklen: 4, tickcolor: colourOf("--muted"), showline: true,
    automargin: true, exponentformat: "power", hoverformat: ".5~g", nticks: 7 });
  return { height: HEIGHT, margin: { l: 60, r: 16, t: 12, b: 48 }, paper_bgcolor: "rgba(0,0,0,0)", plot_bgcolor: "rgba(0,0,0,0)",
    font: { family: getComputedStyle(document.body).fontFamily, size: 12, color: ink }, xaxis: axis(x.label, x.unit, false),
    yaxis: { ...axis(y.label, y.unit, y.log), ...(equal ? { scaleanchor: "x" } : {}) }, showlegend: legend, legend: { orientation: "h", y: -0.24, yanchor: "top", font: { size: 12 } },
    hovermode: "closest", dragmode: "zoom", uirevision: "keep",
    hoverlabel: { bgcolor: colourOf("--card"), bordercolor: line, font: { color: ink } },
    modebar: { bgcolor: "rgba(0,0,0,0)", color: colourOf("--muted"), activecolor: ink } };
}
