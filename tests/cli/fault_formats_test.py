"""Finite-fault models in the layout of each producer: `slipfront event FILE` reads them as one
model."""

import dataclasses
import json
import math
import os
import tempfile
import unittest

import xarray

from support import CommandLine

KM_PER_DEGREE = 6371 * math.pi / 180
STRIKE, DIP, RAKE, MODULUS, SPEED = 120.0, 40.0, 95.0, 36e9, 2.5  # degrees, Pa, km/s
LENGTH, WIDTH = 3.0, 2.0  # km, of a subfault
ALONG, DOWN = 6, 4
HYPOCENTRE = (2, 1)  # column and row
LONGITUDE, LATITUDE, TOP = 143.0, 37.5, 5.0


class Subfault:
    """A subfault whose centre is given along strike and down dip, in km, from the middle of the
    upper edge."""

    def __init__(self, column, row):
        self.column, self.row = column, row
        self.along = (column + 0.5 - ALONG / 2) * LENGTH
        self.down = (row + 0.5) * WIDTH
        here, there = (self.along, self.down), (
            (HYPOCENTRE[0] + 0.5 - ALONG / 2) * LENGTH,
            (HYPOCENTRE[1] + 0.5) * WIDTH,
        )
        self.time = math.dist(here, there) / SPEED
        self.rise = 1.5
        self.slip = 0.4 + 0.3 * column - 0.1 * row  # m

    def position(self, along=0.0, down=0.0):
        """Longitude, latitude and depth in km, at an offset from the centre."""
        strike, dip = math.radians(STRIKE), math.radians(DIP)
        s, d = self.along + along, self.down + down
        east = s * math.sin(strike) + d * math.cos(dip) * math.cos(strike)
        north = s * math.cos(strike) - d * math.cos(dip) * math.sin(strike)
        latitude = LATITUDE + north / KM_PER_DEGREE
        return (
            LONGITUDE + east / KM_PER_DEGREE / math.cos(math.radians(LATITUDE)),
            latitude,
            TOP + d * math.sin(dip),
        )


FAULT = [Subfault(column, row) for row in range(DOWN) for column in range(ALONG)]
MOMENT = sum(f.slip * MODULUS * LENGTH * WIDTH * 1e6 for f in FAULT)
MEAN_SLIP = sum(f.slip for f in FAULT) / len(FAULT)
ORIGIN = FAULT[HYPOCENTRE[1] * ALONG + HYPOCENTRE[0]].position()


def param(segments=1):
    text = f"#Total number of fault_segments=     {segments}\n"
    for number in range(segments):
        text += (
            f"#Fault_segment =   {number + 1} nx(Along-strike)= {ALONG:3} Dx= {LENGTH:5.2f}km"
            f" ny(downdip)= {DOWN:3} Dy= {WIDTH:5.2f}km\n#Boundary of Fault_segment    "
            f" {number + 1}. EQ in cell 3,2. Lon: {ORIGIN[0]:9.4f}   Lat: {ORIGIN[1]:8.4f}\n#Lon. "
            " Lat.  Depth\n"
            + "       143.0   37.5   5.0\n" * 5
            + "#Lat. Lon. depth slip rake strike dip t_rup t_ris t_fal mo\n"
        )
        for f in FAULT:
            x, y, z = f.position()
            moment = f.slip * MODULUS * LENGTH * WIDTH * 1e13
            x += 0.5 * number
            text += (
                f"{y:.6f} {x:.6f} {z:.6f} {100 * f.slip:.6f} {RAKE} {STRIKE} {DIP} {f.time + 9 * number:.6f} 0.5"
                f" 1.0 {moment:.9e}\n"
            )
    return text


def geojson():
    features = []
    for f in FAULT:
        corners = [
            f.position(a * LENGTH / 2, d * WIDTH / 2)
            for a, d in ((-1, -1), (1, -1), (1, 1), (-1, 1), (-1, -1))
        ]
        features.append(
            {
                "type": "Feature",
                "properties": {
                    "slip": f.slip,
                    "rake": RAKE,
                    "trup": f.time,
                    "rise": f.rise,
                    "sf_moment": f.slip * MODULUS * LENGTH * WIDTH * 1e6,
                },
                "geometry": {
                    "type": "Polygon",
                    "coordinates": [[[x, y, 1000 * z] for x, y, z in corners]],
                },
            }
        )
    return json.dumps(
        {"type": "FeatureCollection", "metadata": {"title": "Made up"}, "features": features}
    )


def srf(version, windows=False):
    text = (
        f"{version}\nPLANE"
        f" 1\n{LONGITUDE} {LATITUDE} {ALONG} {DOWN} {ALONG * LENGTH} {DOWN * WIDTH}\n"
    )
    text += (
        f"{STRIKE} {DIP} {TOP} {(HYPOCENTRE[0] + 0.5 - ALONG / 2) * LENGTH} {(HYPOCENTRE[1] + 0.5) * WIDTH}\nPOINTS"
        f" {len(FAULT)}\n"
    )
    for f in FAULT:
        x, y, z = f.position()
        rock = f" {100 * math.sqrt(MODULUS / 2700):.9e} 2.7" if version == "2.0" else ""
        text += (
            f"{x:.9f} {y:.9f} {z:.9f} {STRIKE} {DIP} {LENGTH * WIDTH * 1e10:.6e} {f.time:.6f} 0.5{rock}\n"
        )
        rates = " ".join([f"{100 * f.slip / 1.5:.6f}"] * 3)
        if windows:  # slip along the rake and across it
            text += f"{RAKE - 90} 0 0 {100 * f.slip:.6f} 3 0 0\n{rates}\n"
        else:
            text += f"{RAKE} {100 * f.slip:.6f} 3 0 0 0 0\n{rates}\n"
    return text


@dataclasses.dataclass
class SrfPoint:
    strike: float  # degrees
    dip: float
    moment: float  # N m


def points_of_srf(path):
    """The points of a file of SRF 2.0 without planes."""
    with open(path, encoding="utf-8") as file:
        words = " ".join(line for line in file if not line.startswith("#")).split()
    if words[:2] != ["2.0", "POINTS"]:
        raise AssertionError(words[:4])
    points, at = [], 3
    for _ in range(int(words[2])):
        strike, dip, area, _, _, speed, density, _, slip, rates = map(float, words[at + 3 : at + 13])
        points.append(SrfPoint(strike, dip, 1e-7 * density * speed**2 * area * slip))
        at += 17 + int(rates)
    return points


def rupt(windows=1):
    text = (
        "# No,lon,lat,z(km),strike,dip,rise,dura,ss-slip(m),ds-slip(m),ss_len(m),ds_len(m),rupt_time(s),rigidity(Pa)\n"
    )
    for window in range(windows):
        for number, f in enumerate(FAULT):
            x, y, z = f.position()
            along, up = (
                f.slip / windows * turn(math.radians(RAKE)) for turn in (math.cos, math.sin)
            )
            duration = f.rise / windows
            text += (
                f"{number + 1}\t{x:.6f}\t{y:.6f}\t{z:.6f}\t{STRIKE}\t{DIP}\t0.5\t{duration}\t{along:.9f}\t{up:.9f}\t"
                f"{1000 * LENGTH}\t{1000 * WIDTH}\t{f.time + window * duration:.6f}\t{MODULUS:e}\n"
            )
    return text


def subfaults_csv(units=False):
    text = "longitude,latitude,depth,length,width,strike,dip,rake,slip,mu,rupture_time,rise_time\n"
    if units:
        text = (
            "# positions are centres\nLon,Lat,Depth [km],Length (km),width_km,Strike,Dip,Rake,Slip"
            " (cm),mu [GPa],rupture time,rise time\n"
        )
    for f in FAULT:
        x, y, z = f.position() if units else f.position(0, -WIDTH / 2)
        km, cm, gpa = (1, 100, 1e-9) if units else (1000, 1, 1)
        text += (
            f"{x:.6f},{y:.6f},{z * km},{LENGTH * km},{WIDTH * km},{STRIKE},{DIP},{RAKE},{f.slip * cm},{MODULUS * gpa},{f.time},{f.rise}\n"
        )
    return text


FILES = {
    "a.param": param(),
    "FFM.geojson": geojson(),
    "a.srf": srf("2.0"),
    "b.srf": srf("2.0", True),
    "a.rupt": rupt(),
    "windows.inv": rupt(3),
    "geoclaw.csv": subfaults_csv(),
    "units.csv": subfaults_csv(True),
    "any.txt": param(),
}


def moment_of_file(grid):
    """Moment of a fault grid in N m, from its variables."""
    with xarray.open_dataset(grid) as g:
        return float((g.slip * g.shear_modulus * g.cell_length * g.cell_width).sum())


class FaultFormats(CommandLine):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)
        return self.path(name)

    def test_reads_one_model_from_each_format(self):
        for name, text in FILES.items():
            with self.subTest(name):
                path = self.write(name, text)
                event = json.loads(self.ok("event", path, "--json", "--samples", "0"))["events"][0]
                self.assertAlmostEqual(event["rupture_velocity_m_s"], 1000 * SPEED, delta=5)
                self.assertAlmostEqual(event["slip_velocity_m_s"], MEAN_SLIP / 1.5, delta=2e-4)

    def test_a_conversion_keeps_the_moment(self):
        grid = self.path("grid.nc")
        for name, text in FILES.items():
            path = self.write(name, text)
            for out, options in (("out.srf", []), ("out.fsp", []), ("out.csv", ["--fault-grid"])):
                with self.subTest(name + " to " + out):
                    self.ok("event", path, "-o", self.path(out), *options, "--samples", "0")
                    self.ok("event", self.path(out), "--fault-grid", "-o", grid, "--samples", "0")
                    self.assertAlmostEqual(moment_of_file(grid) / MOMENT, 1, delta=1e-6)

    def test_several_segments_stay_several(self):
        path, grid = self.write("two.param", param(2)), self.path("grid.nc")
        for out, options in (("two.srf", []), ("two.fsp", []), ("two.csv", ["--fault-grid"])):
            self.ok("event", path, "-o", self.path(out), *options, "--samples", "0")
            self.ok("event", self.path(out), "--fault-grid", "-o", grid, "--samples", "0")
            self.assertAlmostEqual(moment_of_file(grid) / MOMENT, 2, delta=2e-6)
            with xarray.open_dataset(grid) as g:
                self.assertEqual(
                    dict(g.sizes), {"segment": 2, "down_dip": DOWN, "along_strike": ALONG}
                )

    def test_srf_1_holds_no_rock_and_states_so(self):
        out = self.path("one.srf")
        printed = self.ok(
            "event",
            self.write("a.srf", srf("2.0")),
            "-o",
            out,
            "--srf-version",
            "1.0",
            "--samples",
            "0",
        )
        self.assertIn("SRF 1.0 holds no shear modulus", " ".join(printed.split()))
        with open(out, encoding="utf-8") as file:
            lines = [line.split() for line in file if not line.startswith("#")]
        self.assertEqual(lines[0], ["1.0"])
        self.assertEqual(len(lines[5]), 8)
        self.refused(
            2,
            "event",
            out,
            "-o",
            self.path("x.fsp"),
            "--srf-version",
            "1.0",
            says=["--srf-version = '1.0'", "no SRF file is written"],
        )

    def test_a_model_that_is_cut_short_is_refused(self):
        for name, text, says in (
            ("a.param", param(), "subfaults in this segment: the file is cut short"),
            ("a.srf", srf("2.0"), "the file is cut short"),
            ("a.rupt", rupt()[:-20], "numbers in this row"),
            ("a.csv", subfaults_csv()[:-8], "numbers in this row"),
        ):
            cut = text if "numbers" in says else "\n".join(text.split("\n")[:-4]) + "\n"
            self.refused(2, "event", self.write(name, cut), says=[says])

    def test_values_out_of_range_are_named(self):
        for old, new, says in (
            (f",{DIP},", ",95,", "dip = '95': out of range; allowed: 0 to 90"),
            (f",{STRIKE},", ",x,", "subfault = 'x': not a number"),
        ):
            self.refused(
                2,
                "event",
                self.write("a.csv", subfaults_csv().replace(old, new, 1)),
                says=[":2: " + says],
            )

    def test_a_mesh_has_an_event_and_points_but_no_grid(self):
        rows = rupt().split("\n")
        moment = 0
        for i, row in enumerate(rows[1:-1], 1):
            cells = row.split("\t")
            cells[4], cells[5] = str(STRIKE + 5 * math.sin(i)), str(DIP + 3 * math.cos(i))
            cells[10] = str(1000 * LENGTH * (1 + 0.3 * math.sin(3 * i)))
            moment += math.hypot(float(cells[8]), float(cells[9])) * float(cells[10]) * float(cells[11]) * float(cells[13])
            rows[i] = "\t".join(cells)
        path = self.write("mesh.rupt", "\n".join(rows))
        for model, out in ((path, "one.srf"), (self.path("one.srf"), "two.srf")):
            event = json.loads(self.ok("event", model, "--json", "--samples", "0"))["events"][0]
            self.assertAlmostEqual(event["rupture_velocity_m_s"], 1000 * SPEED, delta=5)
            self.ok("event", model, "-o", self.path(out), "--samples", "0")
            points = points_of_srf(self.path(out))
            self.assertEqual(len(points), len(rows) - 2)
            self.assertAlmostEqual(sum(p.moment for p in points) / moment, 1, delta=1e-6)
            for i, point in enumerate(points, 1):
                self.assertAlmostEqual(point.strike, STRIKE + 5 * math.sin(i), 5)
                self.assertAlmostEqual(point.dip, DIP + 3 * math.cos(i), 5)
            for options in (["-o", self.path("a.fsp")], ["--fault-grid", "-o", self.path("a.nc")]):
                self.refused(2, "event", model, *options, says=["the subfaults form no grid", "event -o OUT.srf needs none"])

    def test_other_commands_name_the_model(self):
        path = self.write("a.param", param())
        self.refused(2, "chain", path, says=["this is a finite-fault model"])
        path = self.write("a.csv", subfaults_csv())
        self.refused(2, "columns", path, says=["a finite-fault model, whose columns need no map"])

    def test_plane_takes_each(self):
        for name in ("a.param", "FFM.geojson", "a.srf", "a.rupt", "geoclaw.csv"):
            printed = self.ok("plane", self.write(name, FILES[name]), "--check")
            self.assertIn("OK", printed)


if __name__ == "__main__":
    unittest.main()
