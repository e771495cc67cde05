#!/usr/bin/python3
"""Makes the high-precision reference tables of slipfront's tests: make_tables.py [table ...] [--out DIR].

Inputs are doubles, printed so that they read back as the same double. Results are computed from the exact value of the double
(oracle.py), at two precisions that must agree to 28 digits, and printed with 25 digits. If there is a second method, the
script checks each table with it and stops if the check fails.
"""
import argparse
import math
import pathlib
import random
import sys
sys.dont_write_bytecode = True  # the tables' folder holds sources and tables only
from mpmath import (asinh, atanh, cos, ellipe, ellipk, exp, log, mp, mpf, nstr, pi, quad, sech, sin, sinh, sqrt, tanh)
from oracle import (DIGITS, amplitude, averages_by_formula, averages_by_quadrature, carlson_rf, complete, psi_of,
                    psi_of_stress, pulse, rapidity, riemann, slip_velocity, trains, twice)


def decades(exponents):
    return [float(f"1e{n}") for n in exponents]


def table_complete():
    """K and E as functions of m1. mpmath's ellipk and ellipe, with the digits that 1 - m1 needs, check the AGM."""
    values = decades(range(-308, -12, 4)) + [10**(-n / 4) for n in range(48, 0, -1)]
    values += [n / 100 for n in range(40, 61)] + [2.2250738585072014e-308, 3.7e-155, 7.3e-17, 0.9, 0.99, 0.999]
    values += [1 - 1e-6, 1 - 1e-9, 1 - 1e-12, 1 - 2.0**-52, 1 - 2.0**-53, 1.0]
    rows = []
    for m1 in sorted(set(values)):
        result = twice(lambda: complete(mpf(m1)))
        with mp.workdps(40 - round(math.log10(m1))):
            other = ellipk(1 - mpf(m1)), ellipe(1 - mpf(m1))
            assert all(abs(a / b - 1) < mpf(10)**-28 for a, b in zip(result, other)), m1
        rows.append([m1, *result])
    return "m1,K,E", rows


def table_psi():
    """K, E and the sound speed as functions of psi. 1 - c0 ~ exp(-4 psi) cancels, so the number of digits grows with psi."""
    def row(psi):
        psi = mpf(psi)
        k, e = complete(tanh(psi)**2)
        c0 = tanh(psi) * k / e
        return [k, e, 1 - c0, c0, atanh(c0)]
    values = [3e-308, 7.77e-155, 1.3e-154] + decades(range(-307, -7, 5)) + [10**(-n / 4) for n in range(32, 0, -1)]
    values += [1, 1.25, 1.5, 2, 2.5, 3, 4, 5, 6, 7, 8, 8.5, 9, 9.5, 10, 12, 15, 18, 19, 20, 25, 30, 40, 60, 100, 170,
               178, 200, 250, 300]
    return "psi,K,E,one_minus_c0,c0,sound_rapidity", [
        [float(psi), *twice(lambda: row(psi), DIGITS + int(1.8 * psi))] for psi in sorted(values)]


def table_jacobi():
    """am, sn, cn and dn. F(am) = z with Carlson's R_F checks each amplitude."""
    def row(z, m1):
        n, rest = amplitude(mpf(z), mpf(m1))
        sign = 1 - 2 * (n % 2)
        s, c = sin(rest), cos(rest)
        dn = sqrt(c * c + m1 * s * s)
        with mp.workdps(50):
            back = s * carlson_rf(c * c, dn * dn, mpf(1)) + 2 * n * carlson_rf(mpf(0), mpf(m1), mpf(1))
            assert abs(back - z) <= mpf(10)**-35 * abs(z), (m1, z)
        return [n * pi + rest, sign * s, sign * c, dn]
    fractions = [0, 1e-8, .1, .25, .5, .75, .9, .99, 1, 1.3, 1.9, 2, 2.7, -.4, -3.2]
    rows = []
    for m1 in [1e-308, 1e-200, 1e-100, 1e-40, 1e-20, 1e-12, 1e-6, 1e-3, .1, .3, .5, .7, .9, .999, 1.0]:
        quarter = complete(mpf(m1))[0]
        for z in [float(f * quarter) for f in fractions] + [1e-3]:
            rows.append([m1, z, *twice(lambda: row(z, m1), 2 * DIGITS + int(-2.2 * math.log10(m1)))])
    return "m1,z,am,sn,cn,dn", rows


def table_train():
    """Averages over one period by quadrature, checked with the closed forms. For tiny psi, only the closed forms are used."""
    rows = []
    for psi in [1e-6, 1e-3, .03, .2, .8, 1.5, 3.0]:
        for phi in [-2.0, -.5, -1e-3, 0.0, .03, .7, 3.0]:
            row = twice(lambda: averages_by_quadrature(mpf(phi), mpf(psi)))
            for a, b in zip(row, twice(lambda: averages_by_formula(mpf(phi), mpf(psi)))):
                assert abs(a - b) <= mpf(10)**-28 * abs(b), (phi, psi)
            rows.append([phi, psi, *row])
    for psi in [1e-20, 1e-150, 1e-300]:
        for phi in [-2.0, 0.0, .7]:
            digits = DIGITS + int(-2 * math.log10(psi))
            rows.append([phi, psi, *twice(lambda: averages_by_formula(mpf(phi), mpf(psi)), digits)])
    return "phi,psi,k,W,sigma2,sigma3,one_minus_cos,P,Q,H,I,J", rows


def relations(given, values, psi_of_value):
    """Rows of pulse() for values of the column `given`. The exact input replaces that column."""
    rows = []
    for value in sorted(set(values)):
        row = twice(lambda: pulse(psi_of_value(mpf(value))))
        assert abs(row[given] / mpf(value) - 1) < mpf(10)**-28
        rows.append([value if i == given else x for i, x in enumerate(row)])
    return ("stress,rupture_velocity,leading_velocity,velocity_ratio,slip_velocity,stress_at_origin,"
            "dislocation_velocity_at_origin,psi,psi_at_origin"), rows


def table_relations_from_velocity():
    """Closed-form pulses from the rupture velocity."""
    values = decades(list(range(-300, -20, 20)) + [-155, -154, -153] + list(range(-20, 0))) + [2.135e-5, 2.14e-5, .003]
    values += [.02, .05, .15, .2, .25, .3, .35, .4, .45, .5, .55, .6, .65, .7, .75, .8, .85, .9, .95, .99, .999, .9999]
    values += [1 - 1e-5, 1 - 1e-6, 1 - 1e-8, 1 - 1e-10, 1 - 1e-12, 1 - 1e-14, 1 - 2.0**-51, 1 - 2.0**-52]
    return relations(1, values, lambda v: psi_of(lambda psi: log(rapidity(psi)) - log(atanh(v))))


def table_relations_from_stress():
    """Closed-form pulses from the stored stress."""
    values = [.0045, .005, .006, .007, .0085, .01, .012, .015, .02, .025, .03, .04, .05, .06, .07, .08, .09, .1, .12,
              .15, .18, .2, .21176, .213, .25, .3, .35, .4, .5, .6, .7, .8, .855, .9, 1.0, 1.03, 1.2, 1.5, 1.8, 2.0,
              2.2, 2.5, 3.0, 4.0, 5.0, 7.0, 10.0, 15.0, 20.0, 30.0, 50.0]
    return relations(0, values, psi_of_stress)


def table_relations_from_slip_velocity():
    """Closed-form pulses from the slip velocity at x = 0."""
    values = decades(list(range(-300, -20, 25)) + list(range(-20, 1))) + [2.6e-7, 4.8e-8]
    values += [.02, .05, .0458, .083, .2, .5, 2.0, 5.0, 10.0, 20.0]

    def psi_of_value(w):
        psi0 = psi_of(lambda psi: log(slip_velocity(psi)) - log(w))
        return psi0 + rapidity(psi0)
    return relations(4, values, psi_of_value)


RIEMANN_PRINTED = {  # step from Sigma- to Sigma+, U = 0: psi*, U*, k*, W*, right edge of the fan, shock; 10 decimals
    (.855, .179): ".0286532627 .0718291137 .6378761420 .0458180779 -.0701295888 .0998484639",
    (1.03, .4): ".0772390381 .1074025664 .8016391862 .0860981059 -.2007657047 .2143667970"}
RIEMANN_CASES = [
    (.5, .2, -.5, .2), (.3, .1, -.2, .4), (2.0, .5, -2.0, .3), (3.0, 1e-3, -3.0, 1e-3),  # collisions: two shocks
    (-.1, .2, .1, .2), (-.05, .5, .5, .3), (-1.0, 1.5, 1.0, 2.0), (-1.5, .3, -1.2, .05),  # two fans
    (0.0, 1.5, 0.0, 1e-9), (0.0, 3.0, 0.0, .01), (0.0, .03, 0.0, 1e-200), (2.0, 2.0, 1.5, 1e-4),  # strong shocks
    (0.0, 1e-9, 0.0, 1e-10), (1e-9, 1e-9, -1e-9, 2e-9), (-1e-9, 3e-9, 1e-9, 1e-9), (0.0, 1e-30, 0.0, 3e-31),
    (0.0, 1e-200, 0.0, 1e-205), (.3, 1e-30, .3, 1e-31), (-.3, 1e-200, -.3, 1e-201),  # slow slip, also on a moving train
    (.7, .4, .5, .1), (1.0, .05, .9, .3), (-.05, .5, .3, .1),  # moving
    (0.0, .1, 0.0, .1 - 1e-9), (.2, .5, .2 + 1e-10, .5), (.2, .5, .2 - 1e-10, .5)]  # weak


def solve_riemann(case):
    """One row of riemann.csv."""
    digits = DIGITS + int(-2 * math.log10(min(case[1], case[3])))  # phi* may differ from phi by as little as psi
    result = twice(lambda: riemann(*map(mpf, case)), digits)
    left, right = ("shock" if result[1] > psi else "fan" for psi in (case[1], case[3]))
    return [*case, *result[:4], left, *result[4:], right]


def table_riemann():
    """Exact Riemann problems of the (k, P) system. The mirror image of each must have the mirrored solution."""
    rows = []
    for stresses, printed in RIEMANN_PRINTED.items():
        psi_left, psi_right = (float(psi_of_stress(mpf(s))) for s in stresses)
        rows.append(solve_riemann((0.0, psi_left, 0.0, psi_right)))
        _, _, _, _, _, psi, k, w, _, _, tail, shock, _, _ = rows[-1]
        for value, text in zip((psi, w / k, k, w, tail, shock), printed.split()):
            assert abs(value - mpf(text)) <= mpf("0.5e-10"), (nstr(value, 12), text)
    rows += [solve_riemann(case) for case in RIEMANN_CASES]
    both = []
    for row in rows:
        phi_left, psi_left, phi_right, psi_right, phi, psi, k, w, kind_left, *speeds, kind_right = row
        mirror = solve_riemann((0 - phi_right, psi_right, 0 - phi_left, psi_left))
        image = [-phi, psi, k, -w, kind_right, *(-s for s in reversed(speeds)), kind_left]
        for a, b in zip(mirror[4:], image):
            assert a == b or abs(a - b) <= mpf(10)**-28 * abs(b), row
        both += [row] if mirror[:4] == row[:4] else [row, mirror]
    return ("phi_left,psi_left,phi_right,psi_right,phi_star,psi_star,k_star,W_star,left_kind,left_head,left_tail,"
            "right_tail,right_head,right_kind"), both


TRAINS = [  # the middle of all bands, and the widths of band, gap, ... band
    (.3, .8), (-1.0, 1e-9), (.1, 5.0),
    (.175, .15, .15, .25), (.5, 1e-9, 1e-9, 1e-9), (1e-8, 2e-7, 3e-8, 1e-7), (.2, 1.0, 1e-9, 1.0), (-.3, 1e-9, 1.0, 1e-9),
    (.05, 5.0, .1, 5.0), (1.5, .01, 2.0, 3.0), (-.4, 1.0, 1e-9, 1e-4), (.1, .2, .1, .3, .05, .4), (-.7, 1e-6, 1e-3, .5, 1e-8, .2)]


def table_trains():
    """Averages of several trains at one position. The flux of energy must equal the momentum, and sum k_i I_i too."""
    def row(centre, widths, digits):
        size = sum(widths) + abs(centre)  # the velocities have this size if it is small
        goal = 40 + (mp.dps - digits) // 5 - min(0, int(2 * math.log10(size)))
        speeds, k, omega, action, flux, p, h, q, energy_flux = trains(centre, widths, goal)
        scale = mpf(10)**-28 * h
        assert abs(energy_flux - p) <= scale and abs(sum(a * b for a, b in zip(k, action)) - p) <= scale
        total = sum(a * b for a, b in zip(omega, action)) + sum(a * b for a, b in zip(k, flux))
        assert abs(total - h - q) <= scale
        return [*speeds, *k, *omega, *action, *flux, p, h, q]
    rows = []
    for centre, *widths in TRAINS:
        digits = 90 + int(-2.2 * len(widths) * min(0, math.log10(min(widths))) + sum(widths))
        result = list(map(text, twice(lambda: row(mpf(centre), list(map(mpf, widths)), digits), digits)))
        n = len(widths) // 2 + 1
        lists = [result[:2 * n], *(result[2 * n + i * n:3 * n + i * n] for i in range(4))]
        rows.append([centre, " ".join(map(text, widths)), *map(" ".join, lists), *result[-3:]])
    return "centre,widths,speeds,k,omega,I,J,P,H,Q", rows


FORCES = {  # law of a scenario: f(w, its parameters, state), and the ranges of its random parameters
    "n-shaped": (lambda w, v, _: v[0] * (w / v[1]) / (1 + (w / v[1])**2), [(.01, 3), (.01, 3)]),
    "flash-heating": (lambda w, v, _: v[1] + (v[0] - v[1]) / (1 + w / v[2]), [(.01, 3), (.01, 3), (.01, 3)]),
    "power": (lambda w, v, _: v[0] * w**v[1], [(.01, 3), (.5, 4)]),
    "rate-and-state": (lambda w, v, theta: v[1] * asinh(
        w / (2 * v[4]) * exp((v[0] + v[2] * log(theta * v[4] / v[3])) / v[1])),
                       [(.01, 1), (.002, .1), (.002, .1), (.001, 1), (.01, 1)]),
}


def table_friction():
    """Mean of the force over slip, <f>_u, of random laws in random trains, as doubles. Checked with u / 2 = pi / 2 - gd(y)."""
    draw = random.Random(15)
    log_uniform = lambda low, high: math.exp(draw.uniform(math.log(low), math.log(high)))
    rows = []
    for i in range(200):
        name = list(FORCES)[i % len(FORCES)]
        force, ranges = FORCES[name]
        values = [log_uniform(*r) for r in ranges]
        phi, psi, theta = log_uniform(1e-4, 3), log_uniform(1e-3, 3), log_uniform(.01, 100)

        def mean():
            speed = lambda v: 2 * sinh(mpf(phi)) * sqrt(sinh(mpf(psi))**2 + sin(v)**2)
            f = lambda v: force(speed(v), list(map(mpf, values)), mpf(theta))
            inner = [psi / 3, psi, 3 * psi, 10 * psi, .3, 1] if psi < .03 else [psi / 3, psi] if psi < 1.5 else [pi / 4]
            return [2 / pi * quad(f, [0, *inner, pi / 2])]
        with mp.workdps(25):
            result = mean()
            other = 2 / pi * quad(lambda y: sech(y) * force(2 * sinh(mpf(phi)) * sqrt(sinh(mpf(psi))**2 + sech(y)**2),
                                                            list(map(mpf, values)), mpf(theta)), [0, 1, 3, 6, 12, 60])
            assert abs(result[0] / other - 1) < mpf(10)**-14, (name, values, phi, psi, result, other)
        rows.append([name, *(values + [0.0] * (5 - len(values))), theta, phi, psi, float(result[0])])
    return "law,v0,v1,v2,v3,v4,theta,phi,psi,mean", rows


# --- output ---------------------------------------------------------------------------------------------------------

TABLES = {name.removeprefix("table_"): f for name, f in list(globals().items()) if name.startswith("table_")}


def text(value):
    """The text of a value: a double in its shortest round-trip form, a result with 25 digits, a word unchanged."""
    if isinstance(value, mpf):
        return nstr(value, 25, min_fixed=1, max_fixed=0)  # always with an exponent
    return value if isinstance(value, str) else repr(value)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("table", nargs="*", help=", ".join(TABLES) + " (default: all)")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path(__file__).parent, help="default: the folder of this script")
    arguments = parser.parse_args()
    if unknown := set(arguments.table) - set(TABLES):
        parser.error(f"no table {', '.join(sorted(unknown))}; there are {', '.join(TABLES)}")
    for name in arguments.table or TABLES:
        with mp.workdps(DIGITS + 40):
            header, rows = TABLES[name]()
            assert all(len(row) == header.count(",") + 1 for row in rows)
            lines = [header] + [",".join(map(text, row)) for row in rows]
        arguments.out.mkdir(parents=True, exist_ok=True)
        (arguments.out / f"{name}.csv").write_text("\n".join(lines) + "\n", encoding="ascii")
        print(f"{name}: {len(rows)} rows", file=sys.stderr)


if __name__ == "__main__":
    main()
