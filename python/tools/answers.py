#!/usr/bin/env python3
"""Write the classes of answers, `planar_impact/answers.py`, from the JSON Schemas in `schemas/`.

    python/tools/answers.py > python/planar_impact/answers.py
"""

from __future__ import annotations

import json
import keyword
import re
import sys
import textwrap
from collections.abc import Mapping
from pathlib import Path
from typing import Any

SCHEMAS = Path(__file__).resolve().parents[2] / "schemas"
VERBS = ("solve", "gradient", "sweep", "crush", "crash3", "reconstruct", "uncertainty", "slide", "stiffness", "record", "formula", "check")
#: Attributes that every answer has: a key of such a name is read with brackets.
TAKEN = {*dir(Mapping), "keys", "items", "values", "get", "to_dict", "to_json", "to_text", "to_svg"}

HEADER = '''"""What each verb returns: a class for every object of its JSON, with its units. Written by `tools/answers.py` from `schemas/`.

A key that may be missing is ``None`` as an attribute, or an empty list; with brackets it raises :class:`KeyError`.
"""

from __future__ import annotations

from functools import partial
from typing import Any, Literal

from ._answer import Answer, Facts
'''


class Classes:
    """The classes written so far."""

    def __init__(self) -> None:
        self.text: dict[str, str] = {}
        self.schemas: dict[str, Any] = {}

    def add(self, schema: dict[str, Any], name: str, prefix: str, base: str, definitions: dict[str, Any]) -> str:
        """Write a class, after those that it needs, and return its name."""
        for written, same in self.schemas.items():
            if same == schema:
                return written
        if name in self.schemas:
            name = prefix + name
        self.schemas[name] = schema
        parts, late, lines = [], [], []
        required = schema.get("required", ())
        for key, entry in schema["properties"].items():
            hint, part = self.kind(entry, prefix, definitions)
            if re.search(rf"\b{name}\b", part):
                # A class that holds others of itself has a name only after its body.
                late.append(f'{name}._parts["{key}"] = {part}')
            elif part:
                parts.append(f'"{key}": {part}')
            if key in TAKEN or not key.isidentifier() or keyword.iskeyword(key):
                continue
            if key not in required and "None" not in hint and not hint.startswith("list["):
                hint += " | None"
            lines.append(f"    {key}: {hint}")
            if described := entry.get("description"):
                lines.append(docstring(described))
        body = [docstring(schema.get("description", f"{name}.")), "", "    __slots__ = ()"]
        if parts or late:
            body.append("    _parts = {" + ", ".join(parts) + "}")
        self.text[name] = "\n".join([f"class {name}({base}):", *body, "", *lines, *(["", "", *late] if late else [])])
        return name

    def kind(self, schema: dict[str, Any], prefix: str, definitions: dict[str, Any]) -> tuple[str, str]:
        """Return the type of a value, and what makes facts of an object in it."""
        if reference := schema.get("$ref"):
            name = reference.rpartition("/")[2]
            target = definitions[name]
            if "properties" not in target:
                return self.kind(target, prefix, definitions)
            name = self.add(target, name, prefix, "Facts[Any]", definitions)
            return name, name
        if choices := schema.get("anyOf") or schema.get("oneOf"):
            kinds = [self.kind(choice, prefix, definitions) for choice in choices]
            hints = list(dict.fromkeys(hint for hint, _ in kinds))
            parts = list(dict.fromkeys(part for _, part in kinds if part))
            assert len(parts) <= 1, f"{choices} are several kinds of objects"
            literals = [hint[len("Literal[") : -1] for hint in hints if hint.startswith("Literal[")]
            others = [hint for hint in hints if not hint.startswith("Literal[")]
            return " | ".join(([f"Literal[{', '.join(literals)}]"] if literals else []) + others), "".join(parts)
        if "const" in schema:
            return f"Literal[{json.dumps(schema['const'])}]", ""
        if "enum" in schema:
            return f"Literal[{', '.join(map(json.dumps, schema['enum']))}]", ""
        types = schema["type"] if isinstance(schema["type"], list) else [schema["type"]]
        hints, part = [], ""
        for name in types:
            if name == "array":
                items = schema.get("items") or {"anyOf": schema["prefixItems"]}
                hint, part = self.kind(items, prefix, definitions)
                hints.append(f"list[{hint}]")
            elif name == "object" and "properties" in schema:
                kinds = [self.kind(entry, prefix, definitions) for entry in schema["properties"].values()]
                part = "Facts"
                hints.append(f"Facts[{' | '.join(dict.fromkeys(hint for hint, _ in kinds))}]")
            elif name == "object":
                hint, inner = self.kind(schema["additionalProperties"], prefix, definitions)
                part = f"partial(Facts, part={inner})" if inner else "Facts"
                hints.append(f"Facts[{hint}]")
            else:
                hints.append({"string": "str", "number": "float", "integer": "int", "boolean": "bool", "null": "None"}[name])
        return " | ".join(hints), part


def docstring(text: str) -> str:
    """Return a description as the docstring of a class or an attribute, with the marks of reStructuredText."""
    text = re.sub(r"`+", "``", " ".join(text.split()))
    lines = textwrap.wrap(f'"""{text}"""', 130)
    return "\n".join(f"    {line}" for line in lines)


def module() -> str:
    """Return the text of the module."""
    classes, roots = Classes(), []
    # The answers first, so that they have the plain names.
    loaded = [json.loads((SCHEMAS / f"{verb}.schema.json").read_text(encoding="utf-8")) for verb in VERBS]
    names = {schema["title"] for schema in loaded}
    for schema in loaded:
        definitions = {
            (f"{schema['title']}{name}" if name in names else name): entry for name, entry in schema.get("$defs", {}).items()
        }
        text = json.dumps({**schema, "$defs": definitions})
        for name in names:
            text = text.replace(f'"#/$defs/{name}"', f'"#/$defs/{schema["title"]}{name}"')
        schema = json.loads(text)
        roots.append(classes.add(schema, schema["title"], schema["title"], "Answer", schema["$defs"]))
    exports = "__all__ = [\n" + "".join(f'    "{name}",\n' for name in sorted(classes.text)) + "]\n"
    return f"{HEADER}\n{exports}\n\n" + "\n\n\n".join(classes.text.values()) + "\n"


if __name__ == "__main__":
    sys.stdout.write(module())
