import sys

import pyarrow as pa
from datafusion import SessionContext, udf

import planar_impact

CASE = planar_impact.template("t-bone")
STRUCT = pa.struct({"delta_v": pa.float64(), "loss": pa.float64(), "refusal": pa.string()})


def impact(speed_1: pa.Array, speed_2: pa.Array, mass_1: pa.Array, restitution: pa.Array) -> pa.StructArray:
    inputs = {
        "vehicle.1.speed [km/h]": speed_1,
        "vehicle.2.speed [km/h]": speed_2,
        "vehicle.1.mass": mass_1,
        "contact.restitution": restitution,
    }
    answer = planar_impact.solve_batch(pa.record_batch(inputs), of=["dV1", "T_L"], case=CASE, threads=1)
    outputs = ("vehicle.1.delta_v_magnitude", "energy.loss", "refusal")
    return pa.StructArray.from_arrays([answer[name] for name in outputs], fields=list(STRUCT))


def main(source: str, target: str) -> None:
    context = SessionContext()
    context.register_udf(udf(impact, [pa.float64()] * 4, STRUCT, "immutable", "impact"))
    context.register_parquet("crashes", source)
    context.sql("""
        SELECT crash, i['delta_v'] AS "vehicle.1.delta_v_magnitude", i['loss'] AS "energy.loss", i['refusal'] AS refusal
        FROM (
            SELECT crash, impact("vehicle.1.speed [km/h]", "vehicle.2.speed [km/h]", "vehicle.1.mass", "contact.restitution") AS i
            FROM crashes
        )
    """).write_parquet(target)


if __name__ == "__main__":
    main(*sys.argv[1:])
