// The main inputs as fields, each with the value and unit that the text has.
import type { Case, Change, Issue } from "./engine";
import { areChanges, values, writeText } from "./frame";

const VEHICLE = [
  ["name", "Name"],
  ["mass", "Mass"],
  ["weight", "Weight"],
  ["yaw_inertia", "Yaw inertia"],
  ["radius_of_gyration", "Radius of gyration"],
  ["heading", "Heading"],
  ["speed", "Speed"],
  ["velocity.x", "Velocity along x"],
  ["velocity.y", "Velocity along y"],
  ["yaw_rate", "Yaw rate"],
  ["impact_center.forward", "Impact center, forward"],
  ["impact_center.left", "Impact center, left"],
] as const;
const CONTACT = [
  ["crush_plane", "Crush plane angle Γ"],
  ["restitution", "Restitution e"],
  ["impulse_ratio", "Impulse ratio μ"],
] as const;
/** Fields that are shown without a value too. */
const ALWAYS = /^contact\.|\.yaw_rate$/;

interface Field {
  path: string;
  row: HTMLElement;
  input: HTMLInputElement;
}

export class Form {
  private readonly fields: Field[] = [];
  private readonly groups: { box: HTMLFieldSetElement; fields: Field[] }[] = [];

  constructor(
    place: HTMLElement,
    private readonly current: () => Case,
    private readonly apply: (changes: Change[]) => void,
    private readonly refuse: (issues: Issue[]) => void,
  ) {
    this.group(place, "Vehicle 1", VEHICLE.map(([key, label]) => [`vehicle.1.${key}`, label]));
    this.group(place, "Vehicle 2", VEHICLE.map(([key, label]) => [`vehicle.2.${key}`, label]));
    this.group(place, "Contact", CONTACT.map(([key, label]) => [`contact.${key}`, label]));
  }

  private group(place: HTMLElement, title: string, inputs: [string, string][]): void {
    const box = document.createElement("fieldset");
    const legend = document.createElement("legend");
    legend.textContent = title;
    box.append(legend);
    const fields: Field[] = inputs.map(([path, label]) => {
      const row = document.createElement("label");
      const text = document.createElement("span");
      text.textContent = label;
      const input = document.createElement("input");
      input.type = "text";
      input.autocomplete = "off";
      input.spellcheck = false;
      input.dataset["path"] = path;
      input.addEventListener("change", () => this.typed(path, input));
      row.append(text, input);
      box.append(row);
      return { path, row, input };
    });
    this.fields.push(...fields);
    this.groups.push({ box, fields });
    place.append(box);
  }

  private typed(path: string, input: HTMLInputElement): void {
    const found = writeText(this.current(), path, input.value);
    if (areChanges(found)) this.apply(found);
    else this.refuse(found);
  }

  /** Shows the values of the text. A text that cannot be read leaves the fields as they are. */
  update(): void {
    const found = values(this.current(), this.fields.map(({ path }) => path));
    for (const { box } of this.groups) box.disabled = found === null;
    found?.forEach((value, place) => {
      const { row, input, path } = this.fields[place]!;
      row.hidden = value === null && !ALWAYS.test(path);
      const text = value?.text ?? "";
      if (input.value !== text) input.value = text;
    });
  }
}
