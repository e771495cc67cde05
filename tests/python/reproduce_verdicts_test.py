"""Tests the rules for the verdict on a printed number with invented numbers, and checks that all numbers of the paper are listed."""

import unittest

from slipfront.reproduce import derived, numbers
from slipfront.reproduce.verdicts import FOLLOWS, READING, SAME, WRONG, Printed, rounded, verdict

#: Every number of the paper's text, in its order: section, text in the paper, key in paper.toml. References, numbers of equations and
#: figures, and constants within formulas (2 pi, 1/2) are left out; formulas have a separate table.
TEXT = [
    ("abstract", "up to 7 orders", "orders_of_range"), ("2.1", "r^-3", "range_of_forces"), ("2.1", "at least 8 times", "neighbours"), ("2.2", "stress amplitude μA/π", "dislocation_stress"),
    ("2.2", "from 10^2", "width_least"), ("2.2", "to 10^4", "width_most"), ("3.1", "seven orders", "orders_of_velocity"), ("Fig. 5", "more than six orders", "orders_of_velocity_caption"),
    ("Fig. 6", "more than seven orders", "orders_of_slip_velocity"), ("Fig. 6", "1.03", "parkfield_stress"), ("Fig. 6", "0.213", "ets_stress_caption"), ("Fig. 7", "0.855", "stress_left"),
    ("Fig. 7", "0.179", "stress_right"), ("3.2", "time 2π", "time"), ("3.2", "greater than five", "fall_of_amplitude"), ("3.3", "35%", "drop_flat_from"), ("3.3", "100%", "drop_flat_to"),
    ("Fig. 8", "C=0.1", "weak"), ("Fig. 8", "C=0.5", "middle"), ("Fig. 8", "C=2.0", "strong"), ("Fig. 8", "0.855", "stress_left"), ("Fig. 8", "0.179", "stress_right"),
    ("Fig. 8", "1.8", "fig_8_factor_0.5"), ("Fig. 8", "5.2", "fig_8_factor_2.0"), ("Fig. 9", "0.855", "stress_left"), ("Fig. 10", "0.606", "stress_middle"), ("Fig. 10", "0.419", "stress_low"),
    ("Fig. 11", "0.1", "weak"), ("4", "M=6", "magnitude"), ("4", "3.0 km/s", "rupture_velocity_km_s"), ("4", "0.5 m/s", "slip_velocity_m_s"), ("4", "6 km/s", "p_wave_speed_km_s"),
    ("4", "0.3", "poisson_ratio"), ("4", "5.4 km/s", "c"), ("4", "0.55", "parkfield_rupture_velocity"), ("4", "1.03", "parkfield_stress"), ("4", "W=0.1", "parkfield_slip_velocity"),
    ("4", "0.083", "parkfield_slip_velocity_0.1"), ("4", "0.05", "parkfield_slip_velocity_0.5"), ("4", "0.02", "parkfield_slip_velocity_2.0"), ("4", "0.0029", "parkfield_contact_ratio_0"),
    ("4", "0.0035", "parkfield_contact_ratio_0.1"), ("4", "0.0058", "parkfield_contact_ratio_0.5"), ("4", "0.0145", "parkfield_contact_ratio_2.0"), ("4", "30 GPa", "shear_modulus_gpa"),
    ("4", "29", "parkfield_stress_mpa_0"), ("4", "34", "parkfield_stress_mpa_0.1"), ("4", "58", "parkfield_stress_mpa_0.5"), ("4", "145 MPa", "parkfield_stress_mpa_2.0"),
    ("4", "31 MPa", "modelled_stress_mpa"), ("4", "10 km/day", "ets_rupture_km_day"), ("4", "2.14e-5", "ets_rupture_velocity"), ("4", "4 mm", "ets_slip_mm"), ("4", "2 weeks", "ets_weeks"),
    ("4", "0.212", "ets_stress"), ("4", "2.6e-7", "ets_slip_velocity"), ("4", "4e-5", "ets_contact_ratio"), ("4", "0.5e-7", "ets_observed_slip_velocity"), ("4", "one-fifth", "ets_share"),
    ("4", "C=2.0", "ets_friction"), ("5", "> 0.4", "drop_flat_discussion"), ("5", "1 m/s", "fast_slip_m_s"), ("5", "V-/c 1e-7", "slowest_rupture"), ("5", "1e-7 m/s", "slow_slip_m_s"),
    ("5", "seven orders", "orders_of_velocity"),
]


class Verdicts(unittest.TestCase):
    def test_same_is_rounding_to_the_digits_printed(self):
        for value, text, expected in ((0.5534, "0.55", SAME), (0.5551, "0.55", READING), (2.135e-5, "2.14e-5", SAME), (4.79e-8, "0.5e-7", SAME), (28.49, "29", READING), (25.9, "29", WRONG),
                                      (0.102, "0.1", SAME), (0.16, "0.1", WRONG), (2.0, "1", WRONG)):
            self.assertEqual(verdict(value, Printed(text)), expected, (value, text))

    def test_bounds(self):
        self.assertEqual(verdict(6.9, Printed("6", "more than")), SAME)
        self.assertEqual(verdict(6.0, Printed("6", "more than")), READING)
        self.assertEqual(verdict(8.0, Printed("8", "at least")), SAME)
        self.assertEqual(verdict(5.0, Printed("6", "more than")), WRONG)

    def test_follows_only_from_arithmetic_that_gives_the_digits(self):
        self.assertEqual(verdict(28.49, Printed("29"), [28.52]), FOLLOWS)
        self.assertEqual(verdict(20.0, Printed("29"), [28.4]), WRONG)
        self.assertEqual(verdict(29.2, Printed("29"), [20.0]), SAME)

    def test_a_ruler_reads_a_fortieth_of_the_axis(self):
        self.assertEqual(verdict(0.0852, Printed("0.083", axis=(0, 0.1))), READING)
        self.assertEqual(verdict(0.0856, Printed("0.083", axis=(0, 0.1))), WRONG)
        decades = Printed("2.6e-7", axis=(1e-8, 1e-6), log=True)
        self.assertEqual(verdict(2.6e-7 * 10**-0.049, decades), READING)
        self.assertEqual(verdict(2.6e-7 * 10**-0.055, decades), WRONG)

    def test_digits(self):
        for value, text, expected in ((2.457e-7, "2.6e-7", "2.5e-7"), (0.0851, "0.083", "0.085"), (56.8, "58", "57"), (4.79e-8, "0.5e-7", "0.5e-7")):
            self.assertEqual(rounded(value, text), expected)


class Paper(unittest.TestCase):
    def setUp(self):
        self.paper = numbers.printed()

    def test_every_number_of_the_text_has_a_row(self):
        listed = [row["key"] for row in self.paper["input"] + self.paper["number"]]
        self.assertEqual(set(listed), {key for _, _, key in TEXT})
        self.assertEqual(len(listed), len(set(listed)))

    def test_the_row_has_the_digits_of_the_text(self):
        printed = numbers.texts(self.paper)
        words = {"five": "5", "six": "6", "seven": "7", "one-fifth": "0.2", "10^2": "1e2", "10^4": "1e4", "amplitude": "1"}
        for _, text, key in TEXT:
            for word, digit in words.items():
                text = text + " " + digit if word in text else text
            self.assertIn(printed[key], text, key)

    def test_where_the_paper_is_found_wrong_a_reason_is_given(self):
        self.assertEqual([row["key"] for row in self.paper["number"] if row.get("reason")], ["dislocation_stress"])

    def test_rules_name_numbers_that_are_printed(self):
        printed = numbers.taken(self.paper)
        for key, rules in derived.rules().items():
            for rule in rules:
                self.assertGreater(derived.apply(rule, printed), 0, key)


if __name__ == "__main__":
    unittest.main()
