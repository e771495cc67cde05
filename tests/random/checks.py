"""What must hold of every pulse, whatever the scenario. A check yields (name, value, allowed, note); it has failed where
the value is not at most what is allowed."""

import math

import numpy as np

import scenarios
from program import RESUME_CHECK, Failed, resumes_to_the_same_bits, run

INTERVALS = 128  # of the output times; a multiple of 4
ROUNDING = 1e-6  # what two runs of one problem may differ by, relative
LEAST_SLIP = 1e-6  # slips are differences of numbers of dislocations, known to 1e-12 or so
MAY_BE_ABSENT = {"trailing_characteristic", "leading_front", "trailing_front", "trailing_front_observed",
                 "leading_front_observed", "first_crossing_time", "first_crossing_position"}
ODD = {"slip_velocity_at_origin", "slip_at_origin", "peak_slip_velocity", "peak_position", "trailing_front",
       "leading_front", "trailing_front_observed", "leading_front_observed"}  # change sign in a mirror
EVEN = {"stress_at_origin", "energy_elastic", "energy_kinetic", "energy_dissipated", "energy_supplied", "cells"}
PLACES = {"peak_position", "trailing_front", "leading_front", "trailing_front_observed", "leading_front_observed"}


def dense(s):
    """The scenario with output times that crowd at t = 0, where velocities jump."""
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
    """Scales to measure differences by."""
    f = seen.fields
    end = f["time"][-1]
    fastest = max(float(np.max(np.abs(f["W"]))), abs(seen.summary["peak_slip_velocity"]))  # may be between the grid's centres
    return {"slip": max(float(np.max(np.abs(f["slip"]))), LEAST_SLIP), "W": fastest, "end": float(end),
            "k": float(np.max(f["k"]))}


class Case:
    """A scenario and its runs, each made when first asked for."""

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
        """Of a number or an array got from the fields, by three grids, as the program states its errors."""
        fine, half, quarter = (of_fields(seen.fields) for seen in (self.seen, self.half, self.quarter))
        return 1.25 * np.maximum(np.abs(fine - half), np.abs(half - quarter) / 2)

    def stated_error(self, key, other=None):
        """Of the difference between two runs, each with the error that it states."""
        errors = (run.errors.get(key, math.nan) for run in (self.plain, other or self.plain))
        return sum(0 if math.isnan(error) else error for error in errors)

    def profile_error(self, key):
        """Of the difference between profiles of two runs at the end."""
        x = self.seen.fields["x"]
        return 2 * self.grid_error(lambda fields: np.interp(x, fields["x"], fields[key][-1]))


def finite(case):
    viscous = case.s["friction"]["law"] in ("none", "viscous")
    absent = MAY_BE_ABSENT | (set() if viscous else {"friction_coefficient", "damping_number"})
    bad = [key for key, value in case.plain.summary.items()
           if isinstance(value, float) and not math.isfinite(value) and key not in absent]
    bad += [key for key, values in case.seen.fields.items()
            if not np.all(np.isfinite(values)) and key not in MAY_BE_ABSENT | {"energy_phonons"}]
    yield "finite", len(bad), 0, " ".join(bad)


def bounds(case):
    f = case.seen.fields
    yield "|U| < 1", float(np.max(np.abs(f["U"]))), 1 - 1e-12, "largest |U|"
    k = f["k"]
    beside = np.maximum(k, np.maximum(np.pad(k, ((0, 0), (1, 0)))[:, :-1], np.pad(k, ((0, 0), (0, 1)))[:, 1:]))
    ratio = float(np.max(np.abs(f["W"]) - beside * (1 + 1e-9)))
    yield "|W| <= k", ratio, 0, "largest |W| - k"
    yield "k >= 0", float(-np.min(k)), 1e-12, "least k, negative"


def slip_is_integral(case):
    f = case.seen.fields
    total, error = integral(f["slip_velocity_at_origin"])
    rate = integral(np.abs(f["slip_velocity_at_origin"]))[0]
    end = case.s["time"]["end"]
    slip = case.seen.summary["slip_at_origin"]
    largest = max(rate * end, float(np.max(np.abs(f["slip_at_origin"]))), LEAST_SLIP)
    # The error of slip as the run states it; that of the integral of W, of which it states only the last value, in the
    # same way.
    stated = case.seen.errors.get("slip_at_origin", math.nan)
    of_velocity = case.grid_error(lambda fields: integral(fields["slip_velocity_at_origin"])[0])
    allowed = ROUNDING + (2 * error * end + (0 if math.isnan(stated) else stated) + of_velocity * end) / largest
    if any("slip_at_origin grows with the cells" in text for text in case.seen.warnings):
        allowed = math.inf
    yield ("slip = int W", abs(slip - total * end) / largest, allowed,
           f"slip {slip:.6g}, integral of W {total * end:.6g}")


def outputs_change_nothing(case):
    """A run that stops at 128 times sees what happens between natural steps."""
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
    """Of |W| at the end, seen on the output grid and above what is rounding of the fastest."""
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
    names_fronts = abs(first[0] - first[-1]) > 0.01 * max(first[0], first[-1])  # else either side may be the stressed one
    for key in sorted(ODD | EVEN):
        if key not in mine or key == "peak_position" and not has_one_peak(case) or "front" in key and not names_fronts:
            continue
        a, b = mine[key], -other[key] if key in ODD else other[key]
        if math.isnan(a) and math.isnan(b) or a == b:
            continue
        if math.isnan(a) != math.isnan(b):  # as a front at the limit of what the cells resolve, by its stated error
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
        # Free edges run out of the domain, at less than c; the train that follows them does not leave it otherwise.
        out = np.maximum(left - x, x - right)[known] - np.where(empty_side(case, x[known]), t[known], 0)
        yield f"front in the domain: {key}", float(np.max(out)), 1e-9 * (right - left), f"{x[known][np.argmax(out)]:.6g}"
        # Where all of the interface moves at once, what is felt first is no signal.
        if key != "trailing_front" or case.s["initial"]["profile"] != "step" or "forcing" in case.s or "interface" in case.s:
            continue
        way = np.maximum(np.abs(np.diff(x[known])) - 3 * cell, 0)  # a foot is read from three cells
        late = np.diff(t[known]) > 1e-3 * end
        if late.any():
            yield f"front slower than c: {key}", float(np.max((way / np.diff(t[known]))[late])), 1, ""


def empty_side(case, x):
    """Whether a front at x may have run into an empty region beyond the domain."""
    k = case.seen.fields["k"][0]
    return np.where(x > case.seen.fields["x"][-1], k[-1] == 0, np.where(x < case.seen.fields["x"][0], k[0] == 0, False))


def dislocations_are_counted(case):
    """The loss of density left of each place is the slip there: number from k against number from slip."""
    f = case.seen.fields
    width = f["x_bounds"][:, 1] - f["x_bounds"][:, 0]
    lost = np.cumsum((f["k"][0] - f["k"][-1]) * width)[:-1]
    slip = f["slip"][-1]
    at_faces = (slip[1:] + slip[:-1]) / 2 - slip[0]
    curve = np.max(np.abs(np.diff(slip, 2)), initial=0)
    scale = size_of(case.seen)["slip"]
    rounding = 1e-8 * float(np.max(f["k"][0])) * float(width[0])  # of psi, which k is got from
    rounding += float(np.max(case.profile_error("k"))) * float(width[0])  # and of where it lies within a cell
    difference = float(np.max(np.abs(lost - (f["k"][0][0] - f["k"][-1][0]) * width[0] / 2 - at_faces)))
    yield "dislocations counted", difference / scale, 1e-6 + (3 * float(curve) + rounding) / scale, "k against slip"
    error = case.plain.summary["conservation_error"]
    told = any("dislocations than there are" in text for text in case.plain.warnings)
    yield "conservation_error", error, math.inf if told else 0.01, "a warning" if told else ""


def energy(case):
    """Energy may leave with a shock, never appear. Only where nothing happens at the ends."""
    f = case.seen.fields
    if max(abs(f["W"][:, [0, -1]]).max(), abs(f["slip"][:, [0, -1]]).max()) > 1e-9 * max(1e-300, abs(f["W"]).max()):
        return
    total = f["energy_elastic"] + f["energy_kinetic"] + f["energy_dissipated"] - f["energy_supplied"]
    moved = np.max(f["energy_kinetic"] + f["energy_dissipated"] + np.abs(f["energy_supplied"]))
    if moved > 0:
        gained = float(np.max(total - total[0])) / moved
        error = abs(f["energy_elastic"][0] - case.half.fields["energy_elastic"][0]) + case.stated_error("energy_shocks")
        told = any("energy was created" in text for text in case.plain.warnings)
        yield "energy made from nothing", gained, math.inf if told else 1e-3 + 2 * error / moved, f"of {moved:.3g} that moved"


def resumes(case):
    if RESUME_CHECK.exists():
        yield "resume", int(not resumes_to_the_same_bits(case.s)), 0, "state at the end, bit by bit"


ALL = [resumes, finite, bounds, slip_is_integral, outputs_change_nothing, same_in_a_mirror, same_when_shifted, fronts,
       dislocations_are_counted, energy]


def results_of(s, wanted=ALL):
    """All results of one scenario; a run that fails is a result."""
    case = Case(s)
    found = []
    for check in wanted:
        try:
            found += list(check(case))
        except Failed:
            pass
    # A run that finds itself wrong has said so: code 4.
    found += [(f"exit {ended.code}, run {name}", math.inf, math.inf if ended.code == 4 else 0, str(ended))
              for name, ended in case.runs.items() if isinstance(ended, Failed)]
    return found
