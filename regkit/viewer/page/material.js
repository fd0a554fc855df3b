/** The material of models: clear in its outline, and fainter where little data support it. */

import { Color, MeshLambertMaterial } from "three";

/** Layer of what a slow renderer draws only into pictures that stay. */
export const FINE = 1;

/**
 * What all materials of a scene share.
 * @typedef {{faint: {value: Color}, weighed: {value: number}, opacity: {value: number}}} Look
 */

/** @returns {Look} */
export const look = () => ({
  faint: { value: new Color() },
  weighed: { value: 1 },
  opacity: { value: 0.5 },
});

// A vertex of a tapered capsule is given by its cap (the sign of y), how far it is from the rim of
// the cap to the pole (0 to 1, above 1 in y) and its direction around the axis (x and z); the
// instance by the radii, the distance of their centres and the sine of the rim's latitude.
const CAPSULE_NORMAL = `
float cap = step(0.0, position.y);
vec2 rim_direction = vec2(sqrt(1.0 - taper.w * taper.w), taper.w);
vec2 direction = normalize(mix(rim_direction, vec2(0.0, 2.0 * cap - 1.0), abs(position.y) - 1.0));
vec3 objectNormal = vec3(position.x * direction.x, direction.y, position.z * direction.x);`;
const CAPSULE_POSITION = `
vec3 transformed = objectNormal * mix(taper.x, taper.y, cap) + vec3(0.0, taper.z * cap, 0.0);`;

const CONFIDENT = `
attribute float confidence;
varying float confident;
void main() {
confident = confidence;`;

const DECLARED = `
uniform vec3 faint;
uniform float weighed, presence, strength;
varying float confident;
void main() {`;

const FADE = `
float sure = mix(1.0, confident, weighed);
diffuseColor.rgb = mix(faint, diffuseColor.rgb, mix(0.15, 1.0, sure));
float rim = 1.0 - abs(dot(normalize(vViewPosition), normal));
diffuseColor.a = mix(strength, 1.0, 0.75 * rim * rim);
diffuseColor.a *= mix(0.35, 1.0, sure) * presence;`;

/**
 * Returns the material of a method's surfaces, and one that draws only their depth: drawn before
 * it, only the nearest surface is seen through, whatever the order of the parts.
 * @param {Look} look
 * @param {{value: number}} presence 1, or less for a body that was not found.
 * @param {boolean} capsules Whether the vertices are those of tapered capsules.
 */
export function surface(look, presence, capsules = false) {
  const made = (options) => {
    const material = new MeshLambertMaterial({ transparent: true, ...options });
    material.onBeforeCompile = (shader) => patch(shader, look, presence, capsules);
    material.customProgramCacheKey = () => `surface ${capsules}`;
    return material;
  };
  return { depth: made({ colorWrite: false }), shown: made({}) };
}

function patch(shader, { faint, weighed, opacity }, presence, capsules) {
  Object.assign(shader.uniforms, { faint, weighed, presence, strength: opacity });
  shader.vertexShader = shader.vertexShader.replace("void main() {", CONFIDENT);
  if (capsules) {
    shader.vertexShader = `attribute vec4 taper;\n${shader.vertexShader}`
      .replace("#include <beginnormal_vertex>", CAPSULE_NORMAL)
      .replace("#include <begin_vertex>", CAPSULE_POSITION);
  }
  shader.fragmentShader = shader.fragmentShader
    .replace("void main() {", DECLARED)
    .replace("#include <normal_fragment_maps>", `#include <normal_fragment_maps>\n${FADE}`);
}
