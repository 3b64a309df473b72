// node fbx.mjs NAME...: fails where three.js' FBXLoader, in headless Chromium, does not put the triangles of NAME.fbx, which
// has one animation of 30 frames a second, where NAME-FRAME.off has them, one file for each pose that is looked at; or finds
// other bones or morph targets than NAME.glb has.
import { createServer } from "node:http";
import { readFile, readdir } from "node:fs/promises";
import { basename, dirname, extname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { launch } from "./browser.mjs";
import { unpacked } from "./packed.mjs";

const here = fileURLToPath(new URL(".", import.meta.url));
const names = process.argv.slice(2);
const page_text = `<!doctype html><script type="importmap">{"imports": {
    "three": "/node_modules/three/build/three.module.js",
    "three/addons/": "/node_modules/three/examples/jsm/"}}</script>
  <body><script type="module" src="/show_fbx.mjs"></script>`;

const server = createServer(async (request, response) => {
  const path = decodeURIComponent(new URL(request.url, "http://localhost").pathname);
  try {
    if (path === "/favicon.ico") return response.writeHead(204).end();
    if (path === "/page") return response.setHeader("Content-Type", "text/html").end(page_text);
    const file = path.startsWith("/characters/") ? `${names[Number(path.split("/")[2])]}.fbx` : join(here, path);
    const type = extname(file) === ".mjs" || extname(file) === ".js" ? "text/javascript" : "application/octet-stream";
    response.setHeader("Content-Type", type).end(await readFile(file));
  } catch {
    response.writeHead(404).end();
  }
});
await new Promise((done) => server.listen(0, "127.0.0.1", done));

/// Where the triangles of an OFF file have their corners.
async function corners_of(file) {
  const words = (await readFile(file, "latin1")).split(/\s+/);
  const vertices = Number(words[1]), faces = Number(words[2]), out = new Float32Array(9 * faces);
  for (let f = 0; f < faces; ++f)
    for (let k = 0; k < 3; ++k)
      for (let axis = 0; axis < 3; ++axis)
        out[9 * f + 3 * k + axis] = Number(words[4 + 3 * Number(words[4 + 3 * vertices + 4 * f + 1 + k]) + axis]);
  return out;
}

async function scene_of(file) {
  const bytes = await readFile(file);
  return JSON.parse(bytes.subarray(20, 20 + bytes.readUInt32LE(12)).toString());
}

function extent(corners) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  corners.forEach((x, i) => {
    low[i % 3] = Math.min(low[i % 3], x);
    high[i % 3] = Math.max(high[i % 3], x);
  });
  return Math.max(...high.map((x, axis) => x - low[axis]));
}

async function faults(page, number, name) {
  const found = [];
  const folder = dirname(name);
  const poses = (await readdir(folder)).filter((file) =>
    file.startsWith(`${basename(name)}-`) && /^\d+\.off$/.test(file.slice(basename(name).length + 1)));
  if (poses.length === 0) return ["there are no poses to compare with"];
  const glb = await scene_of(`${name}.glb`);
  const weights = Object.fromEntries(glb.meshes.flatMap(({ extras, weights = [] }) =>
    (extras?.targetNames ?? []).map((target, i) => [target, weights[i] ?? 0])));
  const loaded = await page.evaluate(([url, morphs]) => window.load(url, morphs),
    [`/characters/${number}/${basename(name)}.fbx`, weights]);
  const bones = glb.skins[0].joints.map((joint) => glb.nodes[joint].name);
  // three.js writes names so that tracks of animations can have them.
  const plain = (text) => text.replace(/\s/g, "_").replace(/[[\].:/]/g, "");
  if (loaded.bones.sort().join() !== bones.map(plain).sort().join()) found.push(`its bones are ${loaded.bones}`);
  const morphs = glb.meshes.reduce((sum, mesh) => sum + (mesh.primitives[0].targets?.length ?? 0), 0);
  if (loaded.morphs !== morphs) found.push(`it has ${loaded.morphs} morph targets, not ${morphs}`);
  let worst = 0;
  for (const file of poses) {
    const frame = Number(/-(\d+)\.off$/.exec(file)[1]);
    const wanted = await corners_of(join(folder, file));
    const seen = unpacked(await page.evaluate((time) => window.pose(time), frame / 30), Float32Array);
    if (seen.length !== wanted.length) found.push(`frame ${frame}: ${seen.length / 9} triangles, not ${wanted.length / 9}`);
    else worst = seen.reduce((most, x, i) => Math.max(most, Math.abs(x - wanted[i])), worst * extent(wanted)) / extent(wanted);
  }
  console.log(`${name}: ${poses.length} poses, triangles within ${worst.toExponential(1)} of the extent`);
  if (!(worst < 1e-4)) found.push(`triangles differ by ${worst} of the extent`);
  return found;
}

const browser = await launch();
const page = await browser.newPage();
page.on("pageerror", (error) => console.log(String(error)));
await page.goto(`http://127.0.0.1:${server.address().port}/page`);
await page.waitForFunction("window.load", null, { timeout: 60000 });
let failed = 0;
for (const [i, name] of names.entries()) {
  let found;
  try {
    found = await faults(page, i, name);
  } catch (error) {
    found = [String(error).split("\n")[0]];
  }
  for (const fault of found) console.log(`${name}: ${fault}`);
  if (found.length > 0) ++failed;
}
console.log(`three.js' FBXLoader: ${names.length} files, ${failed} failed`);
await browser.close();
server.close();
process.exit(names.length > 0 && failed === 0 ? 0 : 1);
