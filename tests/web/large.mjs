// node large.mjs PAGE PROGRAM WORK: fails where a body of 100 thousand faces does not turn on the page as lightly as on a
// page of `skelgen view`, or where a file of 200 MB with two million faces freezes the tab, or is neither shown nor refused.
import { execFileSync } from "node:child_process";
import { createWriteStream, mkdirSync, readFileSync, statSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { Faults, launch } from "./browser.mjs";
import { drop, state } from "./checks.mjs";
import { serve } from "./serve.mjs";

const [folder, program, work] = process.argv.slice(2);
const faults = new Faults();
const expect = faults.expect.bind(faults);
mkdirSync(work, { recursive: true });
const server = await serve(folder), browser = await launch();
const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
await page.goto(server.url);
await page.waitForSelector('body[data-worker="ready"]', { timeout: 60000 });

// ---- 100 thousand faces, on both pages ----

const body = join(work, "large.off"), view = join(work, "large.html");
execFileSync(program, ["synth", "--pose", "t", "--faces", "100000", "-o", body]);
execFileSync(program, ["view", body, "-q", "-o", view]);

/// Pictures a second while an arrow key turns the body, and what the page's own script takes for one of them, in ms.
const turned = (shown) => shown.evaluate(() => new Promise((done) => {
  const canvas = document.getElementById("canvas"), original = window.requestAnimationFrame, times = [];
  window.requestAnimationFrame = (callback) => original((now) => {
    const start = performance.now();
    callback(now);
    times.push(performance.now() - start);
  });
  const begin = performance.now();
  const turn = (now) => {
    if (now - begin > 6000) {
      window.requestAnimationFrame = original;
      return done({ rate: (1000 * times.length) / (now - begin), own: times.sort((a, b) => a - b)[times.length >> 1] });
    }
    canvas.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight", bubbles: true }));
    original(turn);
  };
  original(turn);
}));

const beside = await browser.newPage({ viewport: { width: 1280, height: 800 } });
await beside.goto(pathToFileURL(resolve(view)).href);
await beside.waitForSelector("#canvas");
await beside.waitForTimeout(2000);
const theirs = await turned(beside);
await beside.close();
await drop(page, body);
expect((await state(page)) === "shown", `100 thousand faces: ${await state(page)}`);
const ours = await turned(page);
const told = ({ rate, own }) => `${rate.toFixed(1)} pictures a second, ${own.toFixed(1)} ms of script for each`;
console.log(`100 thousand faces turn, drawn without a graphics card: the page ${told(ours)}; skelgen view ${told(theirs)}`);
expect(ours.own < 1000 / 60, `a picture of 100 thousand faces takes the page's script ${ours.own} ms`);
expect(ours.own < 2 * theirs.own + 1, `it takes ${ours.own} ms, and that of skelgen view ${theirs.own} ms`);

// ---- 200 MB, two million faces ----

/// A body of `Math.pow(4, times)` as many faces, as an OBJ with normals; edges are halved. Lines are long as scanners write them.
async function written(from, times, path) {
  const [, counts, ...lines] = readFileSync(from, "utf8").trim().split("\n");
  const [vertices] = counts.split(" ").map(Number);
  const places = lines.slice(0, vertices).map((line) => line.split(" ").map(Number));
  let faces = lines.slice(vertices).map((line) => line.split(" ").slice(1, 4).map(Number));
  for (let i = 0; i < times; ++i) {
    const middles = new Map();
    const middle = (a, b) => {
      const key = Math.min(a, b) * 2 ** 24 + Math.max(a, b);
      if (!middles.has(key)) middles.set(key, places.push(places[a].map((x, axis) => (x + places[b][axis]) / 2)) - 1);
      return middles.get(key);
    };
    faces = faces.flatMap(([a, b, c]) => {
      const [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
      return [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]];
    });
  }
  const file = createWriteStream(path);
  const write = async (of, line) => {
    for (let i = 0; i < of.length; i += 20000)
      if (!file.write(of.slice(i, i + 20000).map(line).join(""))) await new Promise((done) => file.once("drain", done));
  };
  await write(places, (p) => `v ${p.map((x) => x.toFixed(15)).join(" ")}\nvn ${p.map((x) => x.toFixed(15)).join(" ")}\n`);
  await write(faces, (f) => `f ${f.map((v) => `${v + 1}//${v + 1}`).join(" ")}\n`);
  await new Promise((done) => file.end(done));
  return faces.length;
}

const small = join(work, "small.off"), huge = join(work, "huge.obj");
execFileSync(program, ["synth", "--pose", "t", "--faces", "32000", "-o", small]);
const faces = await written(small, 3, huge);
const megabytes = statSync(huge).size / 2 ** 20;
expect(faces > 1.9e6 && megabytes > 195, `the huge file has ${faces} faces and ${megabytes.toFixed(0)} MB`);
// A tab is alive while what is to be done at once is done at once.
await page.evaluate(() => {
  window.longest = 0;
  window.said = new Set();
  let last = performance.now();
  setInterval(() => {
    const now = performance.now();
    window.longest = Math.max(window.longest, now - last);
    last = now;
    if (document.body.dataset.state === "busy") window.said.add(document.getElementById("busy-text").textContent);
  }, 20);
});
const start = performance.now();
await drop(page, huge);
const { longest, said } = await page.evaluate(() => ({ longest: window.longest, said: [...window.said] }));
const end = await state(page);
const seconds = (performance.now() - start) / 1000;
console.log(`${(faces / 1e6).toFixed(1)} million faces, ${megabytes.toFixed(0)} MB: ${end} after ${seconds.toFixed(1)} s, the tab busy for ${(longest / 1000).toFixed(1)} s at most; it says ${said.join(" ")}`);
expect(end === "shown" || end === "refused", `the huge file: ${end}`);
expect(said.length > 0, "of the huge file nothing is said while it is read");
expect(longest < 3000, `the tab stands still for ${(longest / 1000).toFixed(1)} s`);
if (end === "refused") console.log(`  it says: ${(await page.locator("#refused").innerText()).replace(/\s+/g, " ")}`);
await page.screenshot({ path: join(work, "huge.png"), timeout: 120000 });
await browser.close();
server.close();
faults.finish("large files");
