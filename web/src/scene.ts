// The scene, live: the drawing of the report below, and over it the handles that drag the inputs of the case.
import type { Case, Change, Handles, Issue, VehicleHandles } from "./engine";
import { areChanges, writeNumber } from "./frame";
import { show } from "./morph";

const SVG = "http://www.w3.org/2000/svg";
/** Resolutions of a drag, in SI: a tenth of a degree, a tenth of a km/h, a centimeter. */
const ANGLE = Math.PI / 1800;
const SPEED = 0.1 / 3.6;
const LENGTH = 0.01;
const DEGREE = Math.PI / 180;

/** New values in SI of inputs by name, with the resolution of each. */
type Move = [input: string, si: number, resolution: number][];
type Point = [number, number];

interface Handle {
  key: string;
  label: string;
  /** Where it is, in ground axes. */
  at: (handles: Handles) => Point | null;
  /** What a pointer at a place of the ground means; `moved` is the way from where the drag has begun. */
  drag: (handles: Handles, pointer: Point, moved: Point) => Move;
  /** What an arrow key means; `by` has one coordinate of 1, or of a tenth with shift. */
  step: (handles: Handles, by: Point) => Move;
  /** Number, least and greatest in degrees or m/s for a screen reader; `null` where it is a place. */
  value: (handles: Handles) => [number, number, number] | null;
}

const rotated = ([x, y]: Point, angle: number): Point => [x * Math.cos(angle) - y * Math.sin(angle), x * Math.sin(angle) + y * Math.cos(angle)];
const angleOf = ([x, y]: Point): number => Math.atan2(y, x);
const plus = (one: Point, other: Point, times = 1): Point => [one[0] + times * other[0], one[1] + times * other[1]];
const minus = (one: Point, other: Point): Point => plus(one, other, -1);
/** The same angle between -180 and 180 degrees. */
export const turned = (angle: number): number => (Math.abs(angle) <= Math.PI ? angle : angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI)));

function heading(which: 0 | 1): Handle {
  const input = `vehicle.${which + 1}.heading`;
  const tail = (vehicle: VehicleHandles): Point => minus([-vehicle.rear, 0], vehicle.impact_center);
  return {
    key: input,
    label: `Heading of vehicle ${which + 1}`,
    at: ({ vehicles, impact_point }) => {
      const vehicle = vehicles[which];
      return vehicle && plus(impact_point, rotated(tail(vehicle), vehicle.heading));
    },
    drag: ({ vehicles, impact_point }, pointer) => [[input, turned(angleOf(minus(pointer, impact_point)) - angleOf(tail(vehicles[which]!))), ANGLE]],
    step: ({ vehicles }, by) => [[input, vehicles[which]!.heading + (by[0] + by[1]) * DEGREE, ANGLE]],
    value: ({ vehicles }) => [vehicles[which]!.heading / DEGREE, -360, 360],
  };
}

function velocity(which: 0 | 1): Handle {
  const vehicle = `vehicle.${which + 1}`;
  const changed = (of: VehicleHandles, by: Point): Move => {
    const velocity = plus(of.velocity, by);
    if (of.has_components) return [[`${vehicle}.velocity.x`, velocity[0], SPEED], [`${vehicle}.velocity.y`, velocity[1], SPEED]];
    return [[`${vehicle}.speed`, velocity[0] * Math.cos(of.heading) + velocity[1] * Math.sin(of.heading), SPEED]];
  };
  return {
    key: `${vehicle}.velocity`,
    label: `Velocity of vehicle ${which + 1}`,
    at: ({ vehicles, speed }) => vehicles[which] && plus(vehicles[which].position, vehicles[which].velocity, speed),
    drag: ({ vehicles, speed }, _, moved) => (speed > 0 ? changed(vehicles[which]!, [moved[0] / speed, moved[1] / speed]) : []),
    step: ({ vehicles }, by) => {
      const of = vehicles[which]!;
      // Along the heading an arrow key to the right or up is faster.
      return changed(of, of.has_components ? by : rotated([by[0] + by[1], 0], of.heading));
    },
    value: ({ vehicles }) => [Math.hypot(...vehicles[which]!.velocity), 0, 100],
  };
}

const HANDLES: Handle[] = [
  {
    key: "contact.crush_plane",
    label: "Crush plane angle Γ",
    at: ({ impact_point, normal, crush_plane }) => plus(impact_point, rotated([normal, 0], crush_plane)),
    drag: ({ impact_point }, pointer) => [["contact.crush_plane", angleOf(minus(pointer, impact_point)), ANGLE]],
    step: ({ crush_plane }, by) => [["contact.crush_plane", turned(crush_plane + (by[0] + by[1]) * DEGREE), ANGLE]],
    value: ({ crush_plane }) => [turned(crush_plane) / DEGREE, -180, 180],
  },
  heading(0),
  heading(1),
  velocity(0),
  velocity(1),
  {
    key: "impact_center",
    label: "Impact center",
    at: ({ impact_point }) => impact_point,
    drag: (handles, _, moved) => impactCenter(handles, moved),
    step: (handles, by) => impactCenter(handles, [by[0] / 10, by[1] / 10]),
    value: () => null,
  },
];

/** Moves the impact center over both vehicles, which stay where they are. */
function impactCenter({ vehicles }: Handles, by: Point): Move {
  return vehicles.flatMap((vehicle, which): Move => {
    if (!vehicle) return [];
    const [forward, left] = plus(vehicle.impact_center, rotated(by, -vehicle.heading));
    return [[`vehicle.${which + 1}.impact_center.forward`, forward, LENGTH], [`vehicle.${which + 1}.impact_center.left`, left, LENGTH]];
  });
}

/** Sets the attributes that differ: each that is set is laid out anew. */
function set(element: Element, attributes: Record<string, string>): void {
  for (const [name, value] of Object.entries(attributes)) if (element.getAttribute(name) !== value) element.setAttribute(name, value);
}

export class Scene {
  private handles: Handles | null = null;
  private readonly drawing: HTMLElement;
  private readonly over: SVGSVGElement;
  private readonly shapes = new Map<Handle, SVGGElement>();
  private held: { handle: Handle; start: Point; handles: Handles } | null = null;

  constructor(
    place: HTMLElement,
    private readonly current: () => Case,
    private readonly edit: { begin: () => void; apply: (changes: Change[]) => void; end: () => void; refuse: (issues: Issue[]) => void },
  ) {
    this.drawing = document.createElement("div");
    this.drawing.className = "drawing";
    this.over = document.createElementNS(SVG, "svg");
    this.over.setAttribute("class", "handles");
    this.over.setAttribute("role", "group");
    this.over.setAttribute("aria-label", "Handles of the scene");
    place.append(this.drawing, this.over);
    for (const handle of HANDLES) this.shapes.set(handle, this.shape(handle));
    this.over.addEventListener("pointermove", (event) => this.drag(event));
    for (const kind of ["pointerup", "pointercancel"] as const) this.over.addEventListener(kind, () => this.letGo());
  }

  private shape(handle: Handle): SVGGElement {
    const shape = document.createElementNS(SVG, "g");
    shape.setAttribute("class", "handle");
    shape.setAttribute("tabindex", "0");
    shape.setAttribute("data-handle", handle.key);
    shape.setAttribute("aria-label", handle.key === "impact_center" ? `${handle.label}, arrow keys move it` : handle.label);
    for (const [name, radius] of [["target", 16], ["dot", 8]] as const) {
      const circle = document.createElementNS(SVG, "circle");
      circle.setAttribute("class", name);
      circle.setAttribute("r", String(radius));
      shape.append(circle);
    }
    const title = document.createElementNS(SVG, "title");
    title.textContent = `${handle.label}: drag it, or use the arrow keys, with shift in smaller steps`;
    shape.append(title);
    shape.addEventListener("pointerdown", (event) => this.hold(handle, event));
    shape.addEventListener("keydown", (event) => this.step(handle, event));
    this.over.append(shape);
    return shape;
  }

  /** Shows a frame. Without handles, as of a reconstruction, the drawing alone. */
  show(svg: string, handles: Handles | null): void {
    show(this.drawing, svg);
    const root = this.drawing.querySelector("svg");
    const box = root?.getAttribute("viewBox") ?? "0 0 1000 834";
    if (this.over.getAttribute("viewBox") !== box) this.over.setAttribute("viewBox", box);
    this.handles = handles;
    for (const [handle, shape] of this.shapes) {
      const at = handles && handle.at(handles);
      const isHidden = !handles || !at || (handle.key.startsWith("vehicle") && !handles.vehicles[Number(handle.key[8]) - 1]);
      set(shape, { display: isHidden ? "none" : "inline" });
      if (isHidden) continue;
      const [x, y] = this.toPage(handles, at);
      const value = handle.value(handles);
      set(shape, { transform: `translate(${x.toFixed(2)} ${y.toFixed(2)})`, role: value ? "slider" : "button" });
      if (!value) continue;
      const [now, least, most] = value;
      set(shape, { "aria-valuenow": now.toFixed(1), "aria-valuemin": String(least), "aria-valuemax": String(most) });
    }
  }

  private toPage({ origin, scale }: Handles, [x, y]: Point): Point {
    return [origin[0] + scale * x, origin[1] - scale * y];
  }

  private toGround({ origin, scale }: Handles, event: PointerEvent): Point {
    const matrix = this.over.getScreenCTM();
    if (!matrix) return [0, 0];
    const { x, y } = new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix.inverse());
    return [(x - origin[0]) / scale, (origin[1] - y) / scale];
  }

  private hold(handle: Handle, event: PointerEvent): void {
    if (!this.handles || event.button !== 0) return;
    event.preventDefault();
    this.shapes.get(handle)?.focus();
    this.over.setPointerCapture(event.pointerId);
    this.held = { handle, start: this.toGround(this.handles, event), handles: this.handles };
    this.edit.begin();
  }

  private drag(event: PointerEvent): void {
    if (!this.held) return;
    const { handle, start, handles } = this.held;
    // The picture may move under the pointer; the drag counts from the picture in which it has begun.
    const pointer = this.toGround(handle.key === "contact.crush_plane" ? (this.handles ?? handles) : handles, event);
    this.move(handle.drag(handles, pointer, minus(pointer, start)));
  }

  /** Ends a drag. */
  letGo(): void {
    if (!this.held) return;
    this.held = null;
    this.edit.end();
  }

  /** Takes the handles away: the text is another than that of the drawing. */
  release(): void {
    this.letGo();
    this.handles = null;
    for (const shape of this.shapes.values()) set(shape, { display: "none" });
  }

  private step(handle: Handle, event: KeyboardEvent): void {
    const size = event.shiftKey ? 0.1 : 1;
    const by: Point | undefined = ({ ArrowLeft: [-size, 0], ArrowRight: [size, 0], ArrowUp: [0, size], ArrowDown: [0, -size] } as Record<string, Point>)[event.key];
    if (!by || !this.handles) return;
    event.preventDefault();
    this.move(handle.step(this.handles, by));
  }

  /** Writes values into the text. */
  move(values: Move): void {
    const of = this.current();
    const changes: Change[] = [];
    for (const [input, si, resolution] of values) {
      const found = writeNumber(of, input, si, resolution);
      if (!areChanges(found)) return this.edit.refuse(found);
      changes.push(...found);
    }
    if (changes.length > 0) this.edit.apply(changes);
  }
}
