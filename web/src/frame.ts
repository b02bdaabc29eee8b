// The part of the engine on the page's own thread: frames and edits. Everything longer runs in a worker.
import init, * as engine from "../generated/frame.js";
import { issues, reply, type Case, type Change, type Frame, type Handles, type Issue } from "./engine";

export async function load(module: WebAssembly.Module): Promise<void> {
  await init({ module_or_path: module });
}

export function frame(of: Case): Frame {
  const computed = engine.frame(JSON.stringify(of));
  const { scene, impulse, energy, tables, gradient, cause, has_unknowns } = computed;
  const handles = computed.handles === "" ? null : (JSON.parse(computed.handles) as Handles);
  const found = issues(computed.issues);
  computed.free();
  return { scene, impulse, energy, tables, gradient, handles, issues: found, cause, has_unknowns };
}

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
