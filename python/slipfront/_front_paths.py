"""Paths and velocities of fronts, from the arrivals of slip at evenly spaced positions."""

import math

from ._numbers import np

#: A local velocity is fitted through as many positions as this to either side of a position, if
#: arrivals were recorded at each step.
HALF_WINDOW = 3

#: The same if arrivals come from outputs. They show a front to a cell, so a few cells would show
#: how many of them it crosses between most outputs.
HALF_WINDOW_OF_OUTPUTS = 20


def _share(row, inside, outside, level):
    """Returns where `row` falls to `level`, from 0 at `inside` to 1 at `outside`, or else 0.5."""
    drop = row[inside] - row[outside]
    return (row[inside] - level) / drop if row[inside] > level and drop > 0 else 0.5


def arrivals(times, speed, level):
    """Returns the time at which each column of speed[time, position] first exceeds `level`, and NaN
    where it never does.

    A front crosses several positions between two output times. It is taken to move at a constant
    velocity from where it was to where it is; both are read between positions. Where slip begins
    between two outputs, all positions have the time of the later one."""
    found = np.full(speed.shape[1], np.nan)
    for now in range(len(times)):
        before = np.isfinite(found)
        for first, last in _runs(np.where((speed[now] > level) & ~before, 0.0, np.nan)):
            along = np.arange(first, last + 1)
            sides = []  # share of the interval at which the front from each side arrives
            for inside, ahead in ((first - 1, along - first), (last + 1, last - along)):
                if now > 0 and 0 <= inside < before.size and before[inside]:
                    step = 1 if inside < first else -1
                    beyond = (last if step > 0 else first) + step
                    start = _share(speed[now - 1], inside, inside + step, level) - 1
                    reached = 0 <= beyond < before.size and not before[beyond]
                    end = last - first + (_share(speed[now], beyond - step, beyond, level)
                                          if reached else 0.0)
                    sides.append((ahead - start) / max(end - start, 1e-9))
            if not sides:
                found[along] = times[now]
                continue
            share = 2 * np.minimum(*sides) if len(sides) == 2 else sides[0]
            found[along] = times[now - 1] + np.clip(share, 0, 1) * (times[now] - times[now - 1])
    return found


def _turns(times, tolerance):
    """Returns the indices at which arrival times turn by more than `tolerance`, and the last."""
    found, rising, extreme = [], True, 0
    for i in range(1, len(times)):
        sign = 1 if rising else -1
        if sign * (times[i] - times[extreme]) >= 0:
            extreme = i
        elif sign * (times[extreme] - times[i]) > tolerance:
            found.append(extreme)
            rising, extreme = not rising, i
    return [*found, len(times) - 1] if len(times) > 1 else []


def _runs(times):
    """Yields (first, last) of each stretch of positions that slip reaches."""
    reached = np.concatenate(([False], np.isfinite(times), [False]))
    for first, last in np.flatnonzero(reached[1:] != reached[:-1]).reshape(-1, 2):
        yield int(first), int(last) - 1


def _source(times, first, last):
    """Returns the ends of the longest stretch that slips at once; of all, the left end twice."""
    begins = times[first:last + 1] == np.min(times[first:last + 1])
    if begins.all():
        return first, first
    left, right = max(_runs(np.where(begins, 0.0, np.nan)), key=lambda run: run[1] - run[0])
    return first + left, first + right


def fronts_of(times, tolerance):
    """Returns (begin, end) indices of each front: slip begins at a local minimum of the arrival
    times, which may be a stretch, and spreads from there until the arrival times fall by more than
    `tolerance`, where another front comes to meet it, or until a position that slip does not reach.
    A single position is (i, i)."""
    found = []
    for first, last in _runs(times):
        left, right = _source(times, first, last)
        to_right = [right + i for i in _turns(times[right:last + 1], tolerance)]
        to_left = [left - i for i in _turns(times[left:first - 1 if first else None:-1], tolerance)]
        if first == last:
            found.append((first, first))
        for source, turns in ((left, to_left), (right, to_right)):
            corners = [source, *turns]
            for i, pair in enumerate(zip(corners, corners[1:])):
                found.append(pair if i % 2 == 0 else pair[::-1])
    return found


def _slope(x, y):
    """Returns the median slope of all pairs of points (Theil and Sen)."""
    first, second = np.triu_indices(len(x), 1)
    return float(np.median((y[second] - y[first]) / (x[second] - x[first])))


def begin_of_motion(times, path):
    """Returns the index in a path after the positions that had slipped at the first output."""
    tied = np.flatnonzero(times[path] != times[path[0]])
    start = int(tied[0]) - 1 if tied.size else 0
    return start if path.size - start >= 3 else 0


def velocities(x, times, begin, end, half_window=HALF_WINDOW):
    """Returns the indices of a front in its direction, and its velocity at each of them: infinite
    where slip arrives everywhere at once, NaN if the front has fewer than three positions. The
    slope of time against position is fitted, because arrival times have the errors."""
    step = 1 if end >= begin else -1
    path = np.arange(begin, end + step, step)
    found = np.full(path.size, math.nan)
    if path.size < 3:
        return path, found
    start = begin_of_motion(times, path)
    for i in range(path.size):
        near = path[max(start, i - half_window):max(start, i) + half_window + 1]
        slowness = step * _slope(x[near], times[near])
        found[i] = 1 / slowness if slowness > 0 else math.inf
    return path, found


def rayleigh_speed(poisson_ratio):
    """Returns the speed of Rayleigh waves over the speed c of the model, c_s (2 / (1 - nu))^(1/2).
    The square r of Rayleigh over S-wave speed is the root of r^3 - 8 r^2 + (24 - 16 k) r - 16 (1 -
    k) between 0 and 1, with k = (c_s / c_p)^2."""
    k = (1 - 2 * poisson_ratio) / (2 - 2 * poisson_ratio)
    roots = np.roots([1, -8, 24 - 16 * k, -16 * (1 - k)])
    r = min(root.real for root in roots if abs(root.imag) < 1e-9 and 0 < root.real < 1)
    return math.sqrt(r * (1 - poisson_ratio) / 2)
