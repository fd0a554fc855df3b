/** A mesh whose vertices follow several segments, by linear blend skinning. */

import { BufferAttribute, BufferGeometry, DynamicDrawUsage, Matrix4, Mesh } from "three";
import { numbers } from "./arrays.js";
import { FINE, surface } from "./material.js";
import { matricesOf } from "./rigid.js";

export class Skin {
  /** @param {any} shape The mesh of a scene. */
  constructor(shape, look, presence) {
    this.vertices = numbers(shape.vertices);
    this.carriers = numbers(shape.carriers);
    this.weights = numbers(shape.weights);
    this.count = this.vertices.length / 3;
    this.each = this.carriers.length / Math.max(this.count, 1);
    const rest = numbers(shape.rest);
    this.unposed = matricesOf(rest, rest.length / 7).map((one) => one.invert());
    this.posed = this.unposed.map(() => new Matrix4());
    const geometry = new BufferGeometry();
    geometry.setAttribute(
      "position",
      new BufferAttribute(this.vertices.slice(), 3).setUsage(DynamicDrawUsage),
    );
    geometry.setIndex(new BufferAttribute(numbers(shape.triangles), 1));
    geometry.computeVertexNormals();
    this.normals = geometry.attributes.normal.array.slice();
    geometry.attributes.normal.setUsage(DynamicDrawUsage);
    this.confidence = new BufferAttribute(new Float32Array(this.count).fill(1), 1);
    geometry.setAttribute("confidence", this.confidence.setUsage(DynamicDrawUsage));
    this.geometry = geometry;
    const materials = surface(look, presence);
    this.material = materials.shown;
    this.objects = [materials.depth, materials.shown].map((one) => new Mesh(geometry, one));
    for (const object of this.objects) object.frustumCulled = false;
    this.objects[0].layers.set(FINE);
  }

  /** Moves the vertices with their carriers. @param {Matrix4[]} transforms T_camera_segment (S). */
  place(transforms) {
    const { position, normal } = this.geometry.attributes;
    const { vertices, normals, carriers, weights, each } = this;
    this.posed.forEach((one, s) => one.multiplyMatrices(transforms[s], this.unposed[s]));
    for (let v = 0; v < this.count; v++) {
      const [i, j, k] = [3 * v, 3 * v + 1, 3 * v + 2];
      let [x, y, z, nx, ny, nz] = [0, 0, 0, 0, 0, 0];
      for (let c = v * each; c < (v + 1) * each; c++) {
        const weight = weights[c];
        if (weight === 0) continue;
        const e = this.posed[carriers[c]].elements;
        x += weight * (e[0] * vertices[i] + e[4] * vertices[j] + e[8] * vertices[k] + e[12]);
        y += weight * (e[1] * vertices[i] + e[5] * vertices[j] + e[9] * vertices[k] + e[13]);
        z += weight * (e[2] * vertices[i] + e[6] * vertices[j] + e[10] * vertices[k] + e[14]);
        nx += weight * (e[0] * normals[i] + e[4] * normals[j] + e[8] * normals[k]);
        ny += weight * (e[1] * normals[i] + e[5] * normals[j] + e[9] * normals[k]);
        nz += weight * (e[2] * normals[i] + e[6] * normals[j] + e[10] * normals[k]);
      }
      position.array[i] = x;
      position.array[j] = y;
      position.array[k] = z;
      normal.array[i] = nx;
      normal.array[j] = ny;
      normal.array[k] = nz;
    }
    position.needsUpdate = true;
    normal.needsUpdate = true;
  }

  /** Fades the mesh at segments. @param {ArrayLike<number> | null} confidence Of segments (S). */
  weigh(confidence) {
    const { array } = this.confidence;
    for (let v = 0; v < this.count; v++) {
      array[v] = confidence ? 0 : 1;
      if (!confidence) continue;
      for (let c = v * this.each; c < (v + 1) * this.each; c++) {
        array[v] += this.weights[c] * confidence[this.carriers[c]];
      }
    }
    this.confidence.needsUpdate = true;
  }

  /** @param {string} colour */
  paint(colour) {
    this.material.color.set(colour);
  }

  dispose() {
    this.geometry.dispose();
    for (const object of this.objects) object.material.dispose();
  }
}
