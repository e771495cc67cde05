"""The command `slipfront chain` as a user runs it."""

import math
import os
import unittest

from support import CommandLine, SOURCE, run

CHAIN = ["time", "scale", "slip_at_origin", "dislocations", "sites", "steps", "site_updates_per_second", "energy_drift", "charge_error",
         "wall_seconds"]


class Chain(CommandLine):
    def test_an_error_of_too_few_sites_names_key_and_file(self):
        case = self.file("short.toml", "[initial]\nstress_left = 1\nstress_right = 1\n[domain]\nleft = -1\nright = 1\n"
                                       "[chain]\nscale = 0.5\nspacing = 0.5\n")
        self.refused(2, "chain", case, says=("short.toml: chain.scale = '0.5': makes a chain of 3 sites",))

    def test_json_has_the_contract_keys(self):
        case = os.path.join(SOURCE, "cases/step.toml")
        out = self.chain(case, "--set", "chain.scale=300")
        for key in CHAIN:
            self.assertIn(key, out)
        self.assertEqual(out["scale"], 300)
        self.assertLess(abs(out["slip_at_origin"] / (2 * math.pi * 0.0482084) - 1), 0.01)
        self.assertLess(out["energy_drift"], 1e-4)
        self.assertEqual(out["charge_error"], 0)
        self.assertIn("OK. This scenario would run", self.ok("chain", case, "--check", "--wide"))

    def test_tends_to_the_consistent_pulse(self):
        case = os.path.join(SOURCE, "cases/step.toml")
        friction = ["--set", "friction.law=viscous", "--set", "friction.coefficient=0.5"]
        pulse = self.pulse(case, *friction)["slip_at_origin"]
        paper = self.pulse(case, *friction, "--set", "friction.closure=paper")["slip_at_origin"]
        error = [abs(self.chain(case, *friction, "--set", f"chain.scale={scale}")["slip_at_origin"] / pulse - 1) for scale in (100, 1000)]
        self.assertLess(error[1], 0.005)
        self.assertLess(error[1], error[0] / 3)
        self.assertGreater(abs(paper / pulse - 1), 0.2)

    def test_lattice_and_ring(self):
        case = os.path.join(SOURCE, "cases/step.toml")
        lattice = self.chain(case, "--set", "chain.scale=100", "--set", "chain.model=lattice", "--set", "medium.contact_ratio=0.1")
        self.assertEqual(lattice["spacing"], 0.1)
        self.assertLess(abs(lattice["slip_at_origin"] / 0.3029 - 1), 0.02)

    def test_forced_ring(self):
        """A force without friction accelerates dislocations without limit. By t = 2 pi they are 2.7 times narrower than at rest."""
        text = ("[initial]\nprofile = 'formula'\nformula = '0.8'\n[domain]\nleft = -1\nright = 1\n"
                "[chain]\nscale = 50\nperiodic = true\n[pulse]\nperiodic = true\n[forcing]\nformula = '0.5'\n")
        case = self.file("ring.toml", text)
        ring, fine = self.chain(case), self.chain(case, "--set", "chain.spacing=0.1")
        self.assertEqual(ring["dislocations"], 13)
        self.assertEqual(ring["charge_error"], 0)
        self.assertLess(fine["energy_drift"], 1e-4)
        self.assertLess(fine["energy_drift"], ring["energy_drift"] / 50)
        self.assertLess(abs(ring["slip_at_origin"] / fine["slip_at_origin"] - 1), 1e-2)
        # The pulse has a stress of 0.8, but the chain has 13 whole dislocations, which give 0.817.
        self.assertLess(abs(fine["slip_at_origin"] * 0.8 / 0.8168 / self.pulse(case)["slip_at_origin"] - 1), 0.01)

    def slider(self, *settings):
        """A block that springs pull. tests/reference/spring_slider.py uses the same numbers."""
        text = ("[initial]\nstress_left = 0\nstress_right = 0\n[interface]\ncontact = 0\n[domain]\nleft = -2\nright = 2\n"
                "[friction]\nlaw = 'rate-and-state'\nstrength = 0.05\ndirect_effect = 0.01\nevolution_effect = 0.015\n"
                "reference_velocity = 0.01\ncharacteristic_slip = 1\n[loading]\nstiffness = 0.0025\nvelocity = 0.001\n"
                "[chain]\nleft = 'free'\nright = 'free'\n[pulse]\ncells = 4\n[time]\nend = 200000\n[output]\nevery = 50000\n")
        return self.file("slider.toml", text), [word for setting in settings for word in ("--set", setting)]

    def test_loading_has_events_and_resumes_to_the_same_bits(self):
        case, _ = self.slider()
        out = case + ".nc"
        whole = self.chain(case, "-o", out)
        events = whole["events"]
        self.assertEqual(len(events), 4)
        self.assertLess(abs((events[3]["onset"] - events[2]["onset"]) / 51684.606 - 1), 2e-3)
        self.assertIsNone(events[3]["rupture_velocity"])
        self.assertIsNone(whole["energy_phonons"])  # a smooth surface has no trains
        self.assertIn("smooth", whole["reasons"]["energy_phonons"])
        self.assertIn("events.rupture_velocity", whole["reasons"])
        self.assertLess(whole["energy_drift"], 1e-10)
        # A block without a substrate has no dislocations, and needs no larger scale.
        self.assertEqual(self.chain(case, "--set", "time.end=50000")["warnings"], [])
        # An interrupted and resumed run writes the same file as an uninterrupted one.
        longer = ["--set", "time.end=4e6", "--set", "output.every=4e5", "--set", "loading.stiffness=0.0025*(1 + 0.05*x)",
                  "--set", "loading.velocity=0.001*(1 + 0.02*x)"]
        cut, uninterrupted = case + ".cut.nc", case + ".alone.nc"
        self.interrupted(cut, "chain", case, *longer)
        self.ok("chain", case, *longer, "--resume", cut)
        self.ok("chain", case, *longer, "-o", uninterrupted)
        with open(cut, "rb") as one, open(uninterrupted, "rb") as other:
            self.assertEqual(one.read(), other.read())
        self.assertIn("4 events", self.ok("chain", case))
        self.assertIn("implicit", self.ok("chain", case, "--check", "--wide"))
        # The scale s of a chain changes only its units: kappa / s^2, f / s, and s times slip and time.
        scaled = self.chain(case, "--set", "chain.scale=3")["events"]
        for key in ("onset", "slip", "stress_drop", "peak_velocity", "duration"):
            self.assertLess(abs(scaled[2][key] / events[2][key] - 1), 5e-3, key)

    def test_invalid_loading_is_refused(self):
        case, _ = self.slider()
        for setting, said in (("loading.stiffness=0", "loading.stiffness"), ("loading.stiffness=-1", "> 0"), ("loading.velocity=nan", "not finite"),
                              ("loading.velocity=inf", "not finite"), ("loading.stifness=1", "'stiffness'"), ("loading.where=top", "where"),
                              ("loading.where=left chain.left=fixed", "chain.left"), ("loading.stiffness=1e-3*x", "is -0.002 at x = -2"),
                              ("loading.velocity=1e-3*(x>0) loading.where=left", "loading.velocity"), ("friction.law=coulomb", "friction."),
                              ("chain.left=absorbing", "absorbing"), ("chain.tolerance=0", "chain.tolerance"),
                              ("interface.contact=1 initial.stress_left=-1", "stress")):
            _, settings = self.slider(*setting.split())
            done = run("chain", case, *settings)
            self.assertEqual(done.returncode, 2, setting)
            self.assertIn(said, done.stderr, setting)
            self.assertEqual(done.stderr.count("\n"), 1, setting)
        for command in ("pulse", "compare"):
            done = run(command, case)
            self.assertEqual(done.returncode, 2)
            self.assertIn("slipfront chain", done.stderr)

    def test_phonons_have_the_energy_that_a_shock_loses(self):
        case = os.path.join(SOURCE, "cases/shock.toml")
        lost = 3.925e-4  # elastic and kinetic energy of `slipfront pulse` at the start less that at the end
        # At such scales, the window leaves an error of a quarter of this value from the train's ripple (docs/chain.md).
        self.assertLess(abs(self.chain(case, "--set", "chain.scale=1500")["energy_phonons"] / lost - 1), 0.3)

    def test_refuses(self):
        case = os.path.join(SOURCE, "cases/step.toml")
        for change, words in [("chain.spacing=0.9", ["spacing", "1.5"]), ("chain.scale=1e13", ["GB"]), ("chain.scale=0", ["scale"]),
                              ("chain.model=lattice", ["chain.spacing"]), ("chain.left=open", ["absorbing"]), ("chain.periodic=yes", ["true or false"]),
                              ("output.dislocations=1", ["output.dislocations", "true or false"]), ("output.displacement=yes", ["true or false"])]:
            with self.subTest(change=change):
                self.refused(2, "chain", case, "--set", "chain.model=sine-gordon", "--set", "time.end=60", "--set", change, says=words)
        made = os.path.join(os.path.dirname(self.file("x", "")), "pulse.nc")
        self.ok("pulse", case, "-o", made)
        self.refused(2, "chain", case, "--resume", made, says=["resume"])

    def test_refuses_more_sites_and_dislocations_than_fit(self):
        case = os.path.join(SOURCE, "cases/step.toml")
        many = ["chain", case, "--set", "chain.scale=1e6", "output.every=1e-5", "pulse.cells=10", "--set"]
        for key in ("output.displacement", "output.dislocations"):
            self.refused(2, *many, f"{key}=true", "--check", says=[key, "GB of memory", "fewer outputs"])
        self.ok(*many, f"{key}=false", "--check")
        plane = os.path.join(SOURCE, "cases/plane-wave.toml")
        self.refused(2, "plane", plane, "--set", f"{key}=true", says=[key, "does not fit [plane]"])

    def test_a_killed_and_resumed_run_writes_the_same_file(self):
        self.killed_and_resumed("chain", 4)


if __name__ == "__main__":
    unittest.main()
