#!/usr/bin/env python3
"""List the crates of every lock file that run a build script, compare them with the recorded list, and search each script for words of the network.

A build script with such a word fails until the list says beside its name what the word means. A new crate fails until someone has looked at its script. `.ci/audit.py --update MANIFEST...` rewrites the list.
"""

import json
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
LIST = ROOT / ".ci" / "build_scripts.txt"
NETWORK = re.compile(r"TcpStream|UdpSocket|reqwest|ureq|hyper|https?_get|\bcurl\b|\bwget\b|git2|\"git\"\s*\)\s*\.arg|download", re.IGNORECASE)


def scripts(manifest: str) -> dict[str, pathlib.Path]:
    """Return the build script of each crate that has one."""
    call = ["cargo", "metadata", "--locked", "--format-version", "1", "--manifest-path", str(ROOT / manifest / "Cargo.toml")]
    packages = json.loads(subprocess.run(call, check=True, capture_output=True).stdout)["packages"]
    found = {}
    for package in packages:
        for target in package["targets"]:
            if "custom-build" in target["kind"]:
                found[package["name"]] = pathlib.Path(target["src_path"])
    return found


def main() -> int:
    update = "--update" in sys.argv
    found: dict[str, pathlib.Path] = {}
    for manifest in (word for word in sys.argv[1:] if word != "--update"):
        found |= scripts(manifest)
    status = 0
    reach = {}
    for name, path in sorted(found.items()):
        lines = [line.split("//")[0] for line in path.read_text(errors="replace").splitlines()]
        reach[name] = sorted({match.group(0) for line in lines for match in NETWORK.finditer(line)})
    listed = dict(line.split(maxsplit=1) if " " in line else (line, "") for line in LIST.read_text().splitlines() if line and not line.startswith("#")) if LIST.exists() else {}
    if update:
        head = "# Crates that run a build script. .ci/audit.py finds no word of the network in them; what such a word means would stand beside the name.\n"
        LIST.write_text(head + "".join(f"{name} {listed.get(name, '; '.join(words))}".rstrip() + "\n" for name, words in reach.items()))
        return 0
    for name, words in reach.items():
        if name not in listed:
            print(f"{name}: a new build script: read {found[name]}, and add the crate to {LIST.name}")
            status = 1
        elif words and not listed[name]:
            print(f"{name}: its build script names {', '.join(words)}")
            status = 1
    print(f"{len(found)} build scripts, each on the list, none with a word of the network" if status == 0 else "build scripts have changed")
    return status


if __name__ == "__main__":
    sys.exit(main())
