// Files in and out. Nothing leaves the machine: a file that is saved is made here.
import type { Opened } from "./engine";

export function save(name: string, content: BlobPart, type: string): void {
  const address = URL.createObjectURL(new Blob([content], { type }));
  const link = document.createElement("a");
  link.href = address;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}

/** Largest file that is read as a case. */
const LARGEST = 4 << 20;

/** The bytes of a file. A folder that is dropped is a file without any. */
export async function bytesOf(file: File): Promise<ArrayBuffer> {
  try {
    return await file.arrayBuffer();
  } catch {
    throw new Error(`${file.name} cannot be read: it is a folder, no longer in its place, or not yours to read`);
  }
}

/** The text of a file, whose bytes a text may not lose; a mark before it stays, for the file that is saved. */
function decoded(name: string, bytes: ArrayBuffer): string {
  try {
    return new TextDecoder("utf-8", { fatal: true, ignoreBOM: true }).decode(bytes);
  } catch {
    throw new Error(`${name} is not UTF-8 text; save it as UTF-8`);
  }
}

/** Reads files that are opened together: the first case among them, with the others as the files that it may name. */
export async function open(list: File[]): Promise<Opened> {
  const read = await Promise.all(list.map(async (file) => {
    if (file.size > LARGEST) throw new Error(`${file.name} is larger than ${LARGEST >> 20} MiB, which no case file is`);
    return { name: file.name, text: decoded(file.name, await bytesOf(file)) };
  }));
  const twice = read.find(({ name }, at) => read.findIndex((other) => other.name === name) < at);
  if (twice) throw new Error(`two files have the name ${twice.name}, by which a case would name both`);
  const report = read.find(({ name }) => /\.html?$/i.test(name));
  if (report) return fromReport(report.name, report.text);
  const cases = read.filter(({ name, text }) => /\.(toml|json)$/i.test(name) && /vehicle/.test(text));
  // Tests have vehicles too: the case is what no other file names.
  const first = cases.find(({ name }) => !cases.some((other) => other.name !== name && other.text.includes(name))) ?? read[0];
  if (!first) throw new Error("no file is given");
  const others = read.filter((file) => file !== first);
  // Tests that a case names may themselves name recordings.
  const texts = read.map(({ text }) => text).join("\n");
  const unused = others.filter(({ name }) => !texts.includes(name)).map(({ name }) => name);
  if (unused.length > 0) throw new Error(`${first.name} does not name ${unused.join(" and ")}: open a case with its own files alone`);
  return { ...first, files: Object.fromEntries(others.map(({ name, text }) => [name, text])) };
}

/** Takes the case out of a report, with the files that it names. A report writes what could end an element as entities. */
function fromReport(name: string, html: string): Opened {
  const decode = (text: string) => text.replaceAll("&lt;", "<").replaceAll("&gt;", ">").replaceAll("&quot;", '"').replaceAll("&apos;", "'").replaceAll("&amp;", "&");
  const embedded = Array.from(html.matchAll(/<script type="([^"<>]*)" id="([^"<>]*)"(?: data-name="([^"<>]*)")?>([^<]*)<\/script>/g));
  const found = embedded.find(([, , id]) => id === "case");
  if (!found) throw new Error(`${name} is not a report: it has no case in it`);
  const files = Object.fromEntries(embedded.flatMap(([, , , named, text]) => (named === undefined ? [] : [[decode(named), decode(text!)]])));
  return { name: name.replace(/\.html?$/i, found[1] === "application/json" ? ".json" : ".toml"), text: decode(found[4]!), files };
}

/** Draws an SVG into a PNG of twice its size. */
export async function toPng(svg: string): Promise<Blob> {
  const address = URL.createObjectURL(new Blob([svg], { type: "image/svg+xml" }));
  try {
    const image = new Image();
    image.src = address;
    await image.decode();
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [2 * image.naturalWidth, 2 * image.naturalHeight];
    canvas.getContext("2d")!.drawImage(image, 0, 0, canvas.width, canvas.height);
    const blob = await new Promise<Blob | null>((resolve) => canvas.toBlob(resolve, "image/png"));
    if (!blob) throw new Error("the drawing cannot be made into a picture");
    return blob;
  } finally {
    URL.revokeObjectURL(address);
  }
}
