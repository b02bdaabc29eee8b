"""Records of other programs through `planar-impact check`."""

import json
import os
import subprocess
import tempfile
from pathlib import Path

PROGRAM = Path(os.environ.get("PLANAR_IMPACT", Path(__file__).parents[2] / "target/release/planar-impact"))


def broken_rules(records, length, mass, angle):
    """Return the rules that each record breaks; the records are in these units and seconds."""
    header = {"schema": "planar-impact-record/1", "units": {"length": length, "mass": mass, "time": "s", "angle": angle}}
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "records.jsonl")
        with open(path, "w", encoding="utf-8") as file:
            for line in (header, *records):
                print(json.dumps(line), file=file)
        found = subprocess.run([PROGRAM, "check", path, "--format", "json"], capture_output=True, text=True, check=False)
    return [{finding["rule"] for finding in each["findings"] if finding["severity"] == "fail"} for each in json.loads(found.stdout)["records"]]
