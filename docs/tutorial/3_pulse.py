"""Step 3: run a pulse with friction, from your own stress profile.

A scenario is a dict nested like the TOML files of docs/scenario.md. Here the left side of the interface is stressed,
most of all in a patch that has not slipped for a long time. Where the stress falls, dislocations push each other
forward, and friction slows them.
"""

import slipfront
from slipfront import plots

scenario = {
    "title": "A patch of high stress behind the front",
    "initial": {"profile": "formula", "formula": "0.2 + 0.6/(1 + exp(4*x)) + 0.3*exp(-(x + 1.5)^2)"},
    "domain": {"left": -9, "right": 5},
    "friction": {"law": "viscous", "coefficient": 0.3},
    "time": {"end": 8},
    "output": {"every": 0.25},
}
pulse = slipfront.pulse(scenario)

# Variables have their units and equations as attributes. Results at the end of the run are attributes of the Dataset.
print(pulse.W.attrs["long_name"], "in", pulse.W.attrs["dimensional_unit"])
print(f"damping number {pulse.attrs['damping_number']:.2f}, peak slip velocity {pulse.attrs['peak_slip_velocity']:.4f}")
print(f"energy: {100 * float(pulse.energy_dissipated[-1] / pulse.energy_elastic[0]):.2f} % of the elastic energy went into friction")

# `set` replaces values, so you need not write the scenario again.
for closure in ("consistent", "paper"):
    other = slipfront.pulse(scenario, set={"friction.closure": closure, "friction.coefficient": 1})
    print(f"C = 1, closure {closure}: peak slip velocity {other.attrs['peak_slip_velocity']:.4f}")

plots.save(plots.space_time(pulse), "3_pulse-map.png")
plots.save(plots.profiles(pulse), "3_pulse-profiles.png")
