"""slipfront units, and scenarios in SI units, as a user meets them."""

import json
import os
import pty
import re
import subprocess
import tempfile
import unittest

from support import CommandLine, PROGRAM, SOURCE

BLOCK = """
[initial]
stress_left = 0
stress_right = 0
[interface]
contact = 0
[friction]
law = "rate-and-state"
normal_stress = "5 MPa"
strength = 0.4
direct_effect = 0.005
evolution_effect = 0.009
characteristic_slip = "0.5 um"
reference_velocity = "1 um/s"
[loading]
stiffness = "0.06 MPa/um"
velocity = "1 um/s"
[domain]
left = "-0.1 m"
right = "0.1 m"
[time]
end = "90 s"
[medium]
shear_modulus = "3 GPa"
density = "1180 kg/m3"
poisson_ratio = 0.33
contact_ratio = 0.0041
asperity_spacing = "20 um"
"""

#: A step into a stressed side, where dislocations overtake each other.
OVERTAKING = """
[initial]
stress_left = 0.9
stress_right = 0.3
[friction]
law = "coulomb"
coefficient = 0.03
[domain]
left = -4
right = 3.5
[time]
end = 3
[medium]
shear_modulus = "22 GPa"
density = "2450 kg/m3"
poisson_ratio = 0.21
contact_ratio = 0.0073
asperity_spacing = "3.3 mm"
"""


class Units(CommandLine):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.file = os.path.join(folder.name, "block.toml")
        with open(self.file, "w", encoding="utf-8") as file:
            file.write(BLOCK)

    def test_keys_are_in_both_systems(self):
        out = json.loads(self.ok("units", self.file, "--json"))
        units = {row["name"]: row["si"] for row in out["units"]}
        self.assertAlmostEqual(units["position"], 20e-6 / 0.0041, places=15)
        keys = {row["key"]: row for row in out["keys"]}
        self.assertEqual(keys["loading.stiffness"]["text"], "0.06 MPa/um")
        self.assertAlmostEqual(keys["loading.stiffness"]["si"] / 0.06e12, 1)
        self.assertAlmostEqual(keys["friction.strength"]["si"] / 2e6, 1)
        self.assertAlmostEqual(keys["friction.characteristic_slip"]["si"] / 0.5e-6, 1)

    def test_prints_the_range_of_a_column_of_a_table(self):
        out = json.loads(self.ok("units", os.path.join(SOURCE, "cases/gouge-patch.toml"), "--json"))
        keys = {row["key"]: row["si"] for row in out["keys"]}
        self.assertAlmostEqual(keys["friction.direct_effect, least"] / (0.008 * 10e6), 1)
        self.assertAlmostEqual(keys["friction.direct_effect, largest"] / (0.012 * 10e6), 1)

    def test_states_the_critical_stiffness(self):
        out = json.loads(self.ok("units", self.file, "--json"))
        critical = next(row["si"] for row in out["units"] if row["name"].startswith("stiffness")) * out["numbers"]["critical_stiffness"]
        self.assertAlmostEqual(critical / ((0.009 - 0.005) * 5e6 / 0.5e-6), 1)  # (b - a) sigma_N / D_c
        self.assertAlmostEqual(out["numbers"]["stiffness_ratio"], 1.5)
        self.assertAlmostEqual(out["numbers"]["strength_over_direct_effect"], 80)
        self.assertIn("critical stiffness: ", self.ok("units", self.file))

    def test_states_where_numbers_that_vary_are_least_and_largest(self):
        settings = ["--set", "friction.units=SI", "--set", "friction.direct_effect=0.005 + 0.01*x",
                    "--set", "loading.units=SI", "--set", "loading.stiffness=0.07e12*(1 + 2*x)"]
        out = json.loads(self.ok("units", self.file, *settings, "--json"))
        keys = {row["key"]: row for row in out["keys"]}
        left, right = keys["domain.left"]["model"], keys["domain.right"]["model"]
        self.assertAlmostEqual(keys["loading.stiffness, least"]["si"] / 0.056e12, 1)
        # f_0 / a; kappa D_c / ((b - a) sigma_N); and 2 pi / sqrt(kappa_c - kappa) where kappa < kappa_c, at the left end
        wanted = {"strength_over_direct_effect": ((0.4 / 0.006, right), (0.4 / 0.004, left)),
                  "stiffness_ratio": ((0.028e6 / 0.025e6, left), (0.042e6 / 0.015e6, right))}
        for name, values in wanted.items():
            for which, (value, x) in zip(("least", "largest"), values):
                found = out["ranges"][name][which]
                self.assertAlmostEqual(found["value"] / value, 1, places=5)
                self.assertAlmostEqual(found["x"], x)
        self.assertNotIn("nucleation_length", out["ranges"])  # these springs are too stiff everywhere
        text = self.ok("units", self.file, *settings)
        self.assertIn("f_0 / a, largest: 100, at x = -0.1 m\n", text)
        softer = json.loads(self.ok("units", self.file, *settings, "--set", "loading.stiffness=0.03e12*(1 + 2*x)", "--json"))
        nucleation = softer["ranges"]["nucleation_length"]
        self.assertAlmostEqual(nucleation["least"]["x"], left)
        self.assertAlmostEqual(nucleation["largest"]["x"] / right, 0.625, places=2)  # stable to the right of it
        self.assertEqual(json.loads(self.ok("units", self.file, "--json"))["ranges"], {})

    def test_states_where_numbers_that_vary_on_a_plane_are_largest(self):
        case, a = os.path.join(SOURCE, "cases/plane-nucleation.toml"), "friction.direct_effect=1 + x^2 + (y - 1)^2"
        for ratio, y in ((1, 1), (0.5, 1)):
            out = json.loads(self.ok("units", case, "--set", a, "--set", f"plane.wave_speed_ratio={ratio}", "--json"))
            found = out["ranges"]["strength_over_direct_effect"]["largest"]
            self.assertAlmostEqual(found["value"], 4.5, places=2)
            self.assertAlmostEqual(found["x"], 0)
            self.assertAlmostEqual(found["y"], y, places=1)

    def test_dimensionless_numbers_give_the_same_bits(self):
        out = json.loads(self.ok("units", self.file, "--json"))
        numbers = [f"{row['key']}={row['model']!r}" for row in out["keys"]]
        plain = self.file + ".plain.toml"
        with open(plain, "w", encoding="utf-8") as file:  # without [medium]
            file.write(BLOCK.split("[medium]")[0].replace('normal_stress = "5 MPa"', ""))
        runs = [json.loads(self.ok("chain", self.file, "--json", "--dimensionless")), json.loads(self.ok("chain", plain, "--json", "--set", *numbers))]
        for run in runs:
            for key in ("wall_seconds", "site_updates_per_second"):
                del run[key]
        self.assertEqual(runs[0], runs[1])

    def test_all_errors_have_a_line(self):
        with open(self.file, encoding="utf-8") as file:
            text = file.read().replace('"90 s"', '"90 m"').replace('"-0.1 m"', '"-0.1 s"')
        with open(self.file, "w", encoding="utf-8") as file:
            file.write(text)
        done = subprocess.run([PROGRAM, "chain", self.file, "--check"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        lines = done.stderr.splitlines()
        self.assertEqual(len(lines), 2, lines)
        self.assertRegex(lines[0], r"block.toml:19: domain.left = '-0.1 s': the unit 's' is not that of a length; allowed: a length")
        self.assertIn("time.end = '90 m'", lines[1])

    def chain_with(self, old, new, *arguments):
        """Runs the chain on the block, in which `old` is replaced."""
        self.assertIn(old, BLOCK)
        return subprocess.run([PROGRAM, "chain", self.fresh(BLOCK.replace(old, new)), *arguments], capture_output=True, text=True)

    def fresh(self, text):
        path = self.file + ".changed.toml"
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def test_an_error_in_the_medium_is_one_line(self):
        done = self.chain_with("poisson_ratio = 0.33", "poisson_ratio = 0.6")
        self.assertRegex(done.stderr, r"\Aslipfront: [^\n]*:26: medium.poisson_ratio = '0.6': out of range; allowed: > -1 and < 0.5\n\Z")

    def test_a_domain_in_metres_is_answered_in_metres(self):
        done = self.chain_with('right = "0.1 m"', 'right = "-0.2 m"')
        self.assertIn("domain.right = '-0.2 m': not to the right of domain.left; allowed: > -0.1 m\n", done.stderr)

    def test_a_block_without_contacts_needs_no_width_of_a_dislocation(self):
        self.assertEqual(self.chain_with("[loading]", "[chain]\nspacing = '2 cm'\n[loading]", "--check").returncode, 0)
        few = self.chain_with("[loading]", "[chain]\nspacing = '5 cm'\n[loading]", "--check")
        self.assertIn("chain.spacing = '0.05 m': makes a chain of 5 sites, 0.05 m apart", few.stderr)

    def test_messages_of_a_solver_are_in_si(self):
        path = self.fresh(OVERTAKING)
        units = {row["name"]: row["si"] for row in json.loads(self.ok("units", path, "--json"))["units"]}
        pattern = r"overtake each other from t = (\S+?)( s)? at x = (\S+?)( m)? on,"
        in_si, in_model = (re.search(pattern, "\n".join(self.pulse(path, units)["warnings"])) for units in ("--si", "--dimensionless"))
        self.assertEqual((in_si[2], in_si[4], in_model[2], in_model[4]), (" s", " m", None, None))
        for group, name in ((1, "time"), (3, "position")):
            self.assertAlmostEqual(float(in_si[group]) / (float(in_model[group]) * units[name]), 1, 4)

    def test_progress_is_in_the_unit_of_the_results(self):
        rock = ("medium.contact_ratio=0.003", "medium.asperity_spacing=1 mm", "chain.scale=20000")
        case = os.path.join(SOURCE, "cases/step-viscous.toml")
        terminal, end = pty.openpty()
        with subprocess.Popen([PROGRAM, "chain", case, "--si", "--set", *rock], stdout=subprocess.DEVNULL, stderr=end) as process:
            printed = b""
            while b"left" not in printed:
                printed += os.read(terminal, 65536)
            process.kill()
        os.close(end)
        os.close(terminal)
        self.assertRegex(printed.decode(), r" %  t = [\d.e-]+ of 0.000386\d* s  \d+ steps/s  \d+ s left")

    def test_a_unit_in_the_wrong_case_has_a_suggestion(self):
        done = self.chain_with('"5 MPa"', '"5 Mpa"')
        self.assertIn("unknown unit 'Mpa' (did you mean 'MPa'?); allowed: ", done.stderr)


if __name__ == "__main__":
    unittest.main()
