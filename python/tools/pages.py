#!/usr/bin/env python3
"""Bring the programs that the pages in `docs/` show up to date: a block of Python after `<!-- programs/NAME.py -->` is that file.

    python/tools/pages.py
"""

from __future__ import annotations

import re
from pathlib import Path

DOCS = Path(__file__).resolve().parents[1] / "docs"
BLOCK = re.compile(r"<!-- (programs/\w+\.py) -->\n```python\n.*?```\n", re.DOTALL)


def current(page: Path) -> str:
    """Return the text that a page should have."""

    def shown(block: re.Match[str]) -> str:
        program = (DOCS / block[1]).read_text(encoding="utf-8")
        return f"<!-- {block[1]} -->\n```python\n{program}```\n"

    return BLOCK.sub(shown, page.read_text(encoding="utf-8"))


if __name__ == "__main__":
    for page in DOCS.glob("*.md"):
        page.write_text(current(page), encoding="utf-8")
