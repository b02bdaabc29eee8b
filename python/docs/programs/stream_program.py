import sys

import pyarrow as pa
import pyarrow.parquet as pq

import planar_impact

CASE = planar_impact.template("t-bone")


def main(source: str, target: str) -> None:
    crashes = pq.ParquetFile(source)
    reader = pa.RecordBatchReader.from_batches(crashes.schema_arrow, crashes.iter_batches())
    solved = planar_impact.solve_batch(reader, of=["dV1", "T_L"], case=CASE)
    with pq.ParquetWriter(target, solved.schema) as writer:
        for batch in solved:
            writer.write_batch(batch)


if __name__ == "__main__":
    main(*sys.argv[1:])
