"""
A heterogeneous fault: what stops a slip pulse
==============================================

Your fault has patches of high and low stress, a strong barrier, and friction with a strength. At
the end of this tutorial you have the slip pulse on it in space and time, and you know what stopped
it. You have also computed the same fault with every single dislocation, and know how far the two
results agree.

slipfront has two solvers for one scenario. ``pulse`` solves averaged equations and takes a second.
``chain`` follows every dislocation, the unit of slip in this theory, and averages nothing.
"""

# %%
# Describe the fault
# ------------------
#
# The stress before the rupture is a formula of the position x. On the left it is 0.85, with a patch
# of high stress near x = 0 and a patch of low stress around x = -2.6, as an older event leaves it.
# On the right of x = 0 there is no stress: that side has slipped before.
#
# The **contact profile** a(x) is the contact ratio at x over that of the rest of the fault. The
# contact ratio A is the real area of contact over the nominal area. Around x = 0.5 it is 1.8 times
# larger: a barrier.

import pathlib
import warnings

import matplotlib.pyplot as plt
import numpy as np

import slipfront
from slipfront import plots

HIGH = "0.3*exp(-((x + 0.5)/0.5)^2)"
LOW = "0.35*exp(-((x + 2.6)/0.5)^2)"
fault = {
    "title": "A heterogeneous fault",
    "initial": {"profile": "formula", "formula": f"x < 0 ? 0.85 + {HIGH} - {LOW} : 0"},
    "interface": {"contact": "1 + 0.8*exp(-((x - 0.5)/0.15)^2)"},
    "friction": {
        "law": "rate-and-state",
        "strength": 0.05,
        "direct_effect": 0.01,
        "evolution_effect": 0.015,
        "reference_velocity": 0.05,
        "characteristic_slip": 0.05,
    },
    "domain": {"left": -5, "right": 1.5},
    "time": {"end": 8},
    "pulse": {"cells": 200},
    "output": {"every": 0.1},
}

plt.style.use(pathlib.Path(slipfront.__file__).with_name("slipfront.mplstyle"))
x = np.linspace(-5, 1.5, 1001)
high, low = 0.3 * np.exp(-((x + 0.5) / 0.5) ** 2), 0.35 * np.exp(-((x + 2.6) / 0.5) ** 2)
figure_fault, axes = plt.subplots(figsize=(7, 2.5))
axes.plot(x, np.where(x < 0, 0.85 + high - low, 0), label="stress before, μA / π")
axes.plot(x, 1 + 0.8 * np.exp(-((x - 0.5) / 0.15) ** 2), label="contact profile a(x)")
axes.set(xlabel="position x, b / A")
axes.legend()

# %%
# Friction has rate and state. Its strength of 0.05 holds small differences of stress at rest, and
# it weakens a little as the fault slips faster.
#
# The numbers of the scenario have no units, so that one run serves all faults. To see what they
# mean on yours, choose the rock, the contact ratio A and the asperity spacing b. Here A is 0.003
# and b is 1 cm:

c = slipfront.medium.speed_from_p_wave(6000, 0.3)
units = slipfront.medium.units(30e9, float(c), 0.003, 0.01)
print(f"position x in b / A              {units['length']:.3g} m")
print(f"time in b / (c A)                {1e3 * units['time']:.3g} ms")
print(f"stress in mu A / pi              {units['stress'] / 1e6:.3g} MPa")
print(f"slip velocity in c A / pi        {units['slip_velocity']:.3g} m/s")
force = slipfront.medium.traction_unit(30e9, 0.3, 0.003)
print(f"friction in mu A^2/(pi (1 - nu)) {force / 1e6:.2g} MPa")

# %%
# Here c (m/s) is the speed of strain waves, mu the shear modulus and nu Poisson's ratio.
#
# Compute the pulse
# -----------------

pulse = slipfront.pulse(fault)
slip, error = pulse.attrs["slip_at_origin"], pulse.attrs["slip_at_origin_error"]
print(f"slip at x = 0 is {slip:.4f} +- {error:.4f} b / (2 pi)")
# sphinx_gallery_thumbnail_number = 2
figure_map = plots.space_time(pulse)

# %%
# Time runs upwards. In the left map the rupture starts at x = 0, where the stress is steepest. The
# patch of high stress relaxes to both sides. To its right the fault slips forward (orange). To its
# left the stress rises with x, and the fault slips backward (violet).
#
# Two things happen next. The leading edge V+ runs into the barrier and stops there at t = 2. Slip
# then returns from the barrier as a weak violet wave. And the violet front on the left slows down
# and ends at the patch of low stress. The line V- belongs to the far flank of that patch, which
# slips a little from the start.
#
# The profiles show the result.

figure_profiles = plots.profiles(pulse)

# %%
# The patch of high stress is gone, and its stress has spread to both sides. The patch of low stress
# is still there: friction has enough strength to hold it. The last two lines cover each other, so
# the fault has come to rest but for a slow creep.
#
# Find what stopped it
# --------------------
#
# An experiment answers this better than a picture. We remove one thing at a time. ``set`` replaces
# a key of the scenario; a friction of another law needs a new table.

viscous = {**fault, "friction": {"law": "viscous", "coefficient": 0.3}}
cases = {
    "as it is": (fault, {}),
    "without the barrier": (fault, {"interface.contact": "1"}),
    "without the high patch": (fault, {"initial.formula": f"x < 0 ? 0.85 - {LOW} : 0"}),
    "without the low patch": (fault, {"initial.formula": f"x < 0 ? 0.85 + {HIGH} : 0"}),
    "no barrier, no strength": (viscous, {"interface.contact": "1"}),
}
print("                         leading edge  slip at x = 0  largest |W| at the end")
for name, (scenario, changes) in cases.items():
    run = slipfront.pulse(scenario, set=changes, errors=False)
    edge, last = run.attrs["leading_front"], float(abs(run.W.isel(time=-1)).max())
    print(f"{name:25}{edge:12.3f}{run.attrs['slip_at_origin']:15.3f}{last:24.4f}")

# %%
# The table gives the answer:
#
# - **The barrier stops the leading edge.** Without it the edge runs more than twice as far.
# - **Strength would have stopped it too.** Without the barrier, the pulse still ends. But with
#   viscous friction, which has no strength, the edge runs on and the fault still slips at the end.
# - **The high patch drives the pulse.** Without it the slip is little more than a third.
# - **The low patch does not matter** for the slip at x = 0. It only stops the backward slip on the
#   left.
#
# Why does a barrier stop a pulse? A dislocation has more energy where there is more contact. It
# must climb the barrier, and only the pressure of the dislocations behind it can push it up.
# Friction takes the energy that is left:

energy = pulse.isel(time=-1)
released = float(pulse.energy_elastic[0] - energy.energy_elastic)
print(f"elastic energy released     {released:.4f}")
print(f"  of it taken by friction   {float(energy.energy_dissipated) / released:.1%}")
print(f"  lost where trains cross   {float(energy.energy_shocks) / released:.1%}")
print(f"  still in motion           {float(energy.energy_kinetic) / released:.1%}")

# %%
# The loss where trains cross needs attention. Averages know one train of dislocations at each
# position. Where the pulse meets the barrier, some dislocations return while others still arrive.
# The averages cannot hold both, and this energy is lost.
#
# Compare with every dislocation
# ------------------------------
#
# How good are the averages then? The chain runs the same scenario. ``scale`` stretches the fault:
# lengths, times and slip are multiplied by it, and friction is divided by it. The averages are
# equal at every scale. But a larger scale has more dislocations, and so it is closer to the
# averages. The chain warns that our scales are coarse. We compare two of them and switch the
# warning off.

warnings.filterwarnings("ignore", message="chain: .* dislocations at scale")
runs = {"pulse": pulse}
free = {"pulse": slipfront.pulse(fault, set={"interface.contact": "1"}, errors=False)}
for scale in (100, 200):
    name, changes = f"chain, scale {scale}", {"chain.scale": scale}
    runs[name] = slipfront.chain(fault, set=changes)
    free[name] = slipfront.chain(fault, set={**changes, "interface.contact": "1"})

print("                  dislocations  leading edge  slip at x = 0  without the barrier")
for name, run in runs.items():
    slip, without = run.attrs["slip_at_origin"], free[name].attrs["slip_at_origin"]
    print(f"{name:18}{run.attrs.get('dislocations', '-'):>12}"
          f"{run.attrs['leading_front']:14.3f}{slip:15.4f}{without:21.4f}")

figure_slip, axes = plt.subplots(figsize=(7, 3))
for name, run in runs.items():
    axes.plot(run.x, run.slip.isel(time=-1), label=name)
axes.set(xlabel="position x, b / A", ylabel="slip at the end, b / (2π)")
axes.legend()

# %%
# All three agree on what happened, and on the shape of the slip. Single dislocations show as small
# steps of the chains on the left.
#
# The numbers differ most where the energy was lost. Without the barrier, the slip of the pulse is
# within 2 % of both chains. With it, the pulse slips 6 to 7 % more than the chains. Longer runs
# of the chain confirm this: at scale 800 its slip is 0.187 with the barrier and 0.291 without. So
# use the pulse to explore a fault, and the chain to check where trains cross.
#
# At scale 200 the fault has 133 dislocations, and six of them passed x = 0. With the constants
# above, its 6.5 units of length are then 6.5 times 3.33 m times 200, which is 4.3 km.
#
# Your own fault
# --------------
#
# Change the formulas of stress and contact, and move both ends of ``domain`` far away from the
# rupture. Check three things before you trust a run:
#
# - the error of the slip, which ``pulse`` estimates with fewer cells;
# - ``first_crossing_time`` and the energy lost where trains cross;
# - that no front has reached an end of the domain.

print("trains first cross at t =", pulse.attrs["first_crossing_time"])
print("leading edge at", round(pulse.attrs["leading_front"], 3), "of", fault["domain"])

# %%
# Here slipfront reports no crossing, although energy was lost at the barrier. So always look at the
# energy too.
#
# **Limits.** The fault is a line, and it has no waves that leave it. A steep contact profile that
# stress does not balance moves dislocations before the rupture. The key ``hold`` of ``initial``
# keeps such a stress at rest.
#
# You can read on in :doc:`/docs/pulse` for the errors of averages, in :doc:`/docs/chain` for the
# chain, and in :doc:`/docs/friction` for other laws.
