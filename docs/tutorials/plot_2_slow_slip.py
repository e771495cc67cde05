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

columns = ["rupture_velocity", "stress", "contact_ratio", "stress_pa_bound"]
print("event                   velocity, c  stress, mu A / pi  contact ratio  stress, kPa")
for name, *values in zip(slow.name.values, *(slow[column].values for column in columns)):
    velocity, stress, contact, pascals = values
    print(f"{name:24}{velocity:11.2e}{stress:19.3f}{contact:15.1e}{pascals / 1e3:13.0f}")

# %%
# Each row has what its observations allow:
#
# - The velocity is in units of c, the speed of strain waves, and the stress in units of mu A / pi.
#   Here mu is the shear modulus. A is the **contact ratio**, the real area of contact over the
#   nominal area. The stress follows from the rupture velocity only.
# - The contact ratio and the stress in kPa need a slip velocity too. Both are lower bounds, because
#   friction may have slowed the slip. :doc:`plot_1_my_earthquake` explains this bound.
# - ``nan`` means "cannot be known". Gisborne 2002 has no rupture velocity, and so it has no stress.
#
# The table names no rock, and slipfront has assumed one. Every assumption is a warning of its
# event:

print(slow.isel(event=0).warnings.item().replace("; ", "\n"))

# %%
# Stress hardly depends on velocity
# ---------------------------------
#
# Look at the third column. How much do velocity and stress vary?

known = slow.where(slow.rupture_velocity.notnull(), drop=True)
for name in ("rupture_velocity", "stress"):
    factor = float(known[name].max() / known[name].min())
    print(f"{name:16} varies by a factor of {factor:.3g}")

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
# theory, only less stress. How much slower is the front at a fifth of the stress of an earthquake?

earthquake = slipfront.relations(rupture_velocity=[0.475])
fifth = slipfront.relations(stress=earthquake.stress / 5)
slower = float(earthquake.rupture_velocity / fifth.rupture_velocity)
print(f"at a stress of {float(fifth.stress):.3f} the front is {slower:.0f} times slower")

# %%
# **Be careful with this result.** Each stress here was computed from a velocity with the closed
# form. The points are on the curve by construction. They show the consequences of the theory for
# your events, and do not test it. A test needs a measurement of stress that does not come from the
# velocity.
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
    kilopascals = float(decade.population_stress_pa_bound) / 1e3
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
# The left panel is the curve of the last section. The right panel has the lower bounds in MPa.
# There the events are not on one curve, because their contact ratios differ. Dotted lines show the
# closed form for contact ratios from 1e-5 to 1e-1. Arrows point up, since friction can only raise a
# bound.
#
# So slow events and earthquakes differ in two ways. The stress over mu A / pi is a fifth. The
# contact ratio is less too, by factors of 4 to 300 against the median of the earthquakes. But the
# second statement is about bounds, and it rests on few events: only four slow ones have both
# velocities.
#
# Find the share of friction
# --------------------------
#
# A contact ratio turns the bound into a value. The paper that slipfront follows (Gershenzon,
# Bambakidis & Skinner, 2015) has one for the typical tremor and slip event: 4e-5.

certain = {"name": "Typical tremor and slip", "rupture_velocity": "10 km/day",
           "slip": "0.4 cm", "duration": "14 days", "contact_ratio": 4e-5}
typical = slipfront.event(certain).isel(event=0)
print(f"stress {float(typical.stress_pa) / 1e3:.0f} kPa")
print(f"friction leaves {float(typical.slip_velocity_ratio):.2f} of the slip velocity")
print(f"damping number {float(typical.damping_number):.0f}")

# %%
# The stress is five times its bound of 16 kPa. Friction took four fifths of the slip velocity. But
# it did not make this event slow: without any friction the front would have the same velocity.
#
# How certain is this? Suppose that rupture velocity and slip are known to 20 %, and the contact
# ratio to a factor of 2.

errors = {"rupture_velocity": "10 */ 1.2 km/day", "slip": "0.4 */ 1.2 cm",
          "contact_ratio": "4e-5 */ 2"}
uncertain = slipfront.event({**certain, **errors}).isel(event=0)
for name in ("stress_pa", "slip_velocity_ratio", "damping_number"):
    low, high = uncertain[f"{name}_interval"].values
    print(f"{name:20} {float(uncertain[name]):9.3g}   [{low:.3g}, {high:.3g}]")

# %%
# The contact ratio decides. Its 90 % interval spans a factor of 10, and so does that of the
# stress. The damping number spans two decades.
#
# Keep the results
# ----------------
#
# ``slow-slip.nc`` already holds everything as NetCDF, with units and long names. ``slipfront.open``
# returns the same Dataset. For a spreadsheet, write the columns that you need as CSV:

again = slipfront.open("slow-slip.nc")
table = again[["name", "kind", *columns]].to_dataframe()
table.to_csv("slow-slip-results.csv", index=False, float_format="%.4g")
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
