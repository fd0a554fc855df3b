/** A grid below the scene that fades with the distance, and tells sizes. */

import { Color, DoubleSide, Mesh, PlaneGeometry, ShaderMaterial } from "three";
import { colour } from "./theme.js";

const VERTEX = `
varying vec2 place;
void main() {
  place = position.xz;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

const FRAGMENT = `
uniform vec3 ink;
uniform float cell;
uniform float radius, ratio;
varying vec2 place;
void main() {
  vec2 cells = place / cell;
  vec2 width = fwidth(cells);
  vec2 line = abs(fract(cells - 0.5) - 0.5) / (0.7 * width * ratio);
  float share = 1.0 - smoothstep(0.3, 1.0, min(line.x, line.y));
  float fade = 1.0 - smoothstep(0.25, 1.0, length(place) / radius);
  float dense = 1.0 - smoothstep(0.2, 0.6, max(width.x, width.y));
  gl_FragColor = vec4(ink, share * fade * dense);
  #include <colorspace_fragment>
}`;

export class Ground {
  constructor() {
    this.uniforms = {
      ink: { value: new Color() },
      cell: { value: 1 },
      radius: { value: 1 },
      ratio: { value: 1 },
    };
    const material = new ShaderMaterial({
      uniforms: this.uniforms,
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      transparent: true,
      depthWrite: false,
      side: DoubleSide,
    });
    this.object = new Mesh(new PlaneGeometry(2, 2).rotateX(-Math.PI / 2), material);
    this.object.renderOrder = -1;
    this.object.frustumCulled = false;
    this.object.onBeforeRender = (renderer) =>
      (this.uniforms.ratio.value = renderer.getPixelRatio());
  }

  /** Lays the grid below an extent. @param {import("./extent.js").Extent} extent */
  lay({ centre, radius, lowest }) {
    const cell = rounded(radius / 1.5);
    const wide = Math.ceil((3.2 * radius) / cell) * cell;
    this.uniforms.cell.value = cell;
    this.uniforms.radius.value = wide;
    const corners = this.object.geometry.attributes.position;
    for (let i = 0; i < 4; i++) {
      corners.setXYZ(i, i % 2 ? wide : -wide, 0, i < 2 ? -wide : wide);
    }
    corners.needsUpdate = true;
    this.object.position.set(centre.x, lowest, centre.z);
    /** Side of a cell [m]. */
    this.cell = cell;
  }

  paint() {
    this.uniforms.ink.value.set(colour("grid"));
  }
}

/** Returns the largest of 1, 2, 5 times a power of ten that is at most a length. */
function rounded(length) {
  const power = 10 ** Math.floor(Math.log10(length));
  return ([5, 2].find((factor) => factor * power <= length) ?? 1) * power;
}
