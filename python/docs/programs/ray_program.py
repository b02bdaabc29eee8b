import sys

import pyarrow as pa
import ray

import planar_impact

CASE = planar_impact.template("t-bone")
OUTPUTS = ["vehicle.1.delta_v_magnitude", "energy.loss"]


def impacts(batch: pa.Table) -> pa.Table:
    return planar_impact.solve_batch(batch, of=OUTPUTS, case=CASE, threads=1).select(["crash", *OUTPUTS, "refusal"])


def main(source: str, target: str) -> None:
    ray.init(num_cpus=2, include_dashboard=False)
    try:
        ray.data.read_parquet(source).map_batches(impacts, batch_format="pyarrow", batch_size=None).write_parquet(target)
    finally:
        ray.shutdown()


if __name__ == "__main__":
    main(*sys.argv[1:])
