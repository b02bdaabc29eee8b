// The case file as text: CodeMirror with completion and documentation from the JSON Schema, and the engine's issues at their place.
import { autocompletion, closeBrackets, completionKeymap, type CompletionContext, type CompletionResult } from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap, invertedEffects, isolateHistory, redo, redoDepth, undo, undoDepth } from "@codemirror/commands";
import { HighlightStyle, StreamLanguage, syntaxHighlighting } from "@codemirror/language";
import { toml } from "@codemirror/legacy-modes/mode/toml";
import { lintGutter, lintKeymap, setDiagnostics, type Diagnostic } from "@codemirror/lint";
import { searchKeymap } from "@codemirror/search";
import { Annotation, EditorState, StateEffect, StateField, Transaction } from "@codemirror/state";
import { EditorView, drawSelection, highlightActiveLine, hoverTooltip, keymap, lineNumbers } from "@codemirror/view";
import { tags } from "@lezer/highlight";
import type { Change, Issue, Opened, Source } from "./engine";
import { tableAt, type CaseSchema } from "./schema";

const colors = EditorView.theme({
  "&": { color: "var(--ink)", backgroundColor: "var(--field)", height: "100%", fontSize: "0.875rem" },
  ".cm-scroller": { fontFamily: "var(--mono)", overflow: "auto" },
  ".cm-content": { caretColor: "var(--ink)" },
  ".cm-cursor": { borderLeftColor: "var(--ink)" },
  ".cm-gutters": { backgroundColor: "var(--panel)", color: "var(--muted)", borderRight: "1px solid var(--line)" },
  ".cm-activeLine": { backgroundColor: "var(--active)" },
  "&.cm-focused > .cm-scroller > .cm-selectionLayer .cm-selectionBackground, .cm-selectionBackground": { backgroundColor: "var(--selection)" },
  ".cm-tooltip": { backgroundColor: "var(--panel)", color: "var(--ink)", border: "1px solid var(--line)", maxWidth: "32rem" },
  ".cm-tooltip-hover": { padding: "0.3rem 0.6rem", whiteSpace: "pre-wrap" },
  ".cm-tooltip-autocomplete ul li[aria-selected]": { backgroundColor: "var(--accent)", color: "var(--on-accent)" },
  ".cm-diagnostic": { whiteSpace: "pre-wrap" },
});

const highlighting = HighlightStyle.define([
  { tag: tags.comment, color: "var(--comment)" },
  { tag: tags.string, color: "var(--string)" },
  { tag: [tags.number, tags.atom], color: "var(--number)" },
  { tag: [tags.propertyName, tags.definition(tags.propertyName)], color: "var(--key)" },
]);

/** A case as it was opened. */
interface Original extends Source {
  /** The mark before its text; empty if there is none. */
  mark: string;
  text: string;
  /** The text as the editor has it. */
  shown: string;
  /** What ends the lines of an edited text: what ends all of its own, if they agree. */
  end: string;
}

function original({ name, files, text }: Opened): Original {
  const mark = text.startsWith("\ufeff") ? "\ufeff" : "";
  const rest = text.slice(mark.length);
  const shown = rest.replace(/\r\n?/g, "\n");
  const isWindows = rest !== shown && shown.replaceAll("\n", "\r\n") === rest;
  return { name, files, mark, text: rest, shown, end: isWindows ? "\r\n" : "\n" };
}

const opened = StateEffect.define<Original>();

const source = StateField.define<Original>({
  create: () => original({ name: "", files: {}, text: "" }),
  update: (was, { effects }) => effects.reduce((now, effect) => (effect.is(opened) ? effect.value : now), was),
});

/** Marks an edit of the form or of the drawing; `true` within a drag, whose edits are one step of the history. */
const drawn = Annotation.define<boolean>();

export class Editor {
  readonly view: EditorView;
  private isMarked = false;
  private held: { before: EditorState; time: number } | null = null;

  constructor(place: HTMLElement, first: Opened, schema: () => Promise<CaseSchema>, private readonly changed: (byHand: boolean) => void, replaced: () => void) {
    const lines = (state: EditorState) => (number: number) => state.doc.line(number).text;
    const complete = async (context: CompletionContext): Promise<CompletionResult | null> => {
      const line = context.state.doc.lineAt(context.pos);
      const before = line.text.slice(0, context.pos - line.from);
      const table = tableAt(lines(context.state), line.number);
      const value = /^\s*([A-Za-z_][A-Za-z0-9_]*)\s*=\s*"([^"]*)$/.exec(before);
      if (value) {
        const options = (await schema()).words(table, value[1]!).map((label) => ({ label, type: "enum" }));
        return { from: context.pos - value[2]!.length, options };
      }
      const key = /^\s*([A-Za-z_][A-Za-z0-9_]*)?$/.exec(before);
      if (!key || (!key[1] && !context.explicit)) return null;
      const options = (await schema()).keys(table).map(({ name, description, examples }) => ({
        label: name,
        type: "property",
        info: description,
        apply: examples[0] ? `${name} = ${examples[0]}` : `${name} = `,
      }));
      return { from: context.pos - (key[1]?.length ?? 0), options, validFor: /^[A-Za-z0-9_]*$/ };
    };
    const hover = hoverTooltip(async (view, pos) => {
      const line = view.state.doc.lineAt(pos);
      const key = /^\s*([A-Za-z_][A-Za-z0-9_]*)\s*=/.exec(line.text);
      if (!key || pos - line.from > key[0].length) return null;
      const { description, examples } = (await schema()).key(tableAt(lines(view.state), line.number), key[1]!);
      if (!description) return null;
      const create = () => {
        const dom = document.createElement("div");
        dom.textContent = examples.length > 0 ? `${description}\nFor example: ${examples.join(", ")}` : description;
        return { dom };
      };
      return { pos: line.from, end: line.from + key[0].length, create };
    });
    // A shadow root takes the editor's style sheets as objects: the policy of the page allows no style elements.
    const root = place.attachShadow({ mode: "open" });
    this.view = new EditorView({
      root,
      parent: root,
      state: EditorState.create({
        doc: original(first).shown,
        extensions: [
          source.init(() => original(first)),
          // A step back to another case is one to its name and files.
          invertedEffects.of(({ effects, startState }) => (effects.some((effect) => effect.is(opened)) ? [opened.of(startState.field(source))] : [])),
          lineNumbers(),
          lintGutter(),
          history({ joinToEvent: (transaction, isAdjacent) => isAdjacent || transaction.annotation(drawn) === true }),
          drawSelection(),
          highlightActiveLine(),
          closeBrackets(),
          StreamLanguage.define(toml),
          syntaxHighlighting(highlighting),
          autocompletion({ override: [complete] }),
          hover,
          keymap.of([...completionKeymap, ...lintKeymap, ...searchKeymap, ...historyKeymap, ...defaultKeymap]),
          EditorView.lineWrapping,
          EditorView.contentAttributes.of({ "aria-label": "Case file" }),
          colors,
          EditorView.updateListener.of((update) => {
            if (update.state.field(source) !== update.startState.field(source)) replaced();
            if (update.docChanged) changed(update.transactions.some((transaction) => transaction.annotation(drawn) === undefined));
          }),
        ],
      }),
    });
    // A long text scrolls by the keyboard too.
    this.view.scrollDOM.tabIndex = 0;
  }

  /** The text as the engine reads it: exactly as it was opened until it is edited, then with the ends of its lines. */
  get text(): string {
    const { text, shown, end } = this.source;
    const now = this.view.state.doc.toString();
    return now === shown ? text : now.replaceAll("\n", end);
  }

  /** The text with the mark before it, as its file has it. */
  get file(): string {
    return this.source.mark + this.text;
  }

  get isEdited(): boolean {
    return this.view.state.doc.toString() !== this.source.shown;
  }

  get source(): Original {
    return this.view.state.field(source);
  }

  /** The place in the editor of a place in the text: an end of a line is one character in the editor. */
  private at(offset: number): number {
    const { text, shown } = this.source;
    const ends = text.length === shown.length ? 0 : this.text.slice(0, offset + 1).split("\r\n").length - 1;
    return Math.min(offset - ends, this.view.state.doc.length);
  }

  /** Replaces the whole text and what it belongs to, as one step that can be undone. */
  replace(by: Opened): void {
    this.end();
    const now = original(by);
    const changes = { from: 0, to: this.view.state.doc.length, insert: now.shown };
    this.view.dispatch({ changes, effects: opened.of(now), annotations: isolateHistory.of("full") });
  }

  /** Applies an edit of the form or of the drawing: as one step that can be undone, or as a part of that of a drag. */
  apply(edits: Change[]): void {
    const changes = edits.map(({ from, to, insert }) => ({ from: this.at(from), to: this.at(to), insert }));
    // The history joins edits that come soon after one another: those of a drag have one time, however long it is held.
    const how = this.held ? Transaction.time.of(this.held.time) : isolateHistory.of("full");
    this.view.dispatch({ changes, annotations: [drawn.of(this.held !== null), how] });
  }

  /** Begins a drag: its edits are one step. */
  begin(): void {
    if (this.held) return;
    this.isolate();
    this.held = { before: this.view.state, time: Date.now() };
  }

  end(): void {
    const { held } = this;
    this.held = null;
    if (!held || held.before.doc === this.view.state.doc) return;
    if (!held.before.doc.eq(this.view.state.doc)) return this.isolate();
    // A drag that leads back to where it has begun is no step.
    this.view.setState(held.before);
    this.changed(false);
  }

  /** Keeps the last step of the history apart from the next one. */
  private isolate(): void {
    this.view.dispatch({ annotations: isolateHistory.of("full") });
  }

  undo(): void {
    undo(this.view);
  }

  redo(): void {
    redo(this.view);
  }

  get depths(): [number, number] {
    return [undoDepth(this.view.state), redoDepth(this.view.state)];
  }

  mark(name: string, issues: Issue[]): void {
    if (issues.length === 0 && !this.isMarked) return;
    this.isMarked = issues.length > 0;
    const diagnostic = ({ from, to, file, path, message, help }: Issue): Diagnostic => {
      const isHere = file === name && from !== null && to !== null;
      const text = `${path === "" ? "" : `${path}: `}${message}${help === null ? "" : `\n${help}`}`;
      return { from: isHere ? this.at(from) : 0, to: isHere ? this.at(to) : 0, severity: "error", message: text };
    };
    this.view.dispatch(setDiagnostics(this.view.state, issues.map(diagnostic)));
  }

  /** Moves the cursor to an issue. */
  goTo(offset: number): void {
    this.view.dispatch({ selection: { anchor: this.at(offset) }, scrollIntoView: true });
    this.view.focus();
  }
}
