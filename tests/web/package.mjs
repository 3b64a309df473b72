// node package.mjs PACKAGE PROGRAM MESH...: fails where the npm package, packed and installed into an empty project, does not
// give what the program gives, or does not do what its types say.
import { execFileSync } from "node:child_process";
import { cpSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { basename, join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { brotliCompressSync, gzipSync } from "node:zlib";
import { createRequire } from "node:module";
import { Faults, launch } from "./browser.mjs";
import { Glb, Program, apart, difference, most_weight, turned } from "./checks.mjs";
import { serve } from "./serve.mjs";

const [source, program_path, ...meshes] = process.argv.slice(2);
const faults = new Faults();
const expect = faults.expect.bind(faults);
const here = fileURLToPath(new URL(".", import.meta.url));

// ---- packed, and installed where there is nothing else ----

const project = join(here, "project");
rmSync(project, { recursive: true, force: true });
mkdirSync(project, { recursive: true });
const npm = (folder, ...words) => execFileSync("npm", words, { cwd: folder, encoding: "utf8" });
const packed = npm(resolve(source), "pack", "--silent", "--pack-destination", project).trim();
writeFileSync(join(project, "package.json"), '{"name": "empty", "private": true, "type": "module"}\n');
npm(project, "install", "--silent", "--no-audit", "--no-fund", "--offline", `./${packed}`);
const installed = join(project, "node_modules", "skelgen");
const skelgen = await import(pathToFileURL(join(installed, "skelgen.mjs")).href);
const { SkelgenWorker } = await import(pathToFileURL(join(installed, "remote.mjs")).href);

const wasm = readFileSync(join(installed, "skelgen.wasm"));
const small = brotliCompressSync(wasm).length;
expect(small <= 1.6 * 2 ** 20, `the .wasm has ${(small / 2 ** 20).toFixed(2)} MB, compressed`);
console.log(`.wasm: ${(wasm.length / 2 ** 20).toFixed(2)} MB, ${(small / 2 ** 20).toFixed(2)} MB by brotli`);

// ---- joints are the program's ----

const program = await Program.at(program_path);
const engine = await skelgen.load();
let worst = 0, heaviest = 0, slower = [], count = 0;
for (const mesh of meshes) {
  const bytes = readFileSync(mesh), name = basename(mesh);
  const wanted = await program.skeleton(mesh);
  const start = performance.now();
  const body = await engine.extract({ name, bytes }).catch((error) => error);
  const seconds = (performance.now() - start) / 1000;
  if (wanted === null || body instanceof Error) {
    if (body.message?.includes("which this build of skelgen cannot read")) continue; // it says what it lacks
    expect(wanted === null && body.code === "no_skeleton", `${name}: the program ${wanted ? "finds" : "refuses"} it, the package says ${body.message ?? "found"}`);
    continue;
  }
  const distance = apart(wanted, body.skeleton);
  expect(distance < 1e-6, `${name}: joints are ${distance} of the body away from the program's`);
  expect(turned(wanted, body.skeleton) < 1e-6, `${name}: its directions are ${turned(wanted, body.skeleton)} off`);
  expect(Math.abs(wanted.quality.sides_confidence - body.quality.sides_confidence) < 1e-6, `${name}: the confidence is another`);
  expect(wanted.quality.warnings.join() === body.quality.warnings.join(), `${name}: warnings are ${body.quality.warnings}`);
  const rigged = await program.rig(mesh, "glb", "--names", "mixamo", "--fingers", "off"), own = body.rig({ fingers: "off" });
  const { bones, weights } = difference(new Glb(rigged.bytes).rig(), new Glb(own.file("glb", { names: "mixamo" })).rig());
  expect(bones < 1e-5 && weights < 1e-5, `${name}: bones of the glb differ by ${bones}, weights by ${weights}`);
  own.delete();
  worst = Math.max(worst, distance);
  heaviest = Math.max(heaviest, weights);
  slower.push({ name, native: wanted.seconds, node: seconds, faces: wanted.mesh.faces });
  ++count;
  body.delete();
}
console.log(`joints of ${count} bodies lie within ${worst.toExponential(1)} of the program's, of the body's size; weights of their rigs within ${heaviest.toExponential(1)}`);
const sum = (key) => slower.reduce((all, one) => all + one[key], 0);
console.log(`the program takes ${sum("native").toFixed(2)} s for them, with starting and reading, Node ${sum("node").toFixed(2)} s`);

// ---- rigs are the program's ----

for (const mesh of meshes.slice(3, 6)) {
  const input = { name: basename(mesh), bytes: readFileSync(mesh) };
  const wanted = await program.rig(mesh, "vrm"), made = await engine.rig(input, { format: "vrm" }).catch((error) => error);
  if (!wanted || made instanceof Error) {
    expect(!wanted, `${input.name}: no vrm: ${made.message}`);
    continue;
  }
  const theirs = new Glb(wanted.bytes).rig(), { bones, weights } = difference(theirs, new Glb(made).rig());
  expect(bones < 1e-5 && weights < most_weight(theirs), `${input.name}: bones of the vrm differ by ${bones}, weights by ${weights}`);
}
const sample = { name: "body.off", bytes: readFileSync(meshes[0]) };
for (const format of ["bvh", "fbx"]) {
  const wanted = await program.rig(meshes[0], format), made = await engine.rig(sample, { format });
  if (format === "bvh") {
    const numbers = (bytes) => new TextDecoder().decode(bytes).match(/-?\d+\.?\d*(e-?\d+)?/g).map(Number);
    const a = numbers(wanted.bytes), b = numbers(made);
    expect(a.length === b.length && a.every((x, i) => Math.abs(x - b[i]) < 1e-3), "the BVH has other numbers");
  } else {
    // The program packs the arrays in it, and so they are not to be compared byte by byte.
    const names = ["left_knee", "right_wrist", "head"], text = new TextDecoder("latin1").decode(made);
    expect(wanted.bytes.length > 1000 && text.startsWith("Kaydara FBX Binary") && names.every((name) => text.includes(name)), "the FBX has no bones");
  }
}

// ---- what else there is ----

const read = await engine.read(sample);
expect(read.positions instanceof Float64Array && read.faces instanceof Uint32Array, "read gives other arrays");
const body = await engine.extract({ positions: Float32Array.from(read.positions), faces: read.faces });
expect(body.joints.length === 21, "arrays of float have no 21 joints");
const parts = body.segment();
expect(parts.parts.includes("left_hand") && parts.vertexPart.length === read.positions.length / 3, "parts are not there");
expect(body.measure().height > 1.4 && body.measure().height < 2.1, `the sample is ${body.measure().height} high`);
const again = body.fit(body.skeleton);
expect(apart({ ...body.skeleton, mesh: { geodesic_diameter: 1 } }, again.skeleton) < 1e-9, "a skeleton that is taken back is another");
const rig = body.rig({ rest: "t-pose" });
await rig.follow(readFileSync(join(here, "../../data/sample/walk.bvh")), "walk");
expect(new Glb(rig.file("glb")).json.animations?.[0].name === "walk", "the clip is not in the file");
expect(!new Glb(rig.file("glb", { animations: false })).json.animations, "a clip is in a file that wants none");
expect(rig.skinJoints.length === (4 * rig.positions.length) / 3, "there are not four joints a vertex");
// From the mesh to the rig by each joint's own motion.
const own = body.rig({ rest: "a-pose", fingers: "off" });
for (const { name, motion, position } of own.joints) {
  const [x, y, z, w, ...shift] = motion, p = body.joints.find((one) => one.name === name).position.map((v) => v * own.metresPerUnit);
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const once = cross([x, y, z], p), twice = cross([x, y, z], once);
  const to = p.map((v, axis) => v + 2 * w * once[axis] + 2 * twice[axis] + shift[axis]);
  expect(Math.hypot(...to.map((v, axis) => v - position[axis])) < 1e-9, `${name} is not moved by its own motion`);
}
own.delete();
const zipped = await engine.extract({ name: "body.off.gz", bytes: gzipSync(sample.bytes) });
expect(zipped.joints.length === 21, "a file compressed by gzip is not read");
const toed = await engine.extract(sample, { fingers: "on", toes: true });
expect(toed.skeleton.joints.length === 71, `with fingers and toes there are ${toed.skeleton.joints.length} joints`);
for (const thing of [rig, again, body, zipped, toed]) thing.delete();

const code_of = (promise) => promise.then(() => "none", (error) => error.code ?? String(error));
expect((await code_of(engine.extract({ positions: new Float64Array(9), faces: new Uint32Array([0, 1, 7]) }))) === "bad_input", "a face without its vertex is taken");
expect((await code_of(engine.extract(sample, { template: "nobody" }))) === "usage", "an unknown template is taken");
expect((await code_of(engine.rig(sample, { format: "doc" }))) === "usage", "an unknown format is taken");
expect((await code_of(engine.extract(sample, { progress: () => false }))) === "cancelled", "progress does not end the search");
expect((await code_of(engine.extract({ name: "x.off", bytes: new Uint8Array(0) }))) === "bad_input", "an empty file is taken");
const cube = "OFF\n8 12 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n3 0 2 1\n3 0 3 2\n3 4 5 6\n3 4 6 7\n3 0 1 5\n3 0 5 4\n3 1 2 6\n3 1 6 5\n3 2 3 7\n3 2 7 6\n3 3 0 4\n3 3 4 7\n";
const refused = await engine.extract({ name: "cube.off", bytes: cube }).catch((error) => error);
expect(refused.code === "no_skeleton" && refused.refusal && refused.trail.length > 0, "a cube is a body");

// ---- in a worker ----

const worker = new SkelgenWorker();
const seen = [];
const remote = await worker.extract(sample, { onProgress: (progress) => seen.push(progress) });
expect(remote.joints.length === 21 && seen.length > 0, "the worker finds nothing, or says nothing");
expect(new Glb(await (await remote.rig()).file("glb")).rig().bones.length >= 21, "the worker's rig has no bones");
const ender = new AbortController();
const ended = code_of(worker.extract(sample, { signal: ender.signal, onProgress: () => ender.abort() }));
setTimeout(() => ender.abort(), 5);
expect((await ended) === "cancelled", "the worker is not ended");
expect((await worker.measure(sample)).height > 1, "after an end it does nothing");
worker.delete();

// ---- no leak ----

const memory = [];
for (let i = 0; i < 30; ++i) {
  const one = await engine.extract(sample);
  one.rig().delete();
  one.delete();
  memory.push(engine.core.HEAPU8?.length ?? process.memoryUsage().rss);
}
expect(memory.at(-1) <= 1.1 * memory[4], `memory grows from ${memory[4]} to ${memory.at(-1)}`);

// ---- types, and a page that is bundled ----

cpSync(join(here, "types.ts"), join(project, "types.ts"));
const tsc = join(here, "node_modules/typescript/bin/tsc");
try {
  execFileSync("node", [tsc, "--strict", "--noEmit", "--target", "es2022", "--lib", "es2022,dom", "--module", "nodenext", "--skipLibCheck", "false", "types.ts"], { cwd: project, encoding: "utf8" });
} catch (error) {
  expect(false, `the types: ${error.stdout}`);
}
const site = join(project, "site");
mkdirSync(site, { recursive: true });
writeFileSync(join(project, "page.mjs"), `import { SkelgenWorker } from "skelgen/remote";
import { extract } from "skelgen";
const mesh = async () => ({ name: "body.off", bytes: await (await fetch("body.off")).arrayBuffer() });
window.in_worker = async () => {
  const worker = new SkelgenWorker({ worker: new URL("worker.js", document.baseURI), wasm: new URL("skelgen.wasm", document.baseURI).href });
  const body = await worker.extract(await mesh());
  const glb = await (await body.rig()).file("glb");
  worker.delete();
  return { skeleton: body.skeleton, bytes: glb.length };
};
window.in_page = async () => (await extract(await mesh())).skeleton;
`);
const { build } = createRequire(join(here, "../../apps/view/package.json"))("esbuild");
await build({ absWorkingDir: project, entryPoints: { page: "./page.mjs", worker: "skelgen/worker" }, bundle: true, minify: true, format: "esm", outdir: site, logLevel: "error" });
writeFileSync(join(site, "index.html"), '<!doctype html><script type="module" src="page.js"></script>');
cpSync(join(installed, "skelgen.wasm"), join(site, "skelgen.wasm"));
cpSync(meshes[0], join(site, "body.off"));
const server = await serve(site), browser = await launch(), page = await browser.newPage();
await page.goto(server.url);
await page.waitForFunction(() => window.in_page);
const wanted = await program.skeleton(meshes[0]);
const bundled = await page.evaluate(() => window.in_worker()).catch((error) => ({ error: String(error) }));
expect(bundled.skeleton && apart(wanted, bundled.skeleton) < 1e-6 && bundled.bytes > 1000, `bundled, the worker says ${bundled.error}`);
const plain = await page.evaluate(() => window.in_page()).catch((error) => ({ error: String(error) }));
expect(plain.joints && apart(wanted, plain) < 1e-6, `bundled, the page itself says ${plain.error}`);
await browser.close();
server.close();
faults.finish("the package");
