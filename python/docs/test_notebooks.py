"""The notebooks run, and show what they showed."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

NOTEBOOKS = sorted((Path(__file__).parent / "notebooks").glob("*.ipynb"))


def shown(notebook: Any) -> list[str]:
    """Return the text of every output, but for pictures and the addresses of objects."""
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    texts = [output.get("text") or output.get("data", {}).get("text/plain", "") for output in outputs]
    return [text for text in texts if " at 0x" not in text]


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_shows_what_it_showed(path: Path) -> None:
    nbformat = pytest.importorskip("nbformat")
    client = pytest.importorskip("nbclient")
    stored, notebook = nbformat.read(path, as_version=4), nbformat.read(path, as_version=4)
    nbformat.validate(stored)
    client.NotebookClient(notebook, timeout=300, resources={"metadata": {"path": str(path.parent)}}).execute()
    assert shown(notebook) == shown(stored) != []
    pictures = [output for cell in notebook.cells for output in cell.get("outputs", []) if "svg" in str(output.get("data")) or "image/png" in output.get("data", {})]
    assert pictures, "a notebook has a picture"
