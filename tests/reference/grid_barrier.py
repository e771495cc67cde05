"""Prints a table of the Peierls-Nabarro barrier of the chain's grid and of the lattice. It takes a minute.

A dislocation at rest has more energy if it is centred on a site than if it is between two sites. The force
F = (difference) / (2 h) moves it over this barrier (src/lattice/chain/model/initial_train.hpp). At rest the diamond rule reads
d2 u / h^2 = (1 + d2 / 12) sin u, and the lattice d2 u / h^2 = sin u. We solve them by Newton's method with 40 digits, because
the barrier is far smaller than the error of the energy, which is of order h^4.

Usage: grid_barrier.py [SPACING]...
"""

import sys

import mpmath as mp

mp.mp.dps = 40


def tridiagonal(lower, middle, upper, right):
    """Solves a tridiagonal system. It overwrites `middle` and `right`, and returns the solution in `right`."""
    for j in range(1, len(right)):
        ratio = lower[j] / middle[j - 1]
        middle[j] -= ratio * upper[j - 1]
        right[j] -= ratio * right[j - 1]
    for j in reversed(range(len(right))):
        right[j] = (right[j] - (upper[j] * right[j + 1] if j + 1 < len(right) else 0)) / middle[j]
    return right


def energy(h, share, between):
    """The energy of a dislocation between two sites or on one. share is 1/12 for the diamond rule and 0 for the lattice."""
    half = int(60 / h)
    sites = [j + mp.mpf(1) / 2 for j in range(-half - 1, half + 1)] if between else list(range(-half, half + 1))
    u = [4 * mp.atan(mp.exp(-j * h)) for j in sites]
    n = len(u)
    for _ in range(30):
        sine, cosine = [mp.sin(v) for v in u], [mp.cos(v) for v in u]
        a, s = [2 * mp.pi, *u, mp.mpf(0)], [mp.mpf(0), *sine, mp.mpf(0)]
        error = [(a[j] - 2 * a[j + 1] + a[j + 2]) / h**2 - s[j + 1] - share * (s[j] - 2 * s[j + 1] + s[j + 2]) for j in range(n)]
        off_diagonal = [1 / h**2 - share * c for c in cosine]
        change = tridiagonal([0, *off_diagonal[:-1]], [-2 / h**2 - (1 - 2 * share) * c for c in cosine], [*off_diagonal[1:], 0], [-e for e in error])
        odd = [(change[j] - change[n - 1 - j]) / 2 for j in range(n)]  # u is 2 pi minus its mirror image
        u = [v + d for v, d in zip(u, odd)]
        if max(map(abs, odd)) < mp.mpf(10) ** -34:
            break
    # With v = u - share h^2 sin u, d2 v / h^2 = sin u, and (1 + share d2)^-1 d2 u / h^2 is sin u as well.
    sine = [mp.sin(v) for v in u]
    v = [2 * mp.pi, *(value - share * h**2 * s for value, s in zip(u, sine)), mp.mpf(0)]
    bonds = sum((right - left) ** 2 for left, right in zip(v, v[1:])) / h**2
    return h * (bonds / 2 - share * h**2 * sum(s * s for s in sine) / 2 + sum(1 - mp.cos(value) for value in u))


def main():
    print("h, force of the grid, of the lattice, (40 pi / h^2) exp(-pi^2 / h)")
    for text in sys.argv[1:] or ["0.7", "0.6", "0.5", "0.45", "0.4", "0.35", "0.3", "0.25"]:
        h = mp.mpf(text)
        forces = [(energy(h, share, False) - energy(h, share, True)) / (2 * h) for share in (mp.mpf(1) / 12, mp.mpf(0))]
        print(text, *(mp.nstr(force, 5) for force in [*forces, 40 * mp.pi / h**2 * mp.exp(-(mp.pi**2) / h)]), sep=", ", flush=True)


if __name__ == "__main__":
    main()
