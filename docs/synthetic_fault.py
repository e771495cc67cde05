"""Writes cases/synthetic-fault.fsp: a finite-fault model of an invented earthquake, in the format of SRCMOD, as an example for `slipfront event`.

Usage: synthetic_fault.py

A vertical fault of 20 km by 8 km strikes north. The largest slip, 1 m, is 3 km south of the hypocentre. The rupture spreads from the
hypocentre at 2.6 km/s, and every subfault slips for 1.2 s.
"""

import math
import pathlib

ALONG, DOWN = 20, 8  # numbers of subfaults along strike and down dip, each 1 km by 1 km
HYPOCENTRE = (12.5, 4.5)  # km along strike from the southern end, km below the top
CENTRE = (9.5, 4.5)  # km, of the largest slip
RUPTURE_VELOCITY, RISE_TIME, MOST_SLIP = 2.6, 1.2, 1.0  # km/s, s, m
TOP = 2.0  # depth of the top of the fault, km
LAYERS = ((0.0, 5.0, 2.9, 2.6), (4.0, 6.0, 3.5, 2.7), (12.0, 6.8, 3.9, 2.9))  # depth of the top, P speed, S speed and density, in km, km/s, km/s and g/cm^3
RIGIDITY = 2700 * 3500**2  # Pa, shear modulus of the layer of the hypocentre


def slip_at(along, down) -> float:
    """Returns the slip in m at a point of the fault (km along strike, km below the top): half an ellipsoid, but at least 0.02 m."""
    away = ((along - CENTRE[0]) / 9) ** 2 + ((down - CENTRE[1]) / 4.5) ** 2
    return max(MOST_SLIP * math.sqrt(max(0.0, 1 - away)), 0.02)


def subfaults():
    """Yields (X, Y, Z, slip, rupture time) of each subfault: km east, north and down of the epicentre, m, s."""
    for j in range(DOWN):
        for i in range(ALONG):
            along, down = i + 0.5, j + 0.5
            away = math.hypot(along - HYPOCENTRE[0], down - HYPOCENTRE[1])
            yield 0.0, along - HYPOCENTRE[0], TOP + down, slip_at(along, down), away / RUPTURE_VELOCITY


def main():
    rows = list(subfaults())
    moment = RIGIDITY * 1e6 * sum(slip for *_, slip, _ in rows)
    magnitude = 2 / 3 * (math.log10(moment) - 9.05)
    lines = [
        "% ----------------------------------  FINITE-SOURCE RUPTURE MODEL  --------------------------------",
        "%", "% Event : Synthetic fault   01/01/2000   [slipfront]",
        "% EventTAG: s2000SYNTHEslip", "%",
        f"% Loc  : LAT  =   0.000      LON =    0.000      DEP = {TOP + HYPOCENTRE[1]:.2f}",
        f"% Size : LEN  =  {ALONG:.2f} km    WID =   {DOWN:.2f} km    Mw = {magnitude:.2f}       Mo = {moment:.2e} Nm",
        f"% Mech : STRK =    0         DIP =  90          RAKE = 180      Htop = {TOP:.2f} km",
        f"% Rupt : HypX =  {HYPOCENTRE[0]:.2f} km    HypZ =  {HYPOCENTRE[1]:.2f} km    avTr = {RISE_TIME:.1f} s    avVr = {RUPTURE_VELOCITY:.1f} km/s",
        "%", "% ----------------------------------  inversion-related parameters  --------------------------------", "%",
        f"% Invs :   Nx  =   {ALONG}           Nz  =    {DOWN}        Fmin = 0.01 Hz     Fmax = 1.0 Hz", "% Invs :   Dx  =   1.00 km      Dz  =  1.00 km",
        "% Invs :   Ntw =   1            Nsg =   1         (# of time-windows,# of fault segments)", "%",
        "% --------------------------------------------------------------------------------------------------", "%",
        "% VELOCITY-DENSITY STRUCTURE", f"% No. of layers =   {len(LAYERS)}", "%", "%   DEPTH      P-VEL      S-VEL       DENS        QP     QS",
        "%   [km]       [km/s]     [km/s]     [g/cm^3]", *(f"%   {z:6.2f}     {p:6.2f}     {s:6.2f}      {d:6.2f}      500    250" for z, p, s, d in LAYERS), "%",
        "% --------------------------------------------------------------------------------------------------", "% 01-Jan-2000, synthetic: no earthquake; made by docs/synthetic_fault.py of slipfront",
        "% --------------------------------------------------------------------------------------------------", "%", "% SOURCE MODEL PARAMETERS",
        f"%   Nsbfs =   {ALONG * DOWN} subfaults", "%   LAT       LON       X==EW     Y==NS       Z       SLIP      RAKE      TRUP      RISE",
        "% --------------------------------------------------------------------------------------------------",
        *(f"{y / 111.2:10.5f}{0.0:10.5f}{x:10.3f}{y:10.3f}{z:10.3f}{slip:10.4f}   180.000{time:10.4f}{RISE_TIME:10.3f}" for x, y, z, slip, time in rows),
    ]
    (pathlib.Path(__file__).parent.parent / "cases" / "synthetic-fault.fsp").write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
