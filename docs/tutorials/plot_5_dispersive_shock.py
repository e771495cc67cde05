"""
A dispersive shock of dislocations
==================================

Without friction, a step of stress does not become a shock. Its dislocations overtake each other,
and there is a wave with two trains at the same position. At the end of this tutorial you have this
wave in closed form, a picture of how it folds, and a smooth profile with three trains at one
position. You have also compared them with every single dislocation.

Positions are in b / A, times in b / (c A), stresses in mu A / pi, and velocities in c. The theory
is on page 9, Several trains at one position.
"""

# %%
# The waves of a step
# -------------------
#
# The stress is 0.855 on the left and 0.6 on the right, and everything is at rest. The exact
# solution depends on x / t only. A fan runs to the left, behind it is a uniform train. From
# x / t = -0.04 to the leading front there are two trains.

import warnings

import matplotlib.pyplot as plt
import numpy as np

import slipfront

LEFT, RIGHT = 0.855, 0.6
exact = slipfront.riemann(LEFT, RIGHT)
for kind, low, high, trains in zip(exact.wave_kind.values, exact.wave_from.values, exact.wave_to.values, exact.wave_trains.values):
    print(f"{kind:12}{low:9.4f} to {high:7.4f}   trains: {trains}")

# %%
# .. code-block:: text
#
#    two-trains    -0.0378 to  0.2282   trains: 2
#
# One train with a shock, as ``slipfront.pulse`` has it by default, is another picture: its front is
# slower, and it slips faster at x = 0.

shocks = slipfront.riemann(LEFT, RIGHT, solution="shocks")
for name, solution in (("two trains", exact), ("one train, shock", shocks)):
    at_origin = float(solution.W.interp(x_over_t=0))
    print(f"{name:18} leading front {solution.right_edge:.4f} c   W(0) {at_origin:.4f} c A / pi")

# %%
# The fold
# --------
#
# Each dislocation has a rapidity r. Without others it would move at tanh(r). A train fills a band of
# rapidities. At rest the band is from -psi to psi, where psi follows from the stress. So at t = 0
# the filled region has two steps at x = 0, from the psi on the left to that on the right.
#
# An edge of a band keeps its rapidity. Its speed depends on all edges at the same position, and
# ``slipfront.train.edge_speeds`` computes it. The lower edge opens as a fan. The upper one has its
# fastest dislocations behind slower ones: it folds over, and between its ends a vertical line
# crosses it three times. These are two bands, so two trains.

below, above = slipfront.train.psi_at_rest([RIGHT, LEFT])
share = np.linspace(0, 1, 200)
lower = -above + (above - below) * share
lower_at = [slipfront.train.edge_speeds([r, above])[0] for r in lower]
upper = below + (above - below) * share
upper_at = [slipfront.train.edge_speeds([-below, below, r, above])[2] for r in upper]

figure, (plane, profile) = plt.subplots(2, 1, figsize=(7, 6), sharex=True, layout="constrained")
ends = np.array([-0.6, 0.3])
plane.plot(np.concatenate(([ends[0]], lower_at, [ends[1]])), np.concatenate(([-above], lower, [-below])), color="C0", label="lower edge")
plane.plot(np.concatenate(([ends[0], upper_at[-1]], upper_at[::-1], [ends[1]])), np.concatenate(([above, above], upper[::-1], [below])), color="C1", label="upper edge")
plane.set(ylabel="rapidity r", title="Edges of the filled region")
plane.legend(loc="lower right")
profile.plot(exact.x_over_t, exact.W, color="C0", label="two trains, exact")
profile.plot(shocks.x_over_t, shocks.W, color="0.6", linestyle="--", label="one train with a shock")
profile.set(xlabel="x / t, c", ylabel="slip velocity W, c A / pi", xlim=ends)
profile.legend()

# %%
# At the leading front the upper band has no width. A few fast dislocations run ahead there, through
# the train on the right. They are faster than tanh(r), because each overtaking shifts them forward.
# At the other end of the fold the gap closes.
#
# Any profile
# -----------
#
# In a smooth profile the edges are curves over x. ``trains = "many"`` follows them, whether they
# fold or not. Here two falls of stress follow each other, and the faster one runs into the slower.

case = slipfront.cases / "overtaking.toml"
many = slipfront.pulse(case, errors=False)
print(f"trains at one position: up to {int(many.trains.max())}")

# %%
# The picture encloses two trains with a solid line, and three with a dashed one.

from slipfront import plots  # noqa: E402

picture = plots.space_time(many)

# %%
# Compare with every dislocation
# ------------------------------
#
# ``chain`` follows each dislocation. At scale 1000 it has about 1000 dislocations.

with warnings.catch_warnings():
    warnings.simplefilter("ignore")  # one train warns where dislocations overtake each other
    one = slipfront.pulse(case, set={"pulse.trains": "one"}, errors=False)
    chain = slipfront.chain(case, set={"chain.scale": 1000})


def error(pulse):
    slip, reference = pulse.slip.isel(time=-1), chain.slip.isel(time=-1)
    return 100 * float(abs(slip - reference).sum() / abs(reference).sum())


print(f"slip over x, difference from the chain: one train {error(one):.1f} %, many trains {error(many):.1f} %")

# %%
# .. code-block:: text
#
#    slip over x, difference from the chain: one train 2.1 %, many trains 0.1 %
#
# The rest is the finite number of dislocations: the difference falls with the scale of the chain,
# to 0.09 % at scale 4000.
#
# Limits
# ------
#
# Several trains are exact without friction and load. Viscous friction and a load may act on two
# trains. With strong friction, one train with shocks is a good approximation
# (``slipfront.pulse`` without ``trains``).
# Where a gap closes, the chain has waves of small amplitude, which the averages do not have.
