"""Planar impact mechanics, crush energy and reconstruction of vehicle collisions.

Every function takes a case: the path of a file, the text of one, or a dict. Answers are in SI and radians, and equal the JSON of the
command line.

>>> import planar_impact
>>> answer = planar_impact.solve(planar_impact.template("barrier"))
>>> sorted(answer)
['contact', 'energy', 'schema', 'title', 'vehicles']
"""

from . import answers
from ._answer import Answer, Facts
from ._batch import ArrowTable, solve_batch
from ._case import Case
from ._errors import CaseError, Error, Issue, PhysicsError
from ._native import Table, __version__
from ._progress import Progress
from ._verbs import (
    Range,
    Units,
    check,
    crash3,
    crush,
    draw,
    formula,
    gradient,
    reconstruct,
    record,
    report,
    slide,
    solve,
    stiffness,
    sweep,
    template,
    uncertainty,
)

__all__ = [
    "Answer",
    "ArrowTable",
    "Case",
    "CaseError",
    "Error",
    "Facts",
    "Issue",
    "PhysicsError",
    "Progress",
    "Range",
    "Table",
    "Units",
    "__version__",
    "answers",
    "check",
    "crash3",
    "crush",
    "draw",
    "formula",
    "gradient",
    "reconstruct",
    "record",
    "report",
    "slide",
    "solve",
    "solve_batch",
    "stiffness",
    "sweep",
    "template",
    "uncertainty",
]
