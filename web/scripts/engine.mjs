// Builds the engine: the crate as WebAssembly, and the JavaScript that calls it, into generated/.
import { execFileSync } from "node:child_process";
import { fileURLToPath } from "node:url";

const web = fileURLToPath(new URL("..", import.meta.url));
const target = process.env.CARGO_TARGET_DIR ?? `${web}target`;
const run = (program, ...args) => execFileSync(program, args, { cwd: web, stdio: "inherit" });

run("cargo", "build", "--locked", "--release", "--target", "wasm32-unknown-unknown", "-p", "planar-impact-web");
run("cargo", "build", "--locked", "--release", "-p", "planar-impact-bindgen");
run(`${target}/release/planar-impact-bindgen`, `${target}/wasm32-unknown-unknown/release/planar_impact_web.wasm`, `${web}generated`);
