// Shows the engine's markup by changing only what differs from the frame before: a drawing has a few hundred elements, and a drag leaves most of
// them as they are. The markup is compared with that of the last frame, tag by tag, and never with the document, which is slow to read.
//
// The engine writes well-formed elements and escapes every text. Elements are made one by one here, so no text can become one; what could act is
// left out all the same.

const SPACES: Record<string, string> = { svg: "http://www.w3.org/2000/svg", math: "http://www.w3.org/1998/Math/MathML" };
const HTML = "http://www.w3.org/1999/xhtml";
const ACTIVE = new Set(["script", "style", "iframe", "object", "embed", "link", "meta", "base", "form", "foreignobject", "animate", "set"]);
const ENTITIES: Record<string, string> = { amp: "&", lt: "<", gt: ">", quot: '"', apos: "'", nbsp: "\u00a0" };

interface Tag {
  /** The tag as written, or `null` for a text. */
  raw: string;
  name: string | null;
  children: Tag[];
  node: Element | Text | null;
  /** Its attributes, read when they are first needed. */
  attributes?: Map<string, string>;
}

const TOKEN = /<(\/?)([A-Za-z][\w:.-]*)([^>]*?)(\/?)>|[^<]+|</g;
const ATTRIBUTE = /([^\s=]+)="([^"]*)"/g;
const VOID = new Set(["br", "hr", "img", "col", "wbr"]);

function decode(text: string): string {
  if (!text.includes("&")) return text;
  return text.replace(/&(?:#(\d+)|#x([0-9a-fA-F]+)|(\w+));/g, (whole, decimal?: string, hex?: string, name?: string) => {
    if (name !== undefined) return ENTITIES[name] ?? whole;
    const code = decimal !== undefined ? Number(decimal) : Number.parseInt(hex!, 16);
    return code <= 0x10ffff ? String.fromCodePoint(code) : whole;
  });
}

function parse(markup: string): Tag[] {
  const top: Tag[] = [];
  const open: { name: string; children: Tag[] }[] = [{ name: "", children: top }];
  TOKEN.lastIndex = 0;
  for (let found = TOKEN.exec(markup); found; found = TOKEN.exec(markup)) {
    const [raw, end, name, , closed] = found;
    const { children } = open[open.length - 1]!;
    if (name === undefined) {
      // Line breaks between elements are the layout of the markup.
      if (/\S/.test(raw) || !raw.includes("\n")) children.push({ raw, name: null, children: [], node: null });
    } else if (end) {
      if (open.length > 1 && open[open.length - 1]!.name === name) open.pop();
    } else {
      const tag: Tag = { raw, name, children: [], node: null };
      children.push(tag);
      if (!closed && !VOID.has(name)) open.push({ name, children: tag.children });
    }
  }
  return top;
}

function isAllowed(name: string, value: string): boolean {
  const lower = name.toLowerCase();
  return !lower.startsWith("on") && lower !== "style" && !(/href$|^src$|^action$/.test(lower) && !value.startsWith("#"));
}

function attributes(tag: Tag): Map<string, string> {
  if (tag.attributes) return tag.attributes;
  const { raw } = tag;
  const found = new Map<string, string>();
  ATTRIBUTE.lastIndex = 0;
  for (let pair = ATTRIBUTE.exec(raw); pair; pair = ATTRIBUTE.exec(raw)) {
    const value = decode(pair[2]!);
    if (isAllowed(pair[1]!, value) && !pair[1]!.startsWith("xmlns")) found.set(pair[1]!, value);
  }
  return (tag.attributes = found);
}

/** Makes an element or a text; `null` for what is left out. */
function make(tag: Tag, space: string): Element | Text | null {
  if (tag.name === null) return (tag.node = document.createTextNode(decode(tag.raw)));
  if (ACTIVE.has(tag.name.toLowerCase())) return null;
  const inner = SPACES[tag.name] ?? space;
  const element = document.createElementNS(inner, tag.name);
  for (const [name, value] of attributes(tag)) element.setAttribute(name, value);
  for (const child of tag.children) {
    const node = make(child, inner);
    if (node) element.appendChild(node);
  }
  return (tag.node = element);
}

/** How far ahead an element of the same name is looked for. */
const AHEAD = 12;

/** How many tags from a place come before one of a name; Infinity if none is near. */
function distance(tags: Tag[], from: number, name: string | null): number {
  const end = Math.min(from + AHEAD, tags.length);
  for (let k = from; k < end; k++) if (tags[k]!.name === name) return k - from;
  return Infinity;
}

function update(place: Element, old: Tag[], next: Tag[], space: string): void {
  let at = 0;
  for (let k = 0; k < next.length; k++) {
    const is = next[k]!;
    const gone = distance(old, at, is.name);
    // Elements have come or gone: the nearer match decides which.
    const isNew = gone > 0 && (at >= old.length || gone > distance(next, k, old[at]!.name));
    if (gone < Infinity && !isNew) {
      for (const end = at + gone; at < end; at++) old[at]!.node?.remove();
      const was = old[at++]!;
      if (was.node) keep(was, is, was.node, space);
      continue;
    }
    const node = make(is, space);
    if (node) place.insertBefore(node, following(old, at));
  }
  for (; at < old.length; at++) old[at]!.node?.remove();
}

/** The first node of tags from a place. */
function following(tags: Tag[], from: number): Element | Text | null {
  for (let k = from; k < tags.length; k++) if (tags[k]!.node) return tags[k]!.node;
  return null;
}

/** Changes the node of a tag into that of another with the same name. */
function keep(was: Tag, is: Tag, node: Element | Text, space: string): void {
  is.node = node;
  if (is.name === null) {
    if (was.raw !== is.raw) (node as Text).data = decode(is.raw);
    return;
  }
  if (was.raw !== is.raw) {
    const [before, after] = [attributes(was), attributes(is)];
    for (const name of before.keys()) if (!after.has(name)) (node as Element).removeAttribute(name);
    for (const [name, value] of after) if (before.get(name) !== value) (node as Element).setAttribute(name, value);
  }
  update(node as Element, was.children, is.children, SPACES[is.name] ?? space);
}

const shown = new WeakMap<Element, { markup: string; tags: Tag[] }>();

/** Shows HTML or SVG in an element, whose contents are of this function alone. */
export function show(place: Element, markup: string): void {
  const last = shown.get(place);
  if (last?.markup === markup) return;
  const start = markup.startsWith("<?xml") ? markup.indexOf("<svg") : 0;
  const tags = parse(start > 0 ? markup.slice(start) : markup);
  if (!last) place.replaceChildren();
  update(place, last?.tags ?? [], tags, HTML);
  shown.set(place, { markup, tags });
}

/** Empties an element, or fills it by other means. */
export function fill(place: Element, ...nodes: Node[]): void {
  shown.delete(place);
  place.replaceChildren(...nodes);
}
