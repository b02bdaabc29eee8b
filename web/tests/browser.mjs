// A browser with the built page, and the program to compare with.
import { execFileSync, spawn } from "node:child_process";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";
import { serve } from "../scripts/serve.mjs";

export const web = fileURLToPath(new URL("..", import.meta.url));
export const root = join(web, "..");
export const program = process.env.PLANAR_IMPACT ?? join(root, "target/release/planar-impact");
export const examples = JSON.parse(readFileSync(join(web, "generated/examples.json"), "utf8"));
export const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

/** What the command line prints; its exit status where it fails. */
export function cli(args, options = {}) {
  try {
    return { status: 0, output: execFileSync(program, args, { cwd: root, stdio: ["ignore", "pipe", "pipe"], maxBuffer: 1 << 28, ...options }).toString() };
  } catch (error) {
    if (typeof error.status !== "number") throw error;
    return { status: error.status, output: error.stdout?.toString() ?? "", errors: error.stderr?.toString() ?? "" };
  }
}

export function cliLater(args) {
  return new Promise((resolve) => {
    const child = spawn(program, args, { cwd: root, stdio: ["ignore", "pipe", "ignore"] });
    const parts = [];
    child.stdout.on("data", (part) => parts.push(part));
    child.on("close", (status) => resolve({ status, output: Buffer.concat(parts).toString() }));
  });
}

export async function start(folder = join(web, "dist"), how = {}) {
  const server = await serve(folder, 0, how);
  const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"],
  });
  const address = `http://localhost:${server.address().port}/`;
  const close = async () => {
    await browser.close();
    server.close();
  };
  return { browser, address, close };
}

/** Opens the page, and collects what goes wrong in it: errors, violations of the policy, requests to elsewhere. */
export async function open({ browser, address }, { fragment = "", ...options } = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, acceptDownloads: true, serviceWorkers: "block", ...options });
  const page = await context.newPage();
  const faults = [];
  page.on("pageerror", (error) => faults.push(String(error)));
  page.on("console", (message) => {
    if (message.type() === "error") faults.push(message.text());
  });
  page.on("request", (request) => {
    if (!request.url().startsWith(address) && !request.url().startsWith("blob:")) faults.push(`asks for ${request.url()}`);
  });
  await page.addInitScript(() => {
    addEventListener("securitypolicyviolation", (event) => console.error(`policy: ${event.violatedDirective} ${event.blockedURI} ${event.sample}`));
  });
  await page.goto(address + fragment);
  return { page, faults, context };
}

/** Waits until the frame of the text as it is has been shown. */
export async function settled(page, act) {
  const count = () => page.evaluate(() => Number(document.documentElement.dataset.frame ?? "0"));
  const before = await count();
  await act();
  await page.waitForFunction((before) => Number(document.documentElement.dataset.frame ?? "0") > before, before, { timeout: 30_000 });
}

export const loadExample = (page, path) => settled(page, () => page.selectOption("#examples", path));

/** The text of the editor, as it is saved. */
export async function text(page) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.click("#save")]);
  return readFileSync(await download.path(), "utf8");
}

export async function type(page, replacement) {
  await page.locator("#editor .cm-content").click();
  await page.keyboard.press("Control+A");
  await page.keyboard.press("Delete");
  await page.keyboard.insertText(replacement);
}

/** Exports in a format, and returns what is saved. */
export async function exported(page, kind) {
  const [download] = await Promise.all([page.waitForEvent("download", { timeout: 120_000 }), page.selectOption("#export", kind)]);
  return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
}

/** mulberry32: small, and the same everywhere. */
export function random(seed) {
  return () => {
    seed = (seed + 0x6d2b79f5) | 0;
    let t = Math.imul(seed ^ (seed >>> 15), 1 | seed);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}
