"""The mathematics of the reference tables, at any precision. It uses only mpmath, with simple formulas and enough digits.

It shares no code with the library. Functions take mpf and work at the current precision. Symbols are those of docs/NOTATION.md, and
    phi, psi   U = tanh(phi), sqrt(m1) = tanh(psi);  m = 1 - m1 is the elliptic parameter, never the modulus
    rapidity   atanh(c0), c0 = tanh(psi) K / E: the sound speed in the frame of the train
"""
from collections import namedtuple
from functools import lru_cache
from mpmath import (agm, asin, asinh, atanh, cos, cosh, exp, log, lu_solve, matrix, mp, mpf, nint, nstr, pi, sin, sinh,
                    sqrt, tanh)

DIGITS = 60  # working digits if nothing cancels; the second pass of `twice` has 40 more


# --- arithmetic ------------------------------------------------------------------------------------------------

def twice(compute, digits=DIGITS):
    """The list of numbers that compute() returns, evaluated at two precisions that must agree to 28 digits."""
    with mp.workdps(digits):
        first = compute()
    with mp.workdps(digits + 40):
        second = compute()
        for a, b in zip(first, second):
            assert abs(a - b) <= mpf(10)**-28 * abs(b), (nstr(a, 32), nstr(b, 32))
    return second


def zero(f, a, b):
    """The zero of f between a and b, by bracketed secants (Anderson & Bjorck), until a relative step is below 1e-45."""
    fa, fb = f(a), f(b)
    assert fa * fb <= 0, "no sign change"
    for _ in range(300):
        x = b - fb * (b - a) / (fb - fa)
        fx = f(x)
        if fx == 0 or abs(x - b) <= mpf(10)**-45 * abs(x):
            return x
        if fx * fb < 0:
            a, fa = b, fb
        else:
            fa *= max(1 - fx / fb, 0) or mpf(1) / 2
        b, fb = x, fx
    raise ArithmeticError("no convergence")


# --- elliptic functions of the complementary parameter -----------------------------------------------------------

def complete(m1):
    """K and E by the arithmetic-geometric mean: K = pi / 2 agm, E = K (1 - sum 2^(n-1) c_n^2), c_0^2 = m."""
    a, b, weight, total = mpf(1), sqrt(m1), mpf(1) / 2, (1 - m1) / 2
    while abs(a - b) > mp.eps * a * 8:
        a, b, c = (a + b) / 2, sqrt(a * b), (a - b) / 2
        weight *= 2
        total += weight * c * c
    return pi / (2 * a), pi / (2 * a) * (1 - total)


def carlson_rf(x, y, z):
    """Carlson's R_F(x, y, z) by duplication: a second method for F and K, which has nothing in common with the AGM."""
    a0 = a = (x + y + z) / 3
    dx, dy, scale = a0 - x, a0 - y, mpf(1)
    reach = max(abs(a0 - v) for v in (x, y, z)) * (3 * mp.eps)**(-mpf(1) / 6)
    while scale * reach > abs(a):
        shift = sqrt(x) * sqrt(y) + sqrt(y) * sqrt(z) + sqrt(z) * sqrt(x)
        x, y, z, a, scale = (x + shift) / 4, (y + shift) / 4, (z + shift) / 4, (a + shift) / 4, scale / 4
    dx, dy = dx * scale / a, dy * scale / a
    dz = -dx - dy
    e2, e3 = dx * dy - dz * dz, dx * dy * dz
    return (1 - e2 / 10 + e3 / 14 + e2 * e2 / 24 - 3 * e2 * e3 / 44) / sqrt(a)


def amplitude(z, m1):
    """am(z) = n pi + rest as (n, rest), |rest| <= pi/2, by descending Landen (Abramowitz & Stegun 16.4).

    It is ill-conditioned near quarter periods, so the caller works with -2.2 log10(m1) extra digits."""
    steps, a, b = [], mpf(1), sqrt(m1)
    n = nint(z * agm(1, b) / pi)
    z -= n * pi / agm(1, b)
    while abs(a - b) > mp.eps * a * 8:
        a, b, c = (a + b) / 2, sqrt(a * b), (a - b) / 2
        steps.append(c / a)
    rest = 2**len(steps) * a * z
    for ratio in reversed(steps):
        rest = (rest + asin(ratio * sin(rest))) / 2
    return int(n), rest


# --- trains -------------------------------------------------------------------------------------------------------

def averages_by_formula(phi, psi):
    """The averages of the uniform train in closed form."""
    u, m1, m, beta = tanh(phi), tanh(psi)**2, 1 / cosh(psi)**2, cosh(phi) * cosh(psi)
    k_, e_ = complete(m1)
    k, s2, s3, osc = pi * beta / k_, 4 * beta**2 * e_ / k_, (2 * beta)**3 * pi * (2 - m) / (4 * k_), \
        2 / m * (e_ / k_ - m1)
    flux, energy = (1 + u * u) / 2 * s2 - osc, (1 + u * u) / 2 * s2 + osc
    assert abs(flux - u * u * s2 - 2 * sinh(psi)**2) <= mpf(10)**-30 * flux  # Q = U P + 2 sinh^2 psi
    return [k, u * k, s2, s3, osc, u * s2, flux, energy, 4 / pi * u * beta * e_, 4 / pi * beta * e_]


@lru_cache(maxsize=None)
def train_samples(psi, digits):  # digits = mp.dps is an argument, so that the cache distinguishes precisions
    """(dn, am) at n equidistant points of one period. There the trapezoidal rule converges like exp(-n pi K'/K)."""
    m1 = tanh(psi)**2
    ratio = agm(1, 1 / cosh(psi)) / agm(1, tanh(psi))  # K / K'
    count = 8 + int(digits * log(10) * ratio / pi)
    quarter = pi / (2 * agm(1, tanh(psi)))
    angles = [amplitude(quarter * (2 * j + 1 - count) / count, m1)[1] for j in range(count)]
    return [(sqrt(cos(a)**2 + m1 * sin(a)**2), a) for a in angles]


def averages_by_quadrature(phi, psi):
    """The averages of `averages_by_formula` as means over one period of the fields u = pi - 2 am, sigma = 2 beta dn, w = U sigma."""
    u = tanh(phi)
    beta = 1 / sqrt((1 - tanh(psi)**2) * (1 - u * u))
    fields = [(2 * beta * dn, u * 2 * beta * dn, 1 - cos(pi - 2 * am)) for dn, am in train_samples(psi, mp.dps)]

    def mean(f):
        return sum(f(*point) for point in fields) / len(fields)
    k = mean(lambda s, w, o: s)
    s2 = mean(lambda s, w, o: s * s)
    momentum = mean(lambda s, w, o: s * w)
    return [k, mean(lambda s, w, o: w), s2, mean(lambda s, w, o: s**3), mean(lambda s, w, o: o), momentum,
            mean(lambda s, w, o: (w * w + s * s) / 2 - o), mean(lambda s, w, o: (w * w + s * s) / 2 + o),
            momentum / k, s2 / k]


# --- the frictionless pulse into an empty interface ---------------------------------------------------------------

def rapidity(psi):
    k, e = complete(tanh(psi)**2)
    return atanh(tanh(psi) * k / e)


def slip_velocity(psi0):
    """W(0) = tanh(phi0) k(phi0, psi0) with phi0 = rapidity(psi0)."""
    return pi * sinh(rapidity(psi0)) * cosh(psi0) / complete(tanh(psi0)**2)[0]


def psi_of(condition, low=-720, high=2.4):
    """The psi at which a monotonic function `condition` vanishes. The search is in log(psi)."""
    return exp(zero(lambda x: condition(exp(x)), mpf(low), mpf(high)))


def psi_of_stress(stress):
    return psi_of(lambda psi: complete(tanh(psi)**2)[0] / cosh(psi) - pi / stress)


def pulse(psi):
    """All columns of relations*.csv for the stored state psi."""
    k, e = complete(tanh(psi)**2)
    psi0 = psi_of(lambda x: log(x + rapidity(x)) - log(psi))
    phi0 = rapidity(psi0)
    return [pi * cosh(psi) / k, tanh(psi) * k / e, tanh(psi), k / e, slip_velocity(psi0),
            pi * cosh(phi0) * cosh(psi0) / complete(tanh(psi0)**2)[0], tanh(phi0), psi, psi0]


# --- the Riemann problem of (k, P) -----------------------------------------------------------------------------------

State = namedtuple("State", "phi psi U p l M")  # speed, pressure, spacing and momentum of a dislocation


def state(phi, psi, k_, e_):
    return State(phi, psi, tanh(phi), 2 * sinh(psi)**2, 2 * k_ / (cosh(phi) * cosh(psi)),
                 8 * sinh(phi) * cosh(psi) * e_)


def make_state(phi, psi):
    return state(phi, psi, *complete(tanh(psi)**2))


def wave(outer, psi, side):
    """The state with the given psi that a wave connects to `outer`. side is -1 for the left (1-) and +1 for the right (2-) wave."""
    if psi - outer.psi <= mpf(10)**-40 * psi:  # a fan (a shock this weak does not differ from one)
        return make_state(outer.phi + side * (psi - outer.psi), psi)
    k_, e_ = complete(tanh(psi)**2)

    def jump(step):  # [p][l] + [U][M]: negative at step 0, positive far away
        s = state(outer.phi + side * step, psi, k_, e_)
        return (s.p - outer.p) * (s.l - outer.l) + (s.U - outer.U) * (s.M - outer.M)
    low, high = mpf(0), 2 * (psi - outer.psi)
    while jump(high) < 0:
        low, high = high, 2 * high
    return state(outer.phi + side * zero(jump, low, high), psi, k_, e_)


def speeds(outer, star, side):
    """Outermost and innermost speed of a wave, which are equal for a shock. Checks the jump and Lax conditions."""
    head, tail = (tanh(s.phi + side * rapidity(s.psi)) for s in (outer, star))
    if star.psi <= outer.psi:
        return head, tail
    (k0, p0, q0), (k1, p1, q1) = ((2 * pi / s.l, s.M / s.l, s.U * s.M / s.l + s.p) for s in (outer, star))
    s = (star.U * k1 - outer.U * k0) / (k1 - k0)
    assert abs(s * (p1 - p0) - (q1 - q0)) <= mpf(10)**-28 * (abs(s * (p1 - p0)) + abs(q1 - q0))
    assert side * head < side * s < side * tail
    return s, s


def riemann(phi_l, psi_l, phi_r, psi_r):
    """The solution: phi*, psi*, k*, W*, left head and tail, right tail and head."""
    left, right = make_state(phi_l, psi_l), make_state(phi_r, psi_r)

    def mismatch(x):
        return wave(left, exp(x), -1).phi - wave(right, exp(x), 1).phi
    low, high = sorted([log(left.psi), log(right.psi)])
    if mismatch(low) <= 0:  # two fans
        psi = (left.phi + left.psi - right.phi + right.psi) / 2
    else:
        while mismatch(high) > 0:
            low, high = high, high + 1
        psi = exp(zero(mismatch, low, high))
    star = wave(left, psi, -1)
    if abs(star.phi) < mpf(10)**-40 * psi:  # a symmetric collision
        star = make_state(mpf(0), psi)
    left_speeds, right_speeds = speeds(left, star, -1), speeds(right, star, 1)
    k = 2 * pi / star.l
    return [star.phi, psi, k, star.U * k, *left_speeds, *reversed(right_speeds)]


# --- several trains at one position ----------------------------------------------------------------------------------

def between(a, b, step, goal):
    """Nodes (x, x - a, b - x, weight) of the tanh-sinh rule for an integral from a to b with ends like 1 / sqrt."""
    count = int(asinh(goal * log(10) * 2.2 / pi) / step) + 1
    for n in range(-count, count + 1):
        q = exp(-pi * sinh(n * step))
        weight = step * pi * cosh(n * step) * q / (1 + q)**2
        yield a + (b - a) / (1 + q), (b - a) / (1 + q), (b - a) * q / (1 + q), (b - a) * weight


def outwards(step, goal):
    """Nodes (s, weight) of the double-exponential rule for 0 < s < inf, for 1 / sqrt(s) at 0 and exp(-s) far away."""
    n = -int((log(goal * log(10) * 2.2) + 1) / step)
    while True:
        s = exp(n * step - exp(-n * step))
        if s > goal * log(10):
            return
        yield s, step * s * (1 + exp(-n * step))
        n += 1


def trains(centre, widths, goal):
    """The averages of N trains from the 2 N edges of their bands, by the formulas of docs/theory/9_trains.md 9.2 as they
    are printed: powers of exp(r), and double-exponential rules. `goal` is the number of digits of these rules; the
    working precision must be higher, because the powers cancel if bands or gaps are narrow.

    Returns the lists of speeds, k, omega, I and J, and P, H, Q, and the flux of H, which equals P."""
    r = [centre - sum(widths) / 2]
    for width in widths:
        r.append(r[-1] + width)
    trains_, total = len(r) // 2, sum(r)
    top = trains_ + 1
    powers, all_powers = range(-top, top + 1, 2), range(-top - 1, top + 2)
    # The integrands have singularities at the other edges. In the variable of the rule, their distance is pi / log(1 / gap).
    reach = max(-log(min(widths)), mpf(3)) + r[-1] - r[0] + 2
    step = 3 * pi * pi / reach / (goal * log(10) + 5)

    def inner(low):
        """[j, n]: integral of (r - r_low)^n exp(j r) / sqrt(R) from edge `low` to the next."""
        sums = {(j, n): mpf(0) for j in all_powers for n in (0, 1)}
        for x, above, below, weight in between(r[low], r[low + 1], step, goal):
            square = 4 * sinh(above) * sinh(below)
            for j, edge in enumerate(r):
                if j not in (low, low + 1):
                    square *= 2 * abs(sinh(x - edge))
            term, factor = weight * exp(all_powers[0] * x) / sqrt(square), exp(x)
            for j in all_powers:
                sums[j, 0] += term
                sums[j, 1] += term * above
                term *= factor
        return sums

    def outer(side):
        """Like inner, over the lowest (side = -1) or highest gap. exp(|r|) / 2 is subtracted from the term with the pole."""
        end = r[0] if side < 0 else r[-1]
        sums = {(j, n): mpf(0) for j in powers for n in (0, 1)}
        for s, weight in outwards(step, goal):
            x, square = end + side * s, 2 * sinh(s)
            for edge in r[1:] if side < 0 else r[:-1]:
                square *= 2 * abs(sinh(x - edge))
            for j in powers:
                term = exp(j * x) / sqrt(square)
                if j == side * top:
                    term = exp(-side * total / 2) / 2 * term - exp(side * x) / 2
                sums[j, 0] += term * weight
                sums[j, 1] += term * weight * side * s
        return sums

    bands, gaps = ([inner(low) for low in range(first, len(widths), 2)] for first in (0, 1))
    lowest, highest = outer(-1), outer(1)
    sign = (-1)**trains_  # the sign of the root in the lowest gap
    upper, lower = exp(-total / 2) / 2, exp(total / 2) / 2 * -sign

    def differential(kind):
        """The coefficients of dp (kind = 1) or dw (-1)."""
        free = powers[1:-1]
        conditions, known = matrix(trains_, trains_), matrix(trains_, 1)
        known[0] = kind * (lowest[-top, 0] - exp(-r[0]) / 2) - sign * upper * lowest[top, 0]
        for column, j in enumerate(free):
            conditions[0, column] = sign * lowest[j, 0]
            for row, gap in enumerate(gaps, 1):
                conditions[row, column] = gap[j, 0]
        for row, gap in enumerate(gaps, 1):
            known[row] = -upper * gap[top, 0] - kind * lower * gap[-top, 0]
        return {**dict(zip(free, lu_solve(conditions, known))), top: upper, -top: kind * lower}

    def over_band(f, i, shift=0):  # with exp(shift r)
        return (-1)**(trains_ - 1 - i) * sum(f[j] * bands[i][j + shift, 0] for j in powers)

    def action(f, kind, i):
        """I (of p) or J (of w): finite parts over the gaps below band i, minus those above, by parts."""
        parts = [kind * lowest[-top, 1] - sign * sum(f[j] * lowest[j, 1] for j in powers[1:]) - kind * exp(-r[0]) / 2]
        for m, gap in enumerate(gaps, 1):
            parts.append(-(-1)**(trains_ - m) * sum(f[j] * gap[j, 1] for j in powers))
        parts.append(-highest[top, 1] - sum(f[j] * highest[j, 1] for j in powers[:-1]) - exp(r[-1]) / 2)
        return 2 / pi * (sum(parts[:i + 1]) - sum(parts[i + 1:]))

    p, w = differential(1), differential(-1)
    up, down, w_up, w_down = (4 / (2 * pi) * sum(over_band(f, i, shift) for i in range(trains_))
                              for f in (p, w) for shift in (1, -1))
    each = range(trains_)
    return ([sum(w[j] * exp(j * x) for j in powers) / sum(p[j] * exp(j * x) for j in powers) for x in r],
            [over_band(p, i) for i in each], [over_band(w, i) for i in each], [action(p, 1, i) for i in each],
            [action(w, -1, i) for i in each], up - down, up + down, w_up - w_down, w_up + w_down)
