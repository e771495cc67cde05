"""`slipfront event MODEL.fsp -o OUT.srf`, read back by a reader of the Standard Rupture Format 2.0 that shares no code with
the program."""

import dataclasses
import json
import math
import os
import unittest

import numpy
import xarray

from support import SOURCE, CommandLine, run

KM_PER_DEGREE = 6371 * math.pi / 180
LAYERS = [(0.0, 5.0, 2.9, 2.6), (4.0, 6.0, 3.5, 2.7), (12.0, 6.8, 3.9, 2.9)]  # km, km/s, km/s, g/cm^3


@dataclasses.dataclass
class Plane:
    longitude: float
    latitude: float
    along_strike: int
    down_dip: int
    length: float
    width: float
    strike: float
    dip: float
    top: float
    hypocentre: tuple[float, float]


@dataclasses.dataclass
class Point:
    longitude: float
    latitude: float
    depth: float
    strike: float
    dip: float
    area: float
    start: float
    step: float
    s_speed: float
    density: float
    rake: float
    slip: float
    rates: list[float]

    def moment(self, slip):  # N m, from CGS
        return self.density * self.s_speed ** 2 * self.area * slip * 1e-7


def read_srf(path):
    """Planes, blocks of points, comments."""
    with open(path, encoding="ascii") as file:
        lines = file.read().split("\n")
    assert lines[0] == "2.0", lines[0]
    comments = [line for line in lines if line.startswith("#")]
    words = iter(" ".join(line for line in lines[1:] if not line.startswith("#")).split())

    def numbers(count):
        return [float(next(words)) for _ in range(count)]

    assert next(words) == "PLANE"
    planes = []
    for _ in range(int(next(words))):
        lon, lat, nx, nz, length, width, strike, dip, top, *hypocentre = numbers(11)
        planes.append(Plane(lon, lat, int(nx), int(nz), length, width, strike, dip, top, tuple(hypocentre)))
    blocks = []
    for _ in planes:
        assert next(words) == "POINTS"
        block = []
        for _ in range(int(next(words))):
            head = numbers(10)
            rake, slip, count, slip2, count2, slip3, count3 = numbers(7)
            assert (slip2, count2, slip3, count3) == (0, 0, 0, 0)
            block.append(Point(*head, rake, slip, numbers(int(count))))
        blocks.append(block)
    assert next(words, None) is None
    return planes, blocks, comments


@dataclasses.dataclass
class Row:
    segment: int
    east: float  # km, middle of the upper edge
    north: float
    depth: float
    slip: float  # m
    rake: float
    rupture_time: float
    rise_time: float
    middle: float  # depth of the centre


@dataclasses.dataclass
class Segment:
    strike: float
    dip: float
    nx: int
    nz: int
    dx: float
    dz: float
    east: float  # position of the upper edge of the first subfault
    north: float
    top: float

    def rows(self, number):
        strike, dip = math.radians(self.strike), math.radians(self.dip)
        for j in range(self.nz):
            for i in range(self.nx):
                down = self.dz * j * math.cos(dip)
                yield Row(number, self.east + self.dx * i * math.sin(strike) + down * math.cos(strike),
                          self.north + self.dx * i * math.cos(strike) - down * math.sin(strike),
                          self.top + self.dz * j * math.sin(dip),
                          slip=round(1.5 + math.sin(0.7 * i + 1.3 * j + number), 4) if (i + j) % 5 else 0.0,
                          rake=10.0 * i - 5 * j, rupture_time=round(-0.6 + 0.9 * i + 0.4 * j + 4 * number, 3),
                          rise_time=0 if i == 1 else 0.8 + 0.1 * j,
                          middle=self.top + self.dz * (j + 0.5) * math.sin(dip))


SEGMENTS = [Segment(20, 90, 5, 4, 2.0, 1.5, 0.0, 0.0, 0.5), Segment(200, 35, 4, 3, 3.0, 2.5, -8.0, 3.0, 2.0),
            Segment(310, 60, 3, 6, 2.0, 2.0, 4.0, -9.0, 0.0)]


def model_text(times="TRUP", rupture_velocity="2.5", rise="RISE", rise_time="1.2", layers=True, exchanged=False):
    rows = [row for k, segment in enumerate(SEGMENTS) for row in segment.rows(k)]
    text = ["% FINITE-SOURCE RUPTURE MODEL", "% Event : Three planes 01/01/2000 [test]",
            "% Loc  : LAT = 10.0  LON = 179.95  DEP = 3.0", "% Size : LEN = 10 km WID = 6 km Mw = 6.5 Mo = 1e19 Nm",
            "% Mech : STRK = 20 DIP = 90 RAKE = 170 Htop = 0.5 km",
            f"% Rupt : HypX = 3 km HypZ = 3 km avTr = {rise_time} s avVr = {rupture_velocity} km/s",
            "% Invs : Nx = 5 Nz = 4 Nsg = 3", "% VELOCITY-DENSITY STRUCTURE"]
    if layers:
        text += [f"% No. of layers = {len(LAYERS)}", "% DEPTH P-VEL S-VEL DENS"]
        text += ["% " + " ".join(map(str, layer)) for layer in LAYERS]
    text += ["% ---", "% Coordinates are given for top-center of each subfault"]
    for k, segment in enumerate(SEGMENTS):
        titles = "X==NS Y==EW" if exchanged else "X==EW Y==NS"
        text += [f"% SEGMENT # {k + 1}: STRIKE = {segment.strike} deg DIP = {segment.dip} deg",
                 f"% LEN = {segment.nx * segment.dx} km WID = {segment.nz * segment.dz} km",
                 f"% depth to top: Z2top = {segment.top} km", f"% Nsbfs = {segment.nx * segment.nz} subfaults",
                 f"% LAT LON {titles} Z SLIP RAKE {times} {rise}"]
        for r in (row for row in rows if row.segment == k):
            lat = 10 + r.north / KM_PER_DEGREE
            lon = 179.95 + r.east / (KM_PER_DEGREE * math.cos(math.radians(lat)))
            text.append(f"{lat:.6f} {lon:.6f} {r.east:.5f} {r.north:.5f} {r.depth:.5f} {r.slip:.4f} {r.rake} "
                        f"{r.rupture_time:.3f} {r.rise_time}")
    return "\n".join(text) + "\n", rows


def modulus(depth):  # Pa, at a depth in km
    layer = [at for at in LAYERS if at[0] <= depth][-1]
    return 1e9 * layer[3] * layer[2] ** 2


def drops_by_fourier(segment, rows, poisson_ratio, finer=25, wider=4):
    """Stress drop of each subfault in Pa by the kernel of Andrews (1980) in wave numbers, on a grid with `finer`^2 points
    a subfault and empty space around the segment. Its error falls as 1 / finer^2, to 1 % here."""
    nx, nz = segment.nx * wider * finer, segment.nz * wider * finer
    cells = numpy.zeros((2, nz, nx))  # along strike, and up dip: the first row is the deepest
    weight = moduli = 0.0
    for n, r in enumerate(rows):
        i, j = n % segment.nx, segment.nz - 1 - n // segment.nx
        where = (slice(j * finer, (j + 1) * finer), slice(i * finer, (i + 1) * finer))
        cells[0][where] = r.slip * math.cos(math.radians(r.rake))
        cells[1][where] = r.slip * math.sin(math.radians(r.rake))
        weight += r.slip
        moduli += r.slip * modulus(r.middle)
    step_x, step_z = 1000 * segment.dx / finer, 1000 * segment.dz / finer
    kx, kz = numpy.meshgrid(2 * math.pi * numpy.fft.fftfreq(nx, step_x), 2 * math.pi * numpy.fft.fftfreq(nz, step_z))
    k = numpy.hypot(kx, kz)
    k[0, 0] = 1  # the mean slip moves both sides as a whole, without stress
    slip = numpy.fft.fft2(cells)
    slip[:, 0, 0] = 0
    slip *= numpy.exp(-((kx * step_x) ** 2 + (kz * step_z) ** 2) / 2)  # one point wide: without it the edges ring
    along = slip[0] * kx + slip[1] * kz
    factor = poisson_ratio / (1 - poisson_ratio)
    half = moduli / weight / 2
    stress = [numpy.fft.ifft2(-half * (k * slip[c] + factor * (kx, kz)[c] * along / k)).real for c in (0, 1)]
    drops = []
    for n, r in enumerate(rows):
        i, j = n % segment.nx, segment.nz - 1 - n // segment.nx
        at = (j * finer + finer // 2, i * finer + finer // 2)
        drops.append(-stress[0][at] * math.cos(math.radians(r.rake)) - stress[1][at] * math.sin(math.radians(r.rake)))
    return drops


class Srf(CommandLine):
    def source(self, text, *options):
        model = self.file("model.fsp", text)
        out = os.path.join(os.path.dirname(model), "out.srf")
        done = self.ok("event", model, "-o", out, "--json", *options)
        return read_srf(out), json.loads(done)["events"][0]

    def test_keeps_moment_geometry_and_times_of_three_segments(self):
        text, rows = model_text()
        (planes, blocks, comments), event = self.source(text)
        self.assertEqual([len(block) for block in blocks], [20, 12, 18])
        self.assertEqual([(p.along_strike, p.down_dip) for p in planes], [(5, 4), (4, 3), (3, 6)])
        areas = [s.dx * s.dz for s in SEGMENTS]
        truth = sum(modulus(r.middle) * areas[r.segment] * 1e6 * r.slip for r in rows)
        points = [point for block in blocks for point in block]
        self.assertAlmostEqual(sum(p.moment(p.slip) for p in points) / truth, 1, delta=1e-7)
        released = sum(p.moment(sum(p.rates) * p.step) for p in points)
        self.assertAlmostEqual(released / truth, 1, delta=1e-7)
        for p, r in zip(points, rows, strict=True):
            segment = SEGMENTS[r.segment]
            self.assertEqual((p.strike, p.dip, p.rake), (segment.strike, segment.dip, r.rake))
            self.assertAlmostEqual(p.area, areas[r.segment] * 1e10, delta=1)
            self.assertAlmostEqual(p.slip, 100 * r.slip, 6)
            self.assertAlmostEqual(sum(p.rates) * p.step, p.slip, delta=1e-6 * max(p.slip, 1))
            self.assertAlmostEqual(p.start, r.rupture_time + 0.6, 6)  # the earliest is at 0
            self.assertAlmostEqual(p.depth, r.middle, 4)
            steps = 0 if r.slip == 0 else math.ceil((r.rise_time or 1.2) / p.step - 1e-9)
            self.assertEqual(len(p.rates), steps)
            self.assertEqual(p.rates, sorted(p.rates, reverse=True))  # friction slows the slip behind the front
        self.assertTrue(any("0.6 s later" in line for line in comments), comments)
        self.assertTrue(any("0.6 s later" in line for line in event["warnings"]))

    def test_centres_and_planes_agree_across_the_date_line(self):
        (planes, blocks, _), _ = self.source(model_text()[0])
        for plane, block, segment in zip(planes, blocks, SEGMENTS, strict=True):
            self.assertAlmostEqual(plane.top, segment.top, 4)
            self.assertAlmostEqual(plane.length, segment.nx * segment.dx)
            self.assertAlmostEqual(plane.width, segment.nz * segment.dz)
            top = block[:plane.along_strike]
            middle = sum(p.longitude for p in top) / len(top), sum(p.latitude for p in top) / len(top)
            up = segment.dz / 2 * math.cos(math.radians(plane.dip))
            east = up * math.cos(math.radians(plane.strike)) / (KM_PER_DEGREE * math.cos(math.radians(middle[1])))
            north = up * math.sin(math.radians(plane.strike)) / KM_PER_DEGREE
            self.assertAlmostEqual(plane.longitude, middle[0] - east, 5)
            self.assertAlmostEqual(plane.latitude, middle[1] + north, 5)
            first, last = top[0], top[-1]
            azimuth = math.atan2((last.longitude - first.longitude) * math.cos(math.radians(first.latitude)),
                                 last.latitude - first.latitude)
            self.assertAlmostEqual(math.degrees(azimuth) % 360, plane.strike, delta=0.1)
        self.assertAlmostEqual(planes[0].hypocentre[0], -4, 3)  # the epicentre is the first subfault
        self.assertAlmostEqual(planes[0].hypocentre[1], 2.5, 3)
        self.assertEqual([p.hypocentre for p in planes[1:]], [(-999.9, -999.9)] * 2)

    def test_completes_what_a_model_does_not_give(self):
        text, rows = model_text(times="UNKNOWN", rupture_velocity="2.0", rise="NONE", rise_time="999")
        (_, blocks, comments), _ = self.source(text)
        points = [point for block in blocks for point in block]
        first = rows[0]
        self.assertAlmostEqual(points[0].start, abs(first.middle - 3.0) / 2.0, 5)
        moment = sum(p.moment(p.slip) for p in points)
        rise_time = 2.03e-9 * (moment * 1e7) ** (1 / 3)
        self.assertEqual({len(p.rates) for p in points if p.slip}, {math.ceil(rise_time / points[0].step)})
        joined = "\n".join(comments)
        for words in ("over 2000 m/s (avVr of the file) for 50 of 50", "by the moment (Somerville et al. 1999)"):
            self.assertIn(words, joined)
        (_, blocks, comments), _ = self.source(model_text(times="UNKNOWN", rupture_velocity="-99")[0])
        self.assertIn("over 2320 m/s (0.8 of the S speed at the hypocentre", "\n".join(comments))
        (_, blocks, comments), _ = self.source(model_text(layers=False)[0], "--shear-modulus", "25 GPa")
        for point in (point for block in blocks for point in block):
            self.assertAlmostEqual(point.density * point.s_speed ** 2 / 10 / 25e9, 1, 6)  # from dyn/cm^2

    def test_latitude_and_longitude_decide_what_x_and_y_are(self):
        right, _ = self.source(model_text()[0])
        exchanged, _ = self.source(model_text(exchanged=True)[0])
        self.assertEqual(right[:2], exchanged[:2])
        self.assertTrue(any("exchanged" in line for line in exchanged[2]))

    def test_slip_rate_is_constant_without_friction(self):
        (_, blocks, _), _ = self.source(model_text()[0], "--damping-number", "0")
        for point in (point for block in blocks for point in block if point.slip):
            for rate in point.rates[:-1]:
                self.assertAlmostEqual(rate / point.rates[0], 1, 6)

    def test_reports_subfaults_faster_than_c(self):
        _, event = self.source(model_text()[0])
        faster = event["faster_than_c"]
        self.assertEqual(faster["subfaults_with_velocity"], sum(1 for a in event["along_fault"] if a["rupture_velocity_m_s"]))
        self.assertEqual(faster["subfaults"], sum(1 for a in event["along_fault"]
                                                  if a["rupture_velocity_m_s"] and a["rupture_velocity_m_s"] >= event["c_m_s"]))
        slow = json.loads(self.ok("event", os.path.join(SOURCE, "cases/synthetic-fault.fsp"), "--json"))["events"][0]
        self.assertEqual(slow["faster_than_c"]["moment_share"], 0)

    def test_fault_grid_has_rows_down_dip_and_the_moment(self):
        text, rows = model_text()
        model = self.file("model.fsp", text)
        out = os.path.join(os.path.dirname(model), "grid.nc")
        self.ok("event", model, "--fault-grid", "-o", out)
        with xarray.open_dataset(out) as grid:
            self.assertEqual(dict(grid.sizes), {"segment": 3, "down_dip": 6, "along_strike": 5})
            slip = grid.slip.values
            for k, segment in enumerate(SEGMENTS):
                mine = [row for row in rows if row.segment == k]
                inside = (k, slice(0, segment.nz), slice(0, segment.nx))
                numpy.testing.assert_allclose(slip[inside].ravel(), [r.slip for r in mine])
                numpy.testing.assert_allclose(grid.rupture_time.values[inside].ravel(), [r.rupture_time + 0.6 for r in mine])
                numpy.testing.assert_allclose(grid.depth.values[inside].ravel(), [1000 * r.middle for r in mine], rtol=1e-5)
                drops = grid.stress_drop.values[inside].ravel()
                numpy.testing.assert_allclose(drops, drops_by_fourier(segment, mine, float(grid.poisson_ratio)),
                                              atol=0.015 * abs(drops).max())
            self.assertEqual(int(numpy.isnan(slip).sum()), 3 * 6 * 5 - len(rows))
            moment = float((grid.shear_modulus * grid.cell_length * grid.cell_width * grid.slip).sum())
            self.assertAlmostEqual(moment / grid.moment_n_m, 1, 9)
            truth = sum(modulus(r.middle) * SEGMENTS[r.segment].dx * SEGMENTS[r.segment].dz * 1e6 * r.slip for r in rows)
            self.assertAlmostEqual(moment / truth, 1, 9)
            self.assertEqual(grid.attrs["Conventions"], "CF-1.10")
            for variable in grid.variables.values():
                self.assertTrue(variable.attrs["long_name"] and variable.attrs["units"])

    def test_points_one_centimetre_apart_are_distinct(self):
        rows = "\n".join(f"{40 + 1e-5 / 111.19 * i!r} 180 0 {1e-5 * i!r} {1e-5 * (j + 10)!r} 1e-6 180 {1e-5 * (1 + i)!r} 1e-5" for j in range(4) for i in range(6))
        text = ("% FINITE-SOURCE RUPTURE MODEL\n% Event : Tiny 01/01/2000 [nobody]\n% Loc : LAT = 40 LON = 180 DEP = 0.0001\n% Size : LEN = 6e-05 km WID = 4e-05 km Mo = 24 Nm\n"
                "% Mech : STRK = 0 DIP = 90 RAKE = 180 Htop = 0.000095 km\n% Rupt : HypX = 0 km HypZ = 0 km avTr = 1e-5 s avVr = 2.6 km/s\n% Invs : Nx = 6 Nz = 4\n"
                "% Invs : Dx = 1e-05 km Dz = 1e-05 km\n% SOURCE MODEL PARAMETERS\n% Nsbfs = 24 subfaults\n% LAT LON X==EW Y==NS Z SLIP RAKE TRUP RISE\n" + rows + "\n")
        (_, (block,), _), _ = self.source(text)
        self.assertEqual(len({(p.longitude, p.latitude, p.depth) for p in block}), 24)
        self.assertAlmostEqual(max(p.latitude for p in block) - 40, 5e-5 / 111.19, delta=1e-11)

    def test_bad_input_is_one_line(self):
        text, _ = model_text()
        model = self.file("model.fsp", text)
        out = os.path.join(os.path.dirname(model), "out.srf")
        table = self.file("t.csv", "name,rupture_velocity_km_s\na,2.8\n")
        no_strike = self.file("strike.fsp", text.replace("STRIKE = 200", "STRIKE = 999").replace("STRK = 20", "STRK = 999"))
        no_position = self.file("position.fsp", text.replace("X==EW", "A").replace("Y==NS", "B"))
        no_depth = self.file("depth.fsp", model_text(times="UNKNOWN")[0].replace("DEP = 3.0", "").replace("HypZ = 3 km", ""))
        no_size = self.file("size.fsp", text.replace("LEN = ", "L = "))
        for arguments, words in (
                ([table], "no finite-fault model; allowed: one finite-fault model, such as .fsp, SRF or .param"),
                ([model, model], "a source is made of one model"),
                ([no_strike], "STRIKE: no strike and dip for this segment"),
                ([no_position], "no subfaults with positions"),
                ([no_depth], "neither rupture times (TRUP)"),
                ([no_size], "no size of a subfault"),
                ([model, "--draws", "5"], "--draws"),
                ([model, "--pulse"], "--pulse")):
            done = run("event", *arguments, "-o", out)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
            self.assertIn(words, done.stderr)
            self.assertFalse(os.path.exists(out))
        for arguments in (["--damping-number", "5"], ["--fault-grid"], ["--fault-grid", "-o", out + ".txt"],
                          ["--fault-grid", "--damping-number", "5", "-o", out + ".nc"]):
            done = run("event", model, *arguments)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
        done = run("event", model + "x", "-o", out)
        self.assertEqual((done.returncode, done.stderr.count("\n")), (3, 1), done.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=0)
