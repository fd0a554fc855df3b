/** Verdicts of frames: in which runs they come, and how they are said. */

/** What is said about verdicts that must not be overlooked, the worst first. */
const ALARMS = { lost: "Body lost", "no data": "No body in sight", doubtful: "Doubtful" };

/** The verdicts of a recording's frames, as runs of the same verdict. */
export class Verdicts {
  /** @param {[string, number][]} runs Verdicts, and for how many frames each holds. */
  constructor(runs = []) {
    /** First frame of each run. @type {number[]} */
    this.starts = [];
    /** @type {string[]} */
    this.words = [];
    this.end = 0;
    for (const [word, count] of runs) {
      this.starts.push(this.end);
      this.words.push(word);
      this.end += count;
    }
  }

  /** Returns the verdict of a frame, or "" where there is none. @param {number} frame */
  at(frame) {
    if (frame >= this.end) return "";
    let low = 0;
    let high = this.starts.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.starts[middle] <= frame) low = middle + 1;
      else high = middle;
    }
    return this.words[low - 1] ?? "";
  }

  /** Appends a frame's verdict, and forgets runs before the frame `first`. */
  append(frame, word, first) {
    if (this.words.at(-1) !== word) {
      this.starts.push(frame);
      this.words.push(word);
    }
    this.end = frame + 1;
    while (this.starts.length > 1 && this.starts[1] <= first) {
      this.starts.shift();
      this.words.shift();
    }
  }
}

/**
 * Returns what has to be said about a frame: the worst verdict, its alarm, and what else is not well.
 * @param {{name: string, verdict: string}[]} methods The methods that are shown.
 * @returns {{verdict: string, alarm: string, more: string} | null}
 */
export function alarm(methods) {
  const names = (verdict) =>
    methods.filter((one) => one.verdict === verdict).map((one) => one.name);
  const [worst, ...others] = Object.keys(ALARMS).filter((verdict) => names(verdict).length > 0);
  if (!worst) return null;
  const whose = names(worst).length < methods.length ? `: ${names(worst).join(", ")}` : "";
  const more = others.map((verdict) => `${verdict}: ${names(verdict).join(", ")}`).join(" · ");
  return { verdict: worst, alarm: ALARMS[worst] + whose, more };
}
