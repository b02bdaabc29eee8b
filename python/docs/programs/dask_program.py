import sys

import dask.dataframe as dd
import pandas as pd
from dask.distributed import Client

import planar_impact

CASE = planar_impact.template("t-bone")
OUTPUTS = ["vehicle.1.delta_v_magnitude", "energy.loss"]


def impacts(crashes: pd.DataFrame) -> pd.DataFrame:
    return planar_impact.solve_batch(crashes, of=OUTPUTS, case=CASE, threads=1)[["crash", *OUTPUTS, "refusal"]]


def main(source: str, target: str) -> None:
    with Client(n_workers=2, threads_per_worker=1, dashboard_address=None):
        crashes = dd.read_parquet(source, split_row_groups=True)
        crashes.map_partitions(impacts, meta=impacts(crashes._meta)).to_parquet(target, write_index=False)


if __name__ == "__main__":
    main(*sys.argv[1:])
