// The page: one text, and everything else made from it.
import { Answers, issueList } from "./answers";
import { Editor } from "./editor";
import { compile, failure, isSame, sentence, type Case, type Change, type Frame, type Issue, type Opened, type Reply } from "./engine";
import * as files from "./files";
import { Form } from "./form";
import * as engine from "./frame";
import { Lane, Stopped } from "./jobs";
import { show } from "./morph";
import { Scene, turned } from "./scene";
import { caseSchema } from "./schema";
import * as share from "./share";
import { TOUR } from "./tour";
import list from "../generated/examples.json";

interface Example extends Opened {
  path: string;
  title: string;
}
const EXAMPLES = list as unknown as Example[];

/** A frame that takes longer is left to the worker, so that the page stays awake. */
const SLOW = 50;
const PATIENCE = 10_000;

const $ = <T extends HTMLElement = HTMLElement>(id: string): T => document.getElementById(id) as T;

const state = {
  units: "",
  frame: null as Frame | null,
  /** What the last frame took in the worker, in milliseconds; `null` if the text has been replaced since. */
  took: null as number | null,
  /** Whether the drawings are still those of another case. */
  isOfAnother: false,
  /** The texts that were last saved, and last shared or opened from the address. */
  saved: null as string | null,
  addressed: null as string | null,
};

let editor: Editor;
let scene: Scene;
let form: Form;
let answers: Answers;
const background = new Lane("frame", PATIENCE);
const drawer = new Lane("verbs", 60_000);

const current = (): Case => {
  const { name, files } = editor.source;
  return { name, text: editor.text, files, units: state.units };
};

function say(text: string, isError = false): void {
  const place = $("message");
  place.textContent = text;
  place.classList.toggle("error", isError);
  place.hidden = text === "";
}

let scheduled = 0;
let byHand = false;

/** The text has changed: by hand, or by a handle, a slider or a field. */
function changed(isByHand: boolean): void {
  byHand ||= isByHand;
  scheduled ||= requestAnimationFrame(() => {
    scheduled = 0;
    const isTyped = byHand;
    byHand = false;
    refresh(isTyped);
  });
}

/** Computes the frame of the text as it is: here if it is known to be quick, otherwise in the worker. */
function refresh(isTyped: boolean): void {
  say("");
  const of = current();
  if (!isTyped && state.took !== null && state.took < SLOW && of.text.length < 100_000) {
    const started = performance.now();
    render(engine.frame(of), isTyped);
    // The layout belongs to the frame.
    void document.body.offsetHeight;
    performance.measure("frame", { start: started, end: performance.now() });
    return;
  }
  background.run<Frame>({ kind: "frame", case: of }).then(
    ({ result, took }) => {
      state.took = took;
      if (isSame(of, current())) render(result, isTyped);
    },
    (error: unknown) => {
      if (!(error instanceof Stopped)) say(`The case cannot be computed: ${failure(error)}`, true);
    },
  );
}

function render(frame: Frame, isTyped: boolean): void {
  state.frame = frame;
  editor.mark(editor.source.name, frame.issues);
  const isRefused = frame.issues.length > 0;
  $("issues").replaceChildren(...(isRefused ? [issueList(frame.issues, editor.source.name, (offset) => editor.goTo(offset))] : []));
  form.update();
  if (frame.handles) {
    drawer.cancel();
    state.isOfAnother = false;
    scene.show(frame.scene, frame.handles);
    show($("impulse"), frame.impulse);
    show($("energy"), frame.energy);
    slide("gamma", turned(frame.handles.crush_plane) * (180 / Math.PI), "°");
    slide("restitution", frame.handles.restitution, "");
  } else {
    // What a handle or a slider has led to, it leads back from; of another text its numbers are not the ones.
    if (isTyped || state.isOfAnother) scene.release();
    if (state.isOfAnother) scene.show("", null);
    if (frame.has_unknowns) void draw();
  }
  for (const id of ["scene", "figures"]) $(id).classList.toggle("stale", !frame.handles);
  for (const id of ["sliders", "figures"]) $(id).hidden = frame.has_unknowns || state.isOfAnother;
  answers.changed(frame);
  const [undo, redo] = editor.depths;
  $<HTMLButtonElement>("undo").disabled = undo === 0;
  $<HTMLButtonElement>("redo").disabled = redo === 0;
  document.documentElement.dataset["frame"] = String(Number(document.documentElement.dataset["frame"] ?? "0") + 1);
}

/** Draws the scene of a reconstruction, which takes a search. */
async function draw(): Promise<void> {
  const of = current();
  try {
    const { result } = await drawer.run<Reply>({ kind: "answer", verb: "draw", case: of, options: {} });
    if (!isSame(of, current()) || state.frame?.handles) return;
    if (result.svg !== "") {
      state.isOfAnother = false;
      scene.show(result.svg, null);
      $("scene").classList.remove("stale");
    } else $("issues").replaceChildren(issueList(result.issues, editor.source.name, (offset) => editor.goTo(offset)));
  } catch (error) {
    if (!(error instanceof Stopped)) say(`The scene cannot be drawn: ${failure(error)}`, true);
  }
}

function slide(id: string, value: number, unit: string): void {
  const input = $<HTMLInputElement>(id);
  if (document.activeElement !== input) input.value = String(value);
  $(`${id}-value`).textContent = `${value.toFixed(unit === "" ? 2 : 1)}${unit}`;
}

const edit = {
  begin: () => editor.begin(),
  apply: (changes: Change[]) => editor.apply(changes),
  end: () => editor.end(),
  refuse: (issues: Issue[]) => say(issues.map(sentence).join("\n"), true),
};

function slider(id: string, input: string, toSi: number, resolution: number): void {
  const control = $<HTMLInputElement>(id);
  control.addEventListener("pointerdown", () => edit.begin());
  for (const kind of ["pointerup", "pointercancel", "change"] as const) control.addEventListener(kind, () => edit.end());
  control.addEventListener("input", () => scene.move([[input, Number(control.value) * toSi, resolution]]));
}

/** The address is no longer that of the case. */
function leaveAddress(): void {
  if (location.hash !== "") history.replaceState(null, "", location.pathname + location.search);
}

/** Takes another case in place of the text. */
function take(opened: Opened): void {
  leaveAddress();
  editor.replace(opened);
}

/** The text is another. */
function edited(isByHand: boolean): void {
  if (editor.file !== state.addressed) leaveAddress();
  changed(isByHand);
}

/** `true` if the text would be lost with the page. */
const isUnsaved = (): boolean => editor.isEdited && ![state.saved, state.addressed].includes(editor.file);

/** Another case has taken the place of the text, or the one before it again. */
function replaced(): void {
  // A handle that is still held moves nothing of the other case.
  scene.letGo();
  background.cancel();
  answers.clear();
  state.took = null;
  state.isOfAnother = true;
  $("name").textContent = editor.source.name;
}

function example(path: string): Example | undefined {
  return EXAMPLES.find((one) => one.path === path);
}

async function openFiles(chosen: File[]): Promise<void> {
  try {
    take(await files.open(chosen));
  } catch (error) {
    say(failure(error), true);
  }
}

async function readFragment(): Promise<void> {
  const fragment = location.hash;
  // What was said may have been of the address before.
  say("");
  try {
    const shared = await share.unpack(fragment);
    // Another address, or another case, may have come first.
    if (!shared || fragment !== location.hash) return;
    state.addressed = shared.text;
    editor.replace(shared);
  } catch (error) {
    if (fragment === location.hash) say(`This address cannot be opened: ${failure(error)}.`, true);
  }
}

const base = (): string => editor.source.name.replace(/^.*[/\\]/, "").replace(/\.[^.]*$/, "") || "case";

/** The row of an export that is under way: its name, how far it is, and the way to end it. */
function exporting(name: string, cancel: () => void): { row: HTMLElement; progress: (done: number, total: number) => void } {
  const [row, text, bar, stop] = [document.createElement("p"), document.createElement("span"), document.createElement("progress"), document.createElement("button")];
  row.className = "running";
  text.textContent = `Exporting ${name}`;
  bar.max = 1;
  bar.setAttribute("aria-label", `Export of ${name}`);
  stop.type = "button";
  stop.textContent = "Cancel";
  stop.addEventListener("click", cancel);
  row.append(text, bar, stop);
  $("exports").append(row);
  const progress = (done: number, total: number) => {
    if (total > 1) bar.value = done / total;
  };
  return { row, progress };
}

/** Makes a file of the text as it is now, under its present name; nothing that was computed before is saved. */
async function exported(kind: string): Promise<void> {
  const of = current();
  const verb = kind === "json" || kind === "csv" ? `.${answers.shown.name}` : "";
  const name = `${base()}${verb}.${kind === "report" ? "html" : kind}`;
  const lane = new Lane("verbs", 0);
  say("");
  const { row, progress } = exporting(name, () => lane.cancel());
  const written = (reply: Reply | null): Reply => {
    if (!reply) throw new Error("there is no answer yet");
    if (reply.issues.length > 0) throw new Error(reply.issues.map(sentence).join("\n"));
    return reply;
  };
  try {
    if (kind === "report") {
      files.save(name, written((await lane.run<Reply>({ kind: "report", case: of }, progress)).result).html, "text/html");
    } else if (kind === "svg" || kind === "png") {
      const { svg } = written((await lane.run<Reply>({ kind: "answer", verb: "draw", case: of, options: {} }, progress)).result);
      if (kind === "svg") files.save(name, svg, "image/svg+xml");
      else files.save(name, await files.toPng(svg), "image/png");
    } else {
      const { csv, json } = written(await answers.ask(lane, progress));
      if (kind === "csv" && csv === "") throw new Error("this answer has no table as CSV; sweep, uncertainty and slide have");
      files.save(name, kind === "csv" ? csv : json, kind === "csv" ? "text/csv" : "application/json");
    }
  } catch (error) {
    if (!(error instanceof Stopped)) say(`${name} cannot be exported: ${failure(error)}`, true);
  } finally {
    row.remove();
    lane.cancel();
  }
}

function tour(): void {
  const dialog = $("tour");
  let at = 0;
  const show = () => {
    const step = TOUR[at]!;
    $("tour-title").textContent = `${at + 1} of ${TOUR.length}: ${step.title}`;
    $("tour-text").textContent = step.text;
    $<HTMLButtonElement>("tour-back").disabled = at === 0;
    $("tour-next").textContent = at + 1 === TOUR.length ? "Finish" : "Next";
    const found = example(step.example);
    if (!found) return;
    take({ name: found.path, text: step.change ? step.change(found.text) : found.text, files: found.files });
    answers.choose(step.verb, step.options);
  };
  const close = () => {
    dialog.hidden = true;
    $("tour-start").focus();
  };
  $("tour-start").addEventListener("click", () => {
    at = 0;
    dialog.hidden = false;
    show();
    $("tour-next").focus();
  });
  $("tour-back").addEventListener("click", () => {
    at--;
    show();
  });
  $("tour-next").addEventListener("click", () => {
    if (at + 1 === TOUR.length) return close();
    at++;
    show();
  });
  $("tour-close").addEventListener("click", close);
}

function wire(): void {
  const choice = $<HTMLSelectElement>("examples");
  for (const { path, title } of EXAMPLES) choice.append(new Option(`${title} (${path})`, path));
  choice.addEventListener("change", () => {
    const found = example(choice.value);
    if (found) take({ name: found.path, text: found.text, files: found.files });
    choice.value = "";
  });
  const opener = $<HTMLInputElement>("open");
  opener.addEventListener("change", () => {
    void openFiles(Array.from(opener.files ?? [])).then(() => (opener.value = ""));
  });
  $("save").addEventListener("click", () => {
    const ending = /\.(toml|json)$/.exec(editor.source.name)?.[0] ?? ".toml";
    state.saved = editor.file;
    files.save(`${base()}${ending}`, state.saved, "text/plain");
  });
  $("share").addEventListener("click", async () => {
    try {
      const text = editor.file;
      const address = await share.pack({ ...editor.source, text });
      if (editor.file !== text) throw new Error("it has changed meanwhile");
      history.replaceState(null, "", address);
      state.addressed = text;
      await navigator.clipboard?.writeText(location.href).catch(() => {});
      say("The address of this page now has the case in it. It stays on this machine until you send it.");
    } catch (error) {
      say(`The case cannot be shared: ${failure(error)}`, true);
    }
  });
  const units = $<HTMLSelectElement>("units");
  units.addEventListener("change", () => {
    state.units = units.value;
    changed(true);
  });
  const kinds = $<HTMLSelectElement>("export");
  kinds.addEventListener("change", () => {
    const kind = kinds.value;
    kinds.value = "";
    if (kind !== "") void exported(kind);
  });
  $("undo").addEventListener("click", () => editor.undo());
  $("redo").addEventListener("click", () => editor.redo());
  addEventListener("hashchange", () => void readFragment());
  addEventListener("beforeunload", (event) => {
    if (isUnsaved()) event.preventDefault();
  });
  addEventListener("dragover", (event) => event.preventDefault());
  addEventListener("drop", (event) => {
    const dropped = Array.from(event.dataTransfer?.files ?? []);
    if (dropped.length === 0) return;
    event.preventDefault();
    const records = answers.shown.name === "check" || dropped.every(({ name }) => /\.(jsonl|csv)$/i.test(name));
    if (records && dropped.length > 1) say(`${dropped.map(({ name }) => name).join(" and ")}: check one file of records at a time`, true);
    else if (records) void answers.check(dropped[0]!);
    else void openFiles(dropped);
  });
  slider("gamma", "contact.crush_plane", Math.PI / 180, Math.PI / 1800);
  slider("restitution", "contact.restitution", 1, 0.01);
  tour();
}

async function start(): Promise<void> {
  const module = compile("frame");
  const first = example("position-a.toml") ?? EXAMPLES[0]!;
  editor = new Editor($("editor"), { name: first.path, files: first.files, text: first.text }, caseSchema, edited, replaced);
  scene = new Scene($("scene"), current, edit);
  form = new Form($("form"), current, (changes) => editor.apply(changes), edit.refuse);
  answers = new Answers($("answers"), current, (offset) => editor.goTo(offset));
  $("name").textContent = editor.source.name;
  wire();
  await engine.load(await module);
  // The first example is known to be quick.
  state.took = 0;
  refresh(false);
  await readFragment();
  performance.mark("ready");
  document.documentElement.dataset["ready"] = "true";
}

start().catch((error: unknown) => say(`The page cannot start: ${failure(error)}`, true));
if ("serviceWorker" in navigator && location.protocol.startsWith("http")) {
  addEventListener("load", () => void navigator.serviceWorker.register("sw.js").catch(() => {}));
}
