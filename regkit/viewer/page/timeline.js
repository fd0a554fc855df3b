/** The timeline: a chart of the whole recording in which clicks and drags go to a frame. */

import { across, drawChart, numberAt, scaleOf } from "./chart.js";

export class Timeline {
  /**
   * @param {HTMLElement} slider Holds the canvas and the playhead.
   * @param {HTMLSelectElement} choice Offers the curves.
   * @param {(number: number) => void} go Called with a frame number.
   */
  constructor(slider, choice, go) {
    this.slider = slider;
    this.canvas = slider.querySelector("canvas");
    this.head = slider.querySelector("div");
    this.choice = choice;
    choice.addEventListener("change", () => this.draw());
    this.scale = null;
    const move = (event) => {
      if (this.scale) go(numberAt(this.scale, event.clientX - slider.getBoundingClientRect().left));
    };
    slider.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      slider.setPointerCapture(event.pointerId);
      move(event);
    });
    slider.addEventListener("pointermove", (event) => {
      if (slider.hasPointerCapture(event.pointerId)) move(event);
    });
    new ResizeObserver(() => this.recording && this.draw()).observe(slider);
  }

  /**
   * Shows the whole of a recording.
   * @param {import("./recording.js").Recording} recording
   * @param {any[]} methods The methods that are shown.
   */
  open(recording, methods) {
    this.recording = recording;
    this.methods = methods;
    this.offer();
    this.draw();
  }

  /** Offers the curves that the methods have. */
  offer() {
    const { choice, recording } = this;
    const names = new Set(
      recording.methods.flatMap(({ curves }) => curves.map(({ name }) => name)),
    );
    const before = choice.value;
    if (names.size > 0 && choice.options.length === names.size && names.has(before)) return;
    choice.replaceChildren(...[...names].map((name) => new Option(name, name)));
    if (names.has(before)) choice.value = before;
    choice.closest("label").hidden = names.size === 0;
  }

  draw() {
    const width = this.slider.clientWidth;
    if (width === 0) return;
    // The style hides the choice where there is no room for a curve.
    const quantity = this.choice.offsetParent ? this.choice.value : "";
    const scale = scaleOf(this.recording, width, this.methods, quantity);
    const ratio = devicePixelRatio;
    const size = [Math.round(width * ratio), Math.round(scale.height * ratio)];
    const pen = this.canvas.getContext("2d");
    if (this.canvas.width !== size[0] || this.canvas.height !== size[1]) {
      [this.canvas.width, this.canvas.height] = size;
      this.canvas.style.height = `${scale.height}px`;
    }
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, width, scale.height);
    drawChart(pen, scale, this.recording, this.methods, quantity);
    this.scale = scale;
    if (this.number !== undefined) this.show(this.number, this.told);
  }

  /** Moves the playhead. @param {number} number @param {string} told The frame in words. */
  show(number, told) {
    this.number = number;
    this.told = told;
    if (!this.scale) return;
    this.head.style.transform = `translateX(${across(this.scale, number)}px)`;
    const { first, last } = this.scale;
    const values = { valuemin: first, valuemax: last, valuenow: number, valuetext: told };
    for (const [key, value] of Object.entries(values))
      this.slider.setAttribute(`aria-${key}`, value);
  }
}
