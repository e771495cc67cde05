"""Step 2: from an observed event to the stress that drove it.

How fast a rupture ran tells its stress over that of the contacts; how fast it slipped tells how much of the interface is
in contact. The first is sure, the second as if there were no friction: a lower bound.
"""

import numpy as np

import slipfront
from slipfront import plots

# Columns are those of a catalogue (docs/events.md); quantities come with their units.
mine = {"name": "My earthquake", "kind": "earthquake", "rupture_velocity": "2.8 km/s", "slip_velocity": "0.6 m/s"}
event = slipfront.event(mine).isel(event=0)
print(f"{event.name.item()}: V = {float(event.rupture_velocity):.3f} c, stress {float(event.stress):.3f} mu A / pi")
print(f"contact ratio A >= {float(event.contact_ratio):.2g}, stress >= {float(event.stress_pa_bound) / 1e6:.0f} MPa")
print(event.warnings.item())

# The shipped catalogue, from creep events to great earthquakes.
catalogue = slipfront.event()
print(f"{catalogue.sizes['event']} events, {float(catalogue.rupture_velocity.min()):.1e} c to {float(catalogue.rupture_velocity.max()):.2f} c")
line = slipfront.relations(rupture_velocity=np.geomspace(1e-7, 0.9, 300))
plots.save(plots.events(catalogue, line), "2_event.png")
