"""The bill of materials of a wheel: the libraries of others that it contains, with versions and licenses (CycloneDX, PEP 770)."""

import json
import pathlib
import shutil
import subprocess

# A header of each library that is compiled into program or module.
HEADERS = {"boost": "boost/version.hpp", "cli11": "CLI/CLI.hpp", "fmt": "fmt/core.h", "nlohmann_json": "nlohmann/json.hpp",
           "pybind11": "pybind11/pybind11.h", "tomlplusplus": "toml++/toml.h"}


def _component(name, version, package):
    return {"type": "library", "name": name, "version": version, "purl": f"pkg:deb/debian/{package}@{version}"}


def _version(package):
    return subprocess.run(["dpkg-query", "-W", "-f", "${Version}", package], check=True, capture_output=True, text=True).stdout


def _package_of(file):
    """The Debian package that has installed a file."""
    for path in (file, pathlib.Path("/lib") / file.relative_to("/usr/lib")) if file.is_relative_to("/usr/lib") else (file,):
        found = subprocess.run(["dpkg-query", "-S", str(path)], capture_output=True, text=True)
        if found.returncode == 0:
            return found.stdout.split(":")[0]
    raise SystemExit(f"{file}: no Debian package has installed it")


def _page_components(root):
    """The components that the page of the explorer contains. KaTeX is only used to build it, but its style sheet and fonts are in the page."""
    packages = json.loads((root / "apps/explorer/package-lock.json").read_text(encoding="utf-8"))["packages"]
    return [{"type": "library", "name": path.split("node_modules/")[-1], "version": entry["version"],
             "purl": f"pkg:npm/{path.split('node_modules/')[-1]}@{entry['version']}"}
            for path, entry in packages.items()
            if path == "node_modules/katex" or path and not entry.get("dev") and "/@types/" not in path]


def write(info, libraries, netcdf, root):
    """Writes the bill of materials and the licenses into the folder *.dist-info.

    info:       the folder
    libraries:  name and file of each library that the wheel contains
    netcdf:     folder of the static netCDF (tools/package/netcdf)
    root:       the source tree
    """
    licenses = info / "licenses"
    licenses.mkdir(exist_ok=True)
    components = []
    for name in ("hdf5", "netcdf"):
        components.append(_component(name, (netcdf / "licenses" / f"{name}.version").read_text().strip(), name))
        shutil.copy(netcdf / "licenses" / name, licenses / f"{name}.copyright")
    headers = {name: pathlib.Path("/usr/include") / header for name, header in HEADERS.items()}
    for name, file in {**headers, **dict(sorted(libraries.items()))}.items():
        package = _package_of(file)
        components.append(_component(name, _version(package), package))
        shutil.copy(pathlib.Path("/usr/share/doc") / package / "copyright", licenses / f"{package}.copyright")
    for text in (root / "LICENSES").iterdir():
        shutil.copy(text, licenses)
    bill = {"bomFormat": "CycloneDX", "specVersion": "1.5", "version": 1, "components": components + _page_components(root)
            + [_component("emscripten", _version("emscripten"), "emscripten")]}
    folder = info / "sboms"
    folder.mkdir(exist_ok=True)
    (folder / "slipfront.cdx.json").write_text(json.dumps(bill, indent=1) + "\n")
