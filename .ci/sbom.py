#!/usr/bin/env python3
"""Write a CycloneDX 1.5 bill of materials for each lock file: of Cargo, of npm, and the requirements of the package for Python. The same input gives the same bytes."""

import json
import pathlib
import subprocess
import sys
import tomllib

ROOT = pathlib.Path(__file__).resolve().parent.parent


def cargo(manifest: str) -> list[dict]:
    """Return the crates of a lock file, with licences from their manifests and the checksums of the registry."""
    call = ["cargo", "metadata", "--locked", "--format-version", "1", "--manifest-path", str(ROOT / manifest / "Cargo.toml")]
    packages = json.loads(subprocess.run(call, check=True, capture_output=True).stdout)["packages"]
    locked = tomllib.loads((ROOT / manifest / "Cargo.lock").read_text())["package"]
    sums = {(package["name"], package["version"]): package.get("checksum") for package in locked}
    components = []
    for package in packages:
        name, version = package["name"], package["version"]
        component = {"type": "library", "name": name, "version": version, "purl": f"pkg:cargo/{name}@{version}"}
        if package.get("license"):
            component["licenses"] = [{"expression": package["license"].replace("/", " OR ")}]
        if sums.get((name, version)):
            component["hashes"] = [{"alg": "SHA-256", "content": sums[(name, version)]}]
        components.append(component)
    return components


def npm(lock: pathlib.Path) -> list[dict]:
    """Return the packages of a lock file of npm."""
    components = []
    for path, package in json.loads(lock.read_text())["packages"].items():
        if not path:
            continue
        name = path.rsplit("node_modules/", 1)[-1]
        component = {"type": "library", "name": name, "version": package["version"], "purl": f"pkg:npm/{name.replace('@', '%40')}@{package['version']}"}
        if package.get("license"):
            component["licenses"] = [{"expression": package["license"]}]
        components.append(component)
    return components


def pypi() -> list[dict]:
    """Return what the package for Python requires; its ranges are those of its users."""
    project = tomllib.loads((ROOT / "python" / "pyproject.toml").read_text())["project"]
    groups = {"": project.get("dependencies", []), **project.get("optional-dependencies", {})}
    return [
        {"type": "library", "name": requirement, "purl": "pkg:pypi/" + requirement.split("[")[0].split(">")[0].split("=")[0].split("<")[0].strip(), "group": group}
        for group, requirements in groups.items()
        for requirement in requirements
    ]


def main() -> None:
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    bills = {f"cargo-{manifest.strip('./').replace('/', '-') or 'workspace'}": cargo(manifest) for manifest in sys.argv[2:]}
    bills |= {f"npm-{lock.parent.name.strip('.')}": npm(lock) for lock in (ROOT / "web/package-lock.json", ROOT / ".ci/pages/package-lock.json")}
    bills["pypi"] = pypi()
    for name, components in bills.items():
        components.sort(key=lambda component: (component["name"], component.get("version", "")))
        bill = {"bomFormat": "CycloneDX", "specVersion": "1.5", "version": 1, "metadata": {"component": {"type": "application", "name": "planar-impact"}}, "components": components}
        (folder / f"{name}.cdx.json").write_text(json.dumps(bill, indent=1) + "\n")
        print(f"{name}: {len(components)} components")


if __name__ == "__main__":
    main()
