"""Writes the page of error messages: error_messages.py PROGRAM CASES > error_messages.md.

Each entry runs a command that fails, so the messages on the page are those of the program. An entry whose command no
longer fails in the stated way is an error of the build."""
import dataclasses
import pathlib
import shutil
import subprocess
import sys
import tempfile

STEP = "[initial]\nstress_left = 1\nstress_right = 0\n"


@dataclasses.dataclass
class Entry:
    command: str
    cause: str
    cure: str
    code: int = 2
    files: dict[str, str] = dataclasses.field(default_factory=dict)


SECTIONS = {
    "Scenario files": [
        Entry("pulse my.toml", "A key has a name that no key has. The message names the nearest known key.",
              "Correct the name. `slipfront keys` lists all keys.", files={"my.toml": STEP + "[pulse]\ncell = 100\n"}),
        Entry("pulse my.toml", "A word is not one of the allowed words.", "Take the suggested word.",
              files={"my.toml": STEP + "[friction]\nlaw = \"viscos\"\n"}),
        Entry("pulse my.toml", "A profile lacks a key that it needs.", "Add the key. For an empty interface the stress is 0.",
              files={"my.toml": "[initial]\nstress_left = 1\n"}),
        Entry("pulse my.toml", "The dislocations of so small a stress are so far apart that a double cannot hold their state.",
              "Give 0, or a stress in the allowed range.", files={"my.toml": "[initial]\nstress_left = 0.001\nstress_right = 0\n"}),
        Entry("pulse my.toml", "A formula may have any length, so the program cannot choose the domain.",
              "Give both ends of `[domain]`.", files={"my.toml": "[initial]\nprofile = \"formula\"\nformula = \"0.8*exp(-x^2)\"\n"}),
        Entry("pulse my.toml", "A formula contains a name that is not a variable, a constant or a function.",
              "The initial stress is a function of x only. A force F may also contain t.",
              files={"my.toml": "[initial]\nprofile = \"formula\"\nformula = \"0.8*exp(-y^2)\"\n[domain]\nleft = -5\nright = 5\n"}),
        Entry("pulse cases/step.toml --set friction.law=rate-and-state friction.strength=\"50 MPa\"",
              "A quantity in SI units needs the constants of the rock and the interface.",
              "Add the constant to `[medium]`, or give the number in the unit of the model."),
    ],
    "Runs": [
        Entry("pulse cases/stick-slip.toml", "Loading creates dislocations, and the averaged equations conserve their number.",
              "Run `slipfront chain`."),
        Entry("chain cases/step.toml --set chain.spacing=2", "The chain has too few sites.",
              "Raise `chain.scale`, or leave out `chain.spacing`."),
        Entry("chain cases/step.toml --set chain.scale=1e12", "The run needs more memory than this machine or its control group has.",
              "Lower `chain.scale`, `pulse.cells` or the number of outputs. `--check` prints the need."),
        Entry("pulse cases/step.toml -o missing/out.nc", "The folder of the output file does not exist.", "Create the folder first.", code=3),
        Entry("pulse cases/step.toml --resume old.nc --set pulse.cells=800", "The file belongs to a run with another scenario.",
              "Resume with the scenario and the `--set` of the first run. Only `time.end` may be later. To change the scenario, start a new run.",
              files={"old.nc": "pulse cases/step.toml -o old.nc --quiet"}),
        Entry("pulse cases/step.toml --resume old.nc --set time.end=20", "The domain follows from `time.end`, so a run to the later end would have had another one.",
              "Start a new run with `[domain]`. That run can be continued.", files={"old.nc": "pulse cases/step.toml -o old.nc --quiet"}),
        Entry("pulse cases/step.toml --resume damaged.nc", "Another program has changed the file, or it was damaged.",
              "Start the run again. Damaged files are never continued.", code=3, files={"damaged.nc": "pulse cases/step.toml -o damaged.nc --quiet"}),
        Entry("chain my.toml", "The numerics failed: an invariant is violated by more than 1 %. "
              "Here a force without friction accelerates dislocations until they are narrower than the sites.",
              "Refine the grid with `chain.spacing` or `pulse.cells`, or end the run earlier. The results up to that time are kept.", code=4,
              files={"my.toml": "[initial]\nstress_left = 0.8\nstress_right = 0.8\n[forcing]\nformula = \"0.5\"\n"
                                "[domain]\nleft = -4\nright = 4\n[chain]\nperiodic = true\nscale = 50\n[time]\nend = 20\n"}),
    ],
    "Values and events": [
        Entry("relations --rupture-velocity 1.2", "A rupture velocity is a share of the speed c. It is below 1.",
              "Divide a velocity in km/s by c. `slipfront event` does this for you."),
        Entry("relations --stress 0", "A stress of 0 carries no dislocations, and so no pulse.", "Give a stress in the allowed range."),
        Entry("event my.csv", "An event ruptures faster than dislocations can move in its rock.",
              "Correct the value or the speed of the rock, for example with `--p-wave-speed`. The other events keep their results.",
              files={"my.csv": "name,rupture_velocity_km_s\nA,7\nB,2.8\n"}),
        Entry("event my.csv", "A number has no unit.", "Write the unit into the cell, or into the title as `rupture_velocity_km_s`.",
              files={"my.csv": "name,rupture_velocity\nA,2.8\n"}),
        Entry("event my.csv", "The title of a column is nearly that of a quantity.", "Correct the title. Titles that are not similar are ignored.",
              files={"my.csv": "name,rupture_velocty_km_s\nA,2.8\n"}),
        Entry("event cases/parkfield-2004.toml --p-wave-speed 6", "A quantity with a dimension has no unit.", "Write \"6 km/s\" in quotes."),
    ],
}


def run(program: str, command: str, folder: pathlib.Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(["bash", "-c", f'"$0" {command}', program], cwd=folder, capture_output=True, text=True)


def prepare(program: str, entry: Entry, folder: pathlib.Path) -> None:
    for name, content in entry.files.items():
        if not name.endswith(".nc"):
            (folder / name).write_text(content, encoding="utf-8")
            continue
        run(program, content, folder)
        if name.startswith("damaged"):
            data = bytearray((folder / name).read_bytes())
            data[len(data) // 2] ^= 1
            (folder / name).write_bytes(data)


def print_entry(program: str, cases: pathlib.Path, entry: Entry) -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        shutil.copytree(cases, folder / "cases")
        prepare(program, entry, folder)
        done = run(program, entry.command, folder)
    message = [line for line in done.stderr.splitlines() if line.startswith("slipfront: ") and ": warning: " not in line]
    if done.returncode != entry.code or not message:
        sys.exit(f"docs/site/error_messages.py: slipfront {entry.command}: exit code {done.returncode}, not {entry.code}: {done.stderr}")
    print(f"```text\n{message[-1]}\n```\n")
    print(f"**Cause.** {entry.cause}\n\n**Cure.** {entry.cure}\n")


def main() -> None:
    program, cases = str(pathlib.Path(sys.argv[1]).resolve()), pathlib.Path(sys.argv[2])
    print("# Error messages, their causes and cures\n")
    print("This page helps you to correct an error. A message names the file, the line, the key and its value. It then")
    print("states the problem and what is allowed. The exit code is 2 for wrong input, 3 for a file that cannot be read or")
    print("written, and 4 if the numerics failed. The messages below come from commands that run when this page is made.\n")
    for title, entries in SECTIONS.items():
        print(f"## {title}\n")
        for entry in entries:
            print_entry(program, cases, entry)


if __name__ == "__main__":
    main()
