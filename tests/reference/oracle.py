"""The mathematics behind the reference tables, at any precision: mpmath only, naive formulas, enough digits.

Shares nothing with the library. Functions take mpf and work at the precision in force. Symbols: NOTATION, and
    phi, psi   U = tanh(phi), sqrt(m1) = tanh(psi);  m = 1 - m1 is the elliptic parameter, never the modulus
    rapidity   atanh(c0), c0 = tanh(psi) K / E: the sound speed in the frame of the train
"""
from collections import namedtuple
from functools import lru_cache
from mpmath import agm, asin, atanh, cos, cosh, exp, log, mp, mpf, nint, nstr, pi, sin, sinh, sqrt, tanh

DIGITS = 60  # working digits where nothing cancels; the second pass of `twice` has 40 more


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
    """The zero of f between a and b: bracketed secants (Anderson & Bjorck), until a step is below 1e-45 of itself."""
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
    """Carlson's R_F(x, y, z) by duplication: a second route to F and K, sharing nothing with the AGM."""
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

    Ill-conditioned near quarter periods: the caller works with -2.2 log10(m1) extra digits."""
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
def train_samples(psi, digits):  # digits = mp.dps, named so that the cache tells precisions apart
    """(dn, am) at equidistant points of one period: the trapezoidal rule then converges like exp(-n pi K'/K)."""
    m1 = tanh(psi)**2
    ratio = agm(1, 1 / cosh(psi)) / agm(1, tanh(psi))  # K / K'
    count = 8 + int(digits * log(10) * ratio / pi)
    quarter = pi / (2 * agm(1, tanh(psi)))
    angles = [amplitude(quarter * (2 * j + 1 - count) / count, m1)[1] for j in range(count)]
    return [(sqrt(cos(a)**2 + m1 * sin(a)**2), a) for a in angles]


def averages_by_quadrature(phi, psi):
    """The same averages as means over one period of the fields u = pi - 2 am, sigma = 2 beta dn, w = U sigma."""
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
    """The psi at which a monotonic condition vanishes, sought in log(psi)."""
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
    """The state of given psi that a wave joins to `outer`; side = -1 the left (1-) wave, +1 the right (2-) wave."""
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
    """Outermost and innermost speed of a wave; for a shock they are one; jump and Lax conditions checked."""
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
