/** The methods beside the scene: their switches, verdicts and values in the frame. */

import { readable } from "./theme.js";

/** Segments with less confidence are named. */
const UNSURE = 0.35;
const NAMED = 4;

/** Returns an element with a class and text, which is never markup. */
export function element(tag, name = "", text = "") {
  const made = document.createElement(tag);
  if (name) made.className = name;
  made.textContent = text;
  return made;
}

/** Returns a value of a curve at a frame: that of the nearest frame that has one. */
export function valueAt({ frames, values }, number) {
  let [low, high] = [0, frames.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (frames[middle] < number) low = middle + 1;
    else high = middle;
  }
  const before =
    low > 0 && (low === frames.length || number - frames[low - 1] < frames[low] - number);
  return values[before ? low - 1 : low] ?? NaN;
}

/** Returns a value with its unit, in three digits. */
export function quantity(value, unit) {
  if (!Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  const digits = size === 0 || size >= 100 ? 0 : size >= 10 ? 1 : size >= 0.01 ? 2 : 4;
  return `${value.toFixed(digits)}${unit ? ` ${unit}` : ""}`;
}

export class Panel {
  /**
   * @param {HTMLElement} list
   * @param {import("./display.js").Display} display
   * @param {() => void} changed
   */
  constructor(list, display, changed) {
    this.list = list;
    this.display = display;
    this.changed = changed;
  }

  /** Lists a recording's methods. @param {import("./recording.js").Recording} recording */
  open(recording) {
    this.items = recording.methods.map((method) => this.item(method));
    this.list.replaceChildren(...this.items.map((item) => item.row));
    this.paint();
  }

  /** Takes the methods' colours as they are at present. */
  paint() {
    for (const { row, method } of this.items)
      row.style.setProperty("--colour", readable(method.colour));
  }

  item(method) {
    const row = element("li");
    const label = element("label", "name");
    const box = element("input");
    box.type = "checkbox";
    box.checked = this.display.methods.has(method.name);
    const badge = element("span", "badge");
    label.append(box, element("i"), element("span", "", method.name), badge);
    const values = element("dl");
    const unsure = element("p");
    row.append(label, values, unsure);
    box.addEventListener("change", () => {
      this.display.methods[box.checked ? "add" : "delete"](method.name);
      this.changed();
    });
    return { method, row, box, badge, values, unsure, cells: [] };
  }

  /** Tells what the methods found in a frame. @param {import("./recording.js").Frame} frame */
  show(frame) {
    this.items.forEach(({ method, row, box, badge, values, unsure, cells }, m) => {
      const on = this.display.methods.has(method.name);
      const verdict = method.verdicts.at(frame.number);
      box.checked = on;
      row.classList.toggle("off", !on);
      row.dataset.verdict = verdict;
      text(badge, verdict);
      badge.hidden = verdict === "";
      while (cells.length < method.curves.length) {
        const cell = element("dd");
        values.append(element("dt", "", method.curves[cells.length].name), cell);
        cells.push(cell);
      }
      method.curves.forEach((curve, c) =>
        text(cells[c], quantity(valueAt(curve, frame.number), curve.unit)),
      );
      text(unsure, this.unsure(method, frame.poses[m].confidence));
    });
  }

  /** Returns which segments little data support. */
  unsure(method, confidence) {
    if (!confidence || !this.display.confidence) return "";
    const names = method.segments.filter((_, s) => confidence[s] < UNSURE);
    if (names.length === 0) return "";
    const more = names.length > NAMED ? ` and ${names.length - NAMED} more` : "";
    return `Little data: ${names.slice(0, NAMED).join(", ")}${more}`;
  }
}

function text(node, content) {
  if (node.textContent !== content) node.textContent = content;
}
