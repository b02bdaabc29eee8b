// Everything that may take long, away from the page's own thread. The page cancels by ending this worker.
import * as engine from "./engine";

export type Task =
  | { kind: "frame"; case: engine.Case }
  | { kind: "answer"; verb: string; case: engine.Case; options: object }
  | { kind: "report"; case: engine.Case }
  | { kind: "check"; name: string; bytes: Uint8Array };

let last = 0;

function progress(done: number, total: number): void {
  const now = performance.now();
  if (now - last > 50) {
    last = now;
    postMessage({ progress: [done, total] });
  }
}

function run(task: Task): engine.Frame | engine.Reply {
  switch (task.kind) {
    case "frame":
      return engine.frame(task.case);
    case "answer":
      return engine.answer(task.verb, task.case, task.options);
    case "report":
      return engine.report(task.case);
    case "check":
      return engine.check(task.name, task.bytes);
  }
}

onmessage = async ({ data }: MessageEvent<{ module: WebAssembly.Module } | { task: Task }>) => {
  if ("module" in data) {
    await engine.load(data.module, progress);
    postMessage({ ready: true });
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
