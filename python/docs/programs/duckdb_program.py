import sys

import duckdb
import pyarrow as pa

import planar_impact

CASE = planar_impact.template("t-bone")


def impact(speed_1: pa.ChunkedArray, speed_2: pa.ChunkedArray, mass_1: pa.ChunkedArray, restitution: pa.ChunkedArray) -> pa.StructArray:
    inputs = {
        "vehicle.1.speed [km/h]": speed_1,
        "vehicle.2.speed [km/h]": speed_2,
        "vehicle.1.mass": mass_1,
        "contact.restitution": restitution,
    }
    answer = planar_impact.solve_batch(pa.table(inputs), of=["dV1", "T_L"], case=CASE, threads=1)
    outputs = ("vehicle.1.delta_v_magnitude", "energy.loss", "refusal")
    return pa.StructArray.from_arrays([answer[name].combine_chunks() for name in outputs], ["delta_v", "loss", "refusal"])


def main(source: str, target: str) -> None:
    connection = duckdb.connect()
    struct = duckdb.struct_type({"delta_v": "DOUBLE", "loss": "DOUBLE", "refusal": "VARCHAR"})
    connection.create_function("impact", impact, ["DOUBLE"] * 4, struct, type="arrow", null_handling="special")
    connection.execute(f"""
        COPY (
            SELECT crash, i.delta_v AS "vehicle.1.delta_v_magnitude", i.loss AS "energy.loss", i.refusal
            FROM (
                SELECT crash, impact("vehicle.1.speed [km/h]", "vehicle.2.speed [km/h]", "vehicle.1.mass", "contact.restitution") AS i
                FROM '{source}'
            )
        ) TO '{target}' (FORMAT parquet)
    """)


if __name__ == "__main__":
    main(*sys.argv[1:])
