"""Answers: the facts of a verb as Python has them."""

from __future__ import annotations

import html
import json
from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar

from . import _native

_V = TypeVar("_V", covariant=True)


class Facts(Mapping[str, _V]):
    """Part of an answer: a mapping whose keys are attributes too. Numbers are in SI and radians.

    A key that is no identifier, or that is a method of a mapping, is read with brackets: ``answer.of["energy.loss"]``.
    """

    __slots__ = ("_facts", "_part")
    #: What makes facts of the objects under a key.
    _parts: ClassVar[dict[str, _Part]] = {}
    _facts: dict[str, Any]
    _part: _Part | None

    def __init__(self, facts: dict[str, Any], part: _Part | None = None) -> None:
        object.__setattr__(self, "_facts", facts)
        object.__setattr__(self, "_part", part)

    def __getitem__(self, key: str) -> _V:
        value: _V = _wrapped(self._facts[key], self._part or self._parts.get(key, Facts))
        return value

    def __iter__(self) -> Iterator[str]:
        return iter(self._facts)

    def __len__(self) -> int:
        return len(self._facts)

    # Type checkers know the attributes of each answer.
    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            # Copies and notebooks ask for private names, some before there are facts.
            if name.startswith("_"):
                raise AttributeError(name)
            if name in self._facts:
                return self[name]
            hint = type(self).__annotations__.get(name)
            if hint is not None:
                return [] if hint.startswith("list") else None
            raise AttributeError(f"no {name!r} here; there are {', '.join(self._facts)}")

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError("an answer cannot be changed")

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *(key for key in self._facts if key.isidentifier())]

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self._facts!r})"

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self._facts, self._part)

    def to_dict(self) -> dict[str, Any]:
        """Return the facts as plain dicts, lists, numbers and strings, which the caller may change."""
        copy: dict[str, Any] = json.loads(json.dumps(self._facts))
        return copy


_Part = Callable[[dict[str, Any]], Facts[Any]]


class Answer(Facts[Any]):
    """The answer of a verb, in SI and radians.

    ``str(answer)`` is the page that the command line prints, in the units of the case or those given as ``units``.

    >>> import planar_impact
    >>> answer = planar_impact.solve(planar_impact.template("barrier"))
    >>> answer.vehicles[0].delta_v_magnitude == answer["vehicles"][0]["delta_v_magnitude"]
    True
    """

    __slots__ = ("_native", "_read", "_units")
    _native: _Rendered
    _read: dict[str, Any] | None
    _units: str | None

    def __init__(self, native: _Rendered, units: str | None = None) -> None:
        object.__setattr__(self, "_native", native)
        object.__setattr__(self, "_part", None)
        object.__setattr__(self, "_read", None)
        object.__setattr__(self, "_units", units)

    @property
    def _facts(self) -> dict[str, Any]:  # type: ignore[override]
        # Most of the time of a single collision is that of writing and reading its JSON: only if someone looks at it.
        read = self._read
        if read is None:
            read = self.to_dict()
            object.__setattr__(self, "_read", read)
        return read

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

    @property
    def figures(self) -> list[str]:
        """The names of the figures of :meth:`to_svg`."""
        return list(self._native.figures)

    def to_svg(self, figure: str | None = None, *, units: str | None = None) -> str | None:
        """Return a figure, or the first: the scene of a collision, the chart of other verbs. ``None`` if there is nothing to draw.

        >>> import planar_impact
        >>> planar_impact.solve(planar_impact.template("t-bone")).figures
        ['scene', 'impulse', 'energy']
        """
        return self._native.drawing(figure, units if units is not None else self._units)

    def __repr__(self) -> str:
        return self.to_text()

    __str__ = __repr__

    def _repr_html_(self) -> str:
        return f"{self._drawn(None) or ''}<pre>{html.escape(self.to_text())}</pre>"

    def _drawn(self, figure: str | None) -> str | None:
        try:
            return self.to_svg(figure)
        except ValueError:
            # Nothing to draw: the page says everything.
            return None

    def __reduce__(self) -> tuple[Any, ...]:
        figures = {figure: self._drawn(figure) for figure in self.figures}
        return type(self), (_Stored(self.to_json(), self.to_text(), figures), self._units)


class _Stored:
    """An answer from another process, with its page and figures as they were."""

    def __init__(self, json: str, page: str, figures: dict[str, str | None]) -> None:
        self.json = json
        self.figures = figures
        self._page = page

    def page(self, units: str | None = None) -> str:
        return self._page

    def drawing(self, figure: str | None = None, units: str | None = None) -> str | None:
        return next(iter(self.figures.values()), None) if figure is None else self.figures[figure]


_Rendered = _native.Answer | _Stored


def _wrapped(value: Any, part: _Part) -> Any:
    if isinstance(value, dict):
        return part(value)
    if isinstance(value, list) and any(isinstance(item, (dict, list)) for item in value):
        return [_wrapped(item, part) for item in value]
    return list(value) if isinstance(value, list) else value
