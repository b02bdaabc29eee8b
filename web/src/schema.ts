// What the JSON Schema says about a place in a case file.
import { once } from "./once";

type Schema = Record<string, unknown>;

const isSchema = (value: unknown): value is Schema => typeof value === "object" && value !== null && !Array.isArray(value);

export interface Key {
  name: string;
  description: string;
  examples: string[];
}

export class CaseSchema {
  constructor(private readonly root: Schema) {}

  /** The schema that a reference leads to, and its alternatives. */
  private forms(schema: unknown, depth = 0): Schema[] {
    if (!isSchema(schema) || depth > 12) return [];
    const found = [schema];
    if (typeof schema["$ref"] === "string") {
      const name = schema["$ref"].split("/").at(-1)!;
      found.push(...this.forms((this.root["$defs"] as Schema | undefined)?.[name], depth + 1));
    }
    for (const key of ["anyOf", "oneOf", "allOf"]) {
      const list = schema[key];
      if (Array.isArray(list)) for (const inner of list) found.push(...this.forms(inner, depth + 1));
    }
    for (const key of ["then", "else"]) found.push(...this.forms(schema[key], depth + 1));
    return found;
  }

  private at(path: string[]): Schema[] {
    let found = this.forms(this.root);
    for (const part of path) {
      const next: Schema[] = [];
      for (const schema of found) {
        const properties = schema["properties"];
        if (isSchema(properties) && part in properties) next.push(...this.forms(properties[part]));
        const patterns = schema["patternProperties"];
        if (isSchema(patterns)) for (const [pattern, inner] of Object.entries(patterns)) if (new RegExp(pattern).test(part)) next.push(...this.forms(inner));
        if (/^[0-9]+$/.test(part)) next.push(...this.forms(schema["items"]));
      }
      // An item of an array stands where the array does.
      found = next.flatMap((schema) => (schema["type"] === "array" && isSchema(schema["items"]) ? [schema, ...this.forms(schema["items"])] : [schema]));
    }
    return found;
  }

  /** The keys of a table. */
  keys(table: string[]): Key[] {
    const found = new Map<string, Key>();
    for (const schema of this.at(table)) {
      const properties = schema["properties"];
      if (!isSchema(properties)) continue;
      for (const name of Object.keys(properties)) if (!found.has(name)) found.set(name, this.key(table, name));
    }
    return [...found.values()];
  }

  /** What the schema says of a key. */
  key(table: string[], name: string): Key {
    const forms = this.at([...table, name]);
    const description = forms.map((schema) => schema["description"]).find((text): text is string => typeof text === "string") ?? "";
    const examples = forms.map((schema) => schema["examples"]).find((list): list is unknown[] => Array.isArray(list)) ?? [];
    return { name, description, examples: examples.map((example) => JSON.stringify(example)) };
  }

  /** The words that a key accepts. */
  words(table: string[], name: string): string[] {
    const words = this.at([...table, name]).flatMap((schema) => (Array.isArray(schema["enum"]) ? schema["enum"] : "const" in schema ? [schema["const"]] : []));
    return [...new Set(words.filter((word): word is string => typeof word === "string"))];
  }
}

/** The schema of a case file, which is a file of the page. */
export const caseSchema = once(async () => {
  const response = await fetch(new URL("case.schema.json", import.meta.url));
  return new CaseSchema((await response.json()) as Schema);
});

/** The table of a line: its header and how many vehicles come before, found by reading lines upwards. */
export function tableAt(lines: (number: number) => string, line: number): string[] {
  for (let number = line; number >= 1; number--) {
    const header = /^\s*\[\[?\s*([A-Za-z0-9_.\- ]+?)\s*\]\]?/.exec(lines(number));
    if (header) return header[1]!.split(".").map((part) => part.trim());
  }
  return [];
}
