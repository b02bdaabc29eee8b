// The page in Debian's Chromium: loads, answers, drags, edits, exports, shares; and what a hostile case does to it.
import assert from "node:assert/strict";
import { createHash } from "node:crypto";
import { appendFileSync, cpSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, describe, test } from "node:test";
import { isDeepStrictEqual } from "node:util";
import { brotliCompressSync, deflateRawSync, gzipSync } from "node:zlib";
import { build } from "esbuild";
import { axe, cli, examples, exported, loadExample, open, root, settled, start, text, type, web } from "./browser.mjs";

let site;
before(async () => (site = await start()));
after(() => site.close());

const pictures = join(web, "test-results");
mkdirSync(pictures, { recursive: true });

/** Opens the page, runs a test, and fails on any error, violation of the policy or request to elsewhere. */
async function visit(act, options) {
  const { page, faults, context } = await open(site, options);
  try {
    await page.waitForFunction(() => Number(document.documentElement.dataset.frame ?? "0") > 0 || !document.querySelector("#message").hidden);
    await act(page, faults);
    assert.deepEqual(faults, []);
  } finally {
    await context.close();
  }
}

/** Waits until the page and its files are kept for use without a network. */
async function kept(page) {
  await page.waitForFunction(() => navigator.serviceWorker.ready.then(() => true));
  await page.waitForFunction(() => navigator.serviceWorker.controller !== null);
}

/** Compares long texts, and shows where they differ. */
function same(actual, expected, what) {
  if (actual === expected) return;
  let at = 0;
  while (actual[at] === expected[at]) at++;
  assert.fail(`${what}: ${JSON.stringify(actual.slice(Math.max(at - 80, 0), at + 80))} instead of ${JSON.stringify(expected.slice(Math.max(at - 80, 0), at + 80))}`);
}

function close(actual, expected, relative, what) {
  assert.ok(actual === expected || Math.abs(actual - expected) <= relative * Math.abs(expected), `${what}: ${actual} instead of ${expected}`);
}

/** A search takes roots and powers of the platform, so its steps differ in the last bits; where it ends does not. */
function near(actual, expected, what) {
  assert.equal(actual.verdict, expected.verdict, what);
  assert.deepEqual(Object.keys(actual), Object.keys(expected));
  for (const [name, { value }] of Object.entries(expected.unknown)) if (value !== null) close(actual.unknown[name].value, value, 1e-6, `${what} ${name}`);
}

const degrees = (source) => Number(/^crush_plane = "(-?[0-9.]+) deg"/m.exec(source)?.[1] ?? NaN);
const handle = (page, key) => page.locator(`[data-handle="${key}"]`);

async function pull(page, key, by, steps = 10) {
  const box = await handle(page, key).locator(".dot").boundingBox();
  const from = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(...from);
  await page.mouse.down();
  await page.mouse.move(from[0] + by[0], from[1] + by[1], { steps });
  await page.mouse.up();
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
}

describe("the page", () => {
  test("opens in under a second from a cold cache, with less than a megabyte", async () => {
    const { page, context } = await open(site);
    await page.waitForFunction(() => document.documentElement.dataset.ready === "true");
    const opened = await page.evaluate(() => performance.getEntriesByType("mark").find(({ name }) => name === "ready").startTime);
    const fetched = await page.evaluate(() => performance.getEntriesByType("resource").map(({ name }) => new URL(name).pathname.slice(1)));
    await context.close();
    const files = [...new Set(["index.html", ...fetched])];
    const size = (pack) => files.reduce((sum, name) => sum + pack(readFileSync(join(web, "dist", name))).length, 0);
    const [gzip, brotli] = [size((bytes) => gzipSync(bytes, { level: 9 })), size(brotliCompressSync)];
    console.log(`ready after ${opened.toFixed(0)} ms; ${files.length} files, ${gzip} bytes with gzip, ${brotli} with Brotli`);
    assert.ok(files.includes("frame.wasm") && !files.includes("verbs.wasm"), files.join());
    assert.ok(gzip < 1e6, `${gzip} bytes`);
    assert.ok(opened < (process.env.CI_SLOW ? 5000 : 1000), `${opened} ms`);
  });

  test("says so when the engine of the verbs cannot be fetched, and asks again", async () => {
    const { page, faults, context } = await open(site);
    await page.waitForFunction(() => document.documentElement.dataset.ready === "true");
    await page.route("**/verbs.wasm", (route) => route.abort());
    await page.click("#tab-sweep");
    await page.waitForFunction(() => document.querySelector("#answers .status").textContent.startsWith("No answer"));
    // The page itself goes on.
    await settled(page, () => page.locator("#restitution").fill("0.12"));
    await page.unroute("**/verbs.wasm");
    await page.click("#tab-sweep");
    await page.waitForFunction(() => document.querySelector("#answers .status").textContent.startsWith("Done"));
    await context.close();
    assert.deepEqual(faults.filter((fault) => !fault.includes("net::ERR_FAILED")), []);
  });

  test("shows every example, with the numbers of the command line", async () => {
    await visit(async (page) => {
      for (const { path, text: source } of examples) {
        await loadExample(page, path);
        const verb = /^\[unknown\]|^\[unknown/m.test(source) ? "reconstruct" : "solve";
        await page.click(`#tab-${verb}`);
        const expected = cli([verb, `cli/examples/${path}`, "--format", "json"]);
        if (expected.output === "") {
          await page.waitForSelector(".issues li");
          continue;
        }
        const { bytes } = await exported(page, "json");
        if (verb === "solve") same(bytes.toString(), expected.output, `${verb} ${path}`);
        else near(JSON.parse(bytes), JSON.parse(expected.output), path);
      }
    });
  });

  test("answers every verb as the command line does", async () => {
    await visit(async (page) => {
      const compare = async (path, verb, args) => {
        await loadExample(page, path);
        await page.click(`#tab-${verb}`);
        const { bytes } = await exported(page, "json");
        same(bytes.toString(), cli([verb, `cli/examples/${path}`, ...args, "--format", "json"]).output, verb);
      };
      await compare("position-a.toml", "gradient", []);
      await compare("position-a.toml", "sweep", ["--vary", "contact.crush_plane=-10 deg:10 deg:1 deg", "--of", "W_n,W_t,T_L,mu0"]);
      await compare("cavalier-crush.toml", "crush", []);
      await compare("cavalier-crush.toml", "crash3", []);
      const live = ["--method", "linear,second-order,monte-carlo,sobol,shapley"];
      await compare("uncertain.toml", "uncertainty", live);
      const sameTable = async (methods) => {
        const { bytes } = await exported(page, "csv");
        same(bytes.toString(), cli(["uncertainty", "cli/examples/uncertain.toml", ...methods, "--format", "csv"]).output, "CSV");
      };
      await sameTable(live);
      await page.getByLabel("Guaranteed ranges").check();
      await sameTable([]);
      await loadExample(page, "slide.toml");
      await page.click("#tab-slide");
      const slid = JSON.parse((await exported(page, "json")).bytes.toString());
      const expected = JSON.parse(cli(["slide", "cli/examples/slide.toml", "--format", "json"]).output);
      slid.vehicles.forEach(({ rest, distance }, k) => {
        close(distance, expected.vehicles[k].distance, 1e-6, "distance");
        rest.position.forEach((place, i) => close(place, expected.vehicles[k].rest.position[i], 1e-6, "rest position"));
      });
      await loadExample(page, "position-a.toml");
      await page.click("#tab-formula");
      await page.waitForSelector("#result math");
      const formula = JSON.parse((await exported(page, "json")).bytes.toString());
      assert.deepEqual(formula, JSON.parse(cli(["formula", "T_L", "--case", "cli/examples/position-a.toml", "--format", "json"]).output));
    });
  });

  test("draws and reports what the command line does", async () => {
    await visit(async (page) => {
      const drawn = join(tmpdir(), `planar-impact-${process.pid}.svg`);
      cli(["draw", "cli/examples/position-b.toml", "-o", drawn]);
      await loadExample(page, "position-b.toml");
      same((await exported(page, "svg")).bytes.toString(), readFileSync(drawn, "utf8"), "SVG");
      const report = (await exported(page, "report")).bytes.toString();
      const page_ = cli(["report", "cli/examples/position-b.toml", "-o", `${drawn}.html`]);
      assert.equal(page_.status, 0);
      // The name of the file is in the report, and the command line has its whole path.
      same(report, readFileSync(`${drawn}.html`, "utf8").replaceAll("cli/examples/position-b.toml", "position-b.toml"), "report");
      const png = (await exported(page, "png")).bytes;
      assert.deepEqual([...png.subarray(1, 4)], [..."PNG"].map((c) => c.charCodeAt(0)));
      assert.ok(png.readUInt32BE(16) === 2000, "twice the width of the drawing");
    });
  });

  test("a report comes back as the case that it is of", async () => {
    await visit(async (page) => {
      await loadExample(page, "sideswipe.toml");
      const source = await text(page);
      const { bytes } = await exported(page, "report");
      await loadExample(page, "position-a.toml");
      await settled(page, () => page.setInputFiles("#open", { name: "sideswipe.html", mimeType: "text/html", buffer: bytes }));
      assert.equal(await text(page), source);
    });
  });

  test("a file that is not UTF-8 is refused", async () => {
    await visit(async (page) => {
      const before = await text(page);
      const latin = Buffer.from('schema = 1\ntitle = "Citro\u00ebn"\n[[vehicle]]\n', "latin1");
      await page.setInputFiles("#open", [{ name: "latin1.toml", mimeType: "application/toml", buffer: latin }]);
      await page.waitForFunction(() => document.querySelector("#message").textContent.includes("latin1.toml is not UTF-8 text"));
      assert.equal(await text(page), before);
    });
  });

  test("a file is kept with its ends of lines and its mark, in what is saved, shared and reported", async () => {
    const lines = examples.find(({ path }) => path === "position-a.toml").text;
    const windows = lines.replaceAll("\n", "\r\n");
    const take = (page, source) => settled(page, () => page.setInputFiles("#open", { name: "a.toml", mimeType: "text/plain", buffer: Buffer.from(source) }));
    await visit(async (page) => {
      for (const source of [windows, `\ufeff${windows}`, windows.replace("\r\n", "\n")]) {
        await take(page, source);
        assert.equal(await text(page), source);
        // The engine reads no mark.
        const hash = createHash("sha256").update(source.replace("\ufeff", "")).digest("hex");
        assert.ok((await exported(page, "report")).bytes.toString().includes(hash));
      }
      await take(page, `\ufeff${windows}`);
      await page.click("#share");
      await page.waitForFunction(() => location.hash.startsWith("#2."));
      const fragment = await page.evaluate(() => location.hash);
      await visit(async (other) => {
        await other.waitForFunction(() => document.documentElement.dataset.ready === "true");
        assert.equal(await text(other), `\ufeff${windows}`);
      }, { fragment });
      // An edit changes its value alone, and its place is found.
      await settled(page, () => page.locator("#restitution").fill("0.12"));
      assert.equal(await text(page), `\ufeff${windows.replace("restitution = 0", "restitution = 0.12")}`);
      await settled(page, () => page.locator("#gamma").fill("3"));
      assert.equal(await text(page), `\ufeff${windows.replace("restitution = 0", "restitution = 0.12").replace('"0 deg"', '"3 deg"')}`);
      await take(page, windows.replace('"180 deg"', '"180 ft"'));
      await page.waitForSelector("#editor .cm-lintRange-error");
      assert.deepEqual(await page.locator("#editor .cm-lintRange-error").allInnerTexts(), ['"180 ft"']);
      await page.locator("#issues button").first().click();
      assert.match(await page.locator("#editor .cm-activeLine").innerText(), /180 ft/);
      // What the command line refuses is not mended without a word.
      const old = lines.replaceAll("\n", "\r");
      await take(page, old);
      await page.waitForSelector(".issues li");
      assert.equal(await text(page), old);
    });
  });

  test("a case that names files finds them when they are opened together", async () => {
    await visit(async (page) => {
      const buffer = (path) => readFileSync(join(root, "cli/examples", path));
      const file = (path) => ({ name: path.split("/").at(-1), mimeType: "text/plain", buffer: buffer(path) });
      for (const names of [["reconstruct/from-tests.toml", "tests/struble-welsh.toml"], ["tests/struble-welsh.toml", "reconstruct/from-tests.toml"]]) {
        await settled(page, () => page.setInputFiles("#open", names.map(file)));
        assert.deepEqual([await page.locator("#issues").innerText(), await page.locator("#name").innerText()], ["", "from-tests.toml"]);
      }
      await settled(page, () => page.setInputFiles("#open", [file("reconstruct/from-tests.toml")]));
      await page.waitForSelector(".issues li");
      assert.match(await page.locator("#issues").innerText(), /is not open in this page/);
      // What no case would find is not lost without a word.
      const refused = async (files, why) => {
        await page.setInputFiles("#open", files);
        await page.waitForFunction((why) => document.querySelector("#message").innerText.includes(why), why);
      };
      await refused([file("position-a.toml"), file("position-b.toml")], "position-a.toml does not name position-b.toml");
      await refused([file("tests/struble-welsh.toml"), file("reconstruct/from-tests.toml"), file("tests/struble-welsh.toml")], "two files have the name struble-welsh.toml");
      assert.equal(await page.locator("#name").innerText(), "from-tests.toml");
      await page.evaluate(() => {
        const dropped = new DataTransfer();
        for (const name of ["a.jsonl", "b.csv"]) dropped.items.add(new File(["{}"], name));
        document.body.dispatchEvent(new DragEvent("drop", { dataTransfer: dropped, bubbles: true }));
      });
      await page.waitForFunction(() => document.querySelector("#message").innerText.includes("a.jsonl and b.csv: check one file of records at a time"));
    });
  });
});

describe("the scene", () => {
  test("a drag of Γ by mouse edits its value alone, and undo takes it back in one step", async () => {
    await visit(async (page) => {
      const before = await text(page);
      await pull(page, "contact.crush_plane", [0, -60]);
      const after = await text(page);
      assert.ok(degrees(after) > 5, after);
      assert.equal(after.replace(/^crush_plane = .*$/m, ""), before.replace(/^crush_plane = .*$/m, ""));
      assert.ok((await page.locator(".drawing").innerText()).includes(`Γ = ${degrees(after).toFixed(1)} deg`));
      const shown = await page.locator("#gamma-value").innerText();
      assert.equal(shown, `${degrees(after).toFixed(1)}°`);
      await settled(page, () => page.click("#undo"));
      assert.equal(await text(page), before);
      await settled(page, () => page.click("#redo"));
      assert.equal(await text(page), after);
    });
  });

  test("each drag is one step, whatever steps there are before it", async () => {
    await visit(async (page) => {
      const slide = async (from, to) => {
        const box = await page.locator("#gamma").boundingBox();
        const at = (share) => [box.x + share * box.width, box.y + box.height / 2];
        await page.mouse.move(...at(from));
        await page.mouse.down();
        await page.mouse.move(...at(to), { steps: 4 });
        await page.mouse.up();
      };
      const typed = async () => {
        await page.locator('[data-path="vehicle.1.speed"]').fill("50 ft/s");
        await page.locator('[data-path="vehicle.1.speed"]').press("Enter");
      };
      const faster = () => pull(page, "vehicle.1.velocity", [-20, 0]);
      const acts = [faster, faster, typed, faster, () => slide(0.5, 0.55), () => slide(0.55, 0.57), () => page.selectOption("#examples", "position-c.toml"), faster];
      const texts = [await text(page)];
      for (const act of acts) {
        await settled(page, act);
        texts.push(await text(page));
      }
      assert.equal(new Set(texts).size, texts.length);
      for (const expected of texts.slice(0, -1).reverse()) {
        await settled(page, () => page.click("#undo"));
        same(await text(page), expected, "undo");
      }
      assert.ok(await page.isDisabled("#undo"));
      for (const expected of texts.slice(1)) {
        await settled(page, () => page.click("#redo"));
        same(await text(page), expected, "redo");
      }
    });
  });

  /** Takes hold of a handle; what is returned moves it on, and waits for the frame. */
  async function grip(page, key) {
    const box = await handle(page, key).locator(".dot").boundingBox();
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
    await page.mouse.move(x, y);
    await page.mouse.down();
    return (down) => settled(page, () => page.mouse.move(x, y + down, { steps: 4 }));
  }

  test("a drag that is held for long is one step, and none if it leads back", async () => {
    await visit(async (page) => {
      const before = await text(page);
      let move = await grip(page, "vehicle.2.velocity");
      await move(-20);
      await page.waitForTimeout(700);
      await move(-40);
      await page.mouse.up();
      await settled(page, () => page.click("#undo"));
      assert.equal(await text(page), before);
      move = await grip(page, "vehicle.2.velocity");
      await move(-20);
      await move(0);
      await settled(page, () => page.mouse.up());
      assert.equal(await text(page), before);
      assert.ok(await page.isDisabled("#undo"));
      await settled(page, () => page.click("#redo"));
      assert.notEqual(await text(page), before);
      // The editor itself goes on.
      await settled(page, () => type(page, before));
      assert.equal(await text(page), before);
    });
  });

  test("another case ends the drag that is held", async () => {
    await visit(async (page) => {
      await settled(page, () => page.click("#tour-start"));
      const first = await text(page);
      const move = await grip(page, "contact.crush_plane");
      await move(-30);
      await settled(page, () => page.locator("#tour-next").press("Enter"));
      await page.mouse.move(700, 300, { steps: 4 });
      await page.mouse.up();
      assert.match(await text(page), /of_critical = 1/);
      assert.equal(degrees(await text(page)), 0);
      await settled(page, () => page.click("#undo"));
      const dragged = await text(page);
      assert.ok(degrees(dragged) > 5);
      assert.equal(dragged.replace(/^crush_plane = .*$/m, 'crush_plane = "0 deg"'), first);
      await settled(page, () => page.click("#undo"));
      assert.equal(await text(page), first);
    });
  });

  test("the pointer and the tip of the normal stay together", async () => {
    await visit(async (page) => {
      const tipAtFirst = await handle(page, "contact.crush_plane").locator(".dot").boundingBox();
      await pull(page, "contact.crush_plane", [-20, -50], 20);
      const [tip, center] = await Promise.all(["contact.crush_plane", "impact_center"].map((key) => handle(page, key).locator(".dot").boundingBox()));
      const angle = (Math.atan2(center.y - tip.y, tip.x - center.x) * 180) / Math.PI;
      const turned = degrees(await text(page));
      assert.ok(Math.abs(angle - turned) < 0.5, `${angle}`);
      assert.ok(tip.y < tipAtFirst.y && turned > 0, "up on the page is a positive angle");
    });
  });

  test("arrow keys turn Γ by a degree, with shift by a tenth", async () => {
    await visit(async (page) => {
      await handle(page, "contact.crush_plane").focus();
      await settled(page, () => page.keyboard.press("ArrowUp"));
      assert.equal(degrees(await text(page)), 1);
      await handle(page, "contact.crush_plane").focus();
      await settled(page, () => page.keyboard.press("Shift+ArrowRight"));
      assert.equal(degrees(await text(page)), 1.1);
      await handle(page, "contact.crush_plane").focus();
      await settled(page, () => page.keyboard.press("ArrowLeft"));
      assert.equal(degrees(await text(page)), 0.1);
      assert.equal(await handle(page, "contact.crush_plane").getAttribute("aria-valuenow"), "0.1");
    });
  });

  test("every other handle moves its own input, the right way", async () => {
    await visit(async (page) => {
      const number = (source, key, which = 0) => Number([...source.matchAll(new RegExp(`^${key} = "(-?[0-9.]+) `, "gm"))][which]?.[1]);
      const first = await text(page);
      // Vehicle 1 heads to the left: an arrow that is pulled to the left is longer.
      await pull(page, "vehicle.1.velocity", [-40, 0]);
      const faster = await text(page);
      assert.ok(number(faster, "speed") > 45, faster);
      assert.equal(number(faster, "speed", 1), number(first, "speed", 1));
      // Vehicle 2 heads up.
      await pull(page, "vehicle.2.velocity", [0, 30]);
      assert.ok(number(await text(page), "speed", 1) < 38);
      // The tail of vehicle 1 is to the right of the impact: pulled up, it turns counter-clockwise.
      await pull(page, "vehicle.1.heading", [0, -40]);
      const turned = number(await text(page), "heading");
      assert.ok(turned < -150 || turned > 182, `${turned}`);
      await settled(page, () => page.click("#undo"));
      await settled(page, () => page.click("#undo"));
      await settled(page, () => page.click("#undo"));
      assert.equal(await text(page), first);
      // To the right is back for vehicle 1, which heads to the left, and to the right of vehicle 2, which heads up.
      await pull(page, "impact_center", [25, 0]);
      const centers = [...(await text(page)).matchAll(/^impact_center = \["(-?[0-9.]+) ft", "(-?[0-9.]+) ft"\]/gm)].map((found) => found.slice(1).map(Number));
      assert.ok(centers[0][0] < 6 && Math.abs(centers[0][1]) < 0.1, String(centers));
      assert.ok(centers[1][1] < -3.5 && Math.abs(centers[1][0] - 7.96804) < 0.1, String(centers));
    });
  });

  test("the sliders of Γ and e edit the text", async () => {
    await visit(async (page) => {
      await settled(page, () => page.locator("#restitution").fill("0.12"));
      assert.match(await text(page), /^restitution = 0.12$/m);
      await settled(page, () => page.locator("#gamma").fill("-3.5"));
      assert.equal(degrees(await text(page)), -3.5);
    });
  });

  // The aim is 4 ms; see the figures in README.md.
  test("a Γ drag keeps up with sixty frames a second, document and layout included", async () => {
    await visit(async (page) => {
      await pull(page, "contact.crush_plane", [-10, -60], 240);
      const frames = await page.evaluate(() => performance.getEntriesByName("frame").map(({ duration }) => duration).slice(20).sort((a, b) => a - b));
      assert.ok(frames.length > 60, `${frames.length} frames`);
      const at = (share) => frames[Math.floor(share * (frames.length - 1))];
      console.log(`frames: ${frames.length}, median ${at(0.5).toFixed(2)} ms, 95 % ${at(0.95).toFixed(2)} ms`);
      assert.ok(at(0.5) < (process.env.CI_SLOW ? 40 : 1000 / 60), `${at(0.5)} ms`);
    });
  });

  test("a frame that the physics refuses says why, and the handle leads back", async () => {
    await visit(async (page) => {
      // At 100 deg the vehicles of position B separate along n.
      await loadExample(page, "position-b.toml");
      await settled(page, () => page.locator("#gamma").fill("100"));
      await page.waitForSelector(".issues li");
      await settled(page, () => page.locator("#gamma").fill("0"));
      assert.equal(await page.locator("#issues li").count(), 0);
    });
  });
});

describe("the editor and the form", () => {
  test("a field and the text stay in step", async () => {
    await visit(async (page) => {
      const mass = page.locator('[data-path="vehicle.1.mass"]');
      assert.equal(await mass.inputValue(), "79.62732919254658 slug");
      await mass.fill("1200 kg");
      await settled(page, () => mass.press("Enter"));
      assert.match(await text(page), /^mass = "1200 kg"$/m);
      await settled(page, () => type(page, readFileSync(join(root, "cli/examples/position-c.toml"), "utf8").replace(/^mass = .*$/m, 'mass = "999 kg"')));
      assert.equal(await mass.inputValue(), "999 kg");
      await settled(page, async () => type(page, (await text(page)).replace(/^impulse_ratio = .*$/m, "")));
      await page.locator('[data-path="contact.impulse_ratio"]').fill("{ of_critical = 0.9 }");
      await settled(page, () => page.locator('[data-path="contact.impulse_ratio"]').press("Enter"));
      assert.match(await text(page), /^impulse_ratio = \{ of_critical = 0\.9 \}$/m);
      assert.equal(await page.locator("#issues li").count(), 0);
    });
  });

  test("issues stand at their place", async () => {
    await visit(async (page) => {
      const source = (await text(page)).replace('heading = "180 deg"', 'heading = "180 ft"').replace("restitution = 0", "restitution = 7");
      await settled(page, () => type(page, source));
      const lines = source.split("\n");
      const at = [lines.findIndex((line) => line.includes("180 ft")) + 1, lines.findIndex((line) => line.includes("= 7")) + 1];
      const shown = await page.locator("#issues").innerText();
      assert.match(shown, new RegExp(`Line ${at[0]}: .*heading.*angle`));
      await page.waitForSelector("#editor .cm-lintRange-error");
      const marked = await page.locator("#editor .cm-lintRange-error").allInnerTexts();
      assert.ok(marked.includes('"180 ft"'), String(marked));
      await page.locator("#issues button").first().click();
      const line = await page.locator("#editor .cm-activeLine").innerText();
      assert.ok(line.includes("180 ft"), line);
    });
  });

  test("what is typed is not lost with the page without a question", async () => {
    await visit(async (page) => {
      // Whether the page would ask.
      const asks = () => page.evaluate(() => !dispatchEvent(new Event("beforeunload", { cancelable: true })));
      const edit = (value) => settled(page, () => page.locator("#restitution").fill(value));
      assert.equal(await asks(), false);
      const [licenses] = await Promise.all([page.waitForEvent("popup"), page.click("footer a")]);
      assert.match(licenses.url(), /LICENSES\.txt$/);
      await licenses.close();
      await edit("0.12");
      assert.equal(await asks(), true);
      const [asked] = await Promise.all([page.waitForEvent("dialog"), page.close({ runBeforeUnload: true })]);
      assert.equal(asked.type(), "beforeunload");
      await asked.dismiss();
      await text(page);
      assert.equal(await asks(), false);
      await edit("0.13");
      assert.equal(await asks(), true);
      await page.click("#share");
      await page.waitForFunction(() => location.hash !== "");
      assert.equal(await asks(), false);
      await edit("0.14");
      assert.equal(await asks(), true);
      const windows = examples.find(({ path }) => path === "position-a.toml").text.replaceAll("\n", "\r\n");
      await settled(page, () => page.setInputFiles("#open", { name: "a.toml", mimeType: "text/plain", buffer: Buffer.from(windows) }));
      assert.equal(await asks(), false);
      await edit("0.15");
      await settled(page, () => page.click("#undo"));
      assert.equal(await asks(), false);
      await settled(page, () => page.click("#undo"));
      assert.equal(await asks(), true);
    });
  });

  test("keys are completed and explained", async () => {
    await visit(async (page) => {
      await type(page, "[contact]\nrestit");
      await page.waitForSelector("#editor .cm-tooltip-autocomplete");
      assert.match(await page.locator("#editor .cm-tooltip-autocomplete").innerText(), /restitution/);
      await page.keyboard.press("Escape");
      await settled(page, () => page.selectOption("#examples", "position-a.toml"));
      await page.locator("#editor .cm-line", { hasText: "yaw_inertia" }).first().hover({ position: { x: 20, y: 8 } });
      await page.waitForSelector("#editor .cm-tooltip-hover");
      assert.match(await page.locator("#editor .cm-tooltip-hover").innerText(), /inertia/i);
    });
  });
});

describe("long verbs", () => {
  test("a reconstruction runs, shows its progress, and can be canceled", async () => {
    await visit(async (page) => {
      await loadExample(page, "reconstruct/two-cars.toml");
      await page.click("#tab-reconstruct");
      await page.locator(".options input").check();
      await page.waitForSelector(".running progress:visible");
      await page.waitForFunction(() => document.querySelector(".running progress").hasAttribute("value"), null, { timeout: 60_000 });
      await page.getByRole("button", { name: "Cancel" }).click();
      assert.equal(await page.locator(".running progress").isVisible(), false);
      await page.locator(".options input").uncheck();
      await page.waitForSelector("#result table", { timeout: 60_000 });
      assert.match(await page.locator("#result").innerText(), /km\/h/);
    });
  });

  const twoCars = "reconstruct/two-cars.toml";
  const reconstruct = async (page) => {
    await loadExample(page, twoCars);
    await page.click("#tab-reconstruct");
    await page.getByRole("button", { name: "Start" }).click();
    await page.waitForSelector(".running progress:visible");
  };

  test("a text that changes during a reconstruction has no answer of the old one", async () => {
    await visit(async (page) => {
      await loadExample(page, twoCars);
      await page.click("#tab-reconstruct");
      // With guaranteed ranges it takes longer than the change of the text.
      await page.locator(".options input").check();
      await page.waitForSelector(".running progress:visible");
      await settled(page, async () => type(page, (await text(page)).replace(/^mass = .*$/m, 'mass = "9000 kg"')));
      await page.waitForTimeout(4000);
      assert.equal(await page.locator("#result table").count(), 0);
      assert.doesNotMatch(await page.locator(".status").innerText(), /Done/);
      // Once it has been answered, a change of the text is said beside the answer.
      await page.locator(".options input").uncheck();
      await page.waitForFunction(() => document.querySelector(".status").textContent.startsWith("Done"), null, { timeout: 60_000 });
      assert.match(await page.locator("#result").innerText(), /Inconsistent evidence/);
      await settled(page, async () => type(page, (await text(page)).replace("9000 kg", "1500 kg")));
      assert.match(await page.locator(".status").innerText(), /The case has changed: start again/);
      assert.match(await page.locator("#result").getAttribute("class"), /stale/);
    });
  });

  test("a step back to another case is one to its name, its files and no address of the other", async () => {
    await visit(async (page) => {
      const name = () => page.locator("#name").innerText();
      const first = await name();
      await page.click("#share");
      await page.waitForFunction(() => location.hash !== "");
      await loadExample(page, "position-b.toml");
      assert.deepEqual([await name(), await page.evaluate(() => location.hash)], ["position-b.toml", ""]);
      await settled(page, () => page.click("#undo"));
      assert.equal(await name(), first);
      const [download] = await Promise.all([page.waitForEvent("download"), page.click("#save")]);
      assert.equal(download.suggestedFilename(), first);
      await settled(page, () => page.click("#redo"));
      assert.equal(await name(), "position-b.toml");
    });
  });

  test("another case takes the place of every answer about the one before", async () => {
    await visit(async (page) => {
      await reconstruct(page);
      await loadExample(page, "position-b.toml");
      await page.waitForTimeout(4000);
      assert.equal(await page.locator("#result").innerText(), "");
      // A reconstruction that `solve` has asked for comes too late for a case without unknowns.
      await page.click("#tab-solve");
      await page.selectOption("#examples", twoCars);
      await page.waitForFunction(() => document.querySelector(".running progress").checkVisibility(), null, { polling: 5 });
      await page.selectOption("#examples", "position-b.toml");
      await page.waitForTimeout(2000);
      assert.doesNotMatch(await page.locator("#result").innerText(), /missing/);
      assert.match(await page.locator("#result").innerText(), /position B[\s\S]*delta-V/);
    });
  });

  test("of a case that is refused, or whose scene is not found, nothing of another is shown or moved", async () => {
    await visit(async (page) => {
      const source = (path) => examples.find((example) => example.path === path).text;
      const take = (name, text) => settled(page, () => page.setInputFiles("#open", { name, mimeType: "text/plain", buffer: Buffer.from(text) }));
      const heading = handle(page, "vehicle.1.heading");
      const shown = async () => [await page.locator("#scene .drawing svg").count(), await heading.isVisible(), await page.locator("#figures").isVisible(), await page.locator("#sliders").isVisible()];
      const isStale = (id) => page.locator(id).evaluate((place) => place.classList.contains("stale"));
      assert.deepEqual(await shown(), [1, true, true, true]);
      const unknowns = source("reconstruct/momentum.toml").replace(/^vehicle\.2\.separation_velocity.*$/m, "");
      for (const [name, text] of [["refused.toml", source("crabbed-barrier.toml").replace("schema = 1", "schema = 1\nxx = 1")], ["unread.toml", "[[["], ["unknown.toml", unknowns]]) {
        await take(name, text);
        await page.waitForSelector(".issues li");
        assert.deepEqual(await shown(), [0, false, false, false], name);
        await loadExample(page, "position-a.toml");
        assert.deepEqual(await shown(), [1, true, true, true]);
      }
      await settled(page, () => type(page, `${source("position-a.toml")}\nxx = 1`));
      assert.deepEqual([await shown(), await isStale("#scene"), await isStale("#figures")], [[1, false, true, true], true, true]);
      await settled(page, () => page.click("#undo"));
      assert.deepEqual([await shown(), await isStale("#scene"), await isStale("#figures")], [[1, true, true, true], false, false]);
      await loadExample(page, "reconstruct/t-bone.toml");
      assert.deepEqual([await heading.isVisible(), await isStale("#scene")], [false, true]);
      await page.waitForFunction(() => document.querySelector("#scene .drawing svg") !== null && !document.querySelector("#scene").classList.contains("stale"), undefined, { timeout: 60_000 });
    });
  });

  test("a crush plane beyond half a turn stands at the slider as within it", async () => {
    await visit(async (page) => {
      const source = examples.find(({ path }) => path === "position-a.toml").text;
      for (const [typed, key, found] of [["270 deg", "ArrowLeft", -90.1], ["200 deg", "ArrowLeft", -160.1], ["-190 deg", "ArrowRight", 170.1], ["810.04 deg", "ArrowRight", 90.1]]) {
        await settled(page, () => type(page, source.replace(/^crush_plane = .*$/m, `crush_plane = "${typed}"`)));
        await settled(page, () => page.locator("#gamma").press(key));
        assert.equal(degrees(await text(page)), found, typed);
      }
    });
  });

  test("an export's error ends with the next export", async () => {
    await visit(async (page) => {
      await page.selectOption("#export", "csv");
      await page.waitForFunction(() => document.querySelector("#message.error")?.textContent.includes("cannot be exported"));
      await exported(page, "json");
      assert.ok(await page.locator("#message").isHidden());
    });
  });

  test("an export keeps its name, shows its progress, and can be canceled", async () => {
    await visit(async (page) => {
      await loadExample(page, "uncertain.toml");
      await page.click("#tab-uncertainty");
      await page.locator(".options input[type=number]").fill("1000000");
      await page.locator(".options input[type=number]").press("Enter");
      const saved = page.waitForEvent("download");
      await page.selectOption("#export", "json");
      await page.waitForSelector("#exports progress[value]");
      await loadExample(page, "position-b.toml");
      await page.click("#tab-sweep");
      assert.equal((await saved).suggestedFilename(), "uncertain.uncertainty.json");
      await page.waitForFunction(() => document.querySelector("#exports").childElementCount === 0);
      await loadExample(page, "uncertain.toml");
      await page.click("#tab-uncertainty");
      await page.locator(".options input[type=number]").fill("10000000");
      await page.selectOption("#export", "csv");
      await page.locator("#exports").getByRole("button", { name: "Cancel" }).click();
      await page.waitForFunction(() => document.querySelector("#exports").childElementCount === 0);
      assert.equal(await page.locator("#message").isVisible(), false);
    });
  });

  test("what an option cannot be is said, and no other number is taken", async () => {
    await visit(async (page) => {
      await loadExample(page, "uncertain.toml");
      await page.click("#tab-uncertainty");
      for (const samples of ["5", "123.5", ""]) {
        await page.locator(".options input[type=number]").fill(samples);
        await page.locator(".options input[type=number]").press("Enter");
        await page.waitForFunction(() => document.querySelector(".status").textContent.startsWith("No answer: Samples: "));
        assert.equal(await page.locator("#result table").count(), 0);
      }
    });
  });

  test("a long sweep is drawn and exported, and its table is left out", async () => {
    await visit(async (page) => {
      await page.click("#tab-sweep");
      await page.locator(".options input").first().fill("contact.restitution=0:1:1e-4");
      await page.locator(".options input").first().press("Enter");
      await page.waitForFunction(() => document.querySelector("#result").textContent.includes("The table has 10001 rows"), null, { timeout: 60_000 });
      assert.equal(await page.locator("#result figure svg").count(), 1);
      assert.equal((await exported(page, "csv")).bytes.toString().trimEnd().split("\n").length, 10_002);
    });
  });

  test("a case without an answer says all that is wrong when it is exported", async () => {
    await visit(async (page) => {
      await loadExample(page, twoCars);
      await page.click("#tab-slide");
      await page.selectOption("#export", "json");
      await page.waitForFunction(() => document.querySelector("#message").textContent.includes("cannot be exported"));
      assert.match(await page.locator("#message").innerText(), /two-cars\.slide\.json cannot be exported: vehicle\.\S+: .* \(/);
    });
  });

  test("a hundred thousand samples", async () => {
    await visit(async (page) => {
      await loadExample(page, "uncertain.toml");
      await page.click("#tab-uncertainty");
      await page.waitForSelector("#result figure svg", { timeout: 60_000 });
      assert.match(await page.locator(".status").innerText(), /Done in/);
      console.log(`uncertainty, 1e5 samples: ${await page.locator(".status").innerText()}`);
    });
  });

  test("a folder that is dropped is named as unreadable, in every tab", async () => {
    await visit(async (page) => {
      const devtools = await page.context().newCDPSession(page);
      const drop = async (...files) => {
        for (const type of ["dragEnter", "dragOver", "drop"]) {
          await devtools.send("Input.dispatchDragEvent", { type, x: 300, y: 300, data: { items: [], files, dragOperationsMask: 1 } });
        }
      };
      const folder = join(root, "cli/examples");
      await drop(folder);
      await page.waitForFunction(() => document.querySelector("#message").textContent.startsWith("examples cannot be read"));
      await page.click("#tab-check");
      await drop(join(folder, "check/paper-table-2.csv"));
      await page.waitForSelector("#result table");
      await drop(folder);
      await page.waitForFunction(() => document.querySelector(".status").textContent.startsWith("No answer: examples cannot be read"));
      assert.equal(await page.locator("#result table").count(), 0);
    });
  });

  test("a formula has one derivative, and a list of them is refused", async () => {
    await visit(async (page) => {
      await page.click("#tab-formula");
      await page.waitForSelector("#result math");
      await page.locator(".options input").nth(1).fill("Gamma, e");
      await page.locator(".options input").nth(1).press("Enter");
      await page.waitForFunction(() => document.querySelector("#result").innerText.includes("no input has the name `Gamma, e`"));
      assert.equal(await page.locator("#result math").count(), 0);
    });
  });

  test("records that are dropped are checked as by the command line", async () => {
    await visit(async (page) => {
      await page.click("#tab-check");
      const file = "cli/examples/check/paper-table-2.csv";
      await page.setInputFiles('#answers input[type="file"]', join(root, file));
      await page.waitForSelector("#result table");
      const checked = JSON.parse((await exported(page, "json")).bytes.toString());
      const expected = JSON.parse(cli(["check", file, "--format", "json"]).output);
      for (const record of expected.records) record.file = "paper-table-2.csv";
      assert.deepEqual(checked, expected);
    });
  });
});

describe("an address with a case", () => {
  test("brings the case back", async () => {
    await visit(async (page) => {
      await loadExample(page, "uncertain.toml");
      await settled(page, () => page.locator("#gamma").fill("5"));
      const source = await text(page);
      await page.click("#share");
      await page.waitForFunction(() => location.hash.startsWith("#2."));
      const fragment = await page.evaluate(() => location.hash);
      await visit(async (other) => {
        await other.waitForSelector(".drawing svg");
        assert.equal(await text(other), source);
      }, { fragment });
    });
  });

  const packed = (value) => `#1.${deflateRawSync(Buffer.from(value)).toString("base64url")}`;
  const hostile = {
    "no case": "#<img src=x onerror=alert(1)>",
    "of a later version": `#3.${deflateRawSync(Buffer.from(JSON.stringify(["a.toml", "schema = 1", {}]))).toString("base64url")}`,
    "not deflated": "#1.AAAA",
    "not packed": "#2.AAAA",
    "not JSON": packed("]"),
    "of other types": packed('[1,2,{}]'),
    "a bomb": packed(JSON.stringify(["a.toml", "x".repeat(40 << 20), {}])),
  };
  test("is that of the case until it is edited", async () => {
    await visit(async (page) => {
      const hash = () => page.evaluate(() => location.hash);
      await page.click("#share");
      await page.waitForFunction(() => location.hash !== "");
      const fragment = await hash();
      await settled(page, () => page.selectOption("#units", "si"));
      assert.equal(await hash(), fragment);
      await settled(page, () => page.locator("#restitution").fill("0.12"));
      assert.equal(await hash(), "");
      await visit(async (other) => {
        await other.waitForFunction(() => document.documentElement.dataset.ready === "true");
        assert.equal(await other.evaluate(() => location.hash), fragment);
        await settled(other, () => pull(other, "contact.crush_plane", [0, -60]));
        assert.equal(await other.evaluate(() => location.hash), "");
      }, { fragment });
    });
  });

  test("says nothing of an address that is gone", async () => {
    await visit(async (page) => {
      await page.waitForFunction(() => document.querySelector("#message").textContent.includes("This address cannot be opened"));
      await page.evaluate(() => (location.hash = ""));
      await page.waitForFunction(() => document.querySelector("#message").hidden);
    }, { fragment: "#nothing" });
  });

  for (const [name, fragment] of Object.entries(hostile)) {
    test(`is refused: ${name}`, async () => {
      await visit(async (page) => {
        await page.waitForFunction(() => document.querySelector("#message").textContent.includes("This address cannot be opened"));
        assert.equal(await page.locator("#message img").count(), 0);
      }, { fragment });
    });
  }
});

describe("hostile cases", () => {
  const bad = `</title></script><img src=x onerror="alert(1)"><script>alert(1)</script>`;
  test("markup in names and titles stays text", async () => {
    await visit(async (page) => {
      page.on("dialog", () => assert.fail("a script ran"));
      const source = (await text(page)).replace(/^title = .*$/m, `title = '${bad}'`).replace('"sedan"', `'${bad}'`);
      await settled(page, () => type(page, source));
      await page.waitForFunction(() => document.querySelector("#result").textContent.includes("<script>"));
      assert.equal(await page.locator("#result img, .drawing img, #result script, .drawing script, .drawing foreignObject").count(), 0);
      await settled(page, () => type(page, source.replace("mass", `'${bad}'`)));
      assert.equal(await page.locator(".issues img, .issues script").count(), 0);
      assert.match(await page.locator("#issues").innerText(), /script/);
    });
  });

  test("markup that the engine should not have written is left out", async () => {
    await visit(async (page) => {
      const { outputFiles } = await build({ entryPoints: [join(web, "src/morph.ts")], bundle: true, format: "iife", globalName: "morph", write: false });
      const markup = '<p onclick="x" style="color:red">a<script>b</' + 'script><a href="javascript:x">c</a><img src="https://example.org/x"></p>';
      const left = await page.evaluate(`${outputFiles[0].text}; const place = document.createElement("div"); morph.show(place, ${JSON.stringify(markup)}); place.innerHTML`);
      assert.equal(left, "<p>a<a>c</a><img></p>");
    });
  });

  test("deep, huge and endless texts end with a message while the page stays awake", async () => {
    await visit(async (page) => {
      const inputs = ["[".repeat(100_000), "a = 1\n".repeat(50_000), "\u0000", "\u202e".repeat(1000), `title = "${"é".repeat(900_000)}"`, "{".repeat(200_000)];
      for (const source of inputs) {
        const buffer = Buffer.from(source);
        const beats = page.evaluate(async () => {
          let [longest, last] = [0, performance.now()];
          for (let i = 0; i < 40; i++) {
            await new Promise((done) => setTimeout(done, 50));
            longest = Math.max(longest, performance.now() - last);
            last = performance.now();
          }
          return longest;
        });
        await page.setInputFiles("#open", { name: "a.toml", mimeType: "text/plain", buffer });
        await page.waitForFunction(() => document.querySelector(".issues li") || document.querySelector("#message").classList.contains("error"), null, { timeout: 30_000 });
        assert.ok((await beats) < 2500, `${source.slice(0, 10)}: ${await beats} ms`);
      }
      await loadExample(page, "position-a.toml");
      assert.equal(await page.locator("#issues li").count(), 0);
    });
  });

  test("every reproducer is answered as by the command line", async () => {
    const folder = join(root, "cli/tests/reproducers");
    await visit(async (page) => {
      for (const name of readdirSync(folder).filter((name) => name.endsWith(".toml"))) {
        const source = readFileSync(join(folder, name), "utf8");
        await settled(page, () => page.setInputFiles("#open", { name, mimeType: "text/plain", buffer: Buffer.from(source) }));
        const expected = cli(["solve", join(folder, name), "--format", "json"]);
        await page.click("#tab-solve");
        if (expected.status === 0) same((await exported(page, "json")).bytes.toString(), expected.output, name);
        else await page.waitForSelector(".issues li");
      }
    });
  });
});

describe("for everyone", () => {
  for (const [width, height] of [[390, 844], [1600, 1000]]) {
    for (const colorScheme of ["light", "dark"]) {
      test(`accessible at ${width} pixels, ${colorScheme}`, async () => {
        await visit(async (page) => {
          for (const [example, verb] of [["position-a.toml", "solve"], ["position-a.toml", "sweep"], ["cavalier-crush.toml", "crash3"], ["position-a.toml", "formula"]]) {
            await loadExample(page, example);
            await page.click(`#tab-${verb}`);
            await page.waitForSelector("#result table, #result figure, #result math");
            await page.evaluate(axe);
            const { violations } = await page.evaluate(() => globalThis.axe.run(document, { runOnly: ["wcag2a", "wcag2aa", "wcag21aa", "wcag22aa", "best-practice"] }));
            assert.deepEqual(violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html.slice(0, 200)).join("; ")}`), []);
            const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
            assert.ok(wide <= 0, `${wide} pixels too wide`);
            await page.screenshot({ path: join(pictures, `${width}-${colorScheme}-${verb}.png`), fullPage: true });
          }
        }, { viewport: { width, height }, colorScheme });
      });
    }
  }

  test("the tour leads through its five steps", async () => {
    await visit(async (page) => {
      await page.click("#tour-start");
      const titles = [];
      for (let step = 0; step < 5; step++) {
        await page.waitForSelector("#result table, #result figure", { timeout: 30_000 });
        titles.push(await page.locator("#tour-title").innerText());
        assert.equal(await page.locator("#issues li").count(), 0, titles.at(-1));
        if (step < 2) {
          // T_L over Γ is constant; over the share of the critical ratio it is greatest at 1.
          const { of } = JSON.parse((await exported(page, "json")).bytes.toString());
          const losses = of["energy.loss"];
          if (step === 0) assert.ok(Math.max(...losses) - Math.min(...losses) < 1e-9 * losses[0]);
          else assert.equal(losses.indexOf(Math.max(...losses)), losses.length - 1);
        }
        await settled(page, () => page.click("#tour-next")).catch((error) => { if (step < 4) throw error; });
      }
      assert.equal(new Set(titles).size, 5);
      assert.equal(await page.locator("#tour").isVisible(), false);
    });
  });

  test("works without a network once it has been opened", async () => {
    const { page, context } = await open(site, { serviceWorkers: "allow" });
    await kept(page);
    await context.setOffline(true);
    await page.reload();
    await page.waitForSelector(".drawing svg");
    await context.close();
  });

  test("a page keeps its own version while it is open, and the next one is new as a whole", async () => {
    const instead = new Map();
    const other = await start(join(web, "dist"), { instead, seconds: 600 });
    const { page, context } = await open(other, { serviceWorkers: "allow" });
    await kept(page);
    const read = (name) => readFileSync(join(web, "dist", name), "utf8");
    instead.set("/sw.js", read("sw.js").replace(/`\$\{OURS\}\w+`/, "`${OURS}new`"));
    instead.set("/verbs.wasm", "no engine of the old page");
    instead.set("/worker.js", "// no worker of the old page");
    instead.set("/style.css", "/* new */");
    await page.evaluate(async () => {
      const registration = await navigator.serviceWorker.ready;
      await registration.update();
      while (!registration.waiting) await new Promise((next) => setTimeout(next, 20));
    });
    await page.click("#tab-sweep");
    await page.waitForSelector("#result svg");
    await page.close();
    // The next version begins once the browser has seen that no page of the old one is open.
    const next = async () => {
      const opened = await context.newPage();
      await opened.goto(other.address);
      const found = await opened.evaluate(async () => [await caches.keys(), await (await fetch("style.css")).text()]);
      await opened.close();
      return found;
    };
    const wanted = [[`planar-impact ${other.address} new`], "/* new */"];
    let found = await next();
    for (let tries = 0; tries < 50 && !isDeepStrictEqual(found, wanted); tries++) found = await next();
    assert.deepEqual(found, wanted);
    await context.close();
    await other.close();
  });

  test("two pages of one host keep their files apart", async () => {
    const folder = mkdtempSync(join(tmpdir(), "pages-"));
    for (const name of ["one", "two"]) cpSync(join(web, "dist"), join(folder, name), { recursive: true });
    appendFileSync(join(folder, "two/style.css"), "/* another */");
    const text = readFileSync(join(folder, "two/sw.js"), "utf8");
    writeFileSync(join(folder, "two/sw.js"), text.replace(/`\$\{OURS\}\w+`/, "`${OURS}another`"));
    const other = await start(folder);
    const { page, context } = await open(other, { fragment: "one/", serviceWorkers: "allow" });
    await kept(page);
    await page.goto(`${other.address}two/`);
    await kept(page);
    await context.setOffline(true);
    for (const name of ["one", "two"]) {
      await page.goto(`${other.address}${name}/`);
      await page.waitForSelector(".drawing svg");
    }
    await context.close();
    await other.close();
    rmSync(folder, { recursive: true });
  });

  test("says that an engine is of another version", async () => {
    const worker = readFileSync(join(web, "dist/worker.js"), "utf8").replaceAll("__wbindgen", "__of_another");
    const other = await start(join(web, "dist"), { instead: new Map([["/worker.js", worker]]) });
    const { page, context } = await open(other);
    await page.waitForSelector(".drawing svg");
    await page.click("#tab-sweep");
    await page.waitForFunction(() => /not of this version of the page[^]*load the page again/.test(document.querySelector("#answers").innerText));
    await context.close();
    await other.close();
  });
});
