// Everything that may take long, away from the page's own thread. The page cancels by ending this worker.
import type { Case, Frame, Part, Reply } from "./engine";
import * as frame from "./frame";
import * as verbs from "./verbs";

export type Task =
  | { kind: "frame"; case: Case }
  | { kind: "answer"; verb: string; case: Case; options: object }
  | { kind: "report"; case: Case }
  | { kind: "check"; name: string; bytes: Uint8Array };

let last = 0;

function progress(done: number, total: number): void {
  const now = performance.now();
  if (now - last > 50) {
    last = now;
    postMessage({ progress: [done, total] });
  }
}

function run(task: Task): Frame | Reply {
  switch (task.kind) {
    case "frame":
      return frame.frame(task.case);
    case "answer":
      return verbs.answer(task.verb, task.case, task.options);
    case "report":
      return verbs.report(task.case);
    case "check":
      return verbs.check(task.name, task.bytes);
  }
}

onmessage = async ({ data }: MessageEvent<{ part: Part; module: WebAssembly.Module } | { task: Task }>) => {
  if ("module" in data) {
    const loaded = data.part === "frame" ? frame.load(data.module) : verbs.load(data.module, progress);
    await loaded.then(
      () => postMessage({ ready: true }),
      (error: unknown) => postMessage({ unusable: String(error) }),
    );
    return;
  }
  try {
    const started = performance.now();
    const result = run(data.task);
    postMessage({ result, took: performance.now() - started });
  } catch (error) {
    // A trap of the engine: its memory cannot be used any more.
    postMessage({ trap: String(error) });
  }
};
