"""Growth rates of steady sliding of a chain with a weakening patch between strengthening ends, by the eigenvalues of the linear system.

    u'' = (u_before - 2 u + u_after) / h^2 + kappa (v t - u) + F - f(u', theta),    theta' = 1 - u' theta / D
    f = a asinh((w / 2 w0) exp((f0 + b ln(theta w0 / D)) / a))

F is the friction of steady sliding at v, which all sites then do. The script prints the rate, the part of the eigenvalue that is real, for
patches of several numbers of sites, and the smallest patch that grows: numbers of tests/chain/implicit/patch_stability_test.cpp.
"""

import numpy as np

SITES, SPACING, KAPPA, V = 80, 2.0, 0.001, 0.001
F0, A, D, W0 = 0.05, 0.01, 1.0, 0.01


def rate(patch):
    """The largest real part of the eigenvalues with `patch` weakening sites in the middle, and its imaginary part."""
    b = np.full(SITES, 0.005)
    b[(SITES - patch) // 2:(SITES + patch) // 2] = 0.018
    couple = np.diag(np.full(SITES, -2.0)) + np.diag(np.ones(SITES - 1), 1) + np.diag(np.ones(SITES - 1), -1)
    couple[0, 1] = couple[-1, -2] = 2
    z = V / (2 * W0) * np.exp((F0 + b * np.log(W0 / V)) / A)
    share = z / np.sqrt(1 + z**2)
    one, none = np.eye(SITES), np.zeros((SITES, SITES))
    system = np.block([[none, one, none], [couple / SPACING**2 - KAPPA * one, -np.diag(A / V * share), -np.diag(b * share)],
                       [none, -one / D, -V / D * one]])
    values = np.linalg.eigvals(system)
    worst = values[values.real.argmax()]
    return worst.real, abs(worst.imag)


def main():
    patches = range(2, SITES, 2)
    print("smallest patch that grows:", min(n for n in patches if rate(n)[0] > 0))
    for patch in range(12, 41, 4):
        print(f"{patch} sites: rate {rate(patch)[0]:.9g}, frequency {rate(patch)[1]:.9g}")


if __name__ == "__main__":
    main()
