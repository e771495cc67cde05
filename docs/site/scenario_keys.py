"""Writes the reference of scenario keys from the program: scenario_keys.py PROGRAM > scenario_keys.md."""
import json
import subprocess
import sys

TABLES = {
    "": ("At the top of the file", ""),
    "initial": ("[initial]", "The stress at t = 0, where everything is at rest. This is the only required table."),
    "friction": ("[friction]", "The law of friction and its parameters. [Choose a law of friction](docs/friction.md) describes the laws."),
    "forcing": ("[forcing]", "A force that acts on every position."),
    "loading": ("[loading]", "Springs whose far ends move, for chains only. [Load a chain](docs/loading.md) describes them."),
    "interface": ("[interface]", "The contact ratio along the interface."),
    "domain": ("[domain]", "The part of the interface that is computed."),
    "plane": ("[plane]", "A rupture on a plane: its edges, the region that is held, and the cells."),
    "nucleation": ("[nucleation]", "Where a rupture on a plane begins, if a static load or friction holds the rest."),
    "time": ("[time]", "The duration of the run."),
    "pulse": ("[pulse]", "Settings of a `pulse` run."),
    "chain": ("[chain]", "Settings of a `chain` run."),
    "medium": ("[medium]", "The rock and the interface, in SI units. Each quantity is a text with a unit, such as \"30 GPa\"."),
    "output": ("[output]", "Times and variables of the output file."),
}


def cell(text: str) -> str:
    return text.replace("|", r"\|")


def main() -> None:
    keys = json.loads(subprocess.run([sys.argv[1], "keys", "--json"], check=True, capture_output=True, text=True).stdout)["keys"]
    print("# Scenario keys\n")
    print("This page lists every key that a scenario file may have, with its type, range, unit and default. The program makes")
    print("the list from the code that checks scenarios; `slipfront keys` prints it too. [Write a scenario file](docs/scenario.md)")
    print("explains how to write a scenario.\n")
    for table, (title, text) in TABLES.items():
        print(f"## {title}\n\n{text}\n")
        print("| key | meaning | type and allowed values | unit | default |\n|---|---|---|---|---|")
        for key in [k for k in keys if k["table"] == table]:
            laws = f" (laws: {', '.join(key['laws'])})" if key["laws"] else ""
            kind = key["type"] + (f": {key['allowed']}" if key["allowed"] else "")
            unit = "" if key["unit"] == "1" else key["unit"]
            print(f"| `{key['key']}` | {cell(key['meaning'] + laws)} | {cell(kind)} | {unit} | {key['default']} |")
        print()
    missing = sorted({k["table"] for k in keys} - set(TABLES))
    if missing:
        sys.exit(f"docs/site/scenario_keys.py: describe the tables {', '.join(missing)}")


if __name__ == "__main__":
    main()
