// node browse.mjs FILE...: fails where three.js (three-vrm for .vrm) or Babylon.js, in headless Chromium, does not put
// each vertex of a character where the file's own matrices put it, or does not show it there: at rest, and with elbow,
// knee and neck bent; where it has fingers, from near by, with thumb and index bent.
import { createServer } from "node:http";
import { readFile } from "node:fs/promises";
import { basename, extname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { VRMHumanBoneName, VRMRequiredHumanBoneName } from "@pixiv/three-vrm";
import { launch } from "./browser.mjs";
import { unpacked } from "./packed.mjs";
import { RigFile, silhouette, view_direction } from "./rig_file.mjs";

const here = fileURLToPath(new URL(".", import.meta.url));
const files = process.argv.slice(2);
const size = 256; // of the pictures, pixels
const bend = 1; // radians

const pages = {
  "three.js": `<script type="importmap">{"imports": {
      "three": "/node_modules/three/build/three.module.js",
      "three/addons/": "/node_modules/three/examples/jsm/",
      "@pixiv/three-vrm": "/node_modules/@pixiv/three-vrm/lib/three-vrm.module.js"}}</script>
    <body><script type="module" src="/show_three.mjs"></script>`,
  "Babylon.js": `<body><script src="/node_modules/babylonjs/babylon.js"></script>
    <script src="/node_modules/babylonjs-loaders/babylonjs.loaders.min.js"></script>
    <script type="module" src="/show_babylon.mjs"></script>`,
};

const server = createServer(async (request, response) => {
  const path = decodeURIComponent(new URL(request.url, "http://localhost").pathname);
  try {
    if (path === "/favicon.ico") return response.writeHead(204).end();
    const page = pages[path.slice(1)];
    if (page) return response.setHeader("Content-Type", "text/html").end(`<!doctype html>${page}`);
    const file = path.startsWith("/rigs/") ? files[Number(path.split("/")[2])] : join(here, path);
    const type = [".js", ".mjs"].includes(extname(file)) ? "text/javascript" : "application/octet-stream";
    response.setHeader("Content-Type", type).end(await readFile(file));
  } catch {
    response.writeHead(404).end();
  }
});
await new Promise((done) => server.listen(0, "127.0.0.1", done));

/// The joints that are bent, by the names that they have in files of both kinds.
const bent = [["left_elbow", "leftLowerArm"], ["right_knee", "rightLowerLeg"], ["neck", "neck"]];
const digits = ["left", "right"].flatMap((side) => [
  { names: [`${side}_thumb_2`, `${side}ThumbProximal`], hand: [`${side}_wrist`, `${side}Hand`] },
  { names: [`${side}_index_2`, `${side}IndexIntermediate`], hand: [`${side}_wrist`, `${side}Hand`] },
]);

/// How much of what either picture shows both show; and how much of the whole the first one shows.
function agreement(a, b) {
  let both = 0, either = 0, first = 0;
  a.forEach((is_there, i) => {
    both += is_there & b[i];
    either += is_there | b[i];
    first += is_there;
  });
  return { common: both / either, covered: first / a.length };
}

/// Which pixels are not black, the uppermost row first.
function shown(pixels) {
  const out = new Uint8Array(size * size);
  for (let i = 0; i < out.length; ++i) out[i] = pixels[4 * ((size - 1 - Math.floor(i / size)) * size + (i % size))] > 0;
  return out;
}

/// The largest distance between vertices, and how many lie farther than `least` apart, as a part of all.
function difference(a, b, least) {
  let worst = 0, moved = 0, count = 0;
  a.forEach((places, m) => {
    for (let i = 0; i < places.length; i += 3) {
      const d = Math.hypot(places[i] - b[m][i], places[i + 1] - b[m][i + 1], places[i + 2] - b[m][i + 2]);
      worst = Math.max(worst, d);
      if (d > least) ++moved;
      ++count;
    }
  });
  return { worst, moved: moved / count };
}

/// What is wrong with what an engine makes of a file; empty when it is right.
async function faults(page, url, rig, is_vrm) {
  const found = [];
  const expect = (condition, what) => condition || found.push(what);
  const { bones, humanoid } = await page.evaluate(([url, size]) => window.engine.load(url, size), [url, size]);
  expect(bones.length === rig.names.length && bones.length >= 21 && rig.names.every((name) => bones.includes(name)), `its bones are ${bones}`);
  if (humanoid) {
    const known = Object.values(VRMHumanBoneName), required = Object.values(VRMRequiredHumanBoneName);
    const wanted = rig.names.filter((name) => known.includes(name)); // with fingers the middle of a hand is none of them
    expect(wanted.length >= 19 && wanted.every((name) => humanoid.includes(name)), `its human bones are ${humanoid}`);
    expect(required.every((name) => humanoid.includes(name)), "it lacks a bone that VRM asks for");
    expect(humanoid.every((name) => rig.names.includes(name)), "nodes are not named as VRM's bones");
  }
  expect(!is_vrm || humanoid || page.is_babylon, "it is no humanoid");
  const whole = rig.extent(), rest = rig.posed();
  const named = (names) => names.find((one) => rig.names.includes(one));
  const near = digits.filter(({ names }) => named(names)).map(({ names, hand }) => ({ names, ...rig.extent(rig.followers(named(hand))) }));
  for (const { names, middle, reach } of [{ names: [], ...whole }, ...bent.map((names) => ({ names, ...whole })), ...near]) {
    const name = named(names), told = name ?? "at rest", is_digit = reach !== whole.reach;
    const camera = { middle, reach, depth: 2 * whole.reach, direction: view_direction };
    const seen = await page.evaluate(([...arguments_]) => window.engine.show(...arguments_), [name ?? null, bend, camera]);
    const places = seen.places.map((text) => unpacked(text, Float32Array));
    const wanted = rig.posed(name, bend);
    expect(places.length === wanted.length && places.every((one, m) => one.length === wanted[m].length), `${told}: other vertices`);
    const { worst } = difference(places, wanted, 0);
    expect(worst < 1e-4 * whole.reach, `${told}: a vertex is ${worst / whole.reach} of the picture off`);
    const { common, covered } = agreement(silhouette(rig, wanted, size, camera), shown(unpacked(seen.pixels, Uint8Array)));
    expect(common > 0.98, `${told}: the pictures have ${common} in common`);
    expect(covered > 0.01 && covered < 0.9, `${told}: the body covers ${covered} of the picture`);
    const { moved } = difference(places, rest, 5e-3 * reach);
    const most = is_digit ? 0.3 : name === "neck" ? 0.9 : 0.6; // heads may have most of a character's vertices
    expect(name ? moved > (is_digit ? 0 : 0.01) && moved < most : moved === 0, `${told}: ${moved} of the vertices move`);
    const followers = rig.followers(name);
    const others = places.map((one, m) => one.map((x, i) => (followers[m][Math.floor(i / 3)] ? rest[m][i] : x)));
    const stray = difference(others, rest, 0).worst;
    expect(stray < 1e-5 * whole.reach, `${told}: what does not follow it moves by ${stray / whole.reach} of the picture`);
  }
  return found;
}

const browser = await launch();
let failed = 0;
for (const engine of Object.keys(pages)) {
  const page = await browser.newPage();
  page.is_babylon = engine === "Babylon.js";
  const messages = [];
  page.on("console", (message) => message.type() === "error" && messages.push(message.text()));
  page.on("pageerror", (error) => messages.push(String(error)));
  await page.goto(`http://127.0.0.1:${server.address().port}/${encodeURIComponent(engine)}`);
  await page.waitForFunction("window.engine", null, { timeout: 60000 }).catch(() => {});
  let failed_here = 0;
  for (const [i, file] of files.entries()) {
    let found;
    try {
      found = await faults(page, `/rigs/${i}/${basename(file)}`, new RigFile(await readFile(file)), extname(file) === ".vrm");
    } catch (error) {
      found = [String(error).split("\n")[0]];
    }
    found.push(...messages.splice(0));
    for (const fault of found) console.log(`${engine}: ${file}: ${fault}`);
    if (found.length > 0) ++failed_here;
  }
  console.log(`${engine}: ${files.length} files, ${failed_here} failed`);
  failed += failed_here;
  await page.close();
}
await browser.close();
server.close();
process.exit(files.length > 0 && failed === 0 ? 0 : 1);
