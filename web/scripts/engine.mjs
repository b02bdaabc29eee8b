// Builds the engine into generated/, as WebAssembly and the JavaScript that calls it: for the page's own thread (frame) and for its workers (verbs).
import { execFileSync } from "node:child_process";
import { fileURLToPath } from "node:url";

const web = fileURLToPath(new URL("..", import.meta.url));
const target = process.env.CARGO_TARGET_DIR ?? `${web}target`;
const run = (program, ...args) => execFileSync(program, args, { cwd: web, stdio: "inherit" });

run("cargo", "build", "--locked", "--release", "-p", "planar-impact-bindgen");
for (const [part, profile] of [["frame", "frame"], ["verbs", "release"]]) {
  run("cargo", "build", "--locked", "--profile", profile, "--target", "wasm32-unknown-unknown", "-p", "planar-impact-web", "--no-default-features", "--features", part);
  run(`${target}/release/planar-impact-bindgen`, `${target}/wasm32-unknown-unknown/${profile}/planar_impact_web.wasm`, `${web}generated`, part);
}
