// What the tests of package and page share: what the program finds in the same files, and how far apart answers are.
import { execFile } from "node:child_process";
import { mkdtemp, readFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { basename, join } from "node:path";
import { promisify } from "node:util";

const run = promisify(execFile);

/// The program beside which all is judged.
export class Program {
  static async at(path) {
    const program = new Program();
    program.path = path;
    program.folder = await mkdtemp(join(tmpdir(), "skelgen-web-"));
    return program;
  }
  /// What it writes into a file of that name, and how many seconds it took; null where it finds no skeleton.
  async written(command, mesh, name, ...options) {
    const out = join(this.folder, name);
    const start = performance.now();
    try {
      await run(this.path, [command, mesh, "-o", out, "-q", ...options]);
    } catch (error) {
      if (error.code === 4) return null;
      throw error;
    }
    return { bytes: await readFile(out), seconds: (performance.now() - start) / 1000 };
  }
  async skeleton(mesh) {
    const made = await this.written("extract", mesh, `${basename(mesh)}.json`);
    return made && { ...JSON.parse(made.bytes), seconds: made.seconds };
  }
  rig = (mesh, format, ...options) => this.written("rig", mesh, `${basename(mesh)}.${format}`, ...options);
}

/// The largest distance between the same joints, as a part of the body's size.
export function apart(a, b) {
  if (a.joints.length !== b.joints.length) return Infinity;
  const size = a.mesh.geodesic_diameter;
  return Math.max(...a.joints.map((joint, j) => {
    const other = b.joints[j];
    if (joint.name !== other.name || Boolean(joint.position) !== Boolean(other.position)) return Infinity;
    return joint.position ? Math.hypot(...joint.position.map((x, axis) => x - other.position[axis])) / size : 0;
  }));
}

/// How far apart the directions of two bodies' frames are.
export const turned = (a, b) =>
  Math.max(...["left", "forward", "up"].flatMap((name) => a.frame[name].map((x, axis) => Math.abs(x - b.frame[name][axis]))));

/// A GLB's JSON, and the numbers of its accessors.
export class Glb {
  constructor(bytes) {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    const length = view.getUint32(12, true);
    this.json = JSON.parse(new TextDecoder().decode(bytes.subarray(20, 20 + length)));
    this.view = new DataView(bytes.buffer, bytes.byteOffset + 20 + length + 8);
  }
  numbers(index) {
    const { bufferView, byteOffset = 0, componentType, count, type } = this.json.accessors[index];
    const { byteOffset: start = 0, byteStride } = this.json.bufferViews[bufferView];
    const [read, bytes] = { 5121: ["getUint8", 1], 5123: ["getUint16", 2], 5125: ["getUint32", 4], 5126: ["getFloat32", 4] }[componentType];
    const width = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4, MAT4: 16 }[type];
    const out = new Float64Array(width * count);
    for (let row = 0; row < count; ++row)
      for (let k = 0; k < width; ++k)
        out[row * width + k] = this.view[read](start + byteOffset + row * (byteStride ?? width * bytes) + k * bytes, true);
    return out;
  }
  /// Names, parents and places of the bones, and weights of the vertices by the bones' numbers.
  rig() {
    const { nodes, skins, meshes } = this.json;
    const bones = skins[0].joints.map((node) => {
      const parent = nodes.findIndex(({ children = [] }) => children.includes(node));
      return { name: nodes[node].name, parent: skins[0].joints.indexOf(parent), place: nodes[node].translation ?? [0, 0, 0] };
    });
    const primitive = meshes[0].primitives[0].attributes;
    return { bones, joints: this.numbers(primitive.JOINTS_0), weights: this.numbers(primitive.WEIGHTS_0), positions: this.numbers(primitive.POSITION) };
  }
}

/// What is different between two rigs: the bones' names and parents, or how far apart places (of the size) and weights are.
export function difference(a, b) {
  if (a.bones.map(({ name, parent }) => `${name} ${parent}`).join() !== b.bones.map(({ name, parent }) => `${name} ${parent}`).join())
    return { bones: Infinity, weights: Infinity };
  const size = Math.max(...a.positions) - Math.min(...a.positions);
  const bones = Math.max(...a.bones.flatMap(({ place }, j) => place.map((x, axis) => Math.abs(x - b.bones[j].place[axis])))) / size;
  const of = ({ joints, weights }, v) => {
    const out = new Map();
    for (let k = 4 * v; k < 4 * v + 4; ++k) out.set(joints[k], (out.get(joints[k]) ?? 0) + weights[k]);
    return out;
  };
  let weights = a.weights.length === b.weights.length ? 0 : Infinity;
  for (let v = 0; v < a.weights.length / 4 && weights < Infinity; ++v) {
    const [one, other] = [of(a, v), of(b, v)];
    for (const joint of new Set([...one.keys(), ...other.keys()]))
      weights = Math.max(weights, Math.abs((one.get(joint) ?? 0) - (other.get(joint) ?? 0)));
  }
  return { bones, weights };
}

/// How far weights may be apart. Fingers are narrow beside the faces they are of: there rounding counts for more.
export const most_weight = ({ bones }) => (bones.some(({ name }) => /index/i.test(name)) ? 2e-4 : 1e-5);

/// What the page is at.
export const state = (page) => page.evaluate(() => document.body.dataset.state);
/// Waits until it computes no more.
export const settled = async (page, most = 600000) => {
  await page.waitForFunction(() => document.body.dataset.state !== "busy", null, { timeout: most });
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
};

/// As if files were dropped from a file manager; their content comes through an input, since a script may not name paths.
export async function drop(page, ...paths) {
  await page.evaluate(() => {
    if (document.getElementById("carrier")) return;
    const input = Object.assign(document.createElement("input"), { type: "file", multiple: true, id: "carrier", hidden: true, ariaLabel: "carrier" });
    document.body.append(input);
  });
  await page.setInputFiles("#carrier", paths);
  await page.evaluate(() => {
    const input = document.getElementById("carrier"), dataTransfer = new DataTransfer();
    for (const file of input.files) dataTransfer.items.add(file);
    input.value = "";
    window.dispatchEvent(new DragEvent("drop", { dataTransfer, bubbles: true, cancelable: true }));
  });
  await settled(page);
}
