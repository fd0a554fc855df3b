/** Which frame is shown, and the clock that plays a recording at its own speed. */

/** A clock that stood still for longer than this was not looked at [s]. */
const PAUSE = 0.25;

export class Player {
  /** @param {() => void} moved Called when the frame, or whether it plays, has changed. */
  constructor(moved) {
    this.moved = moved;
    this.index = 0;
    this.speed = 1;
    this.playing = false;
    /** Whether the frame still waits for its points; the clock stands still meanwhile. */
    this.waiting = false;
    /** Whether the newest frame of a live recording is shown. */
    this.following = false;
    this.tick = this.tick.bind(this);
  }

  /**
   * Goes to a recording.
   * @param {import("./recording.js").Recording} recording
   * @param {number} number Number of its frame, if it is not a live one.
   */
  open(recording, number) {
    this.recording = recording;
    this.following = recording.live;
    this.go(this.following ? recording.frames.length - 1 : recording.nearest(number));
  }

  get frame() {
    return this.recording.frames[this.index];
  }

  /** Goes to a frame by its index among the scene's. @param {number} index */
  go(index) {
    const last = this.recording.frames.length - 1;
    this.index = Math.max(0, Math.min(index, last));
    this.clock = this.frame?.time ?? 0;
    this.moved();
  }

  /** Goes to a frame as the reader wants, who no longer follows a live recording then. */
  seek(index) {
    this.following = this.recording.live && index >= this.recording.frames.length - 1;
    if (this.following) this.playing = false;
    this.go(index);
  }

  /** Goes to the next mark, or to the one before. @param {1 | -1} direction */
  mark(direction) {
    const numbers = this.recording.marks.map((mark) => mark.frame);
    if (numbers.length === 0) return;
    const places = [...new Set(numbers.map((number) => this.recording.nearest(number)))];
    if (direction < 0) places.reverse();
    const next = places.find((place) => direction * (place - this.index) > 0);
    this.seek(next ?? places[0]);
  }

  play(playing = !this.playing) {
    this.playing = playing && this.recording.frames.length > 1;
    if (this.playing) {
      this.following = false;
      this.before = undefined;
      this.request ??= requestAnimationFrame(this.tick);
    }
    this.moved();
  }

  tick(now) {
    this.request = undefined;
    if (!this.playing) return;
    const passed = Math.min((now - (this.before ?? now)) / 1000, PAUSE);
    this.before = now;
    if (!this.waiting) this.advance(passed * this.speed);
    if (this.playing) this.request ??= requestAnimationFrame(this.tick);
  }

  /** Moves on by a time [s] of the recording. @param {number} seconds */
  advance(seconds) {
    const { frames, live } = this.recording;
    const last = frames.length - 1;
    this.clock += seconds;
    // The last frame is shown as long as the one before it.
    const end = frames[last].time + (frames[last].time - frames[last - 1].time);
    if (this.clock >= end) {
      if (live) return this.seek(last);
      this.index = 0;
      this.clock = frames[0].time;
      return this.moved();
    }
    let index = this.index;
    while (index < last && frames[index + 1].time <= this.clock) index++;
    if (index === this.index) return undefined;
    this.index = index;
    return this.moved();
  }
}
