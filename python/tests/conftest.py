"""Cases of the repository, and the program to compare with."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "cli" / "examples"
REFERENCE = ROOT / "cli" / "tests" / "reference"


def reference(name: str) -> list[dict[str, Any]]:
    """Return the reference answers of a file."""
    return [json.loads(line) for line in (REFERENCE / f"{name}.jsonl").read_text(encoding="utf-8").splitlines()]


@pytest.fixture(scope="session")
def program() -> str:
    """Return the path of the command line, which the variable PLANAR_IMPACT names."""
    path = os.environ.get("PLANAR_IMPACT")
    if not path:
        pytest.skip("PLANAR_IMPACT does not name the command line")
    return path
