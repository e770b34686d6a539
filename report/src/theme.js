// Light and dark: the system's choice unless the reader makes another; paper is always light.
import { element } from "./dom.js";

const CHOICES = ["auto", "light", "dark"];
const listeners = [];
const system = matchMedia("(prefers-color-scheme: dark)");

/** Calls `listener(print)` now and whenever the page's colours change; `print` tells that paper is next. */
export function onTheme(listener) {
  listeners.push(listener);
  listener(false);
}

function notify(print) {
  for (const listener of listeners) listener(print);
}

/** A custom property of the page as a plain CSS colour. */
export function colourOf(property) {
  const probe = element("i", { style: `color:var(${property});display:none` });
  document.body.append(probe);
  const { color } = getComputedStyle(probe);
  probe.remove();
  return color;
}

/** The button that changes the theme. */
export function themeButton() {
  let choice = "auto";
  const apply = (theme, print = false) => {
    document.documentElement.dataset.theme = theme;
    notify(print);
  };
  const button = element("button", { type: "button", id: "theme", text: "theme: auto", on: { click: () => {
    choice = CHOICES[(CHOICES.indexOf(choice) + 1) % CHOICES.length];
    button.textContent = `theme: ${choice}`;
    apply(choice);
  } } });
  system.addEventListener("change", () => notify(false));
  addEventListener("beforeprint", () => apply("light", true));
  addEventListener("afterprint", () => apply(choice));
  return button;
}
