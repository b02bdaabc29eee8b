// The engine in Node and the command line give the same bytes, over random collisions. RANDOM_CASES sets their number.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { cliLater, random, web } from "./browser.mjs";

globalThis.planarImpactProgress = () => {};
const engine = await import("../generated/verbs.js");
engine.initSync({ module: readFileSync(join(web, "generated/verbs_bg.wasm")) });

/** Two vehicles that mostly drive towards each other; some cases are refused, which must agree too. */
function collision(number) {
  const next = random(number);
  const between = (low, high) => low + (high - low) * next();
  const facing = between(-180, 180);
  const vehicle = (turn) => `[[vehicle]]
mass = "${between(800, 20000)} kg"
${next() < 0.5 ? `yaw_inertia = "${between(800, 40000)} kg m^2"` : `radius_of_gyration = "${between(1, 2)} m"`}
heading = "${facing + turn + between(-60, 60)} deg"
speed = "${between(0, 120)} ${next() < 0.5 ? "km/h" : "mph"}"
yaw_rate = "${between(-30, 30)} deg/s"
impact_center = ["${between(-1, 2.5)} m", "${between(-1, 1)} m"]
`;
  const ratio = next() < 0.5 ? "" : `impulse_ratio = { of_critical = ${next()} }\n`;
  return `schema = 1\n${vehicle(0)}${vehicle(180)}[contact]\ncrush_plane = "${facing + between(-30, 30)} deg"\nrestitution = ${next() * 0.4}\n${ratio}`;
}

test("random collisions", { timeout: 3_600_000 }, async () => {
  const count = Number(process.env.RANDOM_CASES ?? 10_000);
  const folder = mkdtempSync(join(tmpdir(), "planar-impact-"));
  let [next, solved] = [0, 0];
  const lane = async (lane) => {
    const file = join(folder, `${lane}.toml`);
    while (next < count) {
      const number = next++;
      const text = collision(number);
      writeFileSync(file, text);
      const { output } = await cliLater(["solve", file, "--format", "json"]);
      const reply = engine.answer("solve", JSON.stringify({ name: "a.toml", text }), "{}");
      assert.equal(reply.json, output, `case ${number}:\n${text}`);
      reply.free();
      if (output !== "") solved++;
    }
  };
  await Promise.all([lane(0), lane(1)]);
  rmSync(folder, { recursive: true });
  console.log(`${count} collisions, of which ${solved} are solved`);
  assert.ok(solved > count / 4);
});
