// node serve.mjs FOLDER [PORT]: serves a folder on localhost, compressed as static hosts do. Tests import `serve`.
import { createServer } from "node:http";
import { readFile } from "node:fs/promises";
import { extname, join, normalize } from "node:path";
import { fileURLToPath } from "node:url";
import { promisify } from "node:util";
import { brotliCompress, constants } from "node:zlib";

const types = {
  ".html": "text/html", ".js": "text/javascript", ".mjs": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml",
  ".wasm": "application/wasm", ".glb": "model/gltf-binary", ".json": "application/json",
};
const pack = promisify(brotliCompress);

/// The server, and how many bytes it has sent as content.
export async function serve(folder, port = 0) {
  const packed = new Map();
  const server = createServer(async (request, response) => {
    const path = normalize(decodeURIComponent(new URL(request.url, "http://localhost").pathname)).replace(/\/$/, "/index.html");
    try {
      if (!packed.has(path))
        packed.set(path, await pack(await readFile(join(folder, path)), { params: { [constants.BROTLI_PARAM_QUALITY]: 5 } }));
      const bytes = packed.get(path);
      server.sent += bytes.length;
      response.writeHead(200, { "Content-Type": types[extname(path)] ?? "application/octet-stream", "Content-Encoding": "br" }).end(bytes);
    } catch {
      response.writeHead(404).end();
    }
  });
  server.sent = 0;
  await new Promise((done) => server.listen(port, "127.0.0.1", done));
  server.url = `http://localhost:${server.address().port}/`;
  return server;
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const [folder, port] = process.argv.slice(2);
  console.log(`the page is at ${(await serve(folder, Number(port ?? 0))).url}`);
}
