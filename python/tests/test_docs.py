"""Examples in docstrings and in the guide run; public names are documented and typed."""

from __future__ import annotations

import doctest
import importlib
import inspect
import pkgutil
import re
from pathlib import Path

import pytest
from test_answers import PACKAGE, tool

import planar_impact

MODULES = ["planar_impact", *(f"planar_impact.{module.name}" for module in pkgutil.iter_modules(planar_impact.__path__))]


@pytest.mark.parametrize("name", MODULES)
def test_docstrings(name: str) -> None:
    assert doctest.testmod(importlib.import_module(name)).failed == 0


def test_the_guide(monkeypatch: pytest.MonkeyPatch) -> None:
    guide = Path(__file__).resolve().parents[1] / "README.md"
    monkeypatch.chdir(guide.parent)
    result = doctest.testfile(str(guide), module_relative=False)
    assert result.attempted > 5 and result.failed == 0


def test_the_pages_show_their_programs() -> None:
    pages = tool("pages")
    shown = [page for page in sorted(pages.DOCS.glob("*.md")) if pages.BLOCK.search(page.read_text(encoding="utf-8"))]
    assert len(shown) >= 8
    for page in shown:
        assert page.read_text(encoding="utf-8") == pages.current(page), f"{page.name}: python/tools/pages.py"
    programs = {path.name for path in (pages.DOCS / "programs").glob("*_program.py")}
    assert programs == {Path(name).name for page in shown for name in pages.BLOCK.findall(page.read_text(encoding="utf-8"))}


def test_links_of_the_pages() -> None:
    for page in [PACKAGE / "README.md", *(PACKAGE / "docs").glob("*.md")]:
        for link in re.findall(r"\]\((?!http)([^)#]+)", page.read_text(encoding="utf-8")):
            assert (page.parent / link).exists(), f"{page.name}: {link}"


def test_public_names_are_documented_and_keyword_only() -> None:
    for name in planar_impact.__all__:
        public = getattr(planar_impact, name)
        if inspect.isfunction(public):
            assert public.__doc__ and "return" in public.__annotations__, name
            parameters = list(inspect.signature(public).parameters.values())
            assert all(parameter.kind is parameter.KEYWORD_ONLY for parameter in parameters[1:]), name


def test_the_types_are_installed() -> None:
    assert (Path(planar_impact.__file__).parent / "py.typed").exists()
