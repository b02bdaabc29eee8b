"""The programs of the guide run, and give the bits of one process."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

PROGRAMS = Path(__file__).parent / "programs"
sys.path.insert(0, str(PROGRAMS))


@pytest.fixture(scope="module")
def source(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a table of several row groups."""
    crashes = pytest.importorskip("crashes")
    path = tmp_path_factory.mktemp("crashes") / "crashes.parquet"
    crashes.main(250_000, str(path))
    return path


ENGINES = {"stream": "pyarrow", "polars": "polars", "duckdb": "duckdb", "datafusion": "datafusion", "spark": "pyspark", "ray": "ray", "dask": "dask"}


@pytest.mark.parametrize("engine", ENGINES)
def test_an_engine_gives_the_bits_of_one_process(engine: str, source: Path, tmp_path: Path) -> None:
    pytest.importorskip(ENGINES[engine])
    import crashes

    target = tmp_path / "solved.parquet"
    subprocess.run([sys.executable, PROGRAMS / f"{engine}_program.py", source, target], check=True, timeout=600)
    assert crashes.same_bits(source, target) == 250_000


def test_jax() -> None:
    jax = pytest.importorskip("jax")
    import jax_program as program
    from jax.test_util import check_grads

    inputs = jax.numpy.array([[15.0, 8.0, 0.1], [12.0, 6.0, 0.2], [20.0, 3.0, 0.05]])
    check_grads(jax.jit(program.impact), (inputs,), order=1, modes=("fwd", "rev"), atol=1e-6, rtol=1e-6)
    slope = jax.jit(jax.grad(program.loss))(inputs)
    outputs, derivatives = program.solved(inputs)
    assert slope == pytest.approx(2 * outputs[:, :1] * derivatives[:, 0, :] / 3, rel=1e-12)


def test_pycrash() -> None:
    pytest.importorskip("pycrash")
    done = subprocess.run([sys.executable, PROGRAMS / "pycrash_program.py"], check=True, timeout=300, capture_output=True, text=True)
    shown = (Path(__file__).parent / "pycrash.md").read_text(encoding="utf-8")
    assert done.stdout.strip() and done.stdout.strip() in shown
