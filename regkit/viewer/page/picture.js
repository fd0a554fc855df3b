/** All that is drawn of a recording: points, clouds, reference joints, models and the ground. */

import { extentOf } from "./extent.js";
import { Ground } from "./ground.js";
import { look } from "./material.js";
import { Model } from "./model.js";
import { Cloud } from "./points.js";
import { Sensors } from "./sensors.js";
import { colour, dark } from "./theme.js";

/** The ground is laid below about so many frames. */
const SAMPLES = 12;

/** How much a model covers of what is behind it, on a light and on a dark page. */
const COVER = { light: 0.42, dark: 0.6 };

export class Picture {
  /** @param {import("./stage.js").Stage} stage @param {import("./recording.js").Recording} recording */
  constructor(stage, recording) {
    this.stage = stage;
    this.recording = recording;
    this.look = look();
    stage.orient(recording.up);
    const size = this.extent(recording.frames[0])?.radius ?? 1;
    this.ground = new Ground();
    this.points = new Cloud({ size: 0.012 * size });
    this.joints = new Cloud({ size: 0.035 * size, least: 9, most: 15, cross: true, above: true });
    this.clouds = recording.clouds.map((source) => {
      const cloud = new Cloud({ size: 0.011 * size });
      cloud.set(source.positions);
      cloud.uniforms.near.value.set(source.colour);
      return cloud;
    });
    this.models = recording.methods.map(
      (method, order) => new Model(method, order, this.look, size),
    );
    this.sensors = new Sensors(recording.cameras, size);
    const parts = [this.points, this.joints, ...this.clouds, ...this.models, this.sensors];
    stage.world.add(...parts.map((part) => part.object));
    stage.scene.add(this.ground.object);
    this.parts = [...parts];
    this.measure();
    this.paint();
  }

  /** Lays the ground below some frames; the points of others may not be here yet. */
  measure(...frames) {
    const all = this.recording.frames;
    const stride = Math.max(1, Math.floor(all.length / SAMPLES));
    const some = all.filter((_, index) => index % stride === 0);
    /** Where these frames are, or null if nothing is in them. */
    this.whole = extentOf(this.recording, [...some, ...frames], this.stage.world);
    this.ground.object.visible = this.whole !== null;
    if (!this.whole) return;
    this.ground.lay(this.whole);
    this.points.uniforms.depths.value.set(...this.whole.depths);
  }

  /**
   * Returns where a frame is, or null if nothing is in it.
   * @param {import("./recording.js").Frame | null} frame
   * @param {boolean} withCameras Whether the depth cameras belong to it.
   */
  extent(frame, withCameras = false) {
    const cameras = withCameras ? this.recording.cameras : [];
    return extentOf(this.recording, frame ? [frame] : [], this.stage.world, cameras);
  }

  /**
   * Shows a frame.
   * @param {import("./recording.js").Frame} frame
   * @param {import("./display.js").Display} display
   */
  show(frame, display) {
    /** The frame that is drawn. */
    this.frame = frame;
    this.points.object.visible = display.points && frame.points !== null;
    if (this.points.object.visible) {
      const { positions, step, origin } = frame.points;
      this.points.set(positions, step, ...origin);
    }
    this.points.uniforms.shaded.value = Number(display.depth);
    for (const cloud of this.clouds) cloud.object.visible = display.points;
    this.sensors.object.visible = display.cameras;
    this.joints.object.visible = display.joints && frame.joints !== null;
    if (this.joints.object.visible) this.joints.set(frame.joints);
    this.look.weighed.value = Number(display.confidence);
    this.look.opacity.value = display.solid ? 1 : COVER[dark() ? "dark" : "light"];
    this.models.forEach((model, m) => {
      model.show(frame.poses[m], this.recording.methods[m].verdicts.at(frame.number), display);
    });
    this.stage.invalidate();
  }

  /** Takes the colours of the style as they are at present. */
  paint() {
    this.stage.paint();
    this.ground.paint();
    this.look.faint.value.set(colour("faint"));
    this.points.uniforms.near.value.set(colour("near"));
    this.points.uniforms.far.value.set(colour("far"));
    this.joints.uniforms.near.value.set(colour("ink"));
    this.sensors.paint();
    for (const model of this.models) model.paint();
  }

  dispose() {
    for (const part of this.parts) {
      this.stage.world.remove(part.object);
      part.dispose();
    }
    this.stage.scene.remove(this.ground.object);
    this.ground.object.geometry.dispose();
    this.ground.object.material.dispose();
  }
}
