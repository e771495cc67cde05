"""Compare slipfront's chain with deal.II, with PETSc and with a plain loop: time of a breather of Eq. 3 at equal error.

The problem is that of the program step-25 of deal.II (Debian packages libdeal.ii-dev and libdeal.ii-doc): a breather with m = 0.5
that starts at rest, on -40 ... 40 instead of -10 ... 10, so that the ends do not matter. The error is the largest of u at the end,
t = 8.16. We compile step-25 with other numbers of cells, without its files, and with lines that print error and time. PETSc (Debian
package petsc-dev) integrates the method of lines with its own time steps. Times are those of the time steps on one core, and between
two grids we interpolate log(time) over log(error).

Usage: breather.py [FOLDER_OF_PROGRAMS].   Needs breather, and leaves out peers that are not installed.
"""

import math
import pathlib
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path("/usr/share/doc/libdeal.ii-doc/examples/step-25/step-25.cc")
ERRORS = (1e-3, 1e-4)
# Our changes of step-25. A step is half a cell, as there.
CHANGES = (
    ("  template <int dim>\n  class SineGordonProblem\n", "  int refinements, steps;\n{}"),
    ("hyper_cube(triangulation, -10, 10)", "hyper_cube(triangulation, -40, 40)"),
    ("n_global_refinements(6)", "n_global_refinements(refinements)"),
    ("time(-5.4414)", "time(-1.5 * numbers::PI / std::sqrt(0.75))"),
    ("time_step(10 * 1. / std::pow(2., 1. * n_global_refinements))",
     "time_step(2.25 * numbers::PI / std::sqrt(0.75) / steps)"),
    ("output_timestep_skip(1)", "output_timestep_skip(1000000000)"),
    ("    output_results(0);", "    std::cout.setstate(std::ios::failbit);\n    Timer timer;"),
    ("time <= final_time", "timestep_number <= static_cast<unsigned int>(steps)"),
    ("          output_results(timestep_number);\n      }\n",
     "{}    const double seconds = timer.wall_time();\n    Vector<double> exact(solution.size());\n"
     "    VectorTools::interpolate(dof_handler, ExactSolution<dim>(1, time - time_step), exact);\n"
     "    solution -= exact;\n"
     '    std::printf("deal.II step-25\\t%g\\t%.4e\\t%.4e\\n", 80.0 / triangulation.n_active_cells(),\n'
     "                solution.linfty_norm(), seconds);\n"),
    ("int main()\n{", "int main(int, char **argv)\n{\n  Step25::refinements = std::atoi(argv[1]);\n"
     "  Step25::steps = std::atoi(argv[2]);"),
    ("#include <fstream>", "#include <cstdio>\n#include <cstdlib>\n#include <deal.II/base/timer.h>\n{}"),
)
PROJECT = """cmake_minimum_required(VERSION 3.13)
find_package(deal.II REQUIRED)
deal_ii_initialize_cached_variables()
project(step-25 CXX)
add_executable(step-25 step-25.cc)
deal_ii_setup_target(step-25)
"""


def rows_of(*command):
    """Rows of a program: method, spacing, error, seconds."""
    with tempfile.TemporaryDirectory() as folder:
        out = subprocess.run(list(map(str, command)), cwd=folder, check=True, capture_output=True, text=True).stdout
    rows = (line.split("\t") for line in out.splitlines() if line.count("\t") == 3)
    return [(name, float(h), float(error), float(seconds)) for name, h, error, seconds in rows]


def step_25(folder):
    """Compiles the program in `folder`, once."""
    folder.mkdir(exist_ok=True)
    text = SOURCE.read_text()
    for old, new in CHANGES:
        if text.count(old) != 1:
            sys.exit(f"{SOURCE}: expected once, but found {text.count(old)} times: {old!r}")
        text = text.replace(old, new.replace("{}", old) if new.count("{}") else new)
    source = folder / "step-25.cc"
    if not source.exists() or source.read_text() != text:
        source.write_text(text)
    (folder / "CMakeLists.txt").write_text(PROJECT)
    for command in (["cmake", "-DCMAKE_BUILD_TYPE=Release", "."], ["cmake", "--build", "."]):
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
        if done.returncode:
            print(f"deal.II: step-25 does not compile: {done.stderr.strip()[-200:]}")
            return []
    return [row for level in range(8, 13)
            for row in rows_of(folder / "step-25", level, round(8.16 * 2 ** (level + 1) / 80))]


def time_at(rows, error):
    """Time of a method at this error, or NaN where its grids do not include it."""
    rows = sorted(rows, key=lambda row: -row[2])
    for (_, _, high, fast), (_, _, low, slow) in zip(rows, rows[1:]):
        if low <= error <= high:
            share = math.log(high / error) / math.log(high / low)
            return math.exp((1 - share) * math.log(fast) + share * math.log(slow))
    return math.nan


def by_method(rows):
    return {name: [row for row in rows if row[0] == name] for name, *_ in rows}


def ratios(rows):
    """By peer: least time of its methods over that of slipfront, for each of ERRORS."""
    methods = by_method(rows)
    found = {}
    for peer in ("plain leapfrog", "PETSc", "deal.II"):
        times = [[time_at(its, error) for error in ERRORS] for name, its in methods.items() if name.startswith(peer)]
        if times:
            found[peer] = [min((t for t in column if t > 0), default=math.nan) / time_at(methods["slipfront"], error)
                           for column, error in zip(zip(*times), ERRORS)]
    return found


def print_times(rows):
    methods = by_method(rows)
    ours = [time_at(methods["slipfront"], error) for error in ERRORS]
    print("\nTime of a breather of Eq. 3 at equal error, in ms, and over that of slipfront\n")
    print("| method | " + " | ".join(f"error {error:g}" for error in ERRORS) + " |")
    print("|---|" + "---|" * len(ERRORS))
    for name, found in methods.items():
        times = [time_at(found, error) for error in ERRORS]
        cells = [f"{t * 1e3:.3g} ({t / o:.3g})" if t > 0 else "" for t, o in zip(times, ours)]
        print(f"| {name} | " + " | ".join(cells) + " |")


def main(folder="build/release/bin"):
    folder = pathlib.Path(folder).resolve()
    rows = rows_of(folder / "breather")
    if (folder / "petsc_breather").exists():
        rows += rows_of(folder / "petsc_breather")
    else:
        print("PETSc is left out: petsc_breather was not built, because petsc-dev was not found")
    if SOURCE.exists() and pathlib.Path("/usr/include/deal.II").exists():
        rows += step_25(folder.parent / "step-25")
    else:
        print("deal.II is left out: libdeal.ii-dev or libdeal.ii-doc is not installed")
    print_times(rows)
    return rows


if __name__ == "__main__":
    main(*sys.argv[1:])
