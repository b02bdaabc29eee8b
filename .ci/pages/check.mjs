// Checks reports and drawings in a browser: valid HTML, accessible, nothing clipped or covered, on a screen of 1280 pixels and printed on A4.
//
//     node check.mjs PLANAR_IMPACT [CHROMIUM]
//
// makes a report and a drawing of each example with the program, and exits with 1 if one does not hold.
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, readdirSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { HtmlValidate } from "html-validate";
import { chromium } from "playwright-core";

const [program, browserPath = "/usr/bin/chromium"] = process.argv.slice(2);
const root = resolve(dirname(fileURLToPath(import.meta.url)), "../..");
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const folder = mkdtempSync(join(tmpdir(), "pages-"));

const examples = ["", "reconstruct"].flatMap((under) =>
  readdirSync(join(root, "cli/examples", under))
    .filter((name) => name.endsWith(".toml"))
    .map((name) => join("cli/examples", under, name)),
);
const more = [
  ["cli/examples/cavalier-crush.toml", "--verb", "crush"],
  ["cli/examples/cavalier-crush.toml", "--verb", "crash3"],
  ["cli/examples/uncertain.toml", "--verb", "uncertainty"],
];

const validator = new HtmlValidate({
  extends: ["html-validate:recommended"],
  rules: {
    // Drawings carry their own attributes; a table that is too wide scrolls, which needs a tab stop.
    "no-inline-style": "off",
    "long-title": "off",
    "svg-focusable": "off",
    "no-trailing-whitespace": "off",
    "prefer-native-element": "off",
  },
});

const faults = [];
const fault = (page, what) => faults.push(`${page}: ${what}`);

/** Runs in the page: texts that leave their drawing or cover one another, and whether the page is wider than the screen. */
function look() {
  const found = [];
  for (const svg of document.querySelectorAll("svg")) {
    const frame = svg.getBoundingClientRect();
    const boxes = [];
    for (const text of svg.querySelectorAll("text")) {
      const box = text.getBoundingClientRect();
      if (box.width === 0) continue;
      const label = text.textContent.trim();
      if (box.left < frame.left - 1 || box.right > frame.right + 1 || box.top < frame.top - 1 || box.bottom > frame.bottom + 1) {
        found.push(`"${label}" leaves its drawing`);
      }
      for (const other of boxes) {
        const across = Math.min(box.right, other.box.right) - Math.max(box.left, other.box.left);
        // A line of text is higher than its letters.
        const down = Math.min(box.bottom, other.box.bottom) - Math.max(box.top, other.box.top);
        if (across > 1 && down > 0.45 * Math.min(box.height, other.box.height)) found.push(`"${label}" covers "${other.label}"`);
      }
      boxes.push({ box, label });
    }
  }
  const width = document.documentElement.scrollWidth;
  if (width > window.innerWidth) found.push(`the page is ${width} pixels wide, the screen ${window.innerWidth}`);
  return found;
}

const browser = await chromium.launch({
  executablePath: browserPath,
  args: ["--no-sandbox", "--disable-gpu", "--disable-background-networking", "--disable-component-update", "--disable-sync"],
});
const context = await browser.newContext({ viewport: { width: 1280, height: 900 } });
const page = await context.newPage();
page.on("request", (request) => {
  if (!request.url().startsWith("file:")) fault(request.frame().url(), `asks for ${request.url()}`);
});

for (const [i, arguments_] of [...examples.map((example) => [example]), ...more].entries()) {
  const name = arguments_.join(" ");
  const file = join(folder, `${i}.html`);
  try {
    execFileSync(program, ["report", ...arguments_, "-o", file], { cwd: root, stdio: "pipe" });
  } catch (error) {
    // 1 is that of a reconstruction without a unique answer, which has a report.
    if (error.status !== 1) {
      fault(name, String(error.stderr));
      continue;
    }
  }
  const report = await validator.validateFile(file);
  for (const message of report.results.flatMap((result) => result.messages)) fault(name, `line ${message.line}: ${message.message} (${message.ruleId})`);
  const started = performance.now();
  await page.goto(pathToFileURL(file).href);
  const opened = performance.now() - started;
  for (const what of await page.evaluate(look)) fault(name, what);
  await page.evaluate(axe);
  const { violations } = await page.evaluate(() => globalThis.axe.run(document, { runOnly: ["wcag2a", "wcag2aa", "wcag21aa", "best-practice"] }));
  for (const violation of violations) fault(name, `${violation.id}: ${violation.help} (${violation.nodes.length}, first ${violation.nodes[0].html.slice(0, 160)})`);
  // A4 at 96 pixels an inch, less the margins.
  await page.emulateMedia({ media: "print" });
  await page.setViewportSize({ width: 673, height: 900 });
  for (const what of await page.evaluate(look)) fault(`${name}, printed`, what);
  await page.emulateMedia({ media: "screen" });
  await page.setViewportSize({ width: 1280, height: 900 });
  console.log(`${name}: opened in ${opened.toFixed(0)} ms`);
}
await browser.close();
for (const what of faults) console.error(what);
console.log(faults.length === 0 ? "every page holds" : `${faults.length} faults`);
process.exitCode = faults.length === 0 ? 0 : 1;
