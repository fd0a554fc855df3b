/** The frame in words: its number and time, and what must not be overlooked. */

import { alarm } from "./verdicts.js";

const $ = (id) => document.getElementById(id);

/**
 * Tells a frame beside and above the scene; returns it in words.
 * @param {import("./recording.js").Recording} recording
 * @param {import("./recording.js").Frame} frame
 * @param {any[]} methods The methods that are shown.
 */
export function readout(recording, frame, methods) {
  const found = methods.map(({ name, verdicts }) => ({ name, verdict: verdicts.at(frame.number) }));
  const why = recording.marks
    .filter((mark) => recording.frames[recording.nearest(mark.frame)] === frame)
    .map((mark) => mark.why);
  const [, last] = recording.range;
  const time = `${frame.time.toFixed(2)} s`;
  const number = document.createElement("strong");
  number.textContent = `Frame ${frame.number}`;
  const rest = document.createElement("small");
  rest.textContent = [
    recording.live ? "" : ` of ${last}`,
    ` · ${time}`,
    ...why.map((one) => ` · ${one}`),
  ].join("");
  $("readout").replaceChildren(number, rest);
  const news = alarm(found);
  showBanner(news?.alarm ?? "", news?.more, news?.verdict);
  return [
    `frame ${frame.number}`,
    time,
    ...found.map(({ name, verdict }) => `${name}: ${verdict}`),
    ...why,
  ].join(", ");
}

/** Shows a line over the scene, or none. */
export function showBanner(text, more = "", verdict = "") {
  const banner = $("banner");
  const key = `${text}\n${more}`;
  if (banner.dataset.key === key) return;
  Object.assign(banner.dataset, { key, verdict });
  banner.hidden = text === "";
  const small = document.createElement("small");
  small.textContent = more;
  banner.replaceChildren(text, ...(more ? [small] : []));
}
