// What crosses the border to the engine, and its two modules.
import { once } from "./once";

/** What the text of a case belongs to. */
export interface Source {
  name: string;
  /** Files that the case may name. */
  files: Record<string, string>;
}

export interface Opened extends Source {
  text: string;
}

export interface Case extends Opened {
  units: string;
}

/** `true` if both have the same text and name, files and units. */
export const isSame = (one: Case, other: Case): boolean =>
  one.text === other.text && one.name === other.name && one.files === other.files && one.units === other.units;

export interface Issue {
  code: string;
  path: string;
  message: string;
  help: string | null;
  file: string;
  line: number | null;
  from: number | null;
  to: number | null;
}

/** An issue in a sentence, with the remedy. */
export const sentence = ({ path, message, help }: Issue): string => `${path === "" ? "" : `${path}: `}${message}${help === null ? "" : ` (${help})`}`;

export const failure = (error: unknown): string => (error instanceof Error ? error.message : String(error));

export interface Change {
  from: number;
  to: number;
  insert: string;
}

export interface VehicleHandles {
  name: string;
  position: [number, number];
  heading: number;
  velocity: [number, number];
  impact_center: [number, number];
  has_components: boolean;
  rear: number;
}

export interface Handles {
  origin: [number, number];
  scale: number;
  speed: number;
  normal: number;
  impact_point: [number, number];
  crush_plane: number;
  restitution: number;
  vehicles: [VehicleHandles | null, VehicleHandles | null];
}

export interface Frame {
  scene: string;
  impulse: string;
  energy: string;
  tables: string;
  gradient: string;
  handles: Handles | null;
  issues: Issue[];
  cause: string;
  has_unknowns: boolean;
}

export interface Reply {
  json: string;
  html: string;
  svg: string;
  csv: string;
  issues: Issue[];
  cause: string;
}

/** The part of the engine that the page opens with, and the one that a worker fetches at the first answer that takes more. */
const PARTS = { frame: once(() => compiled("frame.wasm")), verbs: once(() => compiled("verbs.wasm")) };

export type Part = keyof typeof PARTS;

/** Fetches a part of the engine, once. */
export const compile = (part: Part): Promise<WebAssembly.Module> => PARTS[part]();

/** Compiles a file while its bytes arrive; a host that does not name their type makes it wait. */
async function compiled(name: string): Promise<WebAssembly.Module> {
  const response = await fetch(new URL(name, import.meta.url));
  if (!response.ok) throw new Error(`the engine cannot be loaded: ${response.status}`);
  if (response.headers.get("content-type")?.startsWith("application/wasm")) return WebAssembly.compileStreaming(response);
  return WebAssembly.compile(await response.arrayBuffer());
}

export const issues = (json: string): Issue[] => (json === "" ? [] : (JSON.parse(json) as Issue[]));

/** A reply where it was made. */
type Foreign = Omit<Reply, "issues"> & { issues: string; free(): void };

/** Copies what crosses the border, and frees it there. */
export function reply(of: Foreign): Reply {
  const copy = { json: of.json, html: of.html, svg: of.svg, csv: of.csv, issues: issues(of.issues), cause: of.cause };
  of.free();
  return copy;
}
