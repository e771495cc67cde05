"""Step 1: compute the velocities that a stress causes.

The left side of an interface is under the shear stress `stress`, and the right side has no stress. A slip pulse starts
where the two meet. Its trailing edge runs into the stressed side at `rupture_velocity`, and its leading edge into the
empty side at `leading_velocity`. The interface slips between them. One of these numbers gives all the others (Eqs. 8-10).
"""

import numpy as np

import slipfront
from slipfront import plots

# Any one quantity gives the others. It may be an array of any shape.
states = slipfront.relations(stress=[0.21, 0.855, 1.03])
for name in ("rupture_velocity", "leading_velocity", "slip_velocity"):
    unit = states[name].attrs["dimensional_unit"]
    print(f"{name:18} {np.array2string(states[name].values, precision=4)}  {unit}")

# The inverse: which stress makes a front run at half the speed of strain waves?
half = slipfront.relations(rupture_velocity=[0.5])
print(f"V = 0.5 c needs a stress of {float(half.stress[0]):.4f} mu A / pi")

# Six decades of velocity correspond to less than one decade of stress, as a picture shows.
many = slipfront.relations(stress=np.geomspace(0.1, 3, 300))
plots.save(plots.relations(many), "1_relations.png")
