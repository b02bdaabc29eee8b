import os
import sys
from collections.abc import Iterator

import pandas as pd
import pyarrow as pa
import pyspark
from pyspark.sql import DataFrame, SparkSession
from pyspark.sql.functions import col, pandas_udf

import planar_impact

CASE = planar_impact.template("t-bone")
OUTPUTS = ["vehicle.1.delta_v_magnitude", "energy.loss"]
SCHEMA = "crash long, `vehicle.1.delta_v_magnitude` double, `energy.loss` double, refusal string"


def impacts(batches: Iterator[pa.RecordBatch]) -> Iterator[pa.RecordBatch]:
    for batch in batches:
        batch = batch.rename_columns([name.replace("__", ".") for name in batch.schema.names])
        yield planar_impact.solve_batch(batch, of=OUTPUTS, case=CASE, threads=1).select(["crash", *OUTPUTS, "refusal"])


def energy_loss(speed_1: pd.Series, speed_2: pd.Series) -> pd.Series:
    columns = {"vehicle.1.speed": speed_1.to_numpy(), "vehicle.2.speed": speed_2.to_numpy(), "contact.restitution": 0.1}
    return pd.Series(planar_impact.solve_batch(columns, of="T_L", case=CASE, threads=1)["energy.loss"])


def session(master: str) -> SparkSession:
    os.environ.setdefault("SPARK_HOME", os.path.dirname(pyspark.__file__))
    os.environ.setdefault("PYSPARK_PYTHON", sys.executable)
    return SparkSession.builder.master(master).config("spark.ui.enabled", "false").getOrCreate()


def read(spark: SparkSession, source: str) -> DataFrame:
    crashes = spark.read.parquet(source)
    # Spark takes a dot in the name of a column for that of a field in a struct.
    return crashes.toDF(*(name.replace(".", "__") for name in crashes.columns))


def main(source: str, target: str, master: str = "local-cluster[2,1,1024]") -> None:
    spark = session(master)
    try:
        crashes = read(spark, source)
        crashes.mapInArrow(impacts, SCHEMA).write.parquet(target)
        # One number of each row, as an expression.
        loss = pandas_udf(energy_loss, "double")
        crashes.select(loss(col("vehicle__1__speed [km/h]") / 3.6, col("vehicle__2__speed [km/h]") / 3.6).alias("loss")).summary().show()
    finally:
        spark.stop()


if __name__ == "__main__":
    main(*sys.argv[1:])
