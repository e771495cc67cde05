"""Step 1: what a stress means.

An interface holds the shear stress `stress` on its left and none on its right. Where they meet, a slip pulse opens: its
trailing edge runs into the stressed side at `rupture_velocity`, its leading edge into the empty one at `leading_velocity`,
and between them the interface slips. One number gives all the others (Eqs. 8-10).
"""

import numpy as np

import slipfront
from slipfront import plots

# Any one quantity gives the rest; arrays of any shape are welcome.
states = slipfront.relations(stress=[0.21, 0.855, 1.03])
for name in ("rupture_velocity", "leading_velocity", "slip_velocity"):
    unit = states[name].attrs["dimensional_unit"]
    print(f"{name:18} {np.array2string(states[name].values, precision=4)}  {unit}")

# Backwards: which stress makes a front run at half the speed of strain waves?
half = slipfront.relations(rupture_velocity=[0.5])
print(f"V = 0.5 c needs a stress of {float(half.stress[0]):.4f} mu A / pi")

# Six decades of velocity are less than one of stress: a picture says it best.
many = slipfront.relations(stress=np.geomspace(0.1, 3, 300))
plots.save(plots.relations(many), "1_relations.png")
