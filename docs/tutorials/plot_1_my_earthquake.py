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

rock = {"p_wave_speed": "6 km/s", "poisson_ratio": 0.25, "shear_modulus": "30 GPa"}
front = {"name": "My earthquake", "rupture_velocity": "2.7 +- 0.2 km/s", **rock}
mine = {**front, "slip_velocity": "0.3 */ 1.3 m/s"}

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


# %%
# The rupture velocity bounds the stress
# --------------------------------------
#
# We begin with the rupture velocity only.

one_velocity = slipfront.event(front).isel(event=0)
show(one_velocity, "rupture_velocity", "stress_bound")
print(f"c = {float(one_velocity.c_m_s):.0f} m/s")

# %%
# The rupture velocity is now in units of c, the speed of strain waves along the fault. It follows
# from the rock. The stress is in units of mu A / pi. A is the **contact ratio**: the real area of
# contact over the nominal area, because rough surfaces touch at the tips of their asperities only.
# We do not know A yet.
#
# Why does a velocity determine a stress? In this theory dislocations carry the slip. A fault under
# more stress holds more of them, and the front of a dense train of dislocations is faster. The
# relation has a closed form, which the upper panel shows.

states = slipfront.relations(stress=np.linspace(0.05, 1.5, 200))
figure_relations = plots.relations(states)

# %%
# The curve is that of the first disturbance that reaches a point of the fault. Friction does not
# change its speed, because it runs into a fault at rest. But friction takes away the slip that it
# carries. A seismologist needs a certain slip velocity to see a front. The observed front is where
# the slip velocity is a thousandth of its peak, unless you choose another ``front_threshold``.
# Under friction, that front falls behind the first disturbance.
#
# So your 2.7 km/s may be the speed of a first disturbance on a fault without friction. Or the first
# disturbance was faster, the stress was larger, and friction slowed the front that you saw. The
# stress of the closed form is therefore a lower bound.
#
# Two velocities give intervals
# -----------------------------
#
# The lower panel shows the slip velocity W that belongs to a stress without friction, in units of
# c A / pi. Your slip velocity in m/s is W times this unit, so A follows, and with A the stress in
# Pa. ``draws`` asks for states of the fault that agree with the data.

velocities = slipfront.event(mine, draws=4000).isel(event=0)
show(velocities, "stress", "contact_ratio", "stress_pa", "damping_number")

# %%
# The stress before the rupture was 21 to 200 MPa, and the contact ratio 0.002 to 0.02. These
# intervals span a factor of ten, mostly because you do not know the friction. The **damping
# number** Gamma measures its strength. It is the coefficient C of viscous friction times the age of
# the pulse, in units of b / (c A), with the asperity spacing b. We sort the draws by it:

print("damping number   share of draws   first disturbance, c   contact ratio   stress, MPa")
for low, high in ((0, 1), (1, 10), (10, 100), (100, 1000)):
    number = velocities.draw_damping_number
    draws = velocities.isel(draw=((number >= low) & (number < high)).values)
    speed, contact, pascals = (float(draws[f"draw_{name}"].median())
                               for name in ("characteristic_velocity", "contact_ratio", "stress_pa"))
    share = draws.sizes["draw"] / velocities.sizes["draw"]
    print(f"{low:5} to {high:<6}{share:16.2f}{speed:23.2f}{contact:16.4f}{pascals / 1e6:14.0f}")

# %%
# Friction has two effects. It lowers the slip velocity, so your 0.3 m/s needs a larger A and more
# stress. And it slows the front, so your 2.7 km/s needs a faster first disturbance. The second
# effect limits the first: a disturbance is never faster than c. So damping numbers of several
# hundred cannot explain your velocities, and the stress has an upper bound too.
#
# The lower end of the interval is the fault without friction. All states between agree with your
# velocities. Which of them is the most probable depends on what you assume about friction before
# any data. Quote the interval and not the median. One more measurement narrows it.
#
# Add a static stress drop
# ------------------------
#
# The static stress drop is the stress before the earthquake minus the stress after it, as
# catalogues list it. Drops of 1 to 10 MPa are typical. Let it be 8 MPa, known to a factor of 1.5.

with_drop = slipfront.event({**mine, "stress_drop": "8 */ 1.5 MPa"}, draws=2000)
ALL = ("stress_pa", "static_drop_pa", "contact_ratio", "slip_velocity_ratio", "damping_number")
show(with_drop.isel(event=0), *ALL)

# %%
# The stress is 31 MPa, between 18 and 67 MPa. The drop is not all of it: ``static_drop_pa`` is the
# drop of the states that agree with all your data, and it is a quarter to a third of the stress.
# The rest remains on the fault. If you know that a stress drop means all of the stored stress,
# write ``"stress_drop_is": "stored"``.
#
# ``slip_velocity_ratio`` is the share of the slip velocity that friction has left. It lies between
# a quarter and nearly all. The corner plot shows the reason. Diagonal panels are histograms of one
# quantity. The other panels show pairs, with the regions that hold 50 % and 90 % of the draws.

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

with_contact = slipfront.event({**mine, "contact_ratio": "0.004 */ 2"}).isel(event=0)
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
added = {"nothing": velocities, "contact ratio": with_contact, "stress drop": with_drop.isel(event=0)}
for name, event in added.items():
    print(f"{name:15} {float(event.damping_number_prior_share):30.2f} {float(event.contact_ratio_prior_share):18.2f}")

# %%
# The contact ratio, known to a factor of 2 only, leaves the damping number as uncertain as before.
# The stress drop helps much more. ``slipfront event FILE --json`` has the shares as
# ``prior_share``.
#
# A better measurement narrows the result. How much is a more precise stress drop worth?

print("error of the stress drop   stress, MPa   share of slip velocity that friction leaves")
for factor in (2, 1.5, 1.2, 1.05):
    event = slipfront.event({**mine, "stress_drop": f"8 */ {factor} MPa"}).isel(event=0)
    least, most = event.stress_pa_interval.values / 1e6
    low, high = event.slip_velocity_ratio_interval.values
    print(f"a factor of {factor:<14}{least:3.0f} to {most:3.0f}      {low:.2f} to {high:.2f}")

# %%
# The stress becomes certain: a drop known to 5 % gives it to a factor of 1.4. The share of friction
# hardly does. The slip velocity, known to a factor of 1.3, then sets most of its width.
#
# When the data contradict each other
# -----------------------------------
#
# Let the static drop be 2 MPa. Without friction, your velocities need a larger one, and friction
# makes the difference larger still. slipfront then omits each observation in turn, and predicts it
# from the others:

small_drop = slipfront.event({**mine, "stress_drop": "2 */ 1.5 MPa"}).isel(event=0)
print(textwrap.fill(small_drop.tension.item(), 84))
show(small_drop, "stress_pa", "static_drop_pa")

# %%
# The slip velocity is 3.7 standard deviations above its prediction, and the stress drop is 3.3
# below. The value of ``stress_pa`` is a compromise that none of the three supports. Do not quote
# it. Look for the observation whose meaning differs from that of the theory. A drop from moment and
# size is a mean over the fault, for example, and the drop of the theory is that at x = 0. The
# ``warnings`` give the stress without each observation.
#
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
# **Limits.** The intervals hold for viscous friction. Friction with a strength can slow the first
# disturbance itself, and then the stress is larger. The intervals from two velocities depend on
# ``front_threshold``: state it with your result. Whether faults obey this theory is another
# question: these numbers assume that they do.
#
# You can read on in :doc:`/docs/events`, which lists all quantities, and in
# :doc:`plot_2_slow_slip`, which does this for a catalogue.
