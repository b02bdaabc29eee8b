// The engine on this thread: what a frame needs. Everything longer runs in a worker.
import init, * as engine from "../generated/engine.js";

export interface Case {
  name: string;
  text: string;
  /** Files that the case may name. */
  files: Record<string, string>;
  units: string;
}

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

/** Called by the engine from a long verb. */
declare global {
  // eslint-disable-next-line no-var
  var planarImpactProgress: (done: number, total: number) => void;
}

export async function load(module: WebAssembly.Module, progress: (done: number, total: number) => void): Promise<void> {
  globalThis.planarImpactProgress = progress;
  await init({ module_or_path: module });
}

const list = (json: string): Issue[] => (json === "" ? [] : (JSON.parse(json) as Issue[]));

/** Copies what crosses the border, and frees it there. */
export function reply(of: engine.Reply): Reply {
  const copy = { json: of.json, html: of.html, svg: of.svg, csv: of.csv, issues: list(of.issues), cause: of.cause };
  of.free();
  return copy;
}

export function frame(of: Case): Frame {
  const computed = engine.frame(JSON.stringify(of));
  const { scene, impulse, energy, tables, gradient, cause, has_unknowns } = computed;
  const handles = computed.handles === "" ? null : (JSON.parse(computed.handles) as Handles);
  const issues = list(computed.issues);
  computed.free();
  return { scene, impulse, energy, tables, gradient, handles, issues, cause, has_unknowns };
}

export const answer = (verb: string, of: Case, options: object): Reply =>
  reply(engine.answer(verb, JSON.stringify(of), JSON.stringify(options)));
export const report = (of: Case): Reply => reply(engine.report(JSON.stringify(of)));
export const check = (name: string, bytes: Uint8Array): Reply => reply(engine.check(name, bytes));

/** The changes that move an input, or the issues that prevent it. */
export function writeNumber(of: Case, input: string, si: number, resolution: number): Change[] | Issue[] {
  const { json, issues } = reply(engine.write_number(of.name, of.text, input, si, resolution));
  return json === "" ? issues : (JSON.parse(json) as Change[]);
}

export function writeText(of: Case, path: string, typed: string): Change[] | Issue[] {
  const { json, issues } = reply(engine.write_text(of.name, of.text, path, typed));
  return json === "" ? issues : (JSON.parse(json) as Change[]);
}

export const areChanges = (found: Change[] | Issue[]): found is Change[] => found.length > 0 && "insert" in found[0]!;

/** The values at paths; `null` where the text cannot be read at all. */
export function values(of: Case, paths: string[]): (({ from: number; to: number; text: string }) | null)[] | null {
  const json = engine.values(of.name, of.text, JSON.stringify(paths));
  return json === "" ? null : JSON.parse(json);
}

export const schema = (): unknown => JSON.parse(engine.case_schema());
export const template = (kind: string): string => engine.case_template(kind);
