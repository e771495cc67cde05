"""Properties that every pulse must have, in any scenario. A check yields (name, value, allowed, note). It has failed if the
value is not at most the allowed one."""

import math

import numpy as np

import scenarios
from program import RESUME_CHECK, Failed, resumes_to_the_same_bits, run

INTERVALS = 128  # intervals between output times; a multiple of 4
ROUNDING = 1e-6  # allowed relative difference between two runs of one problem
LEAST_SLIP = 1e-6  # slips are differences of numbers of dislocations, with errors of about 1e-12
MAY_BE_ABSENT = {"trailing_characteristic", "leading_front", "trailing_front", "trailing_front_observed",
                 "leading_front_observed", "first_crossing_time", "first_crossing_position"}
ODD = {"slip_velocity_at_origin", "slip_at_origin", "peak_slip_velocity", "peak_position", "trailing_front",
       "leading_front", "trailing_front_observed", "leading_front_observed"}  # these change sign in a mirrored problem
EVEN = {"stress_at_origin", "energy_elastic", "energy_kinetic", "energy_dissipated", "energy_supplied", "cells"}
PLACES = {"peak_position", "trailing_front", "leading_front", "trailing_front_observed", "leading_front_observed"}


def dense(s):
    """The scenario with output times that are denser near t = 0, where velocities jump."""
    end = s["time"]["end"]
    times = [end * (i / INTERVALS)**3 for i in range(1, INTERVALS)]
    return scenarios.changed(s, output_times=times, output_variables=["k", "U", "W", "slip"])


def simpson(f, step):
    weights = np.ones(len(f))
    weights[1:-1:2], weights[2:-1:2] = 4, 2
    return float(np.sum(weights * f)) * step / 3


def integral(rate):
    """Integral over time of a rate at the output times of `dense`, and its error: t = end tau^3."""
    tau = np.linspace(0, 1, INTERVALS + 1)
    f = rate * 3 * tau**2
    fine, coarse = simpson(f, 1 / INTERVALS), simpson(f[::2], 2 / INTERVALS)
    return fine, abs(fine - coarse)


def size_of(seen):
    """Scales with which differences are compared."""
    f = seen.fields
    end = f["time"][-1]
    fastest = max(float(np.max(np.abs(f["W"]))), abs(seen.summary["peak_slip_velocity"]))  # the peak may be between the centres of cells
    return {"slip": max(float(np.max(np.abs(f["slip"]))), LEAST_SLIP), "W": fastest, "end": float(end),
            "k": float(np.max(f["k"]))}


class Case:
    """A scenario and its runs. Each run starts when it is first needed."""

    def __init__(self, s):
        self.s = s
        self.runs = {}

    def get(self, name, s, profiles=False):
        if name not in self.runs:
            try:
                self.runs[name] = run(s, profiles=profiles)
            except Failed as failure:
                self.runs[name] = failure
        if isinstance(self.runs[name], Failed):
            raise self.runs[name]
        return self.runs[name]

    @property
    def plain(self):
        return self.get("plain", self.s)

    @property
    def seen(self):
        return self.get("dense", dense(self.s), True)

    @property
    def half(self):
        return self.get("half", dense(scenarios.changed(self.s, pulse_cells=self.s["pulse"]["cells"] // 2)), True)

    @property
    def quarter(self):
        return self.get("quarter", dense(scenarios.changed(self.s, pulse_cells=max(4, self.s["pulse"]["cells"] // 4))), True)

    @property
    def cell(self):
        """Mean width of a cell."""
        edges = self.seen.fields["x_bounds"]
        return float(edges.max() - edges.min()) / self.s["pulse"]["cells"]

    def grid_error(self, of_fields):
        """The error of a number or an array computed from the fields. We use three grids, like the program for its errors."""
        fine, half, quarter = (of_fields(seen.fields) for seen in (self.seen, self.half, self.quarter))
        return 1.25 * np.maximum(np.abs(fine - half), np.abs(half - quarter) / 2)

    def stated_error(self, key, other=None):
        """The stated error of the difference between two runs: the sum of the errors that both state."""
        errors = (run.errors.get(key, math.nan) for run in (self.plain, other or self.plain))
        return sum(0 if math.isnan(error) else error for error in errors)

    def profile_error(self, key):
        """The error of the difference between the final profiles of two runs."""
        x = self.seen.fields["x"]
        return 2 * self.grid_error(lambda fields: np.interp(x, fields["x"], fields[key][-1]))


def finite(case):
    viscous = case.s["friction"]["law"] in ("none", "viscous")
    loading = {"loading_force", "loading_stress", "event_count", "event_recurrence_time", "event_median_stress_drop",
               "event_median_peak_velocity"}  # absent without springs, which these scenarios do not have
    absent = MAY_BE_ABSENT | loading | (set() if viscous else {"friction_coefficient", "damping_number"})
    if not math.isfinite(case.plain.summary["first_crossing_time"]):
        absent |= {"energy_shocks"}  # no shocks, as no trains have met
    bad = [key for key, value in case.plain.summary.items()
           if isinstance(value, float) and not math.isfinite(value) and key not in absent]
    bad += [key for key, values in case.seen.fields.items()
            if not np.all(np.isfinite(values)) and key not in MAY_BE_ABSENT | loading | {"energy_phonons", "energy_shocks"}]
    yield "finite", len(bad), 0, " ".join(bad)


def bounds(case):
    f = case.seen.fields
    yield "|U| < 1", float(np.max(np.abs(f["U"]))), 1 - 1e-12, "largest |U|"
    k = f["k"]
    largest_near = np.maximum(k, np.maximum(np.pad(k, ((0, 0), (1, 0)))[:, :-1], np.pad(k, ((0, 0), (0, 1)))[:, 1:]))
    ratio = float(np.max(np.abs(f["W"]) - largest_near * (1 + 1e-9)))
    yield "|W| <= k", ratio, 0, "largest |W| - k"
    yield "k >= 0", float(-np.min(k)), 1e-12, "least k, negative"


def slip_is_integral(case):
    f = case.seen.fields
    total, error = integral(f["slip_velocity_at_origin"])
    rate = integral(np.abs(f["slip_velocity_at_origin"]))[0]
    end = case.s["time"]["end"]
    slip = case.seen.summary["slip_at_origin"]
    largest = max(rate * end, float(np.max(np.abs(f["slip_at_origin"]))), LEAST_SLIP)
    # The run states the error of slip. Of W it states only the error of the last value, so we compute the error of its
    # integral in the same way.
    stated = case.seen.errors.get("slip_at_origin", math.nan)
    of_velocity = case.grid_error(lambda fields: integral(fields["slip_velocity_at_origin"])[0])
    allowed = ROUNDING + (2 * error * end + (0 if math.isnan(stated) else stated) + of_velocity * end) / largest
    if any("slip_at_origin grows with the cells" in text for text in case.seen.warnings):
        allowed = math.inf
    yield ("slip = int W", abs(slip - total * end) / largest, allowed,
           f"slip {slip:.6g}, integral of W {total * end:.6g}")


def outputs_change_nothing(case):
    """The results of a run that stops at 128 times must agree with those of a run with its natural steps."""
    a, b = case.plain.summary, case.seen.summary
    scale, least = size_of(case.seen), 1e-9 * a["energy_elastic"]
    for key, unit in (("slip_at_origin", scale["slip"]), ("slip_velocity_at_origin", scale["W"]),
                      ("energy_supplied", max(abs(b["energy_supplied"]), least)),
                      ("energy_dissipated", max(abs(b["energy_dissipated"]), least)),
                      ("leading_front", max(1, scale["end"]))):
        if math.isnan(a[key]) or math.isnan(b[key]) or unit == 0:
            continue
        coarse = case.half.summary[key]
        error = max(0 if math.isnan(coarse) else abs(b[key] - coarse), case.stated_error(key, case.seen)) / unit
        yield (f"steps: {key}", abs(a[key] - b[key]) / unit, 1e-5 + 2 * error, f"{a[key]:.6g}, with short steps {b[key]:.6g}")


def has_one_peak(case):
    """Whether |W| at the end has a single peak on the output grid, above the rounding error of the largest velocity."""
    f = case.seen.fields
    if np.max(np.abs(f["W"][-1])) < 1e-9 * np.max(np.abs(f["W"])):
        return False
    high = f["x"][np.abs(f["W"][-1]) > 0.98 * np.max(np.abs(f["W"][-1]))]
    return high.size > 0 and high.max() - high.min() < 0.1 * (f["x"][-1] - f["x"][0])


def same_in_a_mirror(case):
    mirrored = case.get("mirror", scenarios.mirrored(case.s))
    mine, other, scale = case.plain.summary, mirrored.summary, size_of(case.seen)
    unit = {"slip_velocity_at_origin": scale["W"], "peak_slip_velocity": scale["W"], "slip_at_origin": scale["slip"]}
    first = case.seen.fields["k"][0]
    names_fronts = abs(first[0] - first[-1]) > 0.01 * max(first[0], first[-1])  # otherwise either side may be the stressed one
    for key in sorted(ODD | EVEN):
        if key not in mine or key == "peak_position" and not has_one_peak(case) or "front" in key and not names_fronts:
            continue
        a, b = mine[key], -other[key] if key in ODD else other[key]
        if math.isnan(a) and math.isnan(b) or a == b:
            continue
        if math.isnan(a) != math.isnan(b):  # such as a front at the limit of resolution, which its stated error covers
            error = mirrored.errors.get(key, math.nan) if math.isnan(a) else case.plain.errors.get(key, math.nan)
            yield f"mirror: {key} is absent", case.cell, error if math.isfinite(error) else 0, f"{a:.9g}, mirrored {b:.9g}"
            continue
        by = scale["end"] + abs(a) if key in PLACES else unit.get(key, max(abs(a), abs(b)))
        if key.startswith("energy"):
            by = max(by, 1e-9 * mine["energy_elastic"])
        allowed = ROUNDING + (case.stated_error(key, mirrored) / by if by else 0)
        yield f"mirror: {key}", abs(a - b) / by if by else math.inf, allowed, f"{a:.9g}, mirrored {b:.9g}"


def same_when_shifted(case):
    if "domain" not in case.s:
        return
    s = scenarios.as_formula(case.s)
    by = 2.5
    here = case.get("formula", dense(s), True).fields
    there = case.get("shifted", dense(scenarios.shifted(s, by)), True).fields
    for key in ("k", "W", "slip"):
        unit = max(float(np.max(np.abs(here[key]))), LEAST_SLIP if key == "slip" else 0)
        if unit > 0:
            difference = float(np.max(np.abs(here[key][-1] - there[key][-1])))
            yield f"shift: {key}", difference / unit, ROUNDING + float(np.max(case.profile_error(key))) / unit, ""


def fronts(case):
    f, end = case.seen.fields, case.s["time"]["end"]
    edges = f["x_bounds"]
    left, right = float(edges.min()), float(edges.max())
    cell = (right - left) / len(f["x"])
    for key in ("trailing_front", "leading_front", "trailing_front_observed", "leading_front_observed"):
        x, t = f[key], f["time"]
        known = np.isfinite(x)
        if not known.any():
            continue
        # Free edges leave the domain, more slowly than c. Other fronts stay in the domain.
        out = np.maximum(left - x, x - right)[known] - np.where(empty_side(case, x[known]), t[known], 0)
        yield f"front in the domain: {key}", float(np.max(out)), 1e-9 * (right - left), f"{x[known][np.argmax(out)]:.6g}"
        # If the whole interface moves at once, the first motion is not a signal.
        if key != "trailing_front" or case.s["initial"]["profile"] != "step" or "forcing" in case.s or "interface" in case.s:
            continue
        way = np.maximum(np.abs(np.diff(x[known])) - 3 * cell, 0)  # the foot is computed from three cells
        late = np.diff(t[known]) > 1e-3 * end
        if late.any():
            yield f"front slower than c: {key}", float(np.max((way / np.diff(t[known]))[late])), 1, ""


def empty_side(case, x):
    """Whether a front at x may have run into an empty region outside the domain."""
    k = case.seen.fields["k"][0]
    return np.where(x > case.seen.fields["x"][-1], k[-1] == 0, np.where(x < case.seen.fields["x"][0], k[0] == 0, False))


def dislocations_are_counted(case):
    """The loss of dislocations to the left of x is the slip at x. Compares the number from k with the number from slip."""
    f = case.seen.fields
    width = f["x_bounds"][:, 1] - f["x_bounds"][:, 0]
    lost = np.cumsum((f["k"][0] - f["k"][-1]) * width)[:-1]
    slip = f["slip"][-1]
    at_faces = (slip[1:] + slip[:-1]) / 2 - slip[0]
    curve = np.max(np.abs(np.diff(slip, 2)), initial=0)
    scale = size_of(case.seen)["slip"]
    rounding = 1e-8 * float(np.max(f["k"][0])) * float(width[0])  # rounding of psi, from which k is computed
    rounding += float(np.max(case.profile_error("k"))) * float(width[0])  # and of the distribution within a cell
    difference = float(np.max(np.abs(lost - (f["k"][0][0] - f["k"][-1][0]) * width[0] / 2 - at_faces)))
    yield "dislocations counted", difference / scale, 1e-6 + (3 * float(curve) + rounding) / scale, "k against slip"
    error = case.plain.summary["conservation_error"]
    warned = any("dislocations than there are" in text for text in case.plain.warnings)
    yield "conservation_error", error, math.inf if warned else 0.01, "a warning" if warned else ""


def energy(case):
    """Energy may be lost in a shock, but not created. The check needs a problem in which nothing moves at the ends."""
    f = case.seen.fields
    if max(abs(f["W"][:, [0, -1]]).max(), abs(f["slip"][:, [0, -1]]).max()) > 1e-9 * max(1e-300, abs(f["W"]).max()):
        return
    total = f["energy_elastic"] + f["energy_kinetic"] + f["energy_dissipated"] - f["energy_supplied"]
    moved = np.max(f["energy_kinetic"] + f["energy_dissipated"] + np.abs(f["energy_supplied"]))
    if moved > 0:
        gained = float(np.max(total - total[0])) / moved
        error = abs(f["energy_elastic"][0] - case.half.fields["energy_elastic"][0]) + abs(f["energy_residual"][-1] - case.half.fields["energy_residual"][-1])
        warned = any("energy was created" in text for text in case.plain.warnings)
        yield "energy made from nothing", gained, math.inf if warned else 1e-3 + 2 * error / moved, f"of {moved:.3g} that moved"


def resumes(case):
    if RESUME_CHECK.exists():
        yield "resume", int(not resumes_to_the_same_bits(case.s)), 0, "state at the end, bit by bit"


ALL = [resumes, finite, bounds, slip_is_integral, outputs_change_nothing, same_in_a_mirror, same_when_shifted, fronts,
       dislocations_are_counted, energy]


def results_of(s, wanted=ALL):
    """All results of one scenario. A run that fails counts as a result."""
    case = Case(s)
    found = []
    for check in wanted:
        try:
            found += list(check(case))
        except Failed:
            pass
    # Exit code 4 is allowed: the run has found its own error and reported it.
    found += [(f"exit {ended.code}, run {name}", math.inf, math.inf if ended.code == 4 else 0, str(ended))
              for name, ended in case.runs.items() if isinstance(ended, Failed)]
    return found
