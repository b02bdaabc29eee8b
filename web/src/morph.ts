// Brings elements to the state of new markup by changing what differs: a drawing of a few hundred elements is kept from frame to frame.
// The markup comes from the engine, which escapes every text. What could act is left out all the same.

const parser = new DOMParser();
const ACTIVE = new Set(["script", "style", "iframe", "object", "embed", "link", "meta", "base", "form", "foreignobject"]);

function isAllowed(element: Element): boolean {
  return !ACTIVE.has(element.localName.toLowerCase());
}

function isAllowedAttribute({ name, value }: Attr): boolean {
  const lower = name.toLowerCase();
  return !lower.startsWith("on") && lower !== "style" && !(/href$|^src$|^action$/.test(lower) && !value.startsWith("#"));
}

function attributes(from: Element, to: Element): void {
  for (const attribute of Array.from(from.attributes)) if (!to.hasAttribute(attribute.name)) from.removeAttribute(attribute.name);
  for (const attribute of Array.from(to.attributes)) {
    if (isAllowedAttribute(attribute) && from.getAttribute(attribute.name) !== attribute.value) from.setAttribute(attribute.name, attribute.value);
  }
}

/** A copy of a node for this document, without what could act. */
function adopted(node: Node): Node | null {
  if (node.nodeType === Node.TEXT_NODE) return document.createTextNode(node.nodeValue ?? "");
  if (!(node instanceof Element) || !isAllowed(node)) return null;
  const copy = document.createElementNS(node.namespaceURI, node.localName);
  attributes(copy, node);
  for (const child of Array.from(node.childNodes)) {
    const inner = adopted(child);
    if (inner) copy.appendChild(inner);
  }
  return copy;
}

function children(from: Element, to: Element): void {
  let old = from.firstChild;
  for (let next = to.firstChild; next; next = next.nextSibling) {
    if (next.nodeType === Node.COMMENT_NODE) continue;
    if (next instanceof Element && !isAllowed(next)) continue;
    if (!old) {
      const copy = adopted(next);
      if (copy) from.appendChild(copy);
      continue;
    }
    const following: ChildNode | null = old.nextSibling;
    if (old.nodeType === Node.TEXT_NODE && next.nodeType === Node.TEXT_NODE) {
      if (old.nodeValue !== next.nodeValue) old.nodeValue = next.nodeValue;
    } else if (old instanceof Element && next instanceof Element && old.localName === next.localName && old.namespaceURI === next.namespaceURI) {
      attributes(old, next);
      children(old, next);
    } else {
      const copy = adopted(next);
      if (copy) from.replaceChild(copy, old);
    }
    old = following;
  }
  while (old) {
    const following: ChildNode | null = old.nextSibling;
    old.remove();
    old = following;
  }
}

/** Shows HTML or SVG in an element. */
export function show(in_: Element, markup: string): void {
  const start = markup.indexOf("<svg");
  const isDrawing = markup.startsWith("<?xml") || start === 0;
  children(in_, parser.parseFromString(isDrawing ? markup.slice(start) : markup, "text/html").body);
}
