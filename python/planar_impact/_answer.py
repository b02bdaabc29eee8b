"""Answers: the facts of a verb as Python has them."""

from __future__ import annotations

import html
import json
from collections.abc import Iterator, Mapping
from typing import Any

from . import _native


class Facts(Mapping[str, Any]):
    """Part of an answer: a mapping whose keys are attributes too. Numbers are in SI and radians.

    A key that is no identifier, or that is a method of a mapping, is read with brackets: ``answer.of["energy.loss"]``.
    """

    __slots__ = ("_facts",)
    _facts: dict[str, Any]

    def __init__(self, facts: dict[str, Any]) -> None:
        object.__setattr__(self, "_facts", facts)

    def __getitem__(self, key: str) -> Any:
        return _wrapped(self._facts[key])

    def __iter__(self) -> Iterator[str]:
        return iter(self._facts)

    def __len__(self) -> int:
        return len(self._facts)

    def __getattr__(self, name: str) -> Any:
        # Copies and notebooks ask for private names, some before there are facts.
        if name.startswith("_"):
            raise AttributeError(name)
        if name in self._facts:
            return self[name]
        raise AttributeError(f"no {name!r} here; there are {', '.join(self._facts)}")

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError("an answer cannot be changed")

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *(key for key in self._facts if key.isidentifier())]

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self._facts!r})"

    def __reduce__(self) -> tuple[Any, ...]:
        return Facts, (self._facts,)

    def to_dict(self) -> dict[str, Any]:
        """Return the facts as plain dicts, lists, numbers and strings, which the caller may change."""
        copy: dict[str, Any] = json.loads(json.dumps(self._facts))
        return copy


class Answer(Facts):
    """The answer of a verb, in SI and radians.

    ``str(answer)`` is the page that the command line prints, in the units of the case or those given as ``units``.

    >>> import planar_impact
    >>> answer = planar_impact.solve(planar_impact.template("barrier"))
    >>> answer.vehicles[0].delta_v_magnitude == answer["vehicles"][0]["delta_v_magnitude"]
    True
    """

    __slots__ = ("_native", "_units")
    _native: _Rendered
    _units: str | None

    def __init__(self, native: _Rendered, units: str | None = None) -> None:
        super().__init__(json.loads(native.json))
        object.__setattr__(self, "_native", native)
        object.__setattr__(self, "_units", units)

    def to_dict(self) -> dict[str, Any]:
        """Return the JSON of the command line as a dict."""
        facts: dict[str, Any] = json.loads(self._native.json)
        return facts

    def to_json(self) -> str:
        """Return the JSON of the command line, byte for byte."""
        return self._native.json

    def to_text(self, *, units: str | None = None) -> str:
        """Return the page that the command line prints, in a system of units: ``us``, ``si`` or ``uk``."""
        return self._native.page(units if units is not None else self._units)

    def to_svg(self, *, units: str | None = None) -> str | None:
        """Return the drawing of the scene; ``None`` if the verb has none."""
        return self._native.drawing(units if units is not None else self._units)

    def __repr__(self) -> str:
        return self.to_text()

    __str__ = __repr__

    def _repr_html_(self) -> str:
        try:
            drawing = self.to_svg() or ""
        except ValueError:
            # Nothing to draw: the page says everything.
            drawing = ""
        return f"{drawing}<pre>{html.escape(self.to_text())}</pre>"

    def __reduce__(self) -> tuple[Any, ...]:
        try:
            drawing = self.to_svg()
        except ValueError:
            drawing = None
        return Answer, (_Stored(self.to_json(), self.to_text(), drawing), self._units)


class _Stored:
    """An answer from another process, with its page as it was."""

    def __init__(self, json: str, page: str, drawing: str | None) -> None:
        self.json = json
        self._page = page
        self._drawing = drawing

    def page(self, units: str | None = None) -> str:
        return self._page

    def drawing(self, units: str | None = None) -> str | None:
        return self._drawing


_Rendered = _native.Answer | _Stored


def _wrapped(value: Any) -> Any:
    if isinstance(value, dict):
        return Facts(value)
    if isinstance(value, list) and any(isinstance(item, (dict, list)) for item in value):
        return [_wrapped(item) for item in value]
    return list(value) if isinstance(value, list) else value
