"""
My earthquake: from velocities to stress and friction
=====================================================

You know how fast an earthquake ruptured and how fast it slipped. At the end of this tutorial you
have its stress, its contact ratio and its friction, each with a 90 % interval. You also know which
of these numbers your data decide.

Seismologists measure two velocities. The **rupture velocity** V (m/s) is that of the rupture front.
The **slip velocity** w (m/s) is that of one side of the fault against the other. slipfront relates
both to the stress on the fault before the rupture.
"""

# %%
# Write down what you measured
# ----------------------------
#
# An event is a ``dict``. A quantity is a text with its number, its unit and, if you know it, its
# error. ``+-`` gives a standard deviation, and ``*/`` gives a factor. Here the slip velocity is
# known to a factor of 1.3. The last three lines describe the rock: the speed of P waves, Poisson's
# ratio nu, and the shear modulus mu.

import textwrap

import numpy as np

import slipfront
from slipfront import plots

mine = {
    "name": "My earthquake",
    "rupture_velocity": "2.7 +- 0.2 km/s",
    "slip_velocity": "0.5 */ 1.3 m/s",
    "p_wave_speed": "6 km/s",
    "poisson_ratio": 0.25,
    "shear_modulus": "30 GPa",
}
velocities = slipfront.event(mine).isel(event=0)

# %%
# The result is an xarray Dataset. Most quantities have a value, and an interval with the 5 % and
# the 95 % quantile. This function prints them. A missing value is NaN, "not a number".


def show(event, *names):
    for name in names:
        value = event[name]
        low, high = event[f"{name}_interval"].values
        unit = value.attrs.get("dimensional_unit") or value.attrs["units"]
        interval = f"[{low:.4g}, {high:.4g}]"
        print(f"{name:27}{float(value):9.4g}   {interval:22}", "" if unit == "1" else unit)


show(velocities, "rupture_velocity", "stress")

# %%
# The rupture velocity gives the stress
# -------------------------------------
#
# The rupture velocity is now in units of c, the speed of strain waves along the fault. It follows
# from the rock:

print(f"c = {float(velocities.c_m_s):.0f} m/s")

# %%
# The stress is in units of mu A / pi. A is the **contact ratio**: the real area of contact over the
# nominal area, because rough surfaces touch at the tips of their asperities only. We do not know A
# yet.
#
# Why does one velocity fix the stress? In this theory dislocations carry the slip. A fault under
# more stress holds more of them, and the front of a dense train of dislocations is faster. The
# relation has a closed form, which the upper panel shows.

states = slipfront.relations(stress=np.linspace(0.05, 1.5, 200))
figure_relations = plots.relations(states)

# %%
# The blue curve is steep: an error of 7 % in the rupture velocity becomes one of 4 % in the
# stress. The curve is that of a fault without friction. But viscous friction does not change the
# velocity of the fast front, because it runs into a fault at rest. So this stress holds with
# friction too.
#
# The slip velocity gives a bound
# -------------------------------
#
# The lower panel shows the slip velocity W that belongs to that stress, in units of c A / pi. Your
# slip velocity in m/s must be W times this unit, and the only unknown is A. So A follows, and with
# A the stress in Pa.

show(velocities, "frictionless_slip_velocity", "contact_ratio", "stress_pa_bound")
show(velocities, "stress_pa")
print()
print(textwrap.fill(velocities.warnings.item(), 84))

# %%
# The stress in Pa is missing, and there is only a bound: 33 MPa or more. The warning gives the
# reason. Friction lowers the slip velocity. If friction was strong, your 0.5 m/s is only a small
# share of the slip velocity without friction. A larger A then explains the same observation, and
# the stress is larger too.
#
# The **damping number** Gamma measures the strength of friction. It is the coefficient C of viscous
# friction times the age of the pulse, in units of b / (c A), with the asperity spacing b.
# ``friction_ratio`` gives the share of the slip velocity that remains. We can therefore follow A
# and the stress along all values of friction:

stress, c = float(velocities.stress), float(velocities.c_m_s)
frictionless = float(velocities.frictionless_slip_velocity)
print("damping number   share of slip velocity   contact ratio   stress, MPa")
for damping in (0, 1, 10, 100):
    share = float(slipfront.friction_ratio(stress, damping).ratio)
    contact = np.pi * 0.5 / (c * frictionless * share)
    pascals = stress * slipfront.medium.stress_unit(30e9, contact)
    print(f"{damping:14} {share:24.3f} {contact:15.4f} {pascals / 1e6:13.0f}")

# %%
# All four lines agree with both of your velocities equally well. No amount of better velocities
# would select one. You need one more measurement.
#
# Add a stress drop, and the bound becomes a value
# ------------------------------------------------
#
# A stress drop of 60 MPa, known to a factor of 1.5, is such a measurement. slipfront takes it for
# all of the stress that was stored. ``draws`` asks for states of the fault that agree with the
# data.

with_drop = slipfront.event({**mine, "stress_drop": "60 */ 1.5 MPa"}, draws=2000)
ALL = ("stress", "contact_ratio", "stress_pa", "slip_velocity_ratio", "damping_number")
show(with_drop.isel(event=0), *ALL)

# %%
# Every line now has a value, the median of the posterior distribution. Friction has left about half
# of the slip velocity. But this share has a wide interval: from a fifth to nearly all.
#
# The corner plot shows the reason. Diagonal panels are histograms of one quantity. The other panels
# show pairs, with the regions that hold 50 % and 90 % of the draws.

# sphinx_gallery_thumbnail_number = 2
figure_corner = plots.corner(with_drop)

# %%
# In the panel of contact ratio and damping number, the draws follow a rising band: a larger contact
# ratio needs more friction. Along this band the slip velocity is the same. The stress drop decides
# where on it your earthquake is. Stress in MPa and contact ratio lie on a line, because the unit of
# stress is in proportion to A.
#
# Or add a contact ratio
# ----------------------
#
# Perhaps you know the contact ratio instead, for example from the normal stress and the hardness of
# the rock. Here we assume a factor of 2 for its error.

with_contact = slipfront.event({**mine, "contact_ratio": "0.008 */ 2"}).isel(event=0)
show(with_contact, *ALL)

# %%
# What do the data decide?
# ------------------------
#
# A median always looks like a measurement. Before you quote it, ask how much of its interval comes
# from the data. Before any data, slipfront takes ln(1 + damping number) as uniform from 0 to a
# damping number of 1e8. It takes ln(A) as uniform from 1e-8 to the contact ratio at which rock
# yields. The **prior share** is the width of an interval over that of this prior. Near 1 your data
# say nothing, and near 0 they decide everything.

print("you add          prior share of damping number   of contact ratio")
added = {"stress drop": with_drop.isel(event=0), "contact ratio": with_contact}
for name, event in added.items():
    print(f"{name:15} {float(event.damping_number_prior_share):30.2f} {float(event.contact_ratio_prior_share):18.2f}")

# %%
# Both measurements leave small shares, so your data decide. The contact ratio was known to a factor
# of 2 only, and it leaves more to the prior than the stress drop. With velocities only, both shares
# would be 1, and slipfront prints no median at all. ``slipfront event FILE --json`` has the shares as
# ``prior_share``.
#
# A better measurement narrows the result. How much is a more precise stress drop worth?

print("error of the stress drop   share of slip velocity that friction leaves")
for factor in (2, 1.5, 1.2, 1.05):
    event = slipfront.event({**mine, "stress_drop": f"60 */ {factor} MPa"}).isel(event=0)
    low, high = event.slip_velocity_ratio_interval.values
    print(f"a factor of {factor:<14} {low:.2f} to {high:.2f}")

# %%
# Below a factor of 1.2 little is gained. The slip velocity, known to a factor of 1.3, then sets
# most of the width. With a better slip velocity the interval is narrow:

better = {"slip_velocity": "0.5 */ 1.05 m/s", "stress_drop": "60 */ 1.05 MPa"}
event = slipfront.event({**mine, **better}).isel(event=0)
show(event, "slip_velocity_ratio", "damping_number")

# %%
# Your own earthquake
# -------------------
#
# Replace the numbers of ``mine`` by yours, and leave out what you do not know. These forms are
# allowed:
#
# - ``"3.0 +- 0.2 km/s"``: a normal distribution with a standard deviation of 0.2 km/s;
# - ``"0.5 */ 1.2 m/s"``: a lognormal distribution, in which one standard deviation is a factor of
#   1.2;
# - ``"2.8..3.2 km/s"``: any value in the range, all equally likely.
#
# You may give ``slip`` and ``rise_time`` in place of the slip velocity. With ``duration`` and
# ``asperity_spacing``, the result has the friction coefficient C too. A value that the theory does
# not allow is an error, and the message gives the reason:

try:
    slipfront.event({**mine, "rupture_velocity": "5.8 km/s"})
except slipfront.InputError as error:
    print(textwrap.fill(str(error), 84))

# %%
# **Limits.** The intervals hold for viscous friction. Friction with a strength can slow the fast
# front, and then the stress is larger than its velocity implies. Whether faults obey this theory is
# another question: these numbers assume that they do.
#
# You can read on in :doc:`/docs/events`, which lists all quantities, and in
# :doc:`plot_2_slow_slip`, which does this for a catalogue.
