// Serves dist/ on this machine: any static host does.  node scripts/serve.mjs [PORT]
import { createServer } from "node:http";
import { readFile } from "node:fs/promises";
import { extname, join, normalize } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";

const TYPES = {
  ".html": "text/html; charset=utf-8",
  ".js": "text/javascript; charset=utf-8",
  ".css": "text/css; charset=utf-8",
  ".wasm": "application/wasm",
  ".json": "application/json",
  ".svg": "image/svg+xml",
  ".txt": "text/plain; charset=utf-8",
  ".webmanifest": "application/manifest+json",
};

/** Serves a folder; the files of `instead`, by their paths, take the place of its own. Browsers keep a file for as many seconds as are given. */
export function serve(folder, port = 0, { instead = new Map(), seconds = 0 } = {}) {
  const packed = new Map();
  const keep = seconds > 0 ? `max-age=${seconds}` : "no-store";
  const server = createServer(async (request, response) => {
    const path = normalize(decodeURIComponent(new URL(request.url ?? "/", "http://localhost").pathname)).replace(/^(\.\.[/\\])+/, "");
    const file = join(folder, path.endsWith("/") ? `${path}index.html` : path);
    const other = instead.get(path);
    try {
      if (other === undefined && !packed.has(file)) packed.set(file, gzipSync(await readFile(file)));
      response.writeHead(200, { "content-type": TYPES[extname(file)] ?? "application/octet-stream", "content-encoding": "gzip", "cache-control": keep });
      response.end(other === undefined ? packed.get(file) : gzipSync(other));
    } catch {
      response.writeHead(404).end("not found");
    }
  });
  return new Promise((resolve) => server.listen(port, "127.0.0.1", () => resolve(server)));
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const server = await serve(fileURLToPath(new URL("../dist", import.meta.url)), Number(process.argv[2] ?? 8080));
  console.log(`http://localhost:${server.address().port}/`);
}
