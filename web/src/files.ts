// Files in and out. Nothing leaves the machine: a file that is saved is made here.
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

export interface Opened {
  name: string;
  text: string;
  files: Record<string, string>;
}

/** Reads files that are opened together: the first case among them, with the others as the files that it may name. */
export async function open(list: File[]): Promise<Opened> {
  const read = await Promise.all(list.map(async (file) => {
    if (file.size > LARGEST) throw new Error(`${file.name} is larger than ${LARGEST >> 20} MiB, which no case file is`);
    return { name: file.name, text: await file.text() };
  }));
  const report = read.find(({ name }) => /\.html?$/i.test(name));
  if (report) return fromReport(report.name, report.text);
  const first = read.find(({ name, text }) => /\.(toml|json)$/i.test(name) && /vehicle/.test(text)) ?? read[0];
  if (!first) throw new Error("no file is given");
  const others = read.filter((file) => file !== first);
  return { ...first, files: Object.fromEntries(others.flatMap(({ name, text }) => [[name, text], [`../${name}`, text]])) };
}

/** Takes the case out of a report, with the files that it names. */
function fromReport(name: string, html: string): Opened {
  const page = new DOMParser().parseFromString(html, "text/html");
  const decode = (text: string) => text.replaceAll("&lt;", "<").replaceAll("&gt;", ">").replaceAll("&amp;", "&");
  const found = page.querySelector("script#case");
  if (!found) throw new Error(`${name} is not a report: it has no case in it`);
  const isJson = found.getAttribute("type") === "application/json";
  const named = Array.from(page.querySelectorAll("script[data-name]")).filter((file) => file !== found);
  const files = Object.fromEntries(named.map((file) => [file.getAttribute("data-name")!, decode(file.textContent ?? "")]));
  return { name: name.replace(/\.html?$/i, isJson ? ".json" : ".toml"), text: decode(found.textContent ?? ""), files };
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
