// Random addresses and case files, mostly damaged: each is read, or refused with its reason; nothing traps. HOSTILE_CASES sets their number.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { deflateRawSync } from "node:zlib";
import { build } from "esbuild";
import { examples, random, web } from "./browser.mjs";

const COUNT = Number(process.env.HOSTILE_CASES ?? 3_000);
const WORDS = ["", "\0", "\u202e", "😀", "\ud800", "</script>", "1e999", "-0", "[[[[", "{{", "\"\"\"", "# ", "=", "\n", "[[vehicle]]\n", "± 1", "nan", " kg", "__proto__", "9".repeat(400), "[".repeat(3000)];

async function module(source) {
  const { outputFiles } = await build({ absWorkingDir: web, entryPoints: [source], bundle: true, format: "esm", write: false });
  return import(`data:text/javascript;base64,${Buffer.from(outputFiles[0].contents).toString("base64")}`);
}

/** Changes a text at a few places: cuts, doubles, moves and inserts. */
function damaged(text, next) {
  for (let times = 1 + Math.floor(3 * next()); times > 0; times--) {
    const at = Math.floor(next() * (text.length + 1));
    const to = Math.min(text.length, at + Math.floor(next() ** 4 * 200));
    const word = WORDS[Math.floor(next() * WORDS.length)];
    text = [text.slice(0, at) + text.slice(to), text.slice(0, to) + text.slice(at), text.slice(0, at) + word + text.slice(at), text.slice(at) + text.slice(0, at)][Math.floor(4 * next())];
  }
  return text;
}

test("a case comes back from its address", async () => {
  const { pack, unpack } = await module("src/share.ts");
  assert.equal(await unpack(""), null);
  assert.equal(await unpack("#"), null);
  const next = random(1);
  const text = () => Array.from({ length: Math.floor(20 * next()) }, () => WORDS[Math.floor(next() * WORDS.length)]).join("").toWellFormed();
  for (let k = 0; k < COUNT / 10; k++) {
    const files = JSON.parse(`{${Array.from({ length: Math.floor(3 * next()) }, (_, i) => `${JSON.stringify(i === 1 ? "__proto__" : `${i}.csv`)}:${JSON.stringify(text())}`).join()}}`);
    const shared = { name: text().slice(0, 200).toWellFormed(), text: text(), files };
    const back = await unpack(await pack(shared));
    assert.deepEqual([back.name, back.text, Object.entries(back.files)], [shared.name, shared.text, Object.entries(files)]);
  }
});

test("an address that could not be read again is not written", async () => {
  const { pack, unpack } = await module("src/share.ts");
  const of = (bytes) => pack({ name: "a.toml", text: "", files: { "a.csv": "0".repeat(bytes) } });
  await assert.rejects(of(4 << 20), /^Error: the case and its files are larger than 4 MiB/);
  assert.equal((await unpack(await of((4 << 20) - 100))).files["a.csv"].length, (4 << 20) - 100);
});

test("half of a character is neither written nor read", async () => {
  const { pack, unpack } = await module("src/share.ts");
  for (const shared of [["\ud800", "", {}], ["a", "x\udc00", {}], ["a", "", { "\ud800": "" }], ["a", "", { b: "\ud800" }]]) {
    await assert.rejects(pack({ name: shared[0], text: shared[1], files: shared[2] }), /half of a character/);
    await assert.rejects(unpack(`#1.${deflateRawSync(JSON.stringify(shared)).toString("base64url")}`), /^Error: the case of this address is damaged$/);
  }
  assert.equal((await unpack(await pack({ name: "😀".repeat(300), text: "", files: {} }))).name, "😀".repeat(200));
});

test("a damaged address is refused with its reason", async () => {
  const { pack, unpack } = await module("src/share.ts");
  const next = random(2);
  const original = { name: "a.toml", text: examples[0].text, files: { "a.csv": "1,2\n" } };
  const whole = await pack(original);
  const odd = [null, 1, [], ["a"], ["a", 1, {}], ["a", "b", null], ["a", "b", { c: 1 }], ["a", "b", []], ["a", "b", {}, 1], { 0: "a", 1: "b", 2: {} }];
  let [refused, read] = [0, 0];
  const visit = async (fragment) => {
    try {
      const shared = await unpack(fragment);
      if (shared === null) return null;
      assert.ok(typeof shared.name === "string" && shared.name.length <= 200 && typeof shared.text === "string");
      assert.ok(Object.values(shared.files).every((file) => typeof file === "string"));
      read++;
      return shared;
    } catch (error) {
      assert.match(error.message, /^the (part of this address after # is not a case|case of this address is (too large|damaged|of version [0-9]{1,9}; this page reads versions 1 and 2|larger than 4 MiB))$/);
      refused++;
      return null;
    }
  };
  for (const value of odd) await visit(`#1.${deflateRawSync(JSON.stringify(value)).toString("base64url")}`);
  assert.equal(refused, odd.length - 1, "an empty list is no names");
  // Addresses of version 1 are read as ever.
  assert.deepEqual(await visit(`#1.${deflateRawSync(JSON.stringify(Object.values(original))).toString("base64url")}`), original);
  [refused, read] = [0, 0];
  for (let k = 0; k < COUNT; k++) {
    const shared = await visit(damaged(whole, next));
    if (shared !== null) assert.deepEqual(shared, original);
  }
  assert.ok(refused > COUNT / 2 && read > 0, `${refused} refused, ${read} read`);
  // No letter that is changed opens another case.
  for (let at = 3; at < whole.length; at++) {
    const other = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_"[Math.floor(64 * next())];
    const shared = await visit(whole.slice(0, at) + other + whole.slice(at + 1));
    if (shared !== null) assert.deepEqual(shared, original);
  }
});

test("a damaged case has a frame or issues, and edits of it do not trap", async () => {
  const engine = await import("../generated/frame.js");
  engine.initSync({ module: readFileSync(join(web, "generated/frame_bg.wasm")) });
  const next = random(3);
  const named = ["contact.crush_plane", "vehicle.1.speed", "vehicle.2.impact_center.left", "contact.restitution", "no.input"];
  let [drawn, refused] = [0, 0];
  for (let k = 0; k < COUNT; k++) {
    const { text: whole, files } = examples[k % examples.length];
    const text = damaged(whole, next);
    const frame = engine.frame(JSON.stringify({ name: "a.toml", text, files }));
    const issues = frame.issues === "" ? [] : JSON.parse(frame.issues);
    assert.ok(issues.length > 0 || frame.has_unknowns || (frame.scene.startsWith("<svg") && JSON.parse(frame.handles) !== null), text);
    assert.notEqual(frame.cause, "defect", text);
    for (const { message, file, from, to } of issues) {
      assert.ok(message.length > 0 && (file !== "a.toml" || from === null || (from <= to && to <= text.length)), JSON.stringify(issues));
    }
    if (issues.length > 0) refused++;
    else drawn++;
    frame.free();
    const input = named[k % named.length];
    const edited = engine.write_number("a.toml", text, input, 0.1 * next(), 0.001);
    // An edit of a text that can be read is read back.
    if (edited.json !== "") {
      const change = JSON.parse(edited.json);
      const after = change.sort((one, other) => other.from - one.from).reduce((text, { from, to, insert }) => text.slice(0, from) + insert + text.slice(to), text);
      assert.ok(Number.isFinite(engine.number_at("a.toml", after, input)), `${input}\n${after}`);
    }
    edited.free();
  }
  console.log(`${drawn} drawn, ${refused} refused`);
  assert.ok(drawn > COUNT / 20 && refused > COUNT / 20, `${drawn} drawn, ${refused} refused`);
});
