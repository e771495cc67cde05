"""
A laboratory block: stick-slip in SI units
==========================================

You press a block of granite onto a base and pull it with a spring at a constant velocity. The block
sticks, slips, and sticks again. At the end of this tutorial you have its force against time, and a
table of its events in seconds, micrometres and kilopascals.

Friction is that of rate and state, with the coefficients that laboratories publish. slipfront takes
friction and rock in SI units. It takes loading, domain and times without units, so this tutorial
also shows how to convert them.
"""

# %%
# Describe the experiment
# -----------------------
#
# All numbers are in SI units. The spring is that of the machine. Its stiffness is a stress over a
# slip, so divide the stiffness in N/m by the area of the block.

import pathlib

import matplotlib.pyplot as plt
import numpy as np

import slipfront
from slipfront import medium

shear_modulus = 30e9  # Pa, mu
p_wave_speed = 5900.0  # m/s
poisson_ratio = 0.25  # nu
height, length = 0.05, 0.10  # m, of the block

normal_stress = 5e6  # Pa
coefficient = 0.6  # f_0, at the reference velocity
direct_effect, evolution_effect = 0.010, 0.015  # a and b
characteristic_slip = 5e-6  # m, D_c: slip that renews the contacts
reference_velocity = 1e-6  # m/s

velocity = 10e-6  # m/s, of the far end of the spring
critical = (evolution_effect - direct_effect) * normal_stress / characteristic_slip
stiffness = 0.5 * critical  # Pa/m
print(f"critical stiffness {critical / 1e9:.1f} MPa/mm")
print(f"spring             {stiffness / 1e9:.1f} MPa/mm")

# %%
# Friction falls with velocity here, because b is larger than a. A spring softer than the **critical
# stiffness** (b - a) N / D_c, with the normal stress N, cannot keep up with this fall. Then the
# block slips in events. A stiffer spring would keep it sliding steadily.
#
# Convert to the units of the model
# ---------------------------------
#
# The rock, the contact ratio A and the asperity spacing b make the units of the model. A is the
# real area of contact over the nominal area. A block without asperities has neither A nor b, so we
# are free to choose both. One choice matters: the model moves a mass of rho b / 2 per area, with
# the density rho and the asperity spacing b. The mass of our block per area is rho times its
# height. So b is twice the height. In the code ``spacing`` is this b, to keep it apart from the
# evolution effect.

spacing = 2 * height
contact_ratio = 0.5
c = float(medium.speed_from_p_wave(p_wave_speed, poisson_ratio))

unit_of_force = float(medium.traction_unit(shear_modulus, poisson_ratio, contact_ratio))
unit_of_velocity = float(medium.slip_velocity_unit(c, contact_ratio))
unit_of_time = medium.units(shear_modulus, c, contact_ratio, spacing)["time"]
unit_of_length = medium.units(shear_modulus, c, contact_ratio, spacing)["length"]
unit_of_slip = unit_of_velocity * unit_of_time

print("unit of      formula                     SI")
print(f"force        mu A^2 / (pi (1 - nu))      {unit_of_force:.4g} Pa")
print(f"velocity     c A / pi                    {unit_of_velocity:.4g} m/s")
print(f"time         b / (c A)                   {unit_of_time:.4g} s")
print(f"slip         b / pi                      {unit_of_slip:.4g} m")
print(f"position     b / A                       {unit_of_length:.4g} m")

# %%
# Forces are per area of the block, so they are in Pa. Here c is the speed of strain waves, which
# follows from the rock.
#
# **Take care with slip.** Our unit of slip is b / pi, because a laboratory measures the slip
# between both faces. The pages of slipfront give u in b / (2 pi), which is the displacement of one
# face. The product of velocity and time decides: it is the slip between the faces.
#
# Write the scenario
# ------------------
#
# Every number keeps its SI unit. With a normal stress, a strength is a friction coefficient. Three
# more settings make a block of the chain:
#
# - a contact of 0 removes the asperities, so that only friction resists;
# - both ends are free, and nothing is stressed at the start;
# - eleven sites over 10 cm are enough, because all of them move together.


def block(velocity, stiffness, end, contact_ratio=0.5):
    """Scenario of the block up to the time `end` in seconds."""
    return {
        "title": "A block of granite that sticks and slips",
        "initial": {"stress_left": 0, "stress_right": 0},
        "interface": {"contact": "0"},
        "friction": {
            "law": "rate-and-state",
            "normal_stress": f"{normal_stress} Pa",
            "strength": coefficient,
            "direct_effect": direct_effect,
            "evolution_effect": evolution_effect,
            "characteristic_slip": f"{characteristic_slip} m",
            "reference_velocity": f"{reference_velocity} m/s",
            "initial_state": "5 s",
        },
        "medium": {
            "shear_modulus": f"{shear_modulus} Pa",
            "p_wave_speed": f"{p_wave_speed} m/s",
            "poisson_ratio": poisson_ratio,
            "contact_ratio": contact_ratio,
            "asperity_spacing": f"{spacing} m",
        },
        "loading": {
            "stiffness": f"{stiffness:.10g} Pa/m",
            "velocity": f"{velocity} m/s",
        },
        "domain": {"left": f"{-length / 2} m", "right": f"{length / 2} m"},
        "chain": {"left": "free", "right": "free", "spacing": f"{length / 10} m"},
        "time": {"end": f"{end} s"},
        "output": {"every": f"{end / 600} s"},
    }


scenario = block(velocity, stiffness, end=300)
for key, value in scenario["loading"].items():
    print(f"loading.{key} = {value}")

# %%
# Pull the block
# --------------
#
# The chain takes steps of any length: tiny ones during an event, and long ones while the block
# sticks.

run = slipfront.chain(scenario, si=False)
print(f"{run.attrs['steps']} steps")


def table(run):
    """The events in SI units."""
    print("onset, s  interval, s  duration, ms  slip, um  stress drop, kPa  velocity, m/s")
    onset = run.event_onset.values * unit_of_time
    columns = zip(onset, np.diff(onset, prepend=np.nan),
                  run.event_duration.values * unit_of_time * 1e3,
                  run.event_slip.values * unit_of_slip * 1e6,
                  run.event_stress_drop.values * unit_of_force / 1e3,
                  run.event_peak_velocity.values * unit_of_velocity)
    for row in columns:
        print("{:8.2f} {:12.2f} {:13.1f} {:9.1f} {:17.1f} {:14.3f}".format(*row))


table(run)

# %%
# The first event is the largest, because the contacts had rested longest. From then on the events
# repeat every 34 s. In each the block slips by a third of a millimetre, within 40 ms and at up to
# 0.6 m/s.
#
# Do these numbers fit together? Between two events the spring is pulled by the interval times the
# velocity, 34.25 s times 10 um/s, which is 343 um. An event slips 326 um. The rest is slow slip
# before and after it.
#
# Draw the force
# --------------
#
# The force of the spring per area is the stiffness times its stretch. We know the stretch: the far
# end has moved by velocity times time, and the block by its slip.

plt.style.use(pathlib.Path(slipfront.__file__).with_name("slipfront.mplstyle"))


def force(run):
    """Time in s, and force of the spring in Pa."""
    time = run.time.values * unit_of_time
    slip = run.slip.mean("x").values * unit_of_slip
    return time, stiffness * (velocity * time - slip)


time, tau = force(run)
figure_force, axes = plt.subplots(figsize=(7, 3))
axes.plot(time, tau / 1e6)
for onset in run.event_onset.values * unit_of_time:
    axes.axvline(onset, color="0.6", linestyle=":", zorder=0)
axes.set(xlabel="time, s", ylabel="force per area, MPa")
right = axes.secondary_yaxis("right", functions=(lambda mpa: mpa * 1e6 / normal_stress,
                                                 lambda f: f * normal_stress / 1e6))
right.set_ylabel("friction coefficient")

# %%
# Dotted lines are the onsets of events. The force rises along a straight line while the block
# sticks and the spring is stretched. It falls within an event. Just before an event the friction
# coefficient is 0.63, and after it is 0.47.
#
# Look into one event
# -------------------
#
# The picture has one point every half second, which is longer than an event. Output does not change
# the steps of a run. So we may repeat it and ask for other times: the 20 s before the last event,
# and 4 ms around its end.

onset = float(run.event_onset[-1]) * unit_of_time
end = onset + float(run.event_duration[-1]) * unit_of_time
before = onset - np.geomspace(20, 1e-3, 60)
during = end + np.linspace(-3e-3, 1e-3, 201)
times = [f"{time} s" for time in np.sort(np.concatenate([before, during]))]
event = slipfront.chain({**scenario, "output": {"times": times}}, si=False)

time, tau = force(event)
speed = event.W.mean("x").values * unit_of_velocity
shown = slice(1, -1)  # without the start and the end of the run
figure_event, (left, right) = plt.subplots(1, 2, figsize=(7, 3))
left.semilogy((time - onset)[shown], speed[shown])
left.axhline(velocity, color="0.6", linestyle=":")
left.set(xlabel="time since onset, s", ylabel="slip velocity, m/s")
milliseconds = (time - end)[shown] * 1e3
right.plot(milliseconds, speed[shown], label="slip velocity, m/s")
right.plot(milliseconds, (tau - tau[-2])[shown] / 1e6, label="force still to fall, MPa")
right.set(xlim=(-3, 1), ylim=(-0.05, None), xlabel="time since the end of the event, ms")
right.legend()

# %%
# On the left the block is never quite at rest. It creeps, and its velocity grows by decades until
# it passes that of the spring (dotted). An event begins at ten times that velocity, and most of its
# 42 ms are the last part of this slow growth.
#
# On the right, the fast slip takes about a millisecond. A block on a spring swings through half a
# period, and this time depends on its mass. So it tests our choice of b:

density = 2 * shear_modulus / ((1 - poisson_ratio) * c**2)
mass = density * height  # per area
fast = time[shown][speed[shown] > 0.1 * speed.max()]
print(f"half a period {1e3 * np.pi * np.sqrt(mass / stiffness):.2f} ms")
print(f"fast slip     {1e3 * (fast[-1] - fast[0]):.2f} ms, at 10 % of the peak")

# %%
# Inertia also explains where the block stops. At half a metre per second its friction coefficient
# is 0.53. The block passes the balance with that friction and comes to rest at 0.47.
#
# Check the conversion
# --------------------
#
# A wrong unit gives wrong seconds. Two checks find it. First, the contact ratio only set our units.
# With another one the events must be the same in SI units.

other = slipfront.chain(block(velocity, stiffness, end=300, contact_ratio=0.25), si=False)
other_time = medium.units(shear_modulus, c, 0.25, spacing)["time"]
print("onsets, s:", np.round(other.event_onset.values * other_time, 2))

# %%
# Second, the critical stiffness is known in SI units. Just below it events must continue, and just
# above it they must die out.

print("stiffness / critical  events  slip velocity of first and last, um/s")
for share in (0.95, 1.05):
    stiff = slipfront.chain(block(velocity, share * critical, end=300), si=False)
    peaks = stiff.event_peak_velocity.values * unit_of_velocity * 1e6
    print(f"{share:20}{peaks.size:8}{peaks[0]:19.0f}{peaks[-1]:10.0f}")

# %%
# With the stiffer spring each event is slower than the last, down to the 100 um/s at which an event
# is counted. Afterwards the block slides steadily.
#
# We also integrated the same block in SI units with another method, Radau of scipy. It gives 34.249
# s for the last interval and 0.6133 m/s for the last event. The table above has 34.25 s and 0.613
# m/s.
#
# Pull at other velocities
# ------------------------
#
# The longer contacts rest, the stronger they are. So the stress drop must fall with the velocity of
# the spring.

print("velocity, um/s  interval, s  stress drop, kPa")
for factor in (0.1, 1, 10):
    pulled = slipfront.chain(block(factor * velocity, stiffness, end=300 / factor), si=False)
    interval = float(np.diff(pulled.event_onset)[-1]) * unit_of_time
    drop = float(pulled.event_stress_drop[-1]) * unit_of_force
    print(f"{factor * velocity * 1e6:14.0f} {interval:12.2f} {drop / 1e3:17.1f}")
theory = 2 * (evolution_effect - direct_effect) * normal_stress * np.log(10)
print(f"2 (b - a) N ln 10 = {theory / 1e3:.0f} kPa")

# %%
# The stress drop falls by 113 and 118 kPa for a factor of ten in velocity. Without inertia it would
# be about (b - a) N ln 10. The block doubles it, because it overshoots.
#
# Your own experiment
# -------------------
#
# Replace the numbers of the first block of code. Let ``end`` be long enough to stretch the spring
# up to the strength, here 120 s. If a run has no events, ``run`` has no variable ``event_onset``.
#
# **Limits.** The block is rigid here, because it is short. A long block slips in parts, and needs
# more sites. Rough surfaces need a contact above 0. Then A and b are those of the surface, and the
# mass is that of a layer of the thickness b / 2.
#
# You can read on in :doc:`/docs/loading` for events that rupture along an interface, and in
# :doc:`/docs/friction` for other laws and their units.
