// node nine_primitives.mjs BODY.off OUT.glb: the body in nine bands, each a primitive with vertices and a material of its
// own; the first is small, as a character's teeth are.
import { readFile, writeFile } from "node:fs/promises";

const [body, out] = process.argv.slice(2);
const numbers = (await readFile(body, "utf8")).trim().split(/\s+/).slice(1).map(Number);
const [vertices, faces] = numbers, point = (v) => numbers.slice(3 + 3 * v, 6 + 3 * v);
const corners = (f) => numbers.slice(3 + 3 * vertices + 4 * f + 1, 3 + 3 * vertices + 4 * f + 4);
const height = (f) => corners(f).reduce((sum, v) => sum + point(v)[1], 0);
const downwards = Array.from({ length: faces }, (_, f) => f).sort((a, b) => height(b) - height(a));
const bands = 9, first = Math.floor(faces / 200);
const band = (place) => (place < first ? 0 : 1 + Math.floor(((place - first) * (bands - 1)) / (faces - first)));

const gltf = { asset: { version: "2.0" }, scene: 0, scenes: [{ nodes: [0] }], nodes: [{ mesh: 0 }], meshes: [{ primitives: [] }],
  materials: [], accessors: [], bufferViews: [], buffers: [] };
const parts = [];
const store = (bytes, accessor) => {
  const byteOffset = parts.reduce((sum, part) => sum + part.length, 0);
  parts.push(bytes);
  gltf.bufferViews.push({ buffer: 0, byteOffset, byteLength: bytes.length });
  return gltf.accessors.push({ bufferView: gltf.bufferViews.length - 1, ...accessor }) - 1;
};
for (let k = 0; k < bands; ++k) {
  const own = new Map(), indices = [];
  downwards.forEach((f, place) => band(place) === k && indices.push(...corners(f).map((v) => {
    if (!own.has(v)) own.set(v, own.size);
    return own.get(v);
  })));
  const points = [...own.keys()].map(point), extreme = (best) => [0, 1, 2].map((i) => points.reduce((a, p) => best(a, Math.fround(p[i])), Math.fround(points[0][i])));
  const position = store(Buffer.from(new Float32Array(points.flat()).buffer),
    { componentType: 5126, count: points.length, type: "VEC3", min: extreme(Math.min), max: extreme(Math.max) });
  const index = store(Buffer.from(new Uint32Array(indices).buffer), { componentType: 5125, count: indices.length, type: "SCALAR" });
  // Greens, neither blue nor yellow as bones are.
  gltf.materials.push({ name: `band${k}`, pbrMetallicRoughness: { baseColorFactor: [0.15, 0.2 + 0.02 * k, 0.15, 1], metallicFactor: 0 } });
  gltf.meshes[0].primitives.push({ attributes: { POSITION: position }, indices: index, material: k });
}
const binary = Buffer.concat(parts);
gltf.buffers.push({ byteLength: binary.length });
const text = JSON.stringify(gltf), json = Buffer.from(text.padEnd(4 * Math.ceil(text.length / 4)));
const header = Buffer.alloc(20), between = Buffer.alloc(8);
[0x46546c67, 2, 28 + json.length + binary.length, json.length, 0x4e4f534a].forEach((word, i) => header.writeUInt32LE(word, 4 * i));
between.writeUInt32LE(binary.length, 0);
between.writeUInt32LE(0x004e4942, 4);
await writeFile(out, Buffer.concat([header, json, between, binary]));
