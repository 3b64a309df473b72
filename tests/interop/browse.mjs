// node browse.mjs FILE...: fails where three.js (three-vrm for .vrm), in headless Chromium, does not show a character
// that bends elbow, knee and neck.
import { createServer } from "node:http";
import { readFile } from "node:fs/promises";
import { basename, extname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { launch } from "./browser.mjs";

const here = fileURLToPath(new URL(".", import.meta.url));
const files = process.argv.slice(2);
const page_text = `<!doctype html><script type="importmap">{"imports": {
  "three": "/node_modules/three/build/three.module.js",
  "three/addons/": "/node_modules/three/examples/jsm/",
  "@pixiv/three-vrm": "/node_modules/@pixiv/three-vrm/lib/three-vrm.module.js"}}</script>
<body><script type="module" src="/viewer.mjs"></script>`;

const server = createServer(async (request, response) => {
  const path = new URL(request.url, "http://localhost").pathname;
  try {
    if (path === "/favicon.ico") return response.writeHead(204).end();
    if (path === "/") return response.setHeader("Content-Type", "text/html").end(page_text);
    const file = path.startsWith("/rigs/") ? files[Number(path.split("/")[2])] : join(here, path);
    const type = [".js", ".mjs"].includes(extname(file)) ? "text/javascript" : "application/octet-stream";
    response.setHeader("Content-Type", type).end(await readFile(file));
  } catch {
    response.writeHead(404).end();
  }
});
await new Promise((done) => server.listen(0, "127.0.0.1", done));

/// What is wrong with what the browser saw; empty when it is right.
function faults(seen, file) {
  const found = [];
  const expect = (condition, what) => condition || found.push(what);
  expect(seen.bones === 21, `${seen.bones} bones`);
  expect(seen.covered > 0.01 && seen.covered < 0.9, `the body covers ${seen.covered} of the picture`);
  if (extname(file) === ".vrm") expect(seen.humanoid === 21, `${seen.humanoid} bones of a humanoid`);
  for (const [bone, bend] of Object.entries(seen.bends)) {
    expect(bend.moved > 0.01 && bend.moved < 0.6, `${bone} moves ${bend.moved} of the vertices`);
    expect(bend.beyond === 0, `${bone} throws ${bend.beyond} vertices farther than it turns`);
    expect(bend.picture > 0.0005, `${bone} changes ${bend.picture} of the picture`);
  }
  return found;
}

const browser = await launch();
const page = await browser.newPage();
const messages = [];
page.on("console", (message) => message.type() === "error" && messages.push(message.text()));
page.on("pageerror", (error) => messages.push(String(error)));
await page.goto(`http://127.0.0.1:${server.address().port}/`);
await page.waitForFunction("window.ready", null, { timeout: 60000 }).catch(() => {});
let failed = 0;
for (const [i, file] of files.entries()) {
  let found;
  try {
    found = faults(await page.evaluate((url) => window.inspect(url), `/rigs/${i}/${basename(file)}`), file);
  } catch (error) {
    found = [String(error).split("\n")[0]];
  }
  found.push(...messages.splice(0));
  for (const fault of found) console.log(`${file}: ${fault}`);
  if (found.length > 0) ++failed;
}
await browser.close();
server.close();
console.log(`three.js: ${files.length} files, ${failed} failed`);
process.exit(files.length > 0 && failed === 0 ? 0 : 1);
