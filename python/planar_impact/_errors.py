"""Errors: every problem of an input at once."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

_E = TypeVar("_E", bound="Error")


@dataclass(frozen=True)
class Issue:
    """One problem of an input."""

    #: A stable code in kebab case, such as ``unknown-key`` or ``tensile``.
    code: str
    #: The dotted path in the case, vehicles counted from 1, such as ``vehicle.1.mass``, or the argument; may be empty.
    path: str
    #: The value and what is accepted.
    message: str
    #: The line of the file or text, counted from 1; ``None`` for a dict, and where the issue has no place.
    line: int | None = None
    #: A remedy, if there is one.
    help: str | None = None

    def __str__(self) -> str:
        path = f"{self.path}: " if self.path else ""
        help = f" ({self.help})" if self.help else ""
        return f"{path}{self.message}{help}"


class Error(ValueError):
    """A case that has no answer. :attr:`issues` has every reason.

    >>> import planar_impact
    >>> try:
    ...     planar_impact.solve({"schema": 1})
    ... except planar_impact.Error as error:
    ...     print(error.issues[0].code)
    missing-key
    """

    #: Every problem, in the order of the file.
    issues: tuple[Issue, ...]

    def __init__(self, message: str = "", issues: Sequence[Issue] = ()) -> None:
        super().__init__(message)
        self.issues = tuple(issues)

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (str(self), self.issues)

    @classmethod
    def _of(cls: type[_E], source: str, entries: Sequence[tuple[str, str, str, str | None, int | None]]) -> _E:
        issues = [Issue(code, path, message, line, help) for code, path, message, help, line in entries]
        return cls._with(issues, source)

    @classmethod
    def _with(cls: type[_E], issues: Sequence[Issue], source: str = "") -> _E:
        def place(issue: Issue) -> str:
            return "" if issue.line is None else f"{source}:{issue.line}: " if source else f"line {issue.line}: "

        return cls("\n".join(f"{place(issue)}{issue}" for issue in issues), issues)


class CaseError(Error):
    """The case or the call is wrong."""


class PhysicsError(Error):
    """The physics refuses the case, such as vehicles that move apart, or a search does not converge."""
