/** The address: which recording, frame and methods the page shows, after its `#`. */

/** The address is written at most this often [ms]; browsers refuse more. */
const SELDOM = 500;

/**
 * @typedef {{recording?: string, frame?: number, play?: boolean, speed?: number,
 *   methods?: string[]}} Place
 */

/** Returns what an address says. @param {string} hash @returns {Place} */
export function read(hash) {
  const place = {};
  for (const part of hash.replace(/^#/, "").split("&")) {
    const [key, value = ""] = part.split("=", 2);
    if (key === "recording") place.recording = decoded(value);
    else if (key === "frame" && Number.isFinite(parseFloat(value))) place.frame = parseFloat(value);
    else if (key === "play") place.play = value === "1";
    else if (key === "speed" && parseFloat(value) > 0) place.speed = parseFloat(value);
    // No name is empty, so that an empty list is one without methods.
    else if (key === "methods") place.methods = value.split(",").filter(Boolean).map(decoded);
  }
  return place;
}

/** Returns an address. @param {Place} place */
export function written({ recording, frame, play, speed, methods }) {
  const parts = [`recording=${encodeURIComponent(recording)}`, `frame=${frame}`];
  if (play) parts.push("play=1");
  if (speed !== 1) parts.push(`speed=${speed}`);
  if (methods) parts.push(`methods=${methods.map(encodeURIComponent).join(",")}`);
  return `#${parts.join("&")}`;
}

function decoded(text) {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}

/** Keeps the page's address up to date. */
export class Address {
  /** @param {(place: Place) => void} go Called when somebody else changes the address. */
  constructor(go) {
    this.timer = 0;
    this.known = location.hash;
    addEventListener("hashchange", () => {
      this.known = location.hash;
      go(read(location.hash));
    });
  }

  /** Writes a place soon. @param {() => Place} place Returns the place then. */
  write(place) {
    this.timer ||= setTimeout(() => {
      this.timer = 0;
      // An address that somebody else has just set is followed, and not overwritten.
      if (location.hash !== this.known) return;
      try {
        history.replaceState(null, "", written(place()));
      } catch {
        // Some frames of other pages, such as a notebook's, have no address of their own.
      }
      this.known = location.hash;
    }, SELDOM);
  }
}
