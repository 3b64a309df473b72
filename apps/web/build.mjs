// node build.mjs WASM OUT: the page as a folder of static files. WASM: the folder with core.mjs and skelgen's .wasm.
import { createHash } from "node:crypto";
import { cp, mkdir, readFile, rm, writeFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";

const [wasm, out] = process.argv.slice(2);
const here = (path) => fileURLToPath(new URL(path, import.meta.url));
// three.js and esbuild are those of the page of `skelgen view`, whose modules are in this one.
const { build } = createRequire(new URL("../view/package.json", import.meta.url))("esbuild");

await rm(out, { recursive: true, force: true });
await mkdir(join(out, "samples"), { recursive: true });
const made_core = { name: "core", setup: ({ onResolve }) => onResolve({ filter: /\/core\.mjs$/ }, () => ({ path: join(process.cwd(), wasm, "core.mjs") })) };
await build({
  entryPoints: { main: here("main.mjs"), worker: here("../../bindings/wasm/worker.mjs") },
  bundle: true, minify: true, format: "esm", target: "es2022", charset: "ascii", outdir: out,
  legalComments: "linked", // licences of others' code in a file beside it
  plugins: [made_core],
  nodePaths: [here("../view/node_modules")],
});
const copies = {
  "index.html": here("page.html"), "style.css": here("style.css"), "icon.svg": here("icon.svg"), "skelgen.wasm": join(wasm, "skelgen.wasm"),
  "walk.bvh": here("../../data/sample/walk.bvh"), "samples/README.md": here("samples/README.md"),
};
for (const [to, from] of Object.entries(copies)) await cp(from, join(out, to));
// Samples are packed here, since not every host packs them; of the body's coordinates a micrometre is enough.
const body = (await readFile(here("../../data/sample/body.off"), "utf8")).replace(/-?\d+\.\d{7,}/g, (number) => Number(number).toFixed(6));
const samples = { "body.off": body, "man.glb": await readFile(here("samples/man.glb")), "zombie.glb": await readFile(here("samples/zombie.glb")) };
for (const [name, bytes] of Object.entries(samples)) await writeFile(join(out, `samples/${name}.gz`), gzipSync(bytes, { level: 9 }));

const kept = ["main.js", "worker.js", ...Object.keys(copies), ...Object.keys(samples).map((name) => `samples/${name}.gz`)];
const hash = createHash("sha256");
for (const file of kept) hash.update(await readFile(join(out, file)));
const offline = (await readFile(here("offline.js"), "utf8"))
  .replace("const files = []", `const files = ${JSON.stringify(["./", ...kept])}`)
  .replace('const version = ""', `const version = "skelgen-${hash.digest("hex").slice(0, 12)}"`);
await writeFile(join(out, "offline.js"), offline);
