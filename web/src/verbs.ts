// The part of the engine in a worker: every verb, reports and checks.
import init, * as engine from "../generated/verbs.js";
import { reply, type Case, type Reply } from "./engine";

/** Called by the engine from a long verb. */
declare global {
  // eslint-disable-next-line no-var
  var planarImpactProgress: (done: number, total: number) => void;
}

export async function load(module: WebAssembly.Module, progress: (done: number, total: number) => void): Promise<void> {
  globalThis.planarImpactProgress = progress;
  await init({ module_or_path: module });
}

export const answer = (verb: string, of: Case, options: object): Reply => reply(engine.answer(verb, JSON.stringify(of), JSON.stringify(options)));
export const report = (of: Case): Reply => reply(engine.report(JSON.stringify(of)));
export const check = (name: string, bytes: Uint8Array): Reply => reply(engine.check(name, bytes));
