/** Starts the page: loads the scene, and connects its parts. */

import { Address, read } from "./address.js";
import { controls, showControls } from "./controls.js";
import { displayChoices, offer } from "./display.js";
import { explain } from "./legend.js";
import { listen } from "./live.js";
import { load } from "./load.js";
import { Panel } from "./panel.js";
import { Picture } from "./picture.js";
import { Player } from "./player.js";
import { readout, showBanner } from "./readout.js";
import { Recording } from "./recording.js";
import { NoWebGL, Stage } from "./stage.js";
import { themeSwitch } from "./theme.js";
import { Timeline } from "./timeline.js";

const $ = (id) => document.getElementById(id);
const root = document.documentElement;

class Page {
  constructor(scene) {
    this.scene = scene;
    this.display = {
      model: "", points: true, depth: true, bones: true, joints: true, confidence: true, solid: false,
      methods: new Set(),
    };
    this.stage = stageOrMessage(() => this.drawn());
    this.player = new Player(() => this.show());
    this.panel = new Panel($("methods"), this.display, () => this.switched());
    this.timeline = new Timeline($("timeline"), (number) => {
      this.player.seek(this.recording.nearest(number));
    });
    this.address = new Address((place) => this.go(place));
    this.controls = controls(this.player, (name) => this.look(name), () => this.moved());
    displayChoices(this.display, () => this.chosen());
    themeSwitch($("theme"), () => this.paint());
    $("curve").addEventListener("change", () => this.chart());
    $("recordings").addEventListener("change", () => this.go({ recording: $("recordings").value }));
    if (this.stage) this.stage.view.renamed = () => showControls(this.player, this.stage.view);
    $("panel").open = !matchMedia("(max-width: 760px)").matches;
    this.title();
    this.go(read(location.hash));
    if (scene.live) this.listen();
  }

  /** The methods that are shown. */
  get methods() {
    return this.recording.methods.filter((method) => this.display.methods.has(method.name));
  }

  title() {
    const { title, note, recordings, live } = this.scene;
    document.title = title;
    $("title").textContent = title;
    $("note").textContent = note;
    $("live").hidden = !live;
    $("recordings").replaceChildren(...recordings.map(({ name }) => new Option(name, name)));
    $("recordings").hidden = recordings.length < 2;
  }

  /** Goes where an address says. @param {import("./address.js").Place} place */
  go({ recording, frame, play, speed, methods }) {
    const { recordings } = this.scene;
    const source = recordings.find((one) => one.name === recording);
    const other = !this.recording || (source && source !== this.source);
    if (other) this.open(source ?? recordings[0], methods, frame);
    else if (methods) this.choose(methods);
    if (speed) this.controls.pace(speed);
    if (!other && frame !== undefined) this.player.seek(this.recording.nearest(frame));
    if (play !== undefined) this.player.play(play);
  }

  open(source, methods, frame = 0) {
    this.source = source;
    this.recording = new Recording(source);
    this.recording.live = this.scene.live;
    $("recordings").value = source.name;
    document.querySelector('[data-view="sensor"]').hidden = !source.camera;
    this.choose(methods);
    offer(this.recording, this.display);
    this.panel.open(this.recording);
    this.draft();
    $("transport").hidden = !this.recording.live && this.recording.length < 2;
    this.curves();
    this.player.open(this.recording, frame);
    this.explain();
  }

  /** Makes what is drawn of the recording. */
  draft() {
    this.picture?.dispose();
    this.picture = this.stage && new Picture(this.stage, this.recording);
    this.fitted = false;
  }

  /** Switches methods on by their names: all, if none of them is one of the recording's. */
  choose(names) {
    const all = this.recording.methods.map((method) => method.name);
    const known = names?.filter((name) => all.includes(name)) ?? all;
    this.display.methods.clear();
    for (const name of names?.length && !known.length ? all : known) this.display.methods.add(name);
    if (this.panel.items) this.switched();
  }

  /** Offers the curves that the methods have. */
  curves() {
    const names = new Set(this.recording.methods.flatMap(({ curves }) => curves.map(({ name }) => name)));
    const before = $("curve").value;
    if ($("curve").options.length !== names.size || !names.has(before)) {
      $("curve").replaceChildren(...[...names].map((name) => new Option(name, name)));
      if (names.has(before)) $("curve").value = before;
      $("curve").closest("label").hidden = names.size === 0;
    }
    this.chart();
  }

  chart() {
    this.timeline.quantity = $("curve").value;
    this.timeline.open(this.recording, this.methods);
  }

  switched() {
    this.chart();
    this.show();
  }

  chosen() {
    this.explain();
    this.show();
  }

  explain() {
    explain($("legend"), this.recording, this.display, this.picture?.ground.cell);
  }

  /** Shows the player's frame everywhere. */
  show() {
    const { frame } = this.player;
    showControls(this.player, this.stage?.view);
    if (!frame) return showBanner("Waiting for the first frame");
    this.panel.show(frame);
    const told = readout(this.recording, frame, this.methods);
    this.timeline.show(frame.number, told);
    this.draw(frame);
    return this.moved();
  }

  /** Draws a frame, as soon as its points are here. */
  async draw(frame) {
    if (!this.picture) return;
    if (frame.href && !frame.points) await this.fetch(frame);
    if (frame !== this.player.frame) return;
    if (!this.fitted) this.look("free");
    this.picture.show(frame, this.display);
    // The next frame's points will be wanted soon; should they be missing, that is told then.
    this.recording.load(this.recording.frames[this.player.index + 1] ?? frame).catch(() => {});
  }

  async fetch(frame) {
    this.player.waiting = true;
    try {
      await this.recording.load(frame);
    } catch (error) {
      showBanner(`The points of frame ${frame.number} are not there: ${error.message}`);
    }
    if (frame === this.player.frame) this.player.waiting = false;
  }

  look(name) {
    const extent = this.picture?.extent(this.player.frame) ?? this.picture?.whole;
    if (!extent) return;
    this.fitted = true;
    const { camera } = this.recording;
    if (name !== "sensor") this.stage.view.look(name, extent);
    else if (camera) this.stage.view.see(camera, this.stage.world, extent);
  }

  /** Keeps the address at what is shown. */
  moved() {
    this.address.write(() => ({
      recording: this.recording.name,
      frame: this.player.frame?.number ?? 0,
      play: this.player.playing,
      speed: this.player.speed,
      methods: this.methods.length < this.recording.methods.length ? this.methods.map(({ name }) => name) : undefined,
    }));
  }

  paint() {
    this.picture?.paint();
    this.panel.paint();
    this.show();
    this.timeline.draw();
    this.explain();
  }

  drawn() {
    root.dataset.ready = this.picture?.frame?.number ?? "";
    root.dataset.triangles = this.stage.renderer.info.render.triangles;
    root.dataset.draws = Number(root.dataset.draws ?? 0) + 1;
  }

  listen() {
    listen(this.recording, {
      arrived: (dropped) => {
        this.dropped = (this.dropped ?? 0) + dropped;
        // Frames that come faster than the screen shows pictures are shown together.
        this.refresh ??= requestAnimationFrame(() => this.grow());
      },
      told: (text, broken = false) => {
        $("status").textContent = text;
        $("status").toggleAttribute("data-broken", broken);
      },
    });
  }

  /** Shows the frames that have arrived. */
  grow() {
    const { player, recording, dropped } = this;
    Object.assign(this, { refresh: undefined, dropped: 0 });
    // A scene without frames has no size; the first frame gives it one.
    if (!this.picture?.whole) this.draft();
    this.curves();
    player.go(player.following ? recording.frames.length - 1 : player.index - dropped);
  }
}

function stageOrMessage(drawn) {
  try {
    return new Stage($("view"), drawn);
  } catch (error) {
    if (!(error instanceof NoWebGL)) throw error;
    message("This browser offers no WebGL, so the scene cannot be drawn. The verdicts and values of each frame are beside and below.");
    return null;
  }
}

function message(text) {
  $("message").textContent = text;
  $("message").hidden = false;
}

try {
  new Page(await load());
} catch (error) {
  message(error.message);
  root.dataset.failed = error.stack;
}
