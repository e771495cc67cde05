#!/usr/bin/python3
"""Makes src/foundation/simd/elliptic_fit.hpp, the polynomials of the pulse solver's kernels: fit_elliptic.py [FILE]. About 3 s.

K = P(m1) - ln(m1) Q(m1),  E = 1 + m1 (PE(m1) - ln(m1) QE(m1))  for 0 < m1 = s^2 <= TOP, the two polynomials of a pair
fitted together to least relative error: least squares on nodes that are denser at 0, reweighted by the errors until
they level (Lawson). The constant terms are those of the expansion about m1 = 0 and stay exact, so the error vanishes
there. The largest error on the nodes is printed with each pair and checked.
"""
import pathlib
import sys
sys.dont_write_bytecode = True
from mpmath import atanh, cos, log, lu_solve, matrix, mp, mpf, nstr, pi, sqrt
from oracle import complete

TOP = mpf(0.9)**2
LN4 = log(mpf(4))


def level(basis, target, nodes, rounds=25):
    """Coefficients of the smallest largest |sum c_j basis_j - target| on the nodes, and that error."""
    rows, wanted = [basis(x) for x in nodes], [target(x) for x in nodes]
    n, weights, best = len(rows[0]), [mpf(1)] * len(nodes), None
    for _ in range(rounds):
        normal, right = matrix(n, n), matrix(n, 1)
        for i in range(n):
            weighted = [w * row[i] for w, row in zip(weights, rows)]
            right[i] = sum(a * b for a, b in zip(weighted, wanted))
            for j in range(i + 1):
                normal[i, j] = normal[j, i] = sum(a * row[j] for a, row in zip(weighted, rows))
        c = lu_solve(normal, right)
        errors = [abs(sum(a * b for a, b in zip(c, row)) - y) for row, y in zip(rows, wanted)]
        if best is None or max(errors) < best[1]:
            best = list(c), max(errors)
        weights = [w * e for w, e in zip(weights, errors)]
        total = sum(weights)
        weights = [w / total for w in weights]
    return best


def towards_zero(count, top, power):
    return [top * ((1 - cos(pi * (k + mpf(1) / 2) / count)) / 2)**power for k in range(count)]


def pairs(degree):
    """K's P and Q, then E's PE and QE, to x^degree in K and in E."""
    nodes = towards_zero(10 * degree, TOP, 2)
    value = {x: complete(x) for x in nodes}
    fits = []
    for which, lowest, fixed in ((0, 1, (LN4, mpf(1) / 2)), (1, 2, (LN4 / 2 - mpf(1) / 4, mpf(1) / 4))):
        def basis(x):
            powers = [x**k / value[x][which] for k in range(lowest, degree + 1)]
            return powers + [-log(x) * p for p in powers]

        def target(x):
            known = fixed[0] - log(x) * fixed[1]
            return 1 - (1 + x * known if which else known) / value[x][which]
        c, error = level(basis, target, nodes)
        half = len(c) // 2
        fits.append(([fixed[0], *c[:half]], [fixed[1], *c[half:]], error))
    return fits


def fit_atanh(terms, top):
    """2 atanh(h) / h - 2 = z A(z), z = h^2 <= top."""
    return level(lambda z: [z**(k + 1) / 2 for k in range(terms)], lambda z: atanh(sqrt(z)) / sqrt(z) - 1,
                 towards_zero(10 * terms, top, 1))


def fit_log(terms):
    """ln(1 + g) = g L(g) for sqrt(1/2) <= 1 + g <= sqrt(2)."""
    low, high = sqrt(mpf(1) / 2) - 1, sqrt(mpf(2)) - 1
    nodes = [low + x for x in towards_zero(10 * terms, high - low, 1)]
    return level(lambda g: [g**(k + 1) / log(1 + g) for k in range(terms)], lambda g: mpf(1), nodes)


def main():
    lines = ["#pragma once", "",
             "// Made by tests/reference/fit_elliptic.py, which says what these are; remake, do not edit.", "// clang-format off", "",
             "namespace slipfront::pulse::fit {", ""]

    def put(kind, name, values, note, suffix=""):
        lines.append(f"/// {note}")
        lines.append(f"inline constexpr {kind} {name}[] = {{")
        digits = 9 if suffix else 17
        lines.extend(f"    {nstr(v, digits, min_fixed=1, max_fixed=0, strip_zeros=False)}{suffix}," for v in values)
        lines.extend(["};", ""])
    with mp.workdps(60):
        lines += ["/// The largest s = sqrt(m1) that these hold for.", f"inline constexpr double largest_s = {float(sqrt(TOP))};", ""]
        for kind, suffix, names, degree, allowed in (("double", "", ("K", "E"), 9, mpf("6e-17")),
                                                     ("float", "f", ("K_float", "E_float"), 4, mpf("3e-8"))):
            for name, (p, q, error) in zip(names, pairs(degree)):
                assert error < allowed, (name, error)
                put(kind, name, p, f"Relative error {nstr(error, 2)}, before rounding; this part and", suffix)
                put(kind, name + "_log", q, "this times -ln m1.", suffix)
        c, error = fit_atanh(7, mpf("0.0413"))
        assert error < mpf("2e-17"), error
        put("double", "atanh_tail", c, f"2 atanh(h) / h - 2 over h^2, for h^2 < 0.0413; error {nstr(error, 2)}.")
        c, error = fit_log(8)
        assert error < mpf("1e-6"), error
        put("float", "log_over_g", c, f"ln(1 + g) / g within a factor of sqrt(2) of 1; relative error {nstr(error, 2)}.", "f")
    lines.append("}  // namespace slipfront::pulse::fit")
    path = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).parents[2] / "src/foundation/simd/elliptic_fit.hpp"
    path.write_text("\n".join(lines) + "\n", encoding="ascii")


if __name__ == "__main__":
    main()
