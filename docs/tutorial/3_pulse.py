"""Step 3: a pulse with friction, from a stress profile of your own.

A scenario is a dict nested like the TOML files of docs/scenario.md. The interface here is stressed on its left, most
in a patch that has not slipped for long; where the stress falls, dislocations push each other on, and friction brakes them.
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

# Variables carry their units and equations; results at the end of the run are attributes.
print(pulse.W.attrs["long_name"], "in", pulse.W.attrs["dimensional_unit"])
print(f"damping number {pulse.attrs['damping_number']:.2f}, peak slip velocity {pulse.attrs['peak_slip_velocity']:.4f}")
print(f"energy: {100 * float(pulse.energy_dissipated[-1] / pulse.energy_elastic[0]):.2f} % of the elastic energy went into friction")

# The same with other values: no need to write the scenario again.
for closure in ("consistent", "paper"):
    other = slipfront.pulse(scenario, set={"friction.closure": closure, "friction.coefficient": 1})
    print(f"C = 1, closure {closure}: peak slip velocity {other.attrs['peak_slip_velocity']:.4f}")

plots.save(plots.space_time(pulse), "3_pulse-map.png")
plots.save(plots.profiles(pulse), "3_pulse-profiles.png")
