import sys

import polars as pl

import planar_impact

CASE = planar_impact.template("t-bone")
INPUTS = ["vehicle.1.speed [km/h]", "vehicle.2.speed [km/h]", "vehicle.1.mass", "contact.restitution"]
OUTPUTS = ["vehicle.1.delta_v_magnitude", "energy.loss"]


def impact(inputs: pl.Series) -> pl.Series:
    answer = planar_impact.solve_batch(inputs.struct.unnest(), of=OUTPUTS, case=CASE, threads=1)
    return answer.select(*OUTPUTS, "refusal").to_struct()


def main(source: str, target: str) -> None:
    kind = pl.Struct({**dict.fromkeys(OUTPUTS, pl.Float64), "refusal": pl.String})
    solved = pl.struct(INPUTS).map_batches(impact, return_dtype=kind, is_elementwise=True)
    pl.scan_parquet(source).with_columns(solved.alias("impact")).unnest("impact").sink_parquet(target)


if __name__ == "__main__":
    main(*sys.argv[1:])
