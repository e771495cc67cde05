"""Compare the lattice of Eq. (1) in LAMMPS and in slipfront, on one core each: differences and site updates per second.

The equation is u_tt = (u_{j+1} - 2 u_j + u_{j-1}) / A^2 - sin u_j with A = 0.5, fixed ends and no friction. The initial state
has kinks with U = 0.3 and antikinks with U = -0.3, 20 apart, which collide repeatedly. Velocity Verlet in LAMMPS and leapfrog
in slipfront are identical, with dt = 0.05. In LAMMPS, bonds of rest length 0 are linear, so that the x coordinate of a site
may be u itself. We try several ways to define the substrate and count the fastest. Rates are per second of processor time
(LAMMPS: loop time x CPU use), the best of several runs.

Usage: lammps_chain.py [CHAIN_RUN] [LMP].   Needs the Debian package lammps.
"""

import array
import math
import os
import re
import subprocess
import sys
import tempfile

A, DT, U, APART, MARGIN = 0.5, 0.05, 0.3, 20, 100
SIZES = ((10_000, 4000), (100_000, 400), (1_000_000, 40))  # sites, steps
REPEATS, OURS_LONGER = 5, 20
TURN = 2 * math.pi
ANCHOR, BLOCK = 16.0, 64  # table bonds: distance of an anchor from u = 0, number of sites per anchor
REACH, POINTS = 60.0, 20000  # largest distance in the table, number of its points

# name, pitch of the sites along x, substrate
VARIANTS = (
    ("x = 2 pi j + u, defaults, addforce", TURN, "variable f atom -sin(x)\nfix 2 mobile addforce v_f 0 0\n"),
    ("x = u, addforce -sin(x)", 0, "variable f atom -sin(x)\nfix 2 mobile addforce v_f 0 0\n"),
    ("x = u, setforce fx-sin(x)", 0, "variable f atom fx-sin(x)\nfix 2 mobile setforce v_f 0 0\n"),
    ("x = u, table bonds to fixed atoms", 0, None),
)
DEFAULTS = "comm_modify cutoff 10\n"
LEAN = "atom_modify sort 0 0\ncomm_modify cutoff 1\nneigh_modify once yes\n"


def start(sites):
    """Return u and u_t of a sum of kinks and antikinks."""
    g = 1 / math.sqrt(1 - U * U)
    kinks = int((sites * A - 2 * MARGIN) / APART) // 2 * 2
    u, v = array.array("d"), array.array("d")
    for j in range(sites):
        nearest = (j * A - MARGIN) / APART
        first, last = max(0, math.ceil(nearest - 2.5)), min(kinks, math.floor(nearest + 2.5) + 1)
        near = [(-1 if k % 2 else 1, math.exp(-g * (j * A - MARGIN - k * APART))) for k in range(first, max(first, last))]
        beyond = -TURN if last > 0 and last % 2 else 0  # kinks and antikinks to the right cancel in pairs; one may remain
        u.append(beyond + sum(sign * 4 * math.atan(e) for sign, e in near))
        v.append(sum(4 * g * U * e / (1 + e * e) for _, e in near))
    return u, v


def write_data(folder, u, v, pitch, table):
    n, bonds = len(u), [(1, j, j + 1) for j in range(1, len(u))]
    atoms = [(j + 1, pitch * j + u[j], v[j]) for j in range(n)]
    if table:
        bonds += [(2, j + 1, n + 1 + j // BLOCK) for j in range(1, n - 1)]
        for block in range((n - 1) // BLOCK, -1, -1):
            atoms.insert((block + 1) * BLOCK, (n + 1 + block, -ANCHOR, 0.0))
        low, high = 1.0, REACH
        lines = [f"sine\n\nSUBSTRATE\nN {POINTS} FP {-math.cos(low - ANCHOR)!r} {-math.cos(high - ANCHOR)!r}\n"]
        for k in range(POINTS):
            r = low + (high - low) * k / (POINTS - 1)
            lines.append(f"{k + 1} {r!r} {1 - math.cos(r - ANCHOR)!r} {-math.sin(r - ANCHOR)!r}")
        with open(f"{folder}/table", "w") as file:
            file.write("\n".join(lines) + "\n")
    with open(f"{folder}/data", "w") as file:
        file.write(f"chain\n\n{len(atoms)} atoms\n{len(bonds)} bonds\n1 atom types\n{2 if table else 1} bond types\n"
                   f"{BLOCK + 4} extra special per atom\n-100 {pitch * n + 100} xlo xhi\n-1 1 ylo yhi\n-1 1 zlo zhi\n"
                   "\nMasses\n\n1 1\n\nAtoms\n\n" + "".join(f"{i} 1 1 {x!r} 0 0\n" for i, x, _ in atoms) +
                   "\nVelocities\n\n" + "".join(f"{i} {w!r} 0 0\n" for i, _, w in atoms) +
                   "\nBonds\n\n" + "".join(f"{k + 1} {t} {i} {j}\n" for k, (t, i, j) in enumerate(bonds)))


def lammps(program, folder, u, v, steps, pitch, substrate):
    """Return the first line that LAMMPS prints, the seconds of each repeat, and u at the end."""
    n, table = len(u), substrate is None
    write_data(folder, u, v, pitch, table)
    K = 1 / (2 * A * A)  # energy K (r - r0)^2
    style, elastic = (f"hybrid harmonic table spline {POINTS}", "harmonic ") if table else ("harmonic", "")
    with open(f"{folder}/in", "w") as file:
        file.write(f"units lj\natom_style bond\nboundary f f f\n{DEFAULTS if pitch else LEAN}"
                   f"special_bonds lj/coul 1 1 1\nbond_style {style}\nread_data data\n"
                   f"bond_coeff 1 {elastic}{K} {pitch!r}\n" + ("bond_coeff 2 table table SUBSTRATE\n" if table else "") +
                   f"group mobile id 2:{n - 1}\nfix 1 mobile nve\n{substrate or ''}timestep {DT}\nrun {steps}\n"
                   "write_dump all custom end id x modify sort id format float %.17g\n")
    seconds = []
    for _ in range(REPEATS):
        out = subprocess.run([program, "-in", "in", "-log", "none"], cwd=folder, capture_output=True, text=True,
                             env={**os.environ, "OMP_NUM_THREADS": "1"})
        if out.returncode:
            sys.exit(f"{program}: {out.stdout[-500:]}")
        wall, = re.findall(r"Loop time of (\S+)", out.stdout)
        percent, = re.findall(r"([\d.]+)% CPU use", out.stdout)
        seconds.append(float(wall) * float(percent) / 100)
    with open(f"{folder}/end") as file:
        rows = file.read().split("ITEM: ATOMS id x\n")[1].split("\n")[:n]
    return out.stdout.split("\n")[0], seconds, [float(row.split()[1]) - pitch * j for j, row in enumerate(rows)]


def ours(program, folder, u, v, steps, how="chain"):
    path = f"{folder}/state"
    with open(path, "wb") as file:
        u.tofile(file)
        v.tofile(file)
    command = [program, path, str(A), str(DT), str(steps), how]
    seconds = float(subprocess.run(command, capture_output=True, check=True).stdout)
    end = array.array("d")
    with open(path + ".out", "rb") as file:
        end.fromfile(file, len(u))
    return seconds, end


def difference(a, b):
    return max(map(lambda p, q: abs(p - q), a, b))


def main(chain_run="build/release/bin/chain_run", lmp="lmp"):
    """Returns, for each number of sites, the rate of slipfront over those of LAMMPS, in doubles and with phases of 32 bits,
    and over that of the plain loop."""
    ratios = []
    with tempfile.TemporaryDirectory() as folder:
        for sites, steps in SIZES:
            u, v = start(sites)
            plain_seconds, plain = ours(chain_run, folder, u, v, steps, "plain")
            chain, single = (ours(chain_run, folder, u, v, steps, how)[1] for how in ("chain", "single"))
            longer = steps * OURS_LONGER
            rate, single_rate = (sites * longer / min(ours(chain_run, folder, u, v, longer, how)[0] for _ in range(REPEATS))
                                 for how in ("chain", "single"))
            print(f"{sites} sites, {steps} steps, in which u changes by up to {difference(u, plain):.1f}. Largest difference of u\n"
                  "from slipfront and from a plain leapfrog loop with the sine of the C library:")
            print(f"{'':<42}{'slipfront':>10}{'plain':>10}{'M sites/s':>11}{'slipfront is':>14}")
            print(f"{'slipfront':<42}{'':>10}{difference(chain, plain):>10.1e}{rate / 1e6:>11.1f}")
            print(f"{'slipfront, phases of 32 bits':<42}{difference(single, chain):>10.1e}{difference(single, plain):>10.1e}"
                  f"{single_rate / 1e6:>11.1f}")
            best = 0
            for name, pitch, substrate in VARIANTS:
                version, seconds, end = lammps(lmp, folder, u, v, steps, pitch, substrate)
                theirs = sites * steps / min(seconds)
                best = max(best, theirs)
                print(f"{name:<42}{difference(end, chain):>10.1e}{difference(end, plain):>10.1e}{theirs / 1e6:>11.1f}"
                      f"{rate / theirs:>8.0f} times")
            print(f"{'plain leapfrog':<42}{difference(chain, plain):>10.1e}{'':>10}"
                  f"{sites * steps / plain_seconds / 1e6:>11.1f}")
            print(f"{version}: slipfront is {rate / best:.0f} times as fast as its fastest variant\n", flush=True)
            ratios.append((rate / best, single_rate / best, rate * plain_seconds / sites / steps))
    return ratios


if __name__ == "__main__":
    main(*sys.argv[1:])
