// A lane runs one task at a time in a worker of its own; a newer task takes the place of one that has not started, and `cancel` ends the worker.
import { compile, type Part } from "./engine";
import type { Task } from "./worker";

export class Stopped extends Error {}

interface Waiting {
  task: Task;
  progress: (done: number, total: number) => void;
  resolve: (result: { result: unknown; took: number }) => void;
  reject: (reason: Error) => void;
}

export class Lane {
  private worker: Worker | null = null;
  private isReady = false;
  private running: Waiting | null = null;
  private waiting: Waiting | null = null;
  private timer = 0;

  constructor(
    /** The part of the engine that the worker has. */
    private readonly part: Part,
    /** Milliseconds after which a task is ended; never if 0. */
    private readonly patience: number,
  ) {}

  run<T>(task: Task, progress: (done: number, total: number) => void = () => {}): Promise<{ result: T; took: number }> {
    return new Promise((resolve, reject) => {
      this.waiting?.reject(new Stopped("a newer task has taken its place"));
      this.waiting = { task, progress, resolve: resolve as Waiting["resolve"], reject };
      this.next();
    });
  }

  cancel(reason = "stopped"): void {
    this.waiting?.reject(new Stopped(reason));
    this.waiting = null;
    if (this.running) this.end(new Stopped(reason));
  }

  get isBusy(): boolean {
    return this.running !== null;
  }

  private start(): void {
    this.isReady = false;
    const worker = new Worker(new URL("worker.js", import.meta.url), { type: "module" });
    this.worker = worker;
    // A worker that has been ended may still be heard.
    worker.onmessage = ({ data }) => {
      if (worker === this.worker) this.hear(data);
    };
    worker.onerror = (event) => {
      if (worker === this.worker) this.fail(new Error(event.message || "the worker cannot be started"));
    };
    compile(this.part).then(
      (module) => worker.postMessage({ part: this.part, module }),
      (error: unknown) => {
        if (worker === this.worker) this.fail(error instanceof Error ? error : new Error(String(error)));
      },
    );
  }

  private hear(data: { ready?: true; unusable?: string; progress?: [number, number]; trap?: string; result?: unknown; took?: number }): void {
    if (data.ready) {
      this.isReady = true;
      this.next();
    } else if (data.unusable !== undefined) {
      this.fail(new Error(`the engine is not of this version of the page (${data.unusable}); save the case, and load the page again`));
    } else if (data.progress) {
      this.running?.progress(...data.progress);
    } else if (data.trap !== undefined) {
      this.end(new Error(`the engine has stopped: ${data.trap}`));
    } else {
      clearTimeout(this.timer);
      const done = this.running;
      this.running = null;
      done?.resolve({ result: data.result, took: data.took ?? 0 });
      this.next();
    }
  }

  /** Ends the worker and whatever waits for it: another would fail as well. */
  private fail(error: Error): void {
    this.waiting?.reject(error);
    this.waiting = null;
    this.end(error);
  }

  private end(error: Error): void {
    clearTimeout(this.timer);
    this.worker?.terminate();
    this.worker = null;
    const ended = this.running;
    this.running = null;
    ended?.reject(error);
    if (this.waiting) this.next();
  }

  private next(): void {
    if (this.running || !this.waiting) return;
    if (!this.worker) return this.start();
    if (!this.isReady) return;
    this.running = this.waiting;
    this.waiting = null;
    this.worker.postMessage({ task: this.running.task });
    if (this.patience > 0) {
      this.timer = window.setTimeout(() => this.end(new Error(`no answer within ${this.patience / 1000} s`)), this.patience);
    }
  }
}
