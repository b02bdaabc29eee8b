"""Writes page_checksum.parquet: three speeds, with a checksum for each page, which the writer of these tests does not have.

    pip install pyarrow && python3 page_checksum.py
"""

import pyarrow
import pyarrow.parquet

table = pyarrow.table({"vehicle.1.speed": [10.0, 11.0, 12.0]})
pyarrow.parquet.write_table(table, "page_checksum.parquet", compression="none", use_dictionary=False, write_page_checksum=True, store_schema=False)
