/** The page: connects what it consists of, and shows the frame of the player in all of it. */

import { Address, read } from "./address.js";
import { controls, showControls } from "./controls.js";
import { displayChoices, everything, offer } from "./display.js";
import { showHeading } from "./heading.js";
import { explain } from "./legend.js";
import { listen } from "./live.js";
import { Panel } from "./panel.js";
import { Picture } from "./picture.js";
import { Player } from "./player.js";
import { readout, showBanner } from "./readout.js";
import { Recording } from "./recording.js";
import { themeSwitch } from "./theme.js";
import { Timeline } from "./timeline.js";

const $ = (id) => document.getElementById(id);
const root = document.documentElement;

export class Page {
  /**
   * @param {any} scene The scene's document.
   * @param {import("./stage.js").Stage | null} stage Where the scene is drawn, if it can be.
   */
  constructor(scene, stage) {
    this.scene = scene;
    this.display = everything();
    this.stage = stage;
    this.player = new Player(() => this.show());
    this.panel = new Panel($("methods"), this.display, () => this.switched());
    this.timeline = new Timeline($("timeline"), $("curve"), (number) => {
      this.player.seek(this.recording.nearest(number));
    });
    this.address = new Address((place) => this.go(place));
    this.controls = controls(
      this.player,
      (name) => this.look(name),
      () => this.moved(),
    );
    displayChoices(this.display, () => this.chosen());
    themeSwitch($("theme"), () => this.paint());
    if (stage) {
      stage.drawn = () => this.drawn();
      stage.view.renamed = () => showControls(this.player, stage.view);
    }
    $("panel").open = !matchMedia("(max-width: 760px)").matches;
    showHeading(scene, (recording) => this.go({ recording }));
    this.go(read(location.hash));
    if (scene.live) listen(this.recording, $("status"), (dropped) => this.grow(dropped));
  }

  /** The methods that are shown. */
  get methods() {
    return this.recording.methods.filter((method) => this.display.methods.has(method.name));
  }

  /** Goes where an address says. @param {import("./address.js").Place} place */
  go({ recording, frame, play, speed, methods }) {
    const { recordings } = this.scene;
    const source = recordings.find((one) => one.name === recording);
    const other = !this.recording || (source && source !== this.source);
    if (other) this.open(source ?? recordings[0], methods, frame);
    else if (methods) {
      this.choose(methods);
      this.switched();
    }
    if (speed) this.controls.pace(speed);
    if (!other && frame !== undefined) this.player.seek(this.recording.nearest(frame));
    if (play !== undefined) this.player.play(play);
  }

  open(source, methods, frame = 0) {
    this.source = source;
    this.recording = new Recording(source, this.scene.live);
    $("recordings").value = source.name;
    document.querySelector('[data-view="sensor"]').hidden = !source.camera;
    this.choose(methods);
    offer(this.recording, this.display);
    this.panel.open(this.recording);
    this.draft();
    $("transport").hidden = !this.recording.live && this.recording.length < 2;
    this.chart();
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
    const chosen = names?.length && known.length === 0 ? all : known;
    for (const name of chosen) this.display.methods.add(name);
  }

  /** Draws the whole of the recording below. */
  chart() {
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
    if (!frame)
      return showBanner(this.scene.live ? "Waiting for the first frame" : "There are no frames");
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
    if (!this.fitted) {
      this.picture.measure(frame);
      this.explain();
      this.look("free");
    }
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
    // A side shows the body; all of the scene has its cameras too.
    const around = this.display.cameras && (name === "free" || name === "top");
    const extent = this.picture?.extent(this.player.frame, around) ?? this.picture?.whole;
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
      methods:
        this.methods.length < this.recording.methods.length
          ? this.methods.map(({ name }) => name)
          : undefined,
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

  /** Shows frames that have arrived. @param {number} dropped How many old ones are gone. */
  grow(dropped) {
    const { player, recording } = this;
    // A scene without frames has no size; the first frame gives it one.
    if (!this.picture?.whole) this.draft();
    this.chart();
    player.go(player.following ? recording.frames.length - 1 : player.index - dropped);
  }
}
