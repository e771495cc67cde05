#!/usr/bin/python3
"""Compares numbers in the documentation with the program, or with the page that they come from.

Usage: check_numbers.py PROGRAM [--all] [PAGE...]     (build/release/bin/slipfront; pages by name, as friction.md; default: all of them)

Without --all it does what takes seconds; CTest runs it so (docs_numbers). With --all it takes an hour or so. Each number may be off
by one unit of its last digit. Prints the numbers that are not what was computed and exits with 1 if there are any.

To add a number, add an entry to ENTRIES: the page, a piece of its text with {} in place of each number to compare and {_} in place of
what is not compared, and a function that gives the numbers. Spaces and line breaks in the text count as one space.
"""

import argparse
import dataclasses
import functools
import json
import math
import pathlib
import re
import struct
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent))

import friction  # noqa: E402

HERE = pathlib.Path(__file__).parent
SOURCE = HERE.parent
NUMBER = r"([+-]?\d+(?:\.\d+)?(?:e[+-]?\d+)?)"
PROGRAM = ""


@dataclasses.dataclass
class Entry:
    page: str  # relative to docs/
    text: str
    values: object  # () -> list of numbers
    slow: bool = False


@functools.lru_cache(maxsize=None)
def run(command, scenario, *settings):
    """The JSON of a run. `scenario` is the name of a case, or the text of a scenario."""
    with tempfile.NamedTemporaryFile("w", suffix=".toml") as file:
        file.write(scenario)
        file.flush()
        path = str(SOURCE / "cases" / f"{scenario}.toml") if "\n" not in scenario else file.name
        sets = ["--set", *settings] if settings else []
        done = subprocess.run([PROGRAM, command, path, "--json", "--quiet", *sets], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"{command} {' '.join(settings)}: exit code {done.returncode}: {done.stderr.strip()}")
    return json.loads(done.stdout)


@functools.lru_cache(maxsize=None)
def page_text(page):
    return " ".join((HERE / page).read_text(encoding="utf-8").split())


def found(page, text):
    """The numbers as printed that stand for {} in a piece of text that is on the page once. \\throws LookupError"""
    pattern = re.escape(" ".join(text.split())).replace(r"\{_\}", r"[^|]+?").replace(r"\{\}", NUMBER)
    matches = re.findall(pattern + r"(?![\d.]*\d)", page_text(page))
    if len(matches) != 1:
        raise LookupError(f"{page}: {len(matches)} times on the page: {text}")
    return [matches[0]] if isinstance(matches[0], str) else list(matches[0])


def numbers_on(page, text):
    return [float(word) for word in found(page, text)]


def last_unit(printed):
    """One unit of the last digit of a printed number."""
    digits, _, exponent = printed.partition("e")
    return 10.0 ** (int(exponent or 0) - len(digits.partition(".")[2]))


def wrong(printed, value):
    return not abs(float(printed) - value) <= 1.0000001 * last_unit(printed)


# Ways to compute the numbers.


def end_of(keys, *arguments):
    """Values at the end of a run."""
    return lambda: [run(*arguments)[key] for key in keys]


def recurrence_slope():
    """How the stress drop of the three slow rows of the table falls for a factor e of v, over b - a = 5e-5."""
    rows = [numbers_on("loading.md", f"| {velocity} | {{_}} | {{}} |")[0] for velocity in ("1e-5", "3e-5", "1e-4")]
    x = [math.log(v) for v in (1e-5, 3e-5, 1e-4)]
    mean_x, mean_y = sum(x) / 3, sum(rows) / 3
    slope = sum((a - mean_x) * (b - mean_y) for a, b in zip(x, rows)) / sum((a - mean_x) ** 2 for a in x)
    return [-slope / 5e-5]


def description(picture):
    """The text that a script left in a PNG: the words of its legend."""
    data, at = (HERE / picture).read_bytes(), 8
    while at < len(data):
        (length,), kind = struct.unpack(">I", data[at:at + 4]), data[at + 4:at + 8]
        key, _, text = data[at + 8:at + 8 + length].partition(b"\0")
        if kind == b"tEXt" and key == b"Description":
            return text.decode("latin-1")
        at += length + 12
    raise LookupError(f"{picture} has no description: draw it again")


def legend_slope():
    return [float(re.match(NUMBER, description("loading-recurrence.png")).group(1))]


def grid_barrier(h):
    """F that moves a dislocation over a site, the formula of docs/chain.md."""
    return 40 * math.pi / h**2 * math.exp(-(math.pi**2) / h)


def diffusion_error():
    """How far pulses at Gamma = 1e8 are from the diffusion limit that the page gives, the larger of both closures."""
    limits = numbers_on("pulse.md", "W(0) sqrt(Gamma) of the step 0.855 is {} (closure consistent) and {} (paper)")
    errors = []
    for closure, limit in zip(("consistent", "paper"), limits):
        settings = ("pulse.cells=400", "friction.law=viscous", f"friction.coefficient={1e8 / (2 * math.pi)}", f"friction.closure={closure}")
        errors.append(abs(1e4 * run("pulse", "step", *settings)["slip_velocity_at_origin"] / limit - 1))
    return [max(errors)]


def recurrence(velocity):
    """Time between events and their stress drop, as docs/loading.py measures them."""
    def values():
        once = 30 / velocity
        settings = {"domain.left": -4 * math.pi, "domain.right": 4 * math.pi, "interface.contact": 1, "chain.tolerance": 1e-4, "loading.velocity": velocity,
                    "loading.event_velocity": max(10 * velocity, 2e-3), "time.end": 6 * once, "output.every": 3 * once}
        events = [e for e in run("chain", "stick-slip", *(f"{key}={value}" for key, value in settings.items()))["events"][2:] if e["complete"]]
        onsets = [e["onset"] for e in events]
        return [(onsets[-1] - onsets[0]) / (len(onsets) - 1), sum(e["stress_drop"] for e in events) / len(events)]
    return values


def slider(tolerance):
    """Period and peak velocity of the block of docs/loading.md, f_0 = 0.05, once it repeats itself."""
    events = run("chain", SLIDER, f"chain.tolerance={tolerance}")["events"]
    return events[7]["onset"] - events[6]["onset"], events[7]["peak_velocity"]


def slider_errors():
    """How much too long the period is, in per cent of Radau's on the same page."""
    exact = numbers_on("loading.md", "| f_0 = 0.05, kappa = 0.0025: period | {_} | {} |")[0]
    return [100 * (slider(tolerance)[0] / exact - 1) for tolerance in (1e-3, 1e-4, 5e-5, 1e-6)]


def energy_lost(scenario, *settings):
    """The share of the energy of motion that a pulse loses where streams cross, in per cent."""
    def values():
        out = run("pulse", scenario, "pulse.cells=400", *settings)
        lost = out["energy_shocks"]
        return [100 * lost / (out["energy_kinetic"] + out["energy_dissipated"] + lost)]
    return values


def slip_difference(law, parameters):
    def values():
        average, chain = (friction.slip(PROGRAM, *arguments) for arguments in (("pulse", law, parameters, "pulse.cells=400"), ("chain", law, parameters, "chain.scale=4000")))
        return [100 * (average / chain - 1)]
    return values


# The entries.

STEP = "[initial]\nstress_left = 0.855\nstress_right = 0\n"
ON_A_SLOPE = STEP + '[interface]\ncontact = "1 + 0.2 * tanh(x - 1)"\n[domain]\nleft = -7\nright = 7\n'
UNIFORM = "[initial]\nstress_left = 0.8\nstress_right = 0.8\n[forcing]\nformula = \"0.05\"\n[domain]\nleft = -4\nright = 4\n[time]\nend = 20\n"
CONTACTS = ("friction.evolution_effect=0.015", "friction.characteristic_slip=0.05", "domain.left=-7", "domain.right=3", "pulse.cells=200")
AGEING = ("friction.contact_ageing=0.003", "friction.contact_time=1")
DILATING = ("friction.dilatancy=0.003", "friction.drainage_time=3")
BARRIERS = (0.6, 0.5, 0.45, 0.4, 0.3)
SLIDER = """[initial]
stress_left = 0
stress_right = 0
[interface]
contact = 0
[friction]
law = "rate-and-state"
strength = 0.05
direct_effect = 0.01
evolution_effect = 0.015
characteristic_slip = 1
reference_velocity = 0.01
[loading]
stiffness = 0.0025
velocity = 0.001
event_velocity = 0.01
[domain]
left = -2
right = 2
[chain]
left = "free"
right = "free"
spacing = 0.5
[time]
end = 4.4e5
[output]
every = 1e5
[pulse]
cells = 4
"""
MY_EVENT = """\
[event]
name = "My earthquake"
rupture_velocity = "2.8 +- 0.2 km/s"
slip_velocity = "0.5 */ 1.2 m/s"
[medium]
p_wave_speed = "6 km/s"
poisson_ratio = 0.25
shear_modulus = "32 GPa"
"""
PULSE = ("slip_at_origin", "slip_velocity_at_origin", "peak_slip_velocity", "peak_position")
VISCOUS = ("friction.law=viscous", "friction.coefficient=0.5")


def friction_table():
    """The table of docs/friction.md, law by law. CTest computes the averages."""
    for law, sets in friction.SETS.items():
        for parameters in sets:
            row = f"| {law} | {friction.in_words(law, parameters)} | "
            settings = friction.settings(law, parameters)
            finest = "{_}" if parameters.get("formula") == "0.1*sqrt(w)" else "{}"
            yield Entry("friction.md", row + "{} |", end_of(["slip_at_origin"], "pulse", "step", *settings, "pulse.cells=400"))
            yield Entry("friction.md", row + "{_} | {} |", end_of(["slip_at_origin"], "chain", "step", *settings, "chain.scale=1000"), slow=True)
            if finest == "{}":
                yield Entry("friction.md", row + "{_} | {_} | {} |", end_of(["slip_at_origin"], "chain", "step", *settings, "chain.scale=4000"), slow=True)


def contact_table():
    """Ruptures whose contacts age or whose pores dilate, on a chain of scale 200."""
    rows = {"neither": (), "beta = 0.003, theta_c = 1": ("contact_ageing=0.003", "contact_time=1"), "beta = 0.01, theta_c = 1": ("contact_ageing=0.01", "contact_time=1"),
            "epsilon / b_p = 0.001, t_p = 3": ("dilatancy=0.001", "drainage_time=3"), "epsilon / b_p = 0.003, t_p = 3": ("dilatancy=0.003", "drainage_time=3")}
    keys = ("slip_at_origin", "peak_slip_velocity", "leading_front", "energy_contacts")
    for name, more in rows.items():
        settings = [*CONTACTS, "chain.scale=200", *(f"friction.{word}" for word in more)]
        yield Entry("friction.md", f"| {name} | {{}} | {{}} | {{}} | {{}} |", end_of(keys, "chain", "rate-and-state", *settings), slow=True)


def my_event(*keys, more=""):
    """The event of start/seismologist.md; pressures in MPa."""
    def values():
        event = run("event", MY_EVENT.replace("[medium]", more + "\n[medium]"))["events"][0]
        return [event[key] / (1e6 if "_pa" in key else 1) for key in keys]
    return values


def front_table():
    """How far the fast front gets under three laws, as shares of slip and of |V-| t without friction (docs/friction_figures.py, fronts)."""
    def values(law, settings):
        def shares():
            free = run("pulse", "step", "pulse.cells=400")
            front = free["trailing_characteristic"]
            out = run("pulse", "rate-and-state" if law == "rate-and-state" else "step", "pulse.cells=400", "initial.stress_left=0.855", *settings)
            return [out["slip_at_origin"] / free["slip_at_origin"], out["trailing_front"] / front, out["trailing_front_observed"] / front]
        return shares
    laws = {"viscous": (("friction.coefficient", 0.02, 3), (0, 8, 12), ("friction.law=viscous",)),
            "coulomb": (("friction.coefficient", 0.001, 0.1), (0, 4, 8), ("friction.law=coulomb",)),
            "rate-and-state": (("friction.strength", 0.001, 0.1), (0, 8, 12), ("friction.evolution_effect=0.015",))}
    for law, ((key, least, most), places, more) in laws.items():
        settings = [(*more, f"{key}={least * (most / least) ** (i / 13)}") for i in places]
        yield Entry("friction.md", " ".join([f"| {law} | {{}} | {{}} | {{}} |"] * len(places)), lambda law=law, settings=settings: [n for s in settings for n in values(law, s)()])


@functools.lru_cache(maxsize=None)
def theories():
    """The numbers of docs/theories.py."""
    package = pathlib.Path(PROGRAM).resolve().parents[1] / "python"
    done = subprocess.run([sys.executable, HERE / "theories.py", "numbers"], capture_output=True, text=True, check=False, env={"PYTHONPATH": str(package)})
    if done.returncode != 0:
        raise RuntimeError(f"theories.py: {done.stderr.strip()}")
    return json.loads(done.stdout)


ENTRIES = [
    Entry("theories.md", "| {} earthquakes | {} MPa | {} MPa | {} MPa ({} events) |",
          lambda: [theories()["fast"][i] * (1e-6 if 2 <= i <= 4 else 1) for i in (0, 2, 4, 3, 1)]),
    Entry("theories.md", "| {} slow events | {} kPa | {} Pa | {} kPa ({} events) |",
          lambda: [theories()["slow"][i] * {2: 1e-3, 3: 1e-3}.get(i, 1) for i in (0, 2, 4, 3, 1)]),
    Entry("theories.md", "the median ratio is {}. slipfront gives {} times as much, and its {_} % interval holds the drop of moment and slip in {} of {} events. Without friction it still gives {}",
          lambda: [theories()["fast"][i] for i in (6, 5, 8, 1, 7)]),
    Entry("theories.md", "a drop that is {} % above it suffices for $0.1 c_s$ after 10 W'. slipfront has no threshold: from 0.001 c to 0.1 c its drop grows {} times",
          lambda: theories()["shapes"][::-1]),
    *friction_table(),
    *front_table(),
    *contact_table(),
    Entry("friction.md", "| pulse, 400 cells | {} | {} | {} | {} |", end_of(PULSE, "pulse", "rate-and-state", "pulse.cells=400")),
    Entry("friction.md", "| chain, scale 1000 | {} | {} | {} | {} |", end_of(PULSE, "chain", "rate-and-state", "chain.scale=1000"), slow=True),
    Entry("friction.md", "| chain, scale 300 | {} | {} | {} | {} |", end_of(PULSE, "chain", "rate-and-state", "chain.scale=300")),
    Entry("friction.md", "At scales 100, 200, 400 and 800 the slip with beta = 0.003 is {}, {}, {} and {}. With epsilon / b_p = 0.003 it is {}, {}, {} and {}.",
          lambda: [run("chain", "rate-and-state", *CONTACTS, *more, f"chain.scale={scale}")["slip_at_origin"] for more in (AGEING, DILATING) for scale in (100, 200, 400, 800)],
          slow=True),
    Entry("pulse.md", "between x = -7 and 7 has W(0) = {}, {}, {} with 100, 200, 400 cells",
          lambda: [run("pulse", ON_A_SLOPE, f"pulse.cells={n}")["slip_velocity_at_origin"] for n in (100, 200, 400)]),
    Entry("pulse.md", "W(0) at t = 20 is {} with continued ends and on a ring",
          end_of(["slip_velocity_at_origin"], "pulse", UNIFORM, "pulse.cells=100")),
    Entry("pulse.md", "is {_} with continued ends and on a ring; a periodic chain has {}.",
          end_of(["slip_velocity_at_origin"], "chain", UNIFORM, "chain.periodic=true", "chain.scale=100"), slow=True),
    Entry("pulse.md", "| W(0), tanh width 1, Sigma- 0.855, Sigma+ 0.179, C = 0.5, t = 2 pi | {} | {} |",
          lambda: [run("pulse", "fig-08", f"friction.closure={closure}")["slip_velocity_at_origin"] for closure in ("consistent", "paper")]),
    Entry("pulse.md", "| slip at x = 0 by t = 2 pi, step 0.855 into empty, C = 0.5 | {} | {} |",
          lambda: [run("pulse", "step", *VISCOUS, f"friction.closure={closure}")["slip_at_origin"] for closure in ("consistent", "paper")]),
    Entry("pulse.md", "| leading edge of that step at t = 2 pi | {} |", end_of(["leading_front"], "pulse", "step", *VISCOUS, "friction.closure=consistent")),
    Entry("pulse.md", "the solver is within {} of it at Gamma = 1e8 with 400 cells", diffusion_error),
    Entry("pulse.md", "| `cases/shock.toml` with C = 0.5 | {} % |", energy_lost("shock", *VISCOUS)),
    Entry("pulse.md", "| `cases/shock.toml`, no friction | {} % |", energy_lost("shock")),
    Entry("chain.md", "| h | barrier of the grid, F | of the lattice, A = h | |---|---|---| " + " ".join(f"| {h} | {{}} | {{_}} |" for h in BARRIERS),
          lambda: [grid_barrier(h) for h in BARRIERS]),
    Entry("chain.md", "gives {} at scale 1000,", end_of(["energy_phonons"], "chain", "shock", "chain.scale=1000"), slow=True),
    *(Entry("loading.md", f"| {v} | {{}} | {{}} |", recurrence(float(v)), slow=True) for v in ("1e-5", "3e-5", "1e-4", "3e-4", "1e-3")),
    Entry("loading.md", "| f_0 = 0.05, kappa = 0.0025: period | {} | {_} |", lambda: [slider(1e-6)[0]], slow=True),
    Entry("loading.md", "| peak velocity | {} | {_} |", lambda: [slider(1e-6)[1]], slow=True),
    Entry("loading.md", "At tolerances 1e-3, 1e-4, 5e-5 (the default) and 1e-6 the period is {}, {}, {} and {} % too long", slider_errors, slow=True),
    # Numbers that come from others on the pages.
    Entry("loading.md", "the drop falls by {} (b - a) for a factor e", recurrence_slope),
    Entry("loading.md", "the drop falls by {} (b - a) for a factor e", legend_slope),
    Entry("trust.md", "at x = 0 is up to {} % above that of the chain at scale {}.",
          lambda: numbers_on("claims.md", "with the paper's closure is up to {} % above the chain. Range: C = 0 to 2 (Gamma = C t to 12.6), scale {}.")),
    Entry("trust.md", "slip within {} % for C = 0 to {}, at scale 4000",
          lambda: [*numbers_on("claims.md", "The pulse with the consistent closure is within {} % of the chain in every row"), 2]),
    Entry("reproduction.md", "| seen at a fixed W | Refuted: {} % slower | | the leading edge | Refuted: {} % slower |",
          lambda: numbers_on("claims.md", "sees it: {} % slower on the chain") + numbers_on("claims.md", "Leading edge: {} % slower on the chain")),
    Entry("../python/slipfront/reproduce/glossary.toml", "within {} %, and the paper's closure is up to {} % above the chain (docs/claims.md)",
          lambda: numbers_on("claims.md", "The pulse with the consistent closure is within {} % of the chain in every row") +
          numbers_on("claims.md", "with the paper's closure is up to {} % above the chain")),
    Entry("start/seismologist.md", "slip velocity 0.5 m/s. The shear stress before the rupture is {} MPa", my_event("stress_pa")),
    Entry("start/seismologist.md", "stress drop 8 MPa. The shear stress before the rupture is {} MPa", my_event("stress_pa", more='stress_drop = "8 */ 1.5 MPa"')),
    Entry("events.md", "`cases/catalogue.csv`: {} published events", lambda: [catalogue_rows()]),
    Entry("../CHANGELOG.md", "a shipped catalogue of {} published events", lambda: [catalogue_rows()]),
]


def catalogue_rows():
    lines = (SOURCE / "cases" / "catalogue.csv").read_text(encoding="utf-8").splitlines()
    return sum(1 for line in lines if line and not line.startswith("#")) - 1


def check(entry):
    """The faults of an entry, a line each; empty if it has none."""
    try:
        printed, values = found(entry.page, entry.text), entry.values()
    except (LookupError, RuntimeError) as error:
        return [str(error)]
    if len(printed) != len(values):
        return [f"{entry.page}: {len(printed)} numbers in the text, {len(values)} computed: {entry.text}"]
    return [f"{entry.page}: {text} is printed, {value:.8g} computed: {entry.text}" for text, value in zip(printed, values) if wrong(text, value)]


def main():
    global PROGRAM
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("program")
    parser.add_argument("--all", action="store_true", help="also what takes long")
    parser.add_argument("pages", nargs="*", help="friction.md, ...")
    options = parser.parse_args()
    PROGRAM = options.program
    chosen = [e for e in ENTRIES if (options.all or not e.slow) and (not options.pages or pathlib.Path(e.page).name in options.pages)]
    if not chosen:
        parser.error("no entry for these pages")
    problems = []
    for entry in chosen:
        for line in check(entry):
            problems.append(line)
            print(line, flush=True)
    print(f"{len(chosen)} entries, {len(problems)} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
