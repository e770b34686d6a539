// Building the page: elements, sections, lists.
import { subscripts } from "./format.js";

/**
 * A new element.
 * @param {string} tag
 * @param {object} properties attributes; `class`, `text`, `on` ({event: handler}) and `dataset` are understood
 * @param {...(Node|string|null)} children nulls are left out
 */
export function element(tag, properties = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (value === undefined || value === null || value === false) continue;
    if (name === "text") node.textContent = value;
    else if (name === "dataset") Object.assign(node.dataset, value);
    else if (name === "on") for (const [event, handler] of Object.entries(value)) node.addEventListener(event, handler);
    else node.setAttribute(name, value === true ? "" : value);
  }
  node.append(...children.filter((child) => child !== null && child !== undefined));
  return node;
}

/** A text in which "E_x" has a real subscript, as nodes. */
export function subscripted(text) {
  return subscripts(text).map((part, i) => (i % 2 ? element("sub", { text: part }) : part));
}

/** A section of the page with its heading, or null when there is nothing to put in it. */
export function section(id, title, ...children) {
  const present = children.flat().filter(Boolean);
  if (present.length === 0) return null;
  return element("section", { id, "aria-labelledby": `${id}-title` }, element("h2", { id: `${id}-title`, text: title }), ...present);
}

/** A labelled <select>; `options` are [value, text] pairs or {group, options}. */
export function select(label, options, attributes = {}) {
  const option = ([value, text]) => element("option", { value, text });
  const list = element("select", attributes);
  for (const entry of options)
    list.append(entry.group ? element("optgroup", { label: entry.group }, ...entry.options.map(option)) : option(entry));
  return { list, row: element("label", { class: "control" }, element("span", { text: label }), list) };
}
