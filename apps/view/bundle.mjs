// node bundle.mjs OUT.cpp: the page with its scripts and styles as one text, in the C++ that apps/skelgen compiles.
import { readFile, writeFile } from "node:fs/promises";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const beside = (name) => new URL(name, import.meta.url);
const [out] = process.argv.slice(2);

const bundled = await build({
  entryPoints: [fileURLToPath(beside("main.mjs"))],
  bundle: true,
  minify: true,
  format: "iife",
  target: "es2022",
  legalComments: "inline", // three.js's licence goes where its code goes
  charset: "ascii",
  write: false,
});
const parts = { script: bundled.outputFiles[0].text, style: await readFile(beside("style.css"), "utf8") };
const html = await readFile(beside("page.html"), "utf8");
const page = html.replace(/<!--(script|style)-->/g, (_, name) => parts[name]);

// Compilers need not take longer literals than this; adjacent ones are one.
const delimiter = "skelgen";
if (page.includes(`)${delimiter}"`)) throw new Error("the page holds what ends a literal");
const literals = page.match(/[^]{1,8000}/g).map((piece) => `    R"${delimiter}(${piece})${delimiter}"\n`);
await writeFile(out, `#include "view_bundle.hpp"

namespace skelgen::cli {

std::string_view view_bundle() {
  static constexpr char page[] =
${literals.join("")};
  return {page, sizeof(page) - 1};
}

} // namespace skelgen::cli
`);
