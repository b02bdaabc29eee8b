"""Cases as Python has them: a path, a text or a dict."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Mapping, Sequence
from typing import Any, Union

from . import _native
from ._errors import CaseError, Issue

#: A case: the path of a file, the text of one in TOML or JSON, or a dict with its keys.
Case = Union[str, "os.PathLike[str]", Mapping[str, Any]]

#: The deepest structure of a case; a case file has about six levels.
_DEEPEST = 64


def source(case: Case) -> _native.Source:
    """Return the source of a case, which is read later."""
    if isinstance(case, Mapping):
        return _native.Source.dict(_dumps(case))
    if isinstance(case, str):
        return _native.Source.path(case) if _is_path(case) else _native.Source.text(_unicode(case))
    if isinstance(case, os.PathLike):
        return _native.Source.path(os.fspath(case))
    raise TypeError(f"a case is a path, a text or a dict, not {type(case).__name__}")


def _is_path(text: str) -> bool:
    # A text that is a case has a key with its value; everything else in one line is meant as a path, which may not exist.
    if "\n" in text or text.lstrip().startswith("{") or "\0" in text:
        return False
    return "=" not in text or os.path.exists(text)


def _dumps(case: Mapping[str, Any]) -> str:
    issues: list[Issue] = []
    plain = _plain(case, "", issues, 0)
    if issues:
        raise CaseError._with(issues[:1000])
    return _unicode(json.dumps(plain, ensure_ascii=False, allow_nan=False))


def _unicode(text: str) -> str:
    try:
        text.encode()
    except UnicodeEncodeError:
        raise CaseError._with([Issue("unreadable-file", "", "a lone surrogate is no character of a case file")]) from None
    return text


def _plain(value: Any, path: str, issues: list[Issue], depth: int) -> Any:
    """Return a value as JSON has it, and report what JSON does not have."""

    def wrong(message: str) -> None:
        issues.append(Issue("wrong-type", path, message))

    if depth > _DEEPEST:
        return wrong(f"nested more than {_DEEPEST} levels deep")
    if value is None or isinstance(value, (bool, str)):
        return str(value) if isinstance(value, str) else value
    if isinstance(value, Mapping):
        inner = {}
        for key, item in value.items():
            if isinstance(key, str):
                inner[str(key)] = _plain(item, f"{path}.{key}" if path else key, issues, depth + 1)
            else:
                wrong(f"a key is a string; found {key!r:.60}")
        return inner
    # NumPy's scalars and arrays become numbers and lists.
    tolist = getattr(value, "tolist", None)
    if callable(tolist) and not isinstance(value, (list, tuple)):
        value = tolist()
    if isinstance(value, (bool, str)):
        return value
    if isinstance(value, (int, float)):
        try:
            number = float(value)
        except OverflowError:
            number = math.inf
        if math.isfinite(number):
            return int(value) if isinstance(value, int) else number
        return wrong(f"expected a finite number, found {number}")
    if isinstance(value, Sequence) and not isinstance(value, (bytes, bytearray, memoryview)):
        return [_plain(item, f"{path}.{i}" if path else str(i), issues, depth + 1) for i, item in enumerate(value, 1)]
    return wrong(f"expected a number, a string, a bool, a list or a dict, found {type(value).__name__}")


def names(value: str | Sequence[str] | None, argument: str) -> list[str]:
    """Return names as a list: one alone, several, or none."""
    if value is None:
        return []
    if isinstance(value, str):
        return [value]
    if isinstance(value, Sequence) and all(isinstance(name, str) for name in value):
        return [str(name) for name in value]
    raise TypeError(f"{argument} is a string or a sequence of strings, not {type(value).__name__}")
