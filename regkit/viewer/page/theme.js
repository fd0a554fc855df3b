/** Light and dark: the system's choice, until the reader makes one. */

const root = document.documentElement;
const system = matchMedia("(prefers-color-scheme: dark)");

// An element that is not shown knows what a colour of the style is at present.
const probe = document.body.appendChild(document.createElement("span"));
probe.hidden = true;

/** Whether the page is dark at present. */
export const dark = () => (root.dataset.theme ?? (system.matches ? "dark" : "light")) === "dark";

/** Returns a colour of the style as it is at present. @param {string} name */
export function colour(name) {
  probe.style.color = `var(--${name})`;
  return getComputedStyle(probe).color;
}

/**
 * Returns a method's colour as it stands out at present: nearer to white on a dark page.
 * @param {string} given As #rrggbb.
 */
export function readable(given) {
  if (!dark()) return given;
  const lighter = (at) => Math.round(0.68 * parseInt(given.slice(at, at + 2), 16) + 0.32 * 255);
  return `rgb(${lighter(1)}, ${lighter(3)}, ${lighter(5)})`;
}

/** Lets a button switch between light and dark. @param {() => void} changed */
export function themeSwitch(button, changed) {
  button.addEventListener("click", () => {
    root.dataset.theme = dark() ? "light" : "dark";
    changed();
  });
  system.addEventListener("change", changed);
}
