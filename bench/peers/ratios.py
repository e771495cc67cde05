"""The table of ratios of ./run bench: time of each peer over that of slipfront. Peers that are not installed are left out."""

import importlib
import importlib.util
import pathlib
import shutil

from peers import breather, lammps_chain


def lattice(folder):
    """Rows for the lattice of Eq. 1, at equal steps and so at equal error."""
    if not (folder / "chain_run").exists() or not shutil.which("lmp"):
        print("LAMMPS is left out: chain_run was not built, or there is no lmp (Debian package lammps)")
        return
    found = lammps_chain.main(folder / "chain_run")
    what = "lattice of Eq. 1, equal steps, " + ", ".join(f"{n:.0e}" for n, _ in lammps_chain.SIZES) + " sites"
    for peer, ratios in zip(("LAMMPS, its fastest way", "the same, phases of 32 bits", "plain leapfrog"), zip(*found)):
        yield peer, what, ratios


def grid(folder):
    """Rows for a breather of Eq. 3, at equal error."""
    if not (folder / "breather").exists():
        print("PETSc and deal.II are left out: breather was not built")
        return
    what = "breather of Eq. 3 to an error of " + ", ".join(f"{e:g}" for e in breather.ERRORS)
    for peer, ratios in breather.ratios(breather.main(folder)).items():
        yield peer, what, ratios


def averages(program):
    """A row for the modulation equations, at equal error."""
    if not importlib.util.find_spec("scipy"):
        print("The method of lines is left out: there is no scipy (Debian package python3-scipy)")
        return
    ratio = importlib.import_module("peers.method_of_lines").main(program)
    if ratio:
        yield "method of lines, scipy", "slip velocity of a tanh pulse with friction to 1e-3", [ratio]


def print_ratios(program):
    folder = pathlib.Path(program).parent
    print("\nOther programs, one core:", flush=True)
    rows = [*lattice(folder), *grid(folder), *averages(program)]
    print("\nTime of a peer over that of slipfront, on one core, at equal error; above 1, slipfront is faster\n\n| peer | task | ratio |\n|---|---|---|")
    for peer, what, ratios in rows:
        print(f"| {peer} | {what} | {', '.join(f'{r:.0f}' for r in ratios)} |", flush=True)
