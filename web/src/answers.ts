// The answers of the verbs: a tab for each, computed in a worker, always about the text as it is.
import { failure, isSame, sentence, type Case, type Frame, type Issue, type Reply } from "./engine";
import { bytesOf } from "./files";
import { Lane } from "./jobs";
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
  for (const issue of issues) {
    const { line, from, file } = issue;
    const item = element("li");
    const text = sentence(issue);
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
  /** Counts what has been asked and what has been given up: only the reply to the last question is shown. */
  private question = 0;
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
    this.stop.addEventListener("click", () => {
      this.cancel();
      this.status.textContent = "Canceled.";
    });
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
      if (option.kind === "number") [input.min, input.max, input.step, input.required] = ["100", "10000000", "1", true];
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
    this.clear();
    this.changed(this.frame);
  }

  /** Another case has taken the place of the text: nothing that was asked about the old one is shown any more. */
  clear(): void {
    this.cancel();
    fill(this.result);
    this.status.textContent = "";
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
    this.clear();
    this.dropped = null;
    const { question } = this;
    try {
      const bytes = new Uint8Array(await bytesOf(file));
      if (question !== this.question) return;
      this.dropped = { name: file.name, bytes };
      await this.run();
    } catch (error) {
      if (question === this.question) this.status.textContent = `No answer: ${failure(error)}`;
    }
  }

  /** The text has changed, and its frame with it. */
  changed(frame: Frame | null): void {
    this.frame = frame;
    if (this.verb.name === "solve" || this.verb.name === "gradient") return this.showFrame();
    if (this.verb.name === "check") return;
    if (this.verb.isLive) {
      clearTimeout(this.timer);
      this.timer = window.setTimeout(() => void this.run(), 60);
      return;
    }
    this.cancel();
    if (!this.result.hasChildNodes()) return;
    this.result.classList.add("stale");
    this.status.textContent = "The case has changed: start again.";
  }

  private showFrame(): void {
    if (!this.frame) return;
    if (this.frame.has_unknowns) return void this.run();
    this.cancel();
    this.status.textContent = "";
    this.result.classList.remove("stale");
    if (this.frame.issues.length > 0) {
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
    this.question++;
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
          samples: Number(text("samples")),
          methods: this.inputs.get("bounds")?.checked ? [] : LIVE_METHODS,
        };
      case "formula":
        return { output: text("output"), wrt: [text("wrt")].filter((name) => name !== "") };
      default:
        return {};
    }
  }

  /** What is wrong with an option that is typed; `null` if nothing is. */
  private unusable(): string | null {
    const wrong = this.verb.options.find(({ name }) => this.inputs.get(name)?.checkValidity() === false);
    return wrong ? `${wrong.label}: ${this.inputs.get(wrong.name)!.validationMessage}` : null;
  }

  /** Asks the verb that is shown about the text as it is now, in a lane of its own for an export, so that no later change takes its place; `null` where there is no answer. */
  async ask(lane: Lane, progress: (done: number, total: number) => void): Promise<Reply | null> {
    const { verb } = this;
    const unusable = this.unusable();
    if (unusable !== null) throw new Error(unusable);
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
    const question = ++this.question;
    const of = this.current();
    this.busy(true);
    this.status.textContent = "Computing";
    const started = performance.now();
    try {
      const reply = await this.ask(this.lane, (done, total) => {
        if (question === this.question && total > 1) this.bar.value = done / total;
      });
      if (question !== this.question) return;
      this.busy(false);
      if (verb.name !== "check" && !isSame(of, this.current())) {
        this.status.textContent = "The case has changed.";
        return;
      }
      this.status.textContent = reply ? `Done in ${((performance.now() - started) / 1000).toFixed(2)} s` : "";
      if (!reply) return;
      this.result.classList.remove("stale");
      if (reply.issues.length > 0) this.refuse(reply.issues);
      else show(this.result, reply.html);
    } catch (error) {
      if (question !== this.question) return;
      this.busy(false);
      fill(this.result);
      this.status.textContent = `No answer: ${failure(error)}`;
    }
  }

  get shown(): Verb {
    return this.verb;
  }
}
