/** Verdicts of frames: in which runs they come, and how they are said. */

/** Verdicts from the best to the worst. */
export const VERDICTS = ["found", "doubtful", "no data", "lost"];

const ALARMS = { doubtful: "Doubtful", lost: "Body lost", "no data": "No body in sight" };

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
 * Returns what has to be said about a frame: the worst verdict, its alarm, and whose it is.
 * @param {{name: string, verdict: string}[]} methods The methods that are shown.
 * @returns {{verdict: string, alarm: string, whose: string} | null}
 */
export function alarm(methods) {
  const bad = methods.filter(({ verdict }) => verdict in ALARMS);
  if (bad.length === 0) return null;
  bad.sort((a, b) => VERDICTS.indexOf(b.verdict) - VERDICTS.indexOf(a.verdict));
  const verdict = bad[0].verdict;
  const alike = bad.length === methods.length && bad.every((one) => one.verdict === verdict);
  const parts = VERDICTS.filter((word) => bad.some((one) => one.verdict === word)).reverse();
  const names = (word) => bad.filter((one) => one.verdict === word).map((one) => one.name);
  const whose = alike ? "" : parts.map((word) => `${word}: ${names(word).join(", ")}`).join(" · ");
  return { verdict, alarm: ALARMS[verdict], whose };
}
