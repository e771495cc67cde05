"""Writes cases/synthetic-laboratory-fronts.csv: fronts that the theory itself produces, as an example for `slipfront laboratory`.

Usage: synthetic_fronts.py

No experiment is behind these numbers. The material is a glassy polymer with a Poisson's ratio of 0.35 and an S-wave speed of 1300 m/s. Its
hardness over modulus is 0.20, and the single fronts scatter about it by 6 % (one standard deviation). Front velocity and stress drop have
measurement errors of 10 %, and both stresses have errors of 2 %. One more front runs faster than c; the theory has no such fronts.
"""

import csv
import math
import pathlib
import random

import slipfront

POISSON_RATIO, S_WAVE_SPEED = 0.35, 1300.0
HARDNESS_OVER_MODULUS, SCATTER = 0.20, 0.06
STRESS_ERROR, OTHER_ERROR = 1.02, 1.10  # factors of one standard deviation
FRONTS, NORMAL_STRESS = 14, 5.0  # MPa
OUTPUT = pathlib.Path(__file__).parent.parent / "cases" / "synthetic-laboratory-fronts.csv"


def front(number, shear_stress, draws):
    """Returns the row of a front whose measured shear stress is given, in MPa."""
    factor = math.pi * HARDNESS_OVER_MODULUS / float(slipfront.medium.plastic_contact_ratio(POISSON_RATIO))
    true_shear, true_normal = shear_stress * STRESS_ERROR ** draws.gauss(0, 1), NORMAL_STRESS * STRESS_ERROR ** draws.gauss(0, 1)
    state = slipfront.relations(stress=factor * true_shear / true_normal * math.exp(SCATTER * draws.gauss(0, 1)))
    speed = float(slipfront.medium.speed_from_s_wave(S_WAVE_SPEED, POISSON_RATIO))
    velocity = speed * float(state.rupture_velocity) * OTHER_ERROR ** draws.gauss(0, 1)
    drop = true_shear * float(1 - state.stress_at_origin / state.stress) * OTHER_ERROR ** draws.gauss(0, 1)
    return [f"front {number}", f"{shear_stress:.2f} */ {STRESS_ERROR}", f"{NORMAL_STRESS} */ {STRESS_ERROR}", f"{velocity:.1f} */ {OTHER_ERROR}",
            f"{drop:.3f} */ {OTHER_ERROR}" if number % 2 else ""]


def main():
    draws = random.Random(1)
    rows = [front(i + 1, 1.8 + 2.6 * i / (FRONTS - 1), draws) for i in range(FRONTS)]
    rows.append([f"front {FRONTS + 1}", f"4.50 */ {STRESS_ERROR}", f"{NORMAL_STRESS} */ {STRESS_ERROR}", f"2400 */ {OTHER_ERROR}", ""])
    with OUTPUT.open("w", newline="", encoding="utf-8") as file:
        file.write("# Synthetic: computed by docs/synthetic_fronts.py from the theory with noise. These are no measurements.\n")
        out = csv.writer(file, lineterminator="\n")
        out.writerow(["name", "tau [MPa]", "normal_stress [MPa]", "front_velocity [m/s]", "stress_drop [MPa]"])
        out.writerows(rows)


if __name__ == "__main__":
    main()
