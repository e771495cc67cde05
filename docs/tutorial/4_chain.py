"""Step 4: test the pulse against a chain that resolves every dislocation.

The pulse averages over dislocations. The chain does not: it solves the sine-Gordon equation. `scale` is the factor by
which it has more dislocations. The larger the scale, the closer is the chain to the average.
"""

import slipfront
from slipfront import plots

step = {
    "title": "A step of stress, C = 0.5",
    "initial": {"profile": "step", "stress_left": 0.855, "stress_right": 0},
    "friction": {"law": "viscous", "coefficient": 0.5},
}
levels = slipfront.compare(step, scales=[100, 400])
slip = levels.slip_at_origin.isel(time=-1)
exact = float(slip.sel(name="pulse-consistent"))
for name, value in zip(levels.name.values, slip.values):
    print(f"{name:18} slip at x = 0: {value:.4f}  ({100 * (value / exact - 1):+.2f} %)")

# The chain uses no closure, and it agrees with "consistent".
chain, paper = (float(slip.sel(name=name)) for name in ("chain-400", "pulse-paper"))
print("nearer to the chain:", "consistent" if abs(chain - exact) < abs(chain - paper) else "paper")
plots.save(plots.comparison(levels), "4_chain.png")
