"""Writes every change that cargo-mutants knows of a file into it, each behind a switch: one build then holds all of them, and a test tries one by naming it.

`a * b` becomes `(match (a, b) { (_l, _r) => if on(7) { _l + _r } else { _l * _r } })`: operands are evaluated once and in order, and temporaries live as long as before.
What the compiler refuses, such as an operator that a type lacks, is found again by the marks around each change and left out.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import Any

import tree_sitter_rust
from tree_sitter import Language, Node, Parser

PARSER = Parser(Language(tree_sitter_rust.language()))
COMPARISONS = {"==", "!=", "<", "<=", ">", ">="}
CONSTANT = {"const_item", "static_item", "array_type", "enum_variant", "const_block"}


@dataclass
class Site:
    """A place of a file with the changes that are tried there."""

    start: int
    end: int
    node: Node | None
    genre: str
    changes: list[tuple[int, str]] = field(default_factory=list)


def on(number: int) -> str:
    return f"::mutant_switch::on({number})"


def marked(number: int, text: str) -> str:
    """Surrounds what a change would run with marks, which name it when the compiler refuses it."""
    return f"/*<{number}*/{text}/*{number}>*/"


class Source:
    def __init__(self, text: str, changes: list[tuple[int, dict[str, Any]]]) -> None:
        self.bytes = text.encode()
        self.lines = [0]
        for line in self.bytes.split(b"\n"):
            self.lines.append(self.lines[-1] + len(line) + 1)
        self.root = PARSER.parse(self.bytes).root_node
        self.unplaced: list[int] = []
        sites: dict[tuple[int, int, str], Site] = {}
        for number, change in changes:
            start, end = (self.offset(change["span"][key]) for key in ("start", "end"))
            # An `impl Trait` is one type, which another value does not have.
            is_hidden = change["genre"] == "FnValue" and "impl " in change["function"]["return_type"]
            site = None if is_hidden else self.site(change["genre"], start, end)
            if site is None:
                self.unplaced.append(number)
                continue
            kept = sites.setdefault((site.start, site.end, site.genre), site)
            kept.changes.append((number, change["replacement"]))
        self.sites = sorted(sites.values(), key=lambda site: (site.start, site.genre != "FnValue", -site.end))

    def offset(self, place: dict[str, int]) -> int:
        """Returns the byte of a line and a column, both from one, where columns count characters."""
        start = self.lines[place["line"] - 1]
        line = self.bytes[start : self.lines[place["line"]] - 1].decode()
        return start + len(line[: place["column"] - 1].encode())

    def site(self, genre: str, start: int, end: int) -> Site | None:
        """Returns the expression that a change is of, or nothing in a constant, where no switch can be read."""
        node = self.root.descendant_for_byte_range(start, max(start, end - 1))
        wanted = {
            "BinaryOperator": {"binary_expression", "compound_assignment_expr"},
            "UnaryOperator": {"unary_expression"},
            "MatchArm": {"match_arm"},
            "MatchArmGuard": {"match_pattern"},
            "StructField": {"struct_expression"},
            "FnValue": {"function_item"},
        }.get(genre, set())
        if genre in ("BinaryOperator", "UnaryOperator"):
            node = node and node.parent
            node = node if node and node.type in wanted else None
        while node is not None and node.type not in wanted:
            node = node.parent
        if node is None or self.is_constant(node):
            return None
        if genre == "FnValue":
            return Site(start, start, None, genre)
        if genre == "MatchArm":
            node = node.child_by_field_name("pattern")
            return node and Site(node.start_byte, node.end_byte, node, "MatchArmGuard")
        return Site(node.start_byte, node.end_byte, node, genre)

    def is_constant(self, node: Node | None) -> bool:
        while node is not None:
            modifiers = [child.text or b"" for child in node.children if child.type == "function_modifiers"]
            if node.type in CONSTANT or node.type == "function_item" and any(b"const" in text for text in modifiers):
                return True
            node = node.parent
        return False

    def plain(self, node: Node) -> str:
        return self.bytes[node.start_byte : node.end_byte].decode()

    def text(self, without: set[int]) -> str:
        """Returns the file with all changes but some."""
        kept = []
        for site in self.sites:
            changes = [change for change in site.changes if change[0] not in without]
            if changes:
                kept.append(Site(site.start, site.end, site.node, site.genre, changes))
        return self.within(0, len(self.bytes), kept)

    def within(self, start: int, end: int, sites: list[Site]) -> str:
        """Returns a part of the file with the changes of the places in it."""
        text, at, index = [], start, 0
        while index < len(sites):
            site = sites[index]
            index += 1
            inner = []
            while index < len(sites) and sites[index].start < site.end:
                inner.append(sites[index])
                index += 1
            text += [self.bytes[at : site.start].decode(), self.changed(site, inner)]
            at = site.end
        return "".join(text) + self.bytes[at:end].decode()

    def part(self, node: Node, sites: list[Site]) -> str:
        return self.within(node.start_byte, node.end_byte, [site for site in sites if node.start_byte <= site.start and site.end <= node.end_byte])

    def changed(self, site: Site, inner: list[Site]) -> str:
        node, numbers = site.node, [number for number, _ in site.changes]
        chosen = lambda with_: "".join(f"if {on(number)} {{ {marked(number, with_(value))} }} else " for number, value in site.changes)
        if site.genre == "FnValue":
            return "".join(f"if {on(number)} {{ {marked(number, f'return {value};')} }} " for number, value in site.changes)
        assert node is not None
        every = ",".join(map(str, numbers))
        if site.genre == "UnaryOperator":
            operand = node.children[-1]
            sign = self.plain(node.children[0])
            body = f"(match ({self.part(operand, inner)}) {{ _v => {chosen(lambda _: '_v')}{{ {sign} _v }} }})"
        elif site.genre == "BinaryOperator":
            left, operator, right = (node.child_by_field_name(name) for name in ("left", "operator", "right"))
            assert left and operator and right
            body = self.binary(chosen, self.part(left, inner), self.plain(left), self.plain(operator), self.part(right, inner), site.changes)
        elif site.genre == "MatchArmGuard":
            body = self.guard(node, inner, site.changes)
        else:
            body = self.without_field(node, inner, site)
        return f"/*<{every}*/{body}/*{every}>*/"

    def binary(self, chosen: Any, left: str, plain_left: str, operator: str, right: str, changes: list[tuple[int, str]]) -> str:
        if operator in ("&&", "||"):
            # The value of the left at which the right is not asked: false for `&&`, true for `||`.
            (number, _), = changes
            ends = on(number) if operator == "&&" else f"!{on(number)}"
            return f"(match {ends} {{ _ends => if ({left}) == _ends {{ _ends }} else {{ {right} }} }})"
        if operator in COMPARISONS:
            return f"(match (&({left}), &({right})) {{ (_l, _r) => {chosen(lambda with_: f'_l {with_} _r')}{{ _l {operator} _r }} }})"
        if operator.endswith("="):
            return f"(match ({right}) {{ _r => {chosen(lambda with_: f'{plain_left} {with_} _r')}{{ {left} {operator} _r }} }})"
        return f"(match ({left}, {right}) {{ (_l, _r) => {chosen(lambda with_: f'_l {with_} _r')}{{ _l {operator} _r }} }})"

    def guard(self, node: Node, inner: list[Site], changes: list[tuple[int, str]]) -> str:
        condition = node.child_by_field_name("condition")
        pattern = self.bytes[node.start_byte : condition.start_byte if condition else node.end_byte].decode().rstrip()
        asked = f"({self.part(condition, inner)})" if condition else "true"
        for number, value in changes:
            if value == "true":
                asked = f"({on(number)} || {asked})"
            else:
                asked = f"(!{on(number)} && {asked})"
        return f"{pattern} {'' if condition else 'if '}{asked}"

    def without_field(self, node: Node, inner: list[Site], site: Site) -> str:
        body = node.child_by_field_name("body")
        assert body is not None
        text = self.part(node, inner)
        for number, name in site.changes:
            fields = [child for child in body.named_children if self.field_name(child) != name]
            less = f"{self.plain(node.child_by_field_name('name'))} {{ {', '.join(self.plain(child) for child in fields)} }}"
            text = f"if {on(number)} {{ {marked(number, less)} }} else {{ {text} }}"
        return f"({text})"

    def field_name(self, child: Node) -> str:
        name = child.child_by_field_name("field") or child
        return self.plain(name)


def field_of(change: dict[str, Any]) -> dict[str, Any]:
    """Names the field that a change takes out of an expression as its replacement."""
    if change["genre"] == "StructField":
        name = re.search(r"delete field (\S+) from", change["name"])
        assert name
        return {**change, "replacement": name[1]}
    return change


MARK = re.compile(rb"/\*(?:<([\d,]+)|([\d,]+)>)\*/")


def refused(text: bytes, start: int, end: int, *, whole: bool = False) -> set[int]:
    """Returns the changes of the innermost marks around a part of a file as it was compiled; without any, or of the whole, those on its lines."""
    opened: list[tuple[int, bytes]] = []
    ranges: list[tuple[int, int, bytes]] = []
    for mark in MARK.finditer(text):
        if mark[1]:
            opened.append((mark.start(), mark[1]))
        else:
            at, numbers = opened.pop()
            ranges.append((at, mark.end(), numbers))
    around = [each for each in ranges if each[0] <= start and end <= each[1]]
    if around and not whole:
        found = [min(around, key=lambda each: each[1] - each[0])[2]]
    else:
        first, last = text.rfind(b"\n", 0, start), text.find(b"\n", end)
        found = [numbers for at, until, numbers in ranges if at < last and first < until]
    return {int(number) for numbers in found for number in numbers.split(b",")}
