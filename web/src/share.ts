// A case as the fragment of an address: "#2." and the packed JSON in base64url. The number is the version of the form: version 1 had no checksum, so that a letter
// that was changed on its way could open another case.
import type { Opened } from "./engine";

const VERSION = "2";
const FORMS: Record<string, CompressionFormat> = { 1: "deflate-raw", [VERSION]: "gzip" };
/** Most bytes of a case with its files, packed and unpacked. */
const PACKED = 1 << 20;
const LARGEST = 4 << 20;

async function through(bytes: Uint8Array, by: GenericTransformStream, most: number, tooLarge: string): Promise<Uint8Array> {
  const reader = (new Blob([bytes as BlobPart]).stream().pipeThrough(by as ReadableWritablePair<Uint8Array, Uint8Array>)).getReader();
  const parts: Uint8Array[] = [];
  let size = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    size += value.length;
    if (size > most) {
      await reader.cancel();
      throw new Error(`${tooLarge} larger than ${most >> 20} MiB`);
    }
    parts.push(value);
  }
  const whole = new Uint8Array(size);
  let at = 0;
  for (const part of parts) {
    whole.set(part, at);
    at += part.length;
  }
  return whole;
}

/** `true` for text without half of a pair of surrogates, which UTF-8 cannot hold. */
const isText = (value: unknown): value is string => typeof value === "string" && !/\p{Surrogate}/u.test(value);

export async function pack(shared: Opened): Promise<string> {
  if (![shared.name, shared.text, ...Object.entries(shared.files).flat()].every(isText)) throw new Error("it has half of a character in it (a lone surrogate)");
  const json = new TextEncoder().encode(JSON.stringify([shared.name, shared.text, shared.files]));
  // What cannot be read again is not written.
  if (json.length > LARGEST) throw new Error(`the case and its files are larger than ${LARGEST >> 20} MiB: an address cannot hold them`);
  const packed = await through(json, new CompressionStream(FORMS[VERSION]!), PACKED, "the packed case and its files are");
  let binary = "";
  for (let at = 0; at < packed.length; at += 8192) binary += String.fromCharCode(...packed.subarray(at, at + 8192));
  return `#${VERSION}.${btoa(binary).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "")}`;
}

/** The case of a fragment; `null` if there is none. */
export async function unpack(fragment: string): Promise<Opened | null> {
  if (fragment.length <= 1) return null;
  const parts = /^#([0-9]+)\.([A-Za-z0-9_-]+)$/.exec(fragment);
  if (!parts) throw new Error("the part of this address after # is not a case");
  const form = FORMS[parts[1]!];
  if (!form) {
    throw new Error(`the case of this address is of version ${parts[1]!.slice(0, 9)}; this page reads versions ${Object.keys(FORMS).join(" and ")}`);
  }
  if (parts[2]!.length > Math.ceil((PACKED * 4) / 3)) throw new Error("the case of this address is too large");
  let json: string;
  try {
    const packed = Uint8Array.from(atob(parts[2]!.replaceAll("-", "+").replaceAll("_", "/")), (c) => c.charCodeAt(0));
    json = new TextDecoder("utf-8", { fatal: true }).decode(await through(packed, new DecompressionStream(form), LARGEST, "the case of this address is"));
  } catch (error) {
    throw new Error(error instanceof Error && error.message.startsWith("the case") ? error.message : "the case of this address is damaged");
  }
  let shared: unknown;
  try {
    shared = JSON.parse(json);
  } catch {
    throw new Error("the case of this address is damaged");
  }
  if (!Array.isArray(shared) || shared.length !== 3 || !isText(shared[0]) || !isText(shared[1])) throw new Error("the case of this address is damaged");
  const files: unknown = shared[2];
  if (typeof files !== "object" || files === null || !Object.entries(files).flat().every(isText)) throw new Error("the case of this address is damaged");
  return { name: Array.from(shared[0]).slice(0, 200).join(""), text: shared[1], files: { ...(files as Record<string, string>) } };
}
