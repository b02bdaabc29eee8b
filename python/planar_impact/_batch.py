"""Many collisions at once: columns of NumPy arrays, or tables through the Arrow C stream."""

from __future__ import annotations

import json
import os
import warnings
from collections.abc import Mapping, Sequence
from typing import Any, Literal, Protocol, TypeVar, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._case import Case, names, source, truth, unicode, whole
from ._errors import CaseError, Issue
from ._progress import Progress, reporting


class ArrowTable(Protocol):
    """A table that exports itself as an Arrow C stream, as those of pyarrow, Polars, pandas and DuckDB do."""

    def __arrow_c_stream__(self, requested_schema: Any = None) -> Any: ...


_T = TypeVar("_T", bound=ArrowTable)
_Names = str | Sequence[str] | None


@overload
def solve_batch(
    columns: _T,
    *,
    of: _Names = None,
    wrt: _Names = None,
    case: Case | None = None,
    threads: int | None = None,
    fast: bool = False,
    check: bool = False,
    derivatives: Literal["columns"] = "columns",
    progress: Progress = None,
) -> _T: ...
@overload
def solve_batch(
    columns: Mapping[str, ArrayLike | Sequence[object]],
    *,
    of: _Names = None,
    wrt: _Names = None,
    case: Case | None = None,
    threads: int | None = None,
    fast: bool = False,
    check: bool = False,
    derivatives: Literal["columns", "array"] = "columns",
    progress: Progress = None,
) -> dict[str, NDArray[Any]]: ...
def solve_batch(
    columns: Any,
    *,
    of: _Names = None,
    wrt: _Names = None,
    case: Case | None = None,
    threads: int | None = None,
    fast: bool = False,
    check: bool = False,
    derivatives: Literal["columns", "array"] = "columns",
    progress: Progress = None,
) -> Any:
    """Solve many collisions, a row each. Every row has the bits that :func:`solve` gives it.

    Args:
        columns: Inputs by name, such as ``"vehicle.1.speed"``, in SI, or with a unit in the name: ``"vehicle.1.speed [mph]"``. Either a
            dict of arrays and scalars, which hold in every row, or a table: of pyarrow, Polars, pandas, DuckDB, or any with
            ``__arrow_c_stream__``. Columns of other names pass through, with a ``UserWarning`` where the name may be meant as that of an
            input, such as ``"e"`` or ``"speed"``. A ``UserWarning`` names sizes that no road vehicle has, and rows of which no input has a
            number, by the first such row, except of a stream, and a NaN of pandas, which counts as an empty cell beside a case. Arrays of
            contiguous float64 are read without a copy, and must not be changed until the call returns.
        of: Outputs by name or symbol, a list or separated by commas. Default: all of :func:`solve`.
        wrt: Inputs to differentiate with respect to.
        case: A case that supplies what no column has, and what is ``None`` or null in a row.
        threads: Number of threads. Default: one for each processor. The answer is the same for any number.
        fast: Fuse multiplications and additions where the machine can, which is faster: the last bits then differ between machines.
        check: Whether to check every solved row with the laws of mechanics, in a column ``"check"``.
        derivatives: ``"columns"`` adds a column ``"d energy.loss / d vehicle.1.speed"`` for each output and input; ``"array"``, for a dict,
            adds one array ``"derivatives"`` of shape (rows, outputs, inputs), in the order of the output columns and of ``wrt``.
        progress: A function that is called with the number of steps done and of all steps, a few times a second, or ``True`` for a
            bar of tqdm. What it raises stops the computation. Not for a stream, whose reader sees its progress.

    Returns:
        What was given, with a column for each output in SI, and ``"refusal"``: the codes of why a row is refused, ``None`` where it is
        solved. Outputs of a refused row are NaN in arrays, null in tables. An output whose name an input has too is called
        ``"result."`` and its name. A ``pyarrow.RecordBatchReader`` gives one that solves while it is read: memory does not grow with the
        number of rows.

    Raises:
        CaseError: A column is unknown, missing, of a wrong type or of another length.

    >>> import numpy as np
    >>> import planar_impact
    >>> answer = planar_impact.solve_batch(
    ...     {"vehicle.1.speed [km/h]": np.array([50.0, -50.0])}, of="T_L", case=planar_impact.template("barrier")
    ... )
    >>> answer["energy.loss"] > 0
    array([ True, False])
    >>> answer["refusal"].tolist()
    [None, 'separating']
    >>> answer = planar_impact.solve_batch(
    ...     {"vehicle.1.speed": np.linspace(10, 20, 4)}, of=["T_L", "dV1"], wrt=["v1", "e"], derivatives="array",
    ...     case=planar_impact.template("barrier"),
    ... )
    >>> answer["derivatives"].shape
    (4, 2, 2)
    """
    of, wrt = names(of, "of"), names(wrt, "wrt")
    base = None if case is None else source(case)
    threads, check, fast = _threads(threads), truth(check, "check"), truth(fast, "fast")
    if not isinstance(derivatives, str) or derivatives not in ("columns", "array"):
        raise CaseError._with([Issue("call", "derivatives", f'unknown value {derivatives!r}; accepted: "columns", "array"')])
    if isinstance(columns, Mapping):
        return _solve_arrays(columns, of, wrt, base, threads, check, fast, derivatives == "array", progress)
    if not (hasattr(columns, "__arrow_c_stream__") or hasattr(columns, "__arrow_c_array__")):
        raise TypeError(f"columns are a dict of arrays, or a table with __arrow_c_stream__, not {type(columns).__name__}")
    if derivatives == "array":
        raise CaseError._with([Issue("call", "derivatives", "a table has columns; give a dict of arrays, or leave it out")])
    if _library(columns) == "pyarrow" and type(columns).__name__ == "RecordBatchReader":
        if progress not in (None, False):
            raise CaseError._with([Issue("call", "progress", "a stream has none, its reader sees its progress; leave it out")])
        import pyarrow as pa

        return pa.RecordBatchReader.from_stream(_native.solve_stream(columns, base, of, wrt, check, fast, threads))
    if _library(columns) == "polars" and type(columns).__name__ == "DataFrame":
        import polars as pl

        # It exports nulls without a type, in lists and structs too, with a buffer that those of Arrow do not have.
        typed = {name: _typed(pl, kind) for name, kind in columns.schema.items()}
        columns = columns.cast({name: kind for name, kind in typed.items() if kind != columns.schema[name]})
    if base is not None and _library(columns) == "pandas" and hasattr(columns, "columns"):
        _warn_of_nothing(columns)
    with reporting(progress) as report:
        answer = _native.solve_table(columns, base, of, wrt, check, fast, threads, report)
        return _like(columns, answer, ["check", "refusal"] if check else ["refusal"])


def _warn_of_nothing(frame: Any) -> None:
    """Warn of numbers that are none: pandas has one mark for a cell without a number and for the result of 0/0."""
    # A name that two columns have is refused later.
    for name in frame.columns.drop_duplicates(keep=False):
        if not isinstance(name, str) or not name.startswith(("vehicle.", "contact.")):
            continue
        column = frame[name]
        if not isinstance(column.dtype, np.dtype) or column.dtype.kind != "f":
            continue
        empty = column.isna().to_numpy(dtype=bool)
        if empty.any():
            message = (
                f"{name}: {int(empty.sum())} of {len(frame)} rows have NaN, which pandas takes as an empty cell, and are solved with the number of "
                f"the case (first at row {int(empty.argmax())}); drop those whose number was computed and failed"
            )
            warnings.warn(message, stacklevel=3)


def _typed(pl: Any, kind: Any) -> Any:
    """Return a type of Polars with text where it has nulls alone."""
    if isinstance(kind, pl.List):
        return pl.List(_typed(pl, kind.inner))
    if isinstance(kind, pl.Array):
        return pl.Array(_typed(pl, kind.inner), kind.size)
    if isinstance(kind, pl.Struct):
        return pl.Struct({field.name: _typed(pl, field.dtype) for field in kind.fields})
    return pl.String() if kind == pl.Null else kind


def _threads(threads: int | None) -> int:
    if threads is None:
        available = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
        return available or 1
    return whole(threads, "threads", 1, 1024)


def _solve_arrays(
    columns: Mapping[str, Any],
    of: list[str],
    wrt: list[str],
    base: _native.Source | None,
    threads: int,
    check: bool,
    fast: bool,
    is_array: bool,
    progress: Progress,
) -> dict[str, NDArray[Any]]:
    issues: list[Issue] = []
    arrays: dict[str, NDArray[Any]] = {}
    for name, column in columns.items():
        if not isinstance(name, str):
            raise TypeError(f"the name of a column is a string, not {type(name).__name__}")
        unicode(name, "columns")
        try:
            arrays[name] = _array(column)
        except (TypeError, ValueError, OverflowError) as error:
            issues.append(Issue("wrong-type", name, f"not an array: {error}"))
            continue
        if arrays[name].ndim > 1:
            issues.append(Issue("wrong-type", name, f"expected one dimension, found {arrays[name].ndim}"))
    lengths = {name: len(array) for name, array in arrays.items() if array.ndim == 1}
    rows = next(iter(lengths.values()), 1)
    first = next(iter(lengths), "")
    for name, length in lengths.items():
        if length != rows:
            issues.append(Issue("length", name, f"{length} rows, and {first} has {rows}"))
    if is_array and "derivatives" in arrays:
        issues.append(Issue("repeated-column", "derivatives", "the answer has an array of this name; rename the column"))
    if issues:
        raise CaseError._with(issues)
    plan = _native.Plan(list(arrays), base, of, wrt, check, fast)
    if is_array:
        # Who looks a derivative up by the place of a name must find it there.
        for argument, asked, count in (("of", of, plan.shape[0]), ("wrt", wrt, plan.shape[1])):
            if len(asked) > count:
                issues.append(Issue("call", argument, f"{len(asked)} names of {count}: the array of derivatives has a place for each once"))
        if issues:
            raise CaseError._with(issues)
    inputs = [list(arrays)[place] for place in plan.inputs]
    cells = []
    for name in inputs:
        try:
            cells.append(_cells(arrays[name]))
        except TypeError as error:
            issues.append(Issue("wrong-type", name, str(error)))
    if issues:
        raise CaseError._with(issues)
    with reporting(progress) as report:
        numbers, slopes, checked, refused = plan.solve(rows, cells, threads, is_array, report)
    answer = {name: array if array.ndim == 1 else np.broadcast_to(array, (rows,)) for name, array in arrays.items()}
    words = [_words(rows, found) for found in ([checked, refused] if check else [refused])]
    if is_array:
        answer.update(zip(plan.names[: len(numbers)], numbers))
        answer["derivatives"] = slopes.reshape(rows, *plan.shape)
        answer.update(zip(plan.names[-len(words) :], words))
    else:
        answer.update(zip(plan.names, [*numbers, *words]))
    return answer


def _array(column: Any) -> NDArray[Any]:
    if isinstance(column, np.ma.MaskedArray):
        # What is masked is nothing.
        plain: NDArray[Any] = np.asarray(column.data).astype(object)
        plain[np.ma.getmaskarray(column)] = None
        return plain
    library = _library(column)
    # So are the nulls of others, which a float would make not a number.
    if library == "pandas" and not isinstance(column.dtype, np.dtype) and column.isna().any():
        return np.asarray(column.to_numpy(dtype=object, na_value=None))
    if library == "pyarrow" and getattr(column, "null_count", False):
        return _objects(column.to_pylist())
    if library == "polars" and hasattr(column, "null_count") and column.null_count():
        return _objects(column.to_list())
    array = np.asarray(column)
    # Beside numbers NumPy takes a truth for one.
    if array.dtype.kind in "iuf" and isinstance(column, (list, tuple)) and any(isinstance(item, (bool, np.bool_)) for item in column):
        return _objects(column)
    return array


def _objects(items: Sequence[object]) -> NDArray[Any]:
    array = np.empty(len(items), dtype=object)
    array[:] = items
    return array


def _cells(array: NDArray[Any]) -> object:
    """Return an input as the extension reads it: an array of float64, a list of cells, or one cell in a tuple."""
    if array.dtype.kind in "iuf":
        if array.ndim == 0:
            return (float(array),)
        return np.require(array, dtype=np.float64, requirements=["C", "A"])
    if array.dtype.kind not in "bUTO":
        raise TypeError(f"an input is a number, a bool or text; this column is {array.dtype}")
    item = array.item() if array.ndim == 0 else None
    if not (item is None or isinstance(item, str) or hasattr(item, "__float__")):
        raise TypeError(f"an input is a number, a bool or text, or an array of these, not {type(item).__name__}")
    plain = [_cell(item) for item in array.reshape(-1).tolist()]
    return plain if array.ndim == 1 else (plain[0],)


def _cell(item: Any) -> object:
    if isinstance(item, np.generic):
        item = item.item()
    if item is None or isinstance(item, (bool, str)):
        return item
    if isinstance(item, int):
        try:
            return float(item)
        except OverflowError:
            return float("inf")
    return item


def _words(rows: int, words: list[tuple[int, str]]) -> NDArray[Any]:
    column = np.full(rows, None, dtype=object)
    for row, word in words:
        column[row] = word
    return column


def _library(table: Any) -> str:
    """Return the library of a table or an array, or of what its class is derived from; empty if it is of none of these."""
    libraries = (kind.__module__.partition(".")[0] for kind in type(table).__mro__)
    return next((library for library in libraries if library in ("pyarrow", "polars", "pandas", "duckdb", "_duckdb")), "")


def _like(given: Any, table: _native.Table, words: list[str]) -> Any:
    """Return a table, in which these columns have a word or nothing, as the kind that was given."""
    library = _library(given)
    if library == "pyarrow":
        import pyarrow as pa

        whole = pa.table(table)
        return whole if type(given).__name__ == "Table" else _one_batch(pa, whole)
    if library == "polars":
        import polars as pl

        return pl.DataFrame(table)
    if library == "pandas":
        import pyarrow as pa

        return _to_pandas(pa.table(table), words)
    if library in ("duckdb", "_duckdb"):
        import duckdb
        import pyarrow as pa

        return duckdb.from_arrow(pa.table(table))
    return table


def _to_pandas(table: Any, words: list[str]) -> Any:
    # Its metadata has the index, and the type of the names of the columns that were given, which those of the answer need not have.
    metadata = dict(table.schema.metadata or {})
    if b"pandas" in metadata:
        known = json.loads(metadata[b"pandas"])
        known["column_indexes"] = [index for index in known.get("column_indexes", []) if index.get("pandas_type") == "unicode"]
        table = table.replace_schema_metadata({**metadata, b"pandas": json.dumps(known).encode()})
    frame = table.to_pandas()
    for word in words:
        # Its own type for text has not a number where there is no word.
        frame[word] = frame[word].astype(object).where(frame[word].notna(), None)
    return frame


def _one_batch(pa: Any, table: Any) -> Any:
    batches = table.combine_chunks().to_batches()
    return batches[0] if batches else pa.RecordBatch.from_pylist([], schema=table.schema)
