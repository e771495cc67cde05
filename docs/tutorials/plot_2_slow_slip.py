"""
A catalogue of slow slip: from a table to stress and contact
============================================================

You have a table of slow slip events, with gaps and ranges, as published tables are. At the end of
this tutorial you have the stress of each event, a comparison with earthquakes by decades of rupture
velocity, and files to keep.

Two columns matter. The **rupture velocity** is that of the front, from its migration along the
fault. The **slip velocity** is that of one side of the fault against the other. It may be missing,
or follow from slip and duration.
"""

# %%
# Read a table
# ------------
#
# This table has thirteen events of the catalogue that ships with slipfront. The column titles give
# the units. A cell may have its own unit, such as ``30 m/s``, or a range, such as ``2-15``. An
# empty cell means "not observed". The column ``rupture_velocity_how`` describes how a velocity was
# found.

import pathlib
import textwrap

import numpy as np

import slipfront
from slipfront import plots

TABLE = """\
name,kind,rupture_velocity_km_day,rupture_velocity_how,slip_cm,duration_days,slip_velocity,source
Alaska 2012,long-term slow slip,0.581,apparent,7.64,79,,Okada et al. 2023
Guerrero 2006,long-term slow slip,0.8,,5.5,349,,Radiguet et al. 2011
Nankai near the trench,slow slip,1-2,,,,,Edgington et al. 2025
California creep events,creep event,1.6-3.0,,,,0.4-0.5 cm/day,King 2019
Iquique foreshocks 2014,foreshock migration,3.125,,,16,,Ruiz et al. 2014
Cascadia 2009,slow slip,5,,,,,Thomas and Bostock 2015
Cascadia 2008 south,slow slip,6,,,,,Dragert and Wang 2011
Cascadia 2008 northwest,slow slip,2-15,,,,,Dragert and Wang 2011
Typical tremor and slip,slow slip,10,,0.4,14,,Gershenzon et al. 2015
Ecuador 2013,slow slip,10-15,,,7,,Wickham-Piotrowski et al. 2024
Shikoku rapid tremor,tremor migration,25-150 km/h,,,,,Shelly et al. 2007
San Andreas deep tremor,tremor migration,30 m/s,,,,,Shelly 2015
Gisborne 2002,slow slip,,,18,10,,Douglas et al. 2005
"""
pathlib.Path("slow-slip.csv").write_text(TABLE, encoding="utf-8")
slow = slipfront.event("slow-slip.csv", output="slow-slip.nc")


def shown(event, name, unit=1.0):
    low, high = event[f"{name}_interval"].values / unit
    return "" if np.isnan(low) else f"{low:.2g} to {high:.2g}"


print("event                    velocity, c   stress, mu A / pi        contact ratio     stress, MPa")
for i in range(slow.sizes["event"]):
    event = slow.isel(event=i)
    print(f"{event.name.item():24}{float(event.rupture_velocity):12.2e}{float(event.stress):20.2f}"
          f"{shown(event, 'contact_ratio'):>21}{shown(event, 'stress_pa', 1e6):>16}")

# %%
# Each row has what its observations allow:
#
# - The velocity is in units of c, the speed of strain waves, and the stress in units of mu A / pi.
#   Here mu is the shear modulus. A is the **contact ratio**, the real area of contact over the
#   nominal area.
# - With a rupture velocity only, the stress is a lower bound. It is that of a fault without
#   friction, which slows the observed front. Then there is nothing in the last two columns.
# - If there is also a slip velocity, contact ratio and stress in MPa have an interval, 5 % to 95 %.
#   :doc:`plot_1_my_earthquake` explains why two velocities bound them from both sides. The stress
#   in the third column is then a median, which depends on what we assume about friction.
# - ``nan`` means "cannot be known". Gisborne 2002 has no rupture velocity, and so it has no stress.
#
# The table names no rock, and slipfront has assumed one. Every assumption is a warning of its
# event:

print(slow.isel(event=0).warnings.item().replace("; ", "\n"))

# %%
# Stress hardly depends on velocity
# ---------------------------------
#
# How much do velocity and stress vary? We compare the least stress, that without friction.

known = slow.rupture_velocity.dropna("event")
least = slipfront.relations(rupture_velocity=known.values).stress
for name, values in (("rupture velocity", known), ("least stress", least)):
    print(f"{name:16} varies by a factor of {float(values.max() / values.min()):.3g}")

# %%
# A factor of 4500 in velocity is a factor of 2 in stress. The closed form gives the reason, here
# for six decades of velocity:

decades = slipfront.relations(rupture_velocity=[1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 0.9])
for velocity, stress in zip(decades.rupture_velocity.values, decades.stress.values):
    print(f"V / c = {velocity:7.0e}   stress {stress:.3f} mu A / pi")

# %%
# Dislocations carry the slip, and stress pushes them together. The force between two of them falls
# exponentially with their distance. A fault with half the stress has dislocations at twice the
# distance, and hardly any force is left to move them. So slow slip needs no special process in this
# theory: less stress suffices. How much slower is the front at a fifth of the stress of an
# earthquake?

earthquake = slipfront.relations(rupture_velocity=[0.475])
fifth = slipfront.relations(stress=earthquake.stress / 5)
slower = float(earthquake.rupture_velocity / fifth.rupture_velocity)
print(f"at a stress of {float(fifth.stress):.3f} the front is {slower:.0f} times slower")

# %%
# Friction can slow the front that we observe as well. How much stress can it hide? The "Typical
# tremor and slip" has both velocities, so its interval includes 90 % of what friction may do.

typical = slow.isel(event=list(slow.name.values).index("Typical tremor and slip"))
print("stress", shown(typical, "stress"), "mu A / pi")

# %%
# Even if friction is as strong as the prior allows, the stress is about twice its least value. That
# is still less than half of an earthquake's.
#
# **Be careful with this result.** Each stress here was computed from a velocity with the theory.
# The results show its consequences for your events, and do not test it. A test needs a measurement
# of stress that does not come from the velocity.
#
# Compare with earthquakes
# ------------------------
#
# Without an argument, ``event`` evaluates the shipped catalogue of 50 events, from creep to great
# earthquakes. The file also holds the **population**: medians and 5 % to 95 % of the events in
# each decade of velocity.

slipfront.event(output="catalogue.nc")
catalogue = slipfront.open("catalogue.nc")
print("decade, c  events  median stress  with slip velocity  median A  median kPa")
for i in range(catalogue.sizes["decade"]):
    decade = catalogue.isel(decade=i).sel(quantile=0.5)
    kilopascals = float(decade.population_stress_pa) / 1e3
    print(f"{float(decade.decade):9.0e}{int(decade.population_events):8}"
          f"{float(decade.population_stress):15.3f}"
          f"{int(decade.population_contact_ratio_events):20}"
          f"{float(decade.population_contact_ratio):10.1e}{kilopascals:12.0f}")

# %%
# The first column is the middle of a decade. Two decades are empty, and the fast tremor is between
# them. So earthquakes and slow slip are separate groups in this catalogue.

line = slipfront.relations(rupture_velocity=np.geomspace(1e-7, 0.9, 300))
figure_events = plots.events(catalogue, line)

# %%
# The left panel has the curve of the last section. Events with a rupture velocity only are on it,
# and their arrows point up, because friction can only raise the stress. Events with both velocities
# are above it. The right panel has the stress in MPa with its interval. There the events are not on
# one curve, because their contact ratios differ. Dotted lines show the closed form for contact
# ratios of a power of ten each.
#
# So slow events and earthquakes differ in the stress over mu A / pi, by a factor of 2 to 5. Do they
# differ in the contact ratio too?

fast = catalogue.where(catalogue.rupture_velocity > 0.1, drop=True)
low, middle, high = fast.contact_ratio.quantile([0.05, 0.5, 0.95]).values
print(f"{'earthquakes, 5 % to 95 % of them':34}{low:.2g} to {high:.2g}, median {middle:.2g}")
for i in np.flatnonzero(slow.contact_ratio.notnull()):
    event = slow.isel(event=i)
    print(f"{event.name.item():34}{shown(event, 'contact_ratio')}")

# %%
# Two of the four slow events have contact ratios like those of earthquakes, and two have smaller
# ones. Four events do not suffice for a rule.
#
# Test a contact ratio from elsewhere
# -----------------------------------
#
# The paper that slipfront follows (Gershenzon, Bambakidis & Skinner, 2015) uses a contact ratio of
# 4e-5 for the typical event. Its interval above ends at 3.8e-5. What happens?

certain = {"name": "Typical tremor and slip", "rupture_velocity": "10 km/day",
           "slip": "0.4 cm", "duration": "14 days"}
try:
    slipfront.event({**certain, "contact_ratio": 4e-5})
except slipfront.InputError as error:
    print(textwrap.fill(str(error), 84))

# %%
# No friction, however strong, explains all these numbers together. The paper reads the rupture
# velocity in another way: as that of the first disturbance, which friction does not slow. slipfront
# assumes the front that one observes. State the other meaning with ``rupture_velocity_is``:

paper = {**certain, "contact_ratio": 4e-5, "rupture_velocity_is": "characteristic"}
as_paper = slipfront.event(paper).isel(event=0)
print(f"stress {float(as_paper.stress_pa) / 1e3:.0f} kPa")
print(f"friction leaves {float(as_paper.slip_velocity_ratio):.2f} of the slip velocity")
print(f"damping number {float(as_paper.damping_number):.0f}")

# %%
# This is what follows from the reading of the paper. Which reading is right depends on how the
# front was located. The front is where the slip velocity exceeds ``front_threshold`` of its peak,
# here one thousandth. How much does this choice matter?

print("front_threshold      contact ratio     stress, kPa")
for threshold in (1e-4, 1e-3, 1e-2, 1e-1):
    event = slipfront.event({**certain, "front_threshold": threshold}).isel(event=0)
    print(f"{threshold:15g}{shown(event, 'contact_ratio'):>19}{shown(event, 'stress_pa', 1e3):>16}")

# %%
# If a network sees only what exceeds a tenth of the peak, it excludes 4e-5 by a factor of two. If
# it sees a ten-thousandth, it does not exclude 4e-5. So state the threshold with your result.
#
# How certain is the rest? Suppose that rupture velocity and slip are known to 20 %, and the contact
# ratio to a factor of 2. We compare both readings.

errors = {"rupture_velocity": "10 */ 1.2 km/day", "slip": "0.4 */ 1.2 cm",
          "contact_ratio": "4e-5 */ 2"}
print("                     observed front           first disturbance")
readings = [slipfront.event({**certain, **errors, "rupture_velocity_is": reading}).isel(event=0)
            for reading in ("front", "characteristic")]
for name in ("contact_ratio", "stress_pa", "slip_velocity_ratio", "damping_number"):
    print(f"{name:20} {shown(readings[0], name):24} {shown(readings[1], name)}")

# %%
# With errors the two readings overlap. The stress is known to a factor of three for the observed
# front, and of ten for the first disturbance: there, only the contact ratio bounds it from above.
# Neither determines the friction. Quote a stress for this event, and no friction.
#
# Keep the results
# ----------------
#
# ``slow-slip.nc`` already holds everything as NetCDF, with units and long names. ``slipfront.open``
# returns the same Dataset. For a spreadsheet, write the columns that you need as CSV:

again = slipfront.open("slow-slip.nc")
table = again[["name", "rupture_velocity", "stress", "contact_ratio", "stress_pa"]]
for name, end in (("low", 0), ("high", 1)):
    table[f"stress_pa_{name}"] = again.stress_pa_interval.isel(bound=end, drop=True)
table.to_dataframe().to_csv("slow-slip-results.csv", index=False, float_format="%.4g")
print(pathlib.Path("slow-slip-results.csv").read_text(encoding="utf-8"))

# %%
# On the command line, ``slipfront event slow-slip.csv -o slow-slip.nc`` writes the same NetCDF
# file. With ``-o results.csv`` it writes all columns as CSV, and ``--population`` prints the
# decades.
#
# Your own table
# --------------
#
# Replace ``TABLE`` by your rows, or give the name of your file to ``event``. Names of columns that
# slipfront does not know, such as ``source``, are free text. A bad row does not lose the others;
# its ``error`` gives the reason:

mixed = slipfront.event([{"name": "good", "rupture_velocity": "4 km/day"},
                         {"name": "bad", "rupture_velocity": "4 km/dy"}])
for name, stress, error in zip(mixed.name.values, mixed.stress.values, mixed.error.values):
    print(name, "-", textwrap.fill(error, 80) if error else f"stress {stress:.3f}")

# %%
# **Limits.** A range without an error is taken as uniform. Length over duration is not a rupture
# velocity: an event that grows to both sides then seems twice as fast.
#
# You can read on in :doc:`/docs/events` for all columns and for large catalogues, and in
# :doc:`/docs/friction_ratio` for the friction that events imply.
