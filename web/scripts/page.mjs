// Builds dist/: bundles, the page, examples, the worker that serves the page without a network, and the licenses of everything in it.
import { build } from "esbuild";
import { createHash } from "node:crypto";
import { execFileSync } from "node:child_process";
import { cpSync, existsSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { brotliCompressSync, gzipSync } from "node:zlib";

const web = fileURLToPath(new URL("..", import.meta.url));
const root = join(web, "..");
const dist = join(web, "dist");
rmSync(dist, { recursive: true, force: true });
mkdirSync(dist, { recursive: true });

/** Examples of the command line, each with the files that it names. */
function examples() {
  const under = (folder) => readdirSync(join(root, "cli/examples", folder)).filter((name) => name.endsWith(".toml")).sort().map((name) => join(folder, name));
  return ["", "reconstruct", "uncertainty"].flatMap(under).map((path) => {
    const file = join(root, "cli/examples", path);
    const text = readFileSync(file, "utf8");
    const named = [...text.matchAll(/"([^"\n]+\.(?:csv|toml|json))"/g)].map((found) => found[1]).filter((name) => existsSync(join(dirname(file), name)));
    return { path, title: /^title = "(.*)"$/m.exec(text)?.[1] ?? path, text, files: Object.fromEntries(named.map((name) => [name, readFileSync(join(dirname(file), name), "utf8")])) };
  });
}
mkdirSync(join(web, "generated"), { recursive: true });
writeFileSync(join(web, "generated/examples.json"), JSON.stringify(examples()));

const { metafile } = await build({
  absWorkingDir: web,
  entryPoints: { main: "src/main.ts", worker: "src/worker.ts" },
  bundle: true,
  format: "esm",
  target: "es2022",
  minify: true,
  legalComments: "none",
  outdir: "dist",
  metafile: true,
  define: { "process.env.NODE_ENV": '"production"' },
});
cpSync(join(web, "static"), dist, { recursive: true });
for (const part of ["frame", "verbs"]) cpSync(join(web, `generated/${part}_bg.wasm`), join(dist, `${part}.wasm`));
writeFileSync(join(dist, "case.schema.json"), JSON.stringify(JSON.parse(readFileSync(join(root, "schemas/case.schema.json"), "utf8"))));
writeFileSync(join(dist, "LICENSES.txt"), licenses(Object.keys(metafile.inputs)));

// The worker of the page keeps exactly these files, under a name that changes with their contents.
const files = readdirSync(dist).filter((name) => name !== "sw.js").sort();
const version = createHash("sha256");
for (const name of files) version.update(name).update(readFileSync(join(dist, name)));
const kept = ["./", ...files.filter((name) => name !== "LICENSES.txt")];
const worker = readFileSync(join(web, "src/sw.js"), "utf8");
writeFileSync(join(dist, "sw.js"), worker.replace("__VERSION__", version.digest("hex").slice(0, 16)).replace('"__FILES__"', JSON.stringify(kept)));

let [plain, gzip, brotli] = [0, 0, 0];
for (const name of readdirSync(dist).sort()) {
  const bytes = readFileSync(join(dist, name));
  const sizes = [bytes.length, gzipSync(bytes, { level: 9 }).length, brotliCompressSync(bytes).length];
  console.log(`${name.padEnd(24)}${sizes.map((size) => size.toLocaleString("en").padStart(12)).join("")}`);
  if (name === "LICENSES.txt") continue;
  [plain, gzip, brotli] = [plain + sizes[0], gzip + sizes[1], brotli + sizes[2]];
}
console.log(`${"without LICENSES.txt".padEnd(24)}${[plain, gzip, brotli].map((size) => size.toLocaleString("en").padStart(12)).join("")}  (plain, gzip, brotli)`);

/** The license texts of every package and crate that is in the page. */
function licenses(inputs) {
  const texts = (folder) =>
    readdirSync(folder).filter((name) => /^(licen[cs]e|copying|notice|copyright)/i.test(name)).sort().map((name) => join(folder, name))
      .flatMap((path) => { try { return [readFileSync(path, "utf8").trim()]; } catch { return []; } });
  const parts = [`planar-impact (MIT OR Apache-2.0)\n\n${texts(root).join("\n\n")}`];
  const packages = new Set(inputs.map((input) => /node_modules\/((?:@[^/]+\/)?[^/]+)/.exec(input)?.[1]).filter(Boolean));
  for (const name of [...packages].sort()) {
    const folder = join(web, "node_modules", name);
    const { version, license } = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
    parts.push(`${name} ${version} (${license})\n\n${texts(folder).join("\n\n")}`);
  }
  const tree = execFileSync("cargo", ["metadata", "--locked", "--format-version", "1", "--filter-platform", "wasm32-unknown-unknown"], { cwd: web, maxBuffer: 1 << 28 });
  const { packages: crates, resolve } = JSON.parse(tree);
  const byId = new Map(crates.map((crate) => [crate.id, crate]));
  const nodes = new Map(resolve.nodes.map((node) => [node.id, node]));
  const found = new Set();
  const visit = (id) => {
    if (found.has(id)) return;
    found.add(id);
    for (const { pkg, dep_kinds } of nodes.get(id).deps) if (dep_kinds.some(({ kind }) => kind === null)) visit(pkg);
  };
  visit(crates.find(({ name }) => name === "planar-impact-web").id);
  for (const { name, version, license, manifest_path, source } of [...found].map((id) => byId.get(id)).filter(({ source }) => source).sort((a, b) => a.name.localeCompare(b.name))) {
    void source;
    parts.push(`${name} ${version} (${license})\n\n${texts(dirname(manifest_path)).join("\n\n")}`);
  }
  return parts.join(`\n\n${"=".repeat(100)}\n\n`) + "\n";
}
