// The answers of the verbs: a tab for each, computed in a worker, always about the text as it is.
import type { Case, Frame, Issue, Reply } from "./engine";
import { Lane, Stopped } from "./jobs";
import { fill, show } from "./morph";

interface Option {
  name: string;
  label: string;
  value: string;
  /** Suggestions, the value as a number, or a switch. */
  kind?: "text" | "number" | "switch";
}

export interface Verb {
  name: string;
  title: string;
  options: Option[];
  /** `true` if it answers again after each change of the text; otherwise on request. */
  isLive: boolean;
  formats: ("json" | "csv" | "svg")[];
}

export const VERBS: Verb[] = [
  { name: "solve", title: "Solve", options: [], isLive: true, formats: ["json"] },
  { name: "gradient", title: "Gradient", options: [], isLive: true, formats: ["json"] },
  {
    name: "sweep",
    title: "Sweep",
    options: [
      { name: "vary", label: "Vary", value: "contact.crush_plane=-10 deg:10 deg:1 deg" },
      { name: "of", label: "Outputs", value: "W_n, W_t, T_L, mu0" },
    ],
    isLive: true,
    formats: ["json", "csv", "svg"],
  },
  { name: "crush", title: "Crush", options: [], isLive: true, formats: ["json"] },
  { name: "crash3", title: "CRASH3", options: [], isLive: true, formats: ["json"] },
  {
    name: "reconstruct",
    title: "Reconstruct",
    options: [{ name: "posterior", label: "Draw the posterior", value: "", kind: "switch" }],
    isLive: false,
    formats: ["json"],
  },
  {
    name: "uncertainty",
    title: "Uncertainty",
    options: [
      { name: "samples", label: "Samples", value: "100000", kind: "number" },
      { name: "bounds", label: "Guaranteed ranges, which take seconds", value: "", kind: "switch" },
    ],
    isLive: true,
    formats: ["json", "csv", "svg"],
  },
  { name: "slide", title: "Slide", options: [], isLive: true, formats: ["json", "csv"] },
  {
    name: "formula",
    title: "Formula",
    options: [
      { name: "output", label: "Output", value: "T_L" },
      { name: "wrt", label: "Derivative by (may be empty)", value: "" },
    ],
    isLive: true,
    formats: ["json"],
  },
  { name: "check", title: "Check", options: [], isLive: false, formats: ["json"] },
];

/** The methods of uncertainty that keep up with a change of the text; without a list all that apply are used. */
const LIVE_METHODS = ["linear", "second-order", "monte-carlo", "sobol", "shapley"];

const element = <K extends keyof HTMLElementTagNameMap>(name: K, className = ""): HTMLElementTagNameMap[K] => {
  const made = document.createElement(name);
  if (className) made.className = className;
  return made;
};

/** A list of issues; choosing one leads to its place. */
export function issueList(issues: Issue[], name: string, goTo: (offset: number) => void): HTMLElement {
  const list = element("ul", "issues");
  for (const { path, message, help, line, from, file } of issues) {
    const item = element("li");
    const text = `${path === "" ? "" : `${path}: `}${message}${help === null ? "" : ` (${help})`}`;
    if (from !== null && file === name) {
      const button = element("button", "link");
      button.type = "button";
      button.textContent = `Line ${line}: ${text}`;
      button.addEventListener("click", () => goTo(from));
      item.append(button);
    } else {
      item.textContent = `${file === "" || file === name ? "" : `${file}: `}${text}`;
    }
    list.append(item);
  }
  return list;
}

export class Answers {
  private verb: Verb = VERBS[0]!;
  private readonly inputs = new Map<string, HTMLInputElement>();
  private readonly tabs = new Map<string, HTMLButtonElement>();
  private readonly options = element("form", "options");
  private readonly status = element("div", "status");
  private readonly bar = element("progress");
  private readonly stop = element("button");
  private readonly result = element("div", "result");
  private readonly lane: Lane;
  private timer = 0;
  private dropped: { name: string; bytes: Uint8Array } | null = null;
  private frame: Frame | null = null;

  constructor(
    place: HTMLElement,
    private readonly current: () => Case,
    private readonly goTo: (offset: number) => void,
  ) {
    this.lane = new Lane("verbs", 0);
    const list = element("div", "tabs");
    list.setAttribute("role", "tablist");
    list.setAttribute("aria-label", "Answers");
    for (const verb of VERBS) list.append(this.tab(verb));
    list.addEventListener("keydown", (event) => this.walk(event));
    this.status.setAttribute("role", "status");
    this.bar.max = 1;
    this.bar.setAttribute("aria-label", "Progress");
    this.stop.type = "button";
    this.stop.textContent = "Cancel";
    this.stop.addEventListener("click", () => this.cancel());
    this.result.id = "result";
    this.result.setAttribute("role", "tabpanel");
    this.result.tabIndex = 0;
    this.options.addEventListener("submit", (event) => {
      event.preventDefault();
      void this.run();
    });
    const row = element("div", "running");
    row.append(this.status, this.bar, this.stop);
    this.busy(false);
    place.append(list, this.options, row, this.result);
    this.choose("solve");
  }

  private tab(verb: Verb): HTMLButtonElement {
    const tab = element("button");
    tab.type = "button";
    tab.id = `tab-${verb.name}`;
    tab.textContent = verb.title;
    tab.setAttribute("role", "tab");
    tab.setAttribute("aria-controls", "result");
    tab.addEventListener("click", () => this.choose(verb.name));
    this.tabs.set(verb.name, tab);
    return tab;
  }

  private walk(event: KeyboardEvent): void {
    const by = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (by === undefined) return;
    event.preventDefault();
    const next = VERBS[(VERBS.indexOf(this.verb) + by + VERBS.length) % VERBS.length]!;
    this.choose(next.name);
    this.tabs.get(next.name)?.focus();
  }

  /** Shows a verb, with other options if given. */
  choose(name: string, options: Record<string, string> = {}): void {
    this.cancel();
    this.verb = VERBS.find((verb) => verb.name === name) ?? this.verb;
    for (const [of, tab] of this.tabs) {
      tab.setAttribute("aria-selected", String(of === this.verb.name));
      tab.tabIndex = of === this.verb.name ? 0 : -1;
    }
    this.result.setAttribute("aria-labelledby", `tab-${this.verb.name}`);
    this.options.replaceChildren();
    this.inputs.clear();
    for (const option of this.verb.options) {
      const label = element("label");
      const input = element("input");
      input.type = option.kind === "switch" ? "checkbox" : option.kind === "number" ? "number" : "text";
      if (option.kind === "number") [input.min, input.max] = ["100", "10000000"];
      input.value = options[option.name] ?? option.value;
      input.addEventListener("change", () => void this.run());
      const text = element("span");
      text.textContent = option.label;
      label.append(text, input);
      this.options.append(label);
      this.inputs.set(option.name, input);
    }
    if (this.verb.name === "check") this.options.append(this.chooser());
    if (!this.verb.isLive && this.verb.name !== "check") {
      const start = element("button");
      start.textContent = "Start";
      this.options.append(start);
    }
    fill(this.result);
    this.status.textContent = "";
    this.changed(this.frame);
  }

  private chooser(): HTMLElement {
    const label = element("label");
    const text = element("span");
    text.textContent = "A file of collision records (JSON, JSON lines, CSV): choose it, or drop it here";
    const input = element("input");
    input.type = "file";
    input.accept = ".json,.jsonl,.csv";
    input.addEventListener("change", () => {
      const file = input.files?.[0];
      if (file) void this.check(file);
    });
    label.append(text, input);
    return label;
  }

  /** Checks the records of a file. */
  async check(file: File): Promise<void> {
    if (this.verb.name !== "check") this.choose("check");
    this.dropped = { name: file.name, bytes: new Uint8Array(await file.arrayBuffer()) };
    await this.run();
  }

  /** The text has changed, and its frame with it. */
  changed(frame: Frame | null): void {
    this.frame = frame;
    if (this.verb.name === "solve" || this.verb.name === "gradient") return this.showFrame();
    clearTimeout(this.timer);
    if (this.verb.isLive) this.timer = window.setTimeout(() => void this.run(), 60);
    else if (this.verb.name !== "check") this.status.textContent = "The case has changed: start again.";
  }

  private showFrame(): void {
    if (!this.frame) return;
    if (this.frame.has_unknowns) {
      void this.run();
    } else if (this.frame.issues.length > 0) {
      this.refuse(this.frame.issues);
    } else {
      show(this.result, this.verb.name === "solve" ? this.frame.tables : this.frame.gradient);
    }
  }

  private refuse(issues: Issue[]): void {
    fill(this.result, issueList(issues, this.current().name, this.goTo));
  }

  private busy(isBusy: boolean): void {
    this.bar.hidden = !isBusy;
    this.stop.hidden = !isBusy;
    if (isBusy) this.bar.removeAttribute("value");
    this.result.setAttribute("aria-busy", String(isBusy));
  }

  cancel(): void {
    clearTimeout(this.timer);
    this.lane.cancel();
    this.busy(false);
  }

  private asked(): object {
    const text = (name: string) => this.inputs.get(name)?.value.trim() ?? "";
    const list = (name: string) => text(name).split(",").map((word) => word.trim()).filter((word) => word !== "");
    switch (this.verb.name) {
      case "sweep":
        return { vary: text("vary").split(";").map((word) => word.trim()), of: list("of") };
      case "reconstruct":
        return { posterior: this.inputs.get("posterior")?.checked ?? false };
      case "uncertainty":
        return {
          samples: Math.min(Math.max(Math.round(Number(text("samples"))) || 100000, 100), 10_000_000),
          methods: this.inputs.get("bounds")?.checked ? [] : LIVE_METHODS,
        };
      case "formula":
        return { output: text("output"), wrt: list("wrt") };
      default:
        return {};
    }
  }

  /** Asks the verb that is shown about the text as it is now, in a lane of its own for an export, so that no later change takes its place; `null` where there is no answer. */
  async ask(lane = this.lane): Promise<Reply | null> {
    const { verb } = this;
    const progress = (done: number, total: number) => {
      if (total <= 1) return;
      this.bar.value = done / total;
    };
    if (verb.name === "check") {
      if (!this.dropped) return null;
      // A copy, because a worker takes what it is given.
      const task = { kind: "check", name: this.dropped.name, bytes: this.dropped.bytes.slice() } as const;
      return (await lane.run<Reply>(task, progress)).result;
    }
    return (await lane.run<Reply>({ kind: "answer", verb: verb.name, case: this.current(), options: this.asked() }, progress)).result;
  }

  async run(): Promise<void> {
    const { verb } = this;
    this.busy(true);
    this.status.textContent = "Computing";
    const started = performance.now();
    try {
      const reply = await this.ask();
      if (verb !== this.verb) return;
      this.busy(false);
      this.status.textContent = reply ? `Done in ${((performance.now() - started) / 1000).toFixed(2)} s` : "";
      if (!reply) return;
      if (reply.issues.length > 0) this.refuse(reply.issues);
      else show(this.result, reply.html);
    } catch (error) {
      if (error instanceof Stopped && error.message !== "stopped") return;
      this.busy(false);
      this.status.textContent = error instanceof Stopped ? "Canceled." : `No answer: ${error instanceof Error ? error.message : String(error)}`;
    }
  }

  get shown(): Verb {
    return this.verb;
  }
}
