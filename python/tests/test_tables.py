"""Tables through the Arrow C stream: the same numbers as arrays, and the kind that was given."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from test_batch import BARRIER, random_columns

import planar_impact
from planar_impact import CaseError

pa = pytest.importorskip("pyarrow")


@pytest.fixture(scope="module")
def columns() -> dict[str, Any]:
    return random_columns(70_000)


@pytest.fixture(scope="module")
def expected(columns: dict[str, Any]) -> dict[str, Any]:
    return planar_impact.solve_batch(columns, of=["T_L", "dV1"], wrt="e")


def same(table: Any, expected: dict[str, Any]) -> None:
    """Compare a table of pyarrow with arrays."""
    assert table.column_names == list(expected)
    assert table["refusal"].to_pylist() == expected["refusal"].tolist()
    for name, column in expected.items():
        if name != "refusal":
            np.testing.assert_array_equal(table[name].to_numpy(), column)
            assert table[name].null_count == np.isnan(column).sum()


def test_pyarrow(columns: dict[str, Any], expected: dict[str, Any]) -> None:
    table = pa.table(columns)
    answer = planar_impact.solve_batch(table, of=["T_L", "dV1"], wrt="e")
    assert isinstance(answer, pa.Table) and answer.schema.field("energy.loss").metadata == {b"unit": b"J"}
    same(answer, expected)
    batch = planar_impact.solve_batch(table.to_batches()[0], of=["T_L", "dV1"], wrt="e")
    assert isinstance(batch, pa.RecordBatch)
    same(pa.table(batch), expected)
    reader = planar_impact.solve_batch(table.to_reader(max_chunksize=1000), of=["T_L", "dV1"], wrt="e")
    assert isinstance(reader, pa.RecordBatchReader)
    same(reader.read_all(), expected)


def test_polars(columns: dict[str, Any], expected: dict[str, Any]) -> None:
    pl = pytest.importorskip("polars")
    answer = planar_impact.solve_batch(pl.DataFrame(columns), of=["T_L", "dV1"], wrt="e", threads=3)
    assert isinstance(answer, pl.DataFrame)
    same(answer.to_arrow(), expected)


def test_pandas(columns: dict[str, Any], expected: dict[str, Any]) -> None:
    pd = pytest.importorskip("pandas")
    frame = pd.DataFrame(columns, index=[f"row {i}" for i in range(70_000)])
    answer = planar_impact.solve_batch(frame, of=["T_L", "dV1"], wrt="e")
    assert isinstance(answer, pd.DataFrame) and answer.index.equals(frame.index)
    assert list(answer.columns) == list(expected)
    np.testing.assert_array_equal(answer["energy.loss"].to_numpy(), expected["energy.loss"])
    assert answer["refusal"].tolist() == list(expected["refusal"]) and None in answer["refusal"].tolist()
    checked = planar_impact.solve_batch(frame[:3], of="T_L", check=True)
    assert checked["check"].tolist() == [None] * 3


def test_duckdb(columns: dict[str, Any], expected: dict[str, Any]) -> None:
    duckdb = pytest.importorskip("duckdb")
    answer = planar_impact.solve_batch(duckdb.from_arrow(pa.table(columns)), of=["T_L", "dV1"], wrt="e")
    assert isinstance(answer, duckdb.DuckDBPyRelation)
    loss = duckdb.sql('SELECT sum("energy.loss") FROM answer').fetchall()[0][0]
    assert loss == pytest.approx(np.nansum(expected["energy.loss"]), rel=1e-12)


class Other:
    """A table of a library that is not known."""

    def __init__(self, table: Any) -> None:
        self.table = table

    def __arrow_c_stream__(self, requested_schema: Any = None) -> Any:
        return self.table.__arrow_c_stream__(requested_schema)


def test_any_other_library(columns: dict[str, Any], expected: dict[str, Any]) -> None:
    answer = planar_impact.solve_batch(Other(pa.table(columns)), of=["T_L", "dV1"], wrt="e")
    assert isinstance(answer, planar_impact.Table) and len(answer) == answer.num_rows == 70_000
    assert answer.column_names == list(expected)
    for _ in range(2):
        same(pa.table(answer), expected)


@pytest.mark.filterwarnings("ignore:no input of the row has a number")
def test_text_units_nulls_and_other_columns() -> None:
    table = pa.table({"site": ["a", "b", None], "vehicle.1.speed [km/h]": ["54", None, "fast"]})
    answer = planar_impact.solve_batch(table, of="T_L", case=BARRIER, check=True)
    assert answer["refusal"].to_pylist() == [None, None, "unreadable"]
    assert answer["site"].to_pylist() == ["a", "b", None]
    assert answer["vehicle.1.speed [km/h]"].to_pylist() == ["54", None, "fast"]
    assert answer["energy.loss"][2].as_py() is None and answer["check"].to_pylist() == [None] * 3


def test_no_rows() -> None:
    empty = pa.table({"vehicle.1.speed": pa.array([], pa.float64())})
    assert planar_impact.solve_batch(empty, of="T_L", case=BARRIER).num_rows == 0
    none = pa.table({"vehicle.1.speed": pa.chunked_array([], pa.float64())})
    assert planar_impact.solve_batch(none, of="T_L", case=BARRIER).num_rows == 0


@pytest.mark.parametrize(
    ("table", "code"),
    [
        (pa.table({"vehicle.1.speed": [b"12"]}), "wrong-type"),
        (pa.table({"vehicle.1.speed": [[12.0]]}), "wrong-type"),
        (pa.table({"vehicle.1.sped": [12.0]}), "unknown-column"),
        (pa.table([[1.0], [2.0]], names=["vehicle.1.speed", "vehicle.1.speed"]), "repeated-column"),
        (pa.table({"vehicle.1.speed": [1.0], "refusal": [1.0]}), "repeated-column"),
    ],
)
def test_wrong_tables(table: Any, code: str) -> None:
    with pytest.raises(CaseError) as caught:
        planar_impact.solve_batch(table, of="T_L", case=BARRIER)
    assert code in [issue.code for issue in caught.value.issues]


def test_a_stream_is_solved_while_it_is_read() -> None:
    drawn: list[int] = []

    def batches() -> Any:
        for i in range(1000):
            drawn.append(i)
            yield pa.record_batch({"row": [i] * 1000, "vehicle.1.speed": np.linspace(10, 20, 1000)})

    schema = pa.schema({"row": pa.int64(), "vehicle.1.speed": pa.float64()})
    reader = pa.RecordBatchReader.from_batches(schema, batches())
    answer = planar_impact.solve_batch(reader, of="T_L", case=BARRIER, threads=2)
    assert drawn == [] and answer.schema.names == ["row", "vehicle.1.speed", "energy.loss", "refusal"]
    first = answer.read_next_batch()
    # Some record batches for each thread, and not the whole stream.
    assert 0 < len(drawn) <= 16 and first["row"].to_pylist() == [0] * 1000
    rest = answer.read_all()
    assert len(drawn) == 1000 and rest["row"].to_numpy().tolist() == np.repeat(range(1, 1000), 1000).tolist()
    assert rest["energy.loss"].to_numpy()[:1000].tolist() == first["energy.loss"].to_pylist()


def test_a_stream_of_large_batches_is_cut() -> None:
    speeds = np.linspace(10, 20, 500_000)
    table = pa.table({"vehicle.1.speed": speeds})
    answer = planar_impact.solve_batch(table.to_reader(), of="T_L", case=BARRIER, threads=1)
    sizes = [batch.num_rows for batch in answer]
    assert sum(sizes) == 500_000 and max(sizes) < 20_000
    whole = planar_impact.solve_batch(table, of="T_L", case=BARRIER)
    again = planar_impact.solve_batch(table.to_reader(), of="T_L", case=BARRIER, threads=3).read_all()
    assert again["energy.loss"].to_numpy().tolist() == whole["energy.loss"].to_numpy().tolist()


def test_what_a_stream_and_a_table_refuse() -> None:
    table = pa.table({"vehicle.1.sped": [12.0]})
    with pytest.raises(CaseError, match="sped"):
        planar_impact.solve_batch(table.to_reader(), of="T_L", case=BARRIER)
    good = pa.table({"vehicle.1.speed": [12.0]})
    with pytest.raises(CaseError, match="a table has columns"):
        planar_impact.solve_batch(good, case=BARRIER, derivatives="array")
    reader = good.to_reader()
    reader.read_all()
    assert planar_impact.solve_batch(reader, of="T_L", case=BARRIER).read_all().num_rows == 0


def test_a_stream_that_fails() -> None:
    class Broken:
        def __arrow_c_stream__(self, requested_schema: Any = None) -> Any:
            return "no capsule"

    def batches() -> Any:
        yield pa.record_batch({"vehicle.1.speed": [12.0]})
        raise OSError("the disk is gone")

    with pytest.raises((TypeError, ValueError)):
        planar_impact.solve_batch(Broken(), case=BARRIER)
    reader = pa.RecordBatchReader.from_batches(pa.schema({"vehicle.1.speed": pa.float64()}), batches())
    answer = planar_impact.solve_batch(reader, case=BARRIER, threads=1)
    # What was read before the failure is answered.
    assert answer.read_next_batch().num_rows == 1
    with pytest.raises((OSError, ValueError), match="the disk is gone"):
        answer.read_next_batch()
    reader = pa.RecordBatchReader.from_batches(pa.schema({"vehicle.1.speed": pa.float64()}), batches())
    with pytest.raises(ValueError, match="the disk is gone"):
        planar_impact.solve_batch(Other(reader), case=BARRIER)


def test_columns_without_a_type_and_tables_without_columns() -> None:
    polars = pytest.importorskip("polars")
    solved = planar_impact.solve_batch(polars.DataFrame({"vehicle.1.speed": [12.0], "remark": [None]}), case=BARRIER, of="dV1")
    assert solved["remark"].to_list() == [None] and solved["vehicle.1.delta_v_magnitude"][0] > 10
    nested = polars.DataFrame({"vehicle.1.speed": [12.0, 13.0], "tags": [[], [None]], "by": [{"a": None}, {"a": None}]})
    assert planar_impact.solve_batch(nested, case=BARRIER, of="dV1")["tags"].to_list() == [[], [None]]
    pandas = pytest.importorskip("pandas")
    for names in (["site", "note"], []):
        given = pandas.DataFrame([[1, 2]], columns=names) if names else pandas.DataFrame()
        given["vehicle.1.speed"] = [12.0]
        found = planar_impact.solve_batch(given, case=BARRIER, of="dV1")
        assert [str(name) for name in found.columns][: len(names)] == [str(name) for name in names]
        assert found["vehicle.1.delta_v_magnitude"][0] > 10
    assert len(planar_impact.solve_batch(pandas.DataFrame(), case=BARRIER, of="dV1")) == 0


@pytest.mark.filterwarnings("ignore:no input of the row has a number")
def test_a_class_of_ones_own_is_that_of_its_library() -> None:
    pandas = pytest.importorskip("pandas")

    class Frame(pandas.DataFrame):  # type: ignore[misc, name-defined]
        pass

    class Series(pandas.Series):  # type: ignore[misc, name-defined]
        pass

    answer = planar_impact.solve_batch(Frame({"vehicle.1.speed": [12.0, 13.0]}, index=["a", "b"]), case=BARRIER, of="dV1")
    assert isinstance(answer, pandas.DataFrame) and list(answer.index) == ["a", "b"]
    column = Series([12.0, None], dtype="Float64")
    assert planar_impact.solve_batch({"vehicle.1.speed": column}, case=BARRIER, of="dV1")["refusal"].tolist() == [None, None]


@pytest.mark.filterwarnings("ignore:no input of the row has a number")
def test_the_nulls_of_arrays_are_those_of_the_case() -> None:
    polars = pytest.importorskip("polars")
    columns = [pa.array([12.0, None]), pa.array([12, None]), pa.chunked_array([[12.0], [None]]), polars.Series([12.0, None]), polars.Series([12, None])]
    own = planar_impact.solve(BARRIER).vehicles[0].delta_v_magnitude
    for column in columns:
        answer = planar_impact.solve_batch({"vehicle.1.speed": column}, case=BARRIER, of="dV1")
        assert answer["refusal"].tolist() == [None, None] and answer["vehicle.1.delta_v_magnitude"][1] == own


def test_text_that_is_none_is_refused() -> None:
    """Of an array in another encoding pyarrow says that it is text, unchecked."""
    broken = pa.array([b"14", b"\xe4"], pa.binary()).view(pa.string())
    large = pa.array([b"14", b"\xe4"], pa.large_binary()).view(pa.large_string())
    for column in (broken, large, broken.dictionary_encode()):
        for name in ("vehicle.1.speed", "contact.tangential_law"):
            with pytest.raises(CaseError, match="(?i)utf"):
                planar_impact.solve_batch(pa.table({name: column}), case=BARRIER, of="dV1")
    stream = pa.RecordBatchReader.from_batches(pa.schema({"vehicle.1.speed": pa.string()}), [pa.record_batch({"vehicle.1.speed": broken})])
    with pytest.raises((ValueError, OSError), match="(?i)utf"):
        planar_impact.solve_batch(stream, case=BARRIER, of="dV1").read_all()


@pytest.mark.filterwarnings("ignore:no input of the row has a number")
@pytest.mark.parametrize("kind", ["Int64", "Float64", "object"])
def test_what_pandas_has_as_nothing_is_that_of_the_case(kind: str) -> None:
    pandas = pytest.importorskip("pandas")
    answer = planar_impact.solve_batch({"vehicle.1.speed": pandas.Series([10, None, 13], dtype=kind)}, case=BARRIER, of="dV1")
    assert answer["vehicle.1.speed"].tolist() == [10, None, 13]
    own = planar_impact.solve(BARRIER).vehicles[0].delta_v_magnitude
    assert answer["vehicle.1.delta_v_magnitude"][1] == own and answer["refusal"].tolist() == [None] * 3


def test_a_number_that_pandas_lost_is_warned_of() -> None:
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame({"vehicle.1.speed": [10.0, float("nan"), 13.0, float("nan")], "contact.restitution": 0.1, "site": [1.0, None, 2.0, 3.0]})
    with pytest.warns(UserWarning) as told:
        answer = planar_impact.solve_batch(frame, case=BARRIER, of="dV1")
    assert [str(one.message).split(",")[0] for one in told] == ["vehicle.1.speed: 2 of 4 rows have NaN"]
    assert "(first at row 1)" in str(told[0].message) and told[0].filename == __file__
    assert answer["refusal"].tolist() == [None] * 4
    # Without a case nothing gives the number, and with NumPy it is none.
    assert planar_impact.solve_batch(dict(frame), case=BARRIER, of="dV1")["refusal"].tolist()[1] == "not-finite"


def test_a_stream_reports_no_progress() -> None:
    pa = pytest.importorskip("pyarrow")
    reader = pa.RecordBatchReader.from_batches(pa.schema({"vehicle.1.speed": pa.float64()}), [])
    with pytest.raises(planar_impact.CaseError, match="a stream has none"):
        planar_impact.solve_batch(reader, case=BARRIER, of="dV1", progress=True)


def test_what_is_no_table_is_a_case_error() -> None:
    pl = pytest.importorskip("polars")
    wide = pl.DataFrame({"id": pl.Series([1], dtype=pl.Int128), "vehicle.1.speed": [12.0]})
    odd = pa.table({"vehicle.1.speed": [12.0]}).replace_schema_metadata({b"\xff": b"\xff"})
    for table in (wide, pl.Series("vehicle.1.speed", [12.0]), odd):
        with pytest.raises(CaseError, match="the table cannot be read"):
            planar_impact.solve_batch(table, case=BARRIER)

    pd = pytest.importorskip("pandas")
    for table in (pd.Series([12.0], name="vehicle.1.speed"), pd.DataFrame({"vehicle.1.speed": [12.0], "phase": [1j]})):
        with pytest.raises(CaseError, match="the table cannot be read"):
            planar_impact.solve_batch(table, case=BARRIER)
    with pytest.raises(CaseError, match="derivatives: unknown value"):
        planar_impact.solve_batch({"vehicle.1.speed": [12.0]}, case=BARRIER, derivatives=pd.Series(["columns"]))
    with pytest.raises(CaseError, match="found one of more than 300 digits"):
        planar_impact.solve_batch({"vehicle.1.speed": [12.0]}, case=BARRIER, threads=10**400)

    class Own:
        def __arrow_c_stream__(self, requested_schema: Any = None) -> Any:
            raise LookupError("of its own")

    with pytest.raises(LookupError, match="of its own"):
        planar_impact.solve_batch(Own(), case=BARRIER)
