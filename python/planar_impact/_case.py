"""Cases as Python has them: a path, a text or a dict."""

from __future__ import annotations

import operator
import os
from collections.abc import Mapping, Sequence
from typing import Any, SupportsFloat, SupportsIndex, Union

import numpy as np

from . import _native
from ._errors import CaseError, Issue

#: A case: the path of a file, the text of one in TOML or JSON, or a dict with its keys.
Case = Union[str, "os.PathLike[str]", Mapping[str, Any]]


def source(case: Case) -> _native.Source:
    """Return the source of a case, which is read later."""
    if isinstance(case, Mapping):
        return _native.Source.dict(case)
    if isinstance(case, str):
        return _native.Source.path(case) if _is_path(case) else _native.Source.text(unicode(case, ""))
    if isinstance(case, os.PathLike):
        return _native.Source.path(os.fspath(case))
    raise TypeError(f"a case is a path, a text or a dict, not {type(case).__name__}")


def _is_path(text: str) -> bool:
    # A text that is a case has a key with its value; everything else in one line is meant as a path, which may not exist. A folder may be called `run=3`.
    if "\n" in text or "\0" in text:
        return False
    try:
        os.fsencode(text)
    except UnicodeEncodeError:
        return False
    is_text = text.removeprefix("\ufeff").lstrip().startswith("{") or "=" in text
    return not is_text or text.lower().endswith((".toml", ".json")) or os.path.exists(text)


def unicode(text: str, argument: str) -> str:
    """Return a text of characters alone: a lone surrogate has no bytes."""
    if not isinstance(text, str):
        raise TypeError(f"{argument} is a string, not {type(text).__name__}")
    try:
        text.encode()
    except UnicodeEncodeError:
        code, of = ("call", "text") if argument else ("unreadable-file", "a case file")
        raise CaseError._with([Issue(code, argument, f"a lone surrogate is no character of {of}")]) from None
    return text


def units(value: str | None) -> str | None:
    """Return the name of a system of units."""
    return None if value is None else unicode(value, "units")


def truth(value: bool, argument: str) -> bool:
    """Return a truth; a text is none, of which ``"no"`` would be true."""
    if not isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{argument} is a bool, not {type(value).__name__}")
    return bool(value)


def number(value: SupportsFloat | SupportsIndex, argument: str) -> float:
    """Return a number; one beyond the floats is infinite, which its verb refuses."""
    if isinstance(value, (str, bytes, bytearray, bool, np.bool_)):
        raise TypeError(f"{argument} is a number, not {type(value).__name__}")
    try:
        return float(value)
    except OverflowError:
        return float("inf")
    except TypeError:
        raise TypeError(f"{argument} is a number, not {type(value).__name__}") from None


def whole(value: SupportsIndex, argument: str, least: int = 0, most: int = (1 << 64) - 1) -> int:
    """Return a whole number within limits."""
    if isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{argument} is a whole number, not {type(value).__name__}")
    try:
        count = operator.index(value)
    except TypeError:
        raise TypeError(f"{argument} is a whole number, not {type(value).__name__}") from None
    if not least <= count <= most:
        limit = "2^64 - 1" if most == (1 << 64) - 1 else str(most)
        found = f"{count:.3g}" if abs(count) < 1 << 1000 else "one of more than 300 digits"
        raise CaseError._with([Issue("call", argument, f"expected a whole number from {least} to {limit}, found {found}")])
    return count


def names(value: str | Sequence[str] | None, argument: str) -> list[str]:
    """Return names as a list: one alone, several, or none. Names of quantities in one string are separated by commas, as those of the command line."""
    if value is None:
        return []
    if isinstance(value, str):
        text = unicode(value, argument)
        return [name.strip() for name in text.split(",")] if argument in ("of", "wrt") else [text]
    if isinstance(value, Sequence) and all(isinstance(name, str) for name in value):
        return [unicode(str(name), argument) for name in value]
    raise TypeError(f"{argument} is a string or a sequence of strings, not {type(value).__name__}")
