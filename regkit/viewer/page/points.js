/** Points of the scene: round ones of a size in metres, or marks of a size in pixels. */

import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DynamicDrawUsage,
  Points,
  ShaderMaterial,
  Vector2,
} from "three";

const VERTEX = `
uniform float size, least, most, height, ratio, shaded;
uniform vec2 depths;
varying float shade;
void main() {
  vec4 place = modelViewMatrix * vec4(position, 1.0);
  gl_Position = projectionMatrix * place;
  float seen = size * 0.5 * projectionMatrix[1][1] * height / max(gl_Position.w, 1e-6);
  gl_PointSize = clamp(seen, least * ratio, most * ratio);
  shade = shaded * clamp((position.z - depths.x) / (depths.y - depths.x), 0.0, 1.0);
}`;

const FRAGMENT = `
uniform vec3 near, far;
uniform float opacity, least_inside;
varying float shade;
void main() {
  float clear = opacity;
  vec2 place = 2.0 * gl_PointCoord - 1.0;
  #ifdef CROSS
    vec2 arm = abs(vec2(place.x + place.y, place.x - place.y));
    if (min(arm.x, arm.y) > 0.26 || max(arm.x, arm.y) > 1.6) discard;
  #else
    float edge = length(place);
    float inside = clamp((1.0 - edge) / fwidth(edge) + 0.5, 0.0, 1.0);
    if (inside < least_inside) discard;
    clear *= inside;
  #endif
  gl_FragColor = vec4(mix(near, far, shade), clear);
  #include <colorspace_fragment>
}`;

export class Cloud {
  /**
   * @param {{size?: number, least?: number, most?: number, cross?: boolean, above?: boolean}} style
   *   Diameter [m], its bounds in the page's pixels, whether the points are crosses, and whether
   *   they are drawn above everything.
   */
  constructor({ size = 0, least = 1.3, most = 9, cross = false, above = false }) {
    this.uniforms = {
      size: { value: size },
      least: { value: least },
      most: { value: most },
      height: { value: 1 },
      ratio: { value: 1 },
      shaded: { value: 0 },
      depths: { value: new Vector2(0, 1) },
      near: { value: new Color() },
      far: { value: new Color() },
      opacity: { value: 1 },
      least_inside: { value: 0 },
    };
    const material = new ShaderMaterial({
      uniforms: this.uniforms,
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      defines: cross ? { CROSS: "" } : {},
      transparent: above,
      // Edges are smoothed by the samples of a pixel, which need no order of the points.
      alphaToCoverage: !above,
      depthTest: !above,
      depthWrite: !above,
    });
    this.object = new Points(new BufferGeometry(), material);
    this.object.frustumCulled = false;
    this.object.renderOrder = above ? 1000 : 0;
    this.object.onBeforeRender = (renderer) => {
      this.uniforms.height.value = renderer.domElement.height;
      this.uniforms.ratio.value = renderer.getPixelRatio();
      // Without samples a pixel is in the point or not.
      this.uniforms.least_inside.value = above || renderer.capabilities.samples > 0 ? 0.02 : 0.5;
    };
    this.reserve(64);
  }

  /** Makes room for a number of points; what room there is, is used again. */
  reserve(count) {
    if (count <= this.positions?.count) return;
    this.object.geometry.dispose();
    const room = 2 ** Math.ceil(Math.log2(count));
    this.positions = new BufferAttribute(new Float32Array(3 * room), 3).setUsage(DynamicDrawUsage);
    this.object.geometry.setAttribute("position", this.positions);
    this.object.geometry.setDrawRange(0, 0);
  }

  /**
   * Shows positions, scaled and moved; those that are not numbers are left out.
   * @param {ArrayLike<number>} list Coordinates (3 N).
   */
  set(list, step = 1, x = 0, y = 0, z = 0) {
    this.reserve(list.length / 3);
    const { array } = this.positions;
    let count = 0;
    for (let i = 0; i < list.length; i += 3) {
      if (!Number.isFinite(list[i] + list[i + 1] + list[i + 2])) continue;
      array[count++] = x + step * list[i];
      array[count++] = y + step * list[i + 1];
      array[count++] = z + step * list[i + 2];
    }
    this.positions.clearUpdateRanges();
    this.positions.addUpdateRange(0, count);
    this.positions.needsUpdate = count > 0;
    this.object.geometry.setDrawRange(0, count / 3);
  }

  dispose() {
    this.object.geometry.dispose();
    this.object.material.dispose();
  }
}
