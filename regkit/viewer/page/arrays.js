/** Typed arrays from a scene's entries, which hold their numbers as base64. */

const TYPES = { f4: Float32Array, i2: Int16Array, u2: Uint16Array, u4: Uint32Array };

/**
 * @typedef {Float32Array | Int16Array | Uint16Array | Uint32Array} Numbers
 * @typedef {{dtype: keyof TYPES, shape: number[], data: string}} Entry
 */

/**
 * Returns the numbers of an entry, in one typed array.
 * @param {Entry} entry
 * @returns {Numbers}
 */
export function numbers(entry) {
  const text = atob(entry.data);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
  return new TYPES[entry.dtype](bytes.buffer);
}

/**
 * Returns views of an entry's rows: of each frame's numbers, for instance.
 * @param {Entry} entry
 * @returns {Numbers[]}
 */
export function rows(entry) {
  const all = numbers(entry);
  const width = all.length / entry.shape[0];
  return Array.from({ length: entry.shape[0] }, (_, row) =>
    all.subarray(row * width, (row + 1) * width),
  );
}

/**
 * Returns the numbers of an entry, or of nested lists, in which null is not a number.
 * @param {Entry | any[]} value
 * @param {new (list: number[]) => Numbers} Type
 * @returns {Numbers}
 */
export function listed(value, Type = Float32Array) {
  if (!Array.isArray(value)) return numbers(value);
  return new Type(value.flat(Infinity).map((one) => one ?? NaN));
}
