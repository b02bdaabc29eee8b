"""Progress of a long call: a function, or a bar of tqdm."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, Union

#: A function of the steps done and of all steps; ``True`` for a bar of tqdm; ``None`` or ``False`` for no reports.
Progress = Union[Callable[[int, int], object], bool, None]


@contextmanager
def reporting(progress: Progress) -> Iterator[Callable[[int, int], object] | None]:
    """Give the function that is called during the block."""
    if progress is None or progress is False:
        yield None
    elif progress is True:
        from tqdm.auto import tqdm

        with tqdm(unit="step") as bar:
            yield lambda done, total: _advance(bar, done, total)
    elif callable(progress):
        yield progress
    else:
        raise TypeError(f"progress is a function of two numbers, True or None, not {type(progress).__name__}")


def _advance(bar: Any, done: int, total: int) -> None:
    # A verb with several searches begins anew, each with its own total.
    bar.total = total
    bar.n = done
    bar.refresh()
