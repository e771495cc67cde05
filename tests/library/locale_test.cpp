// The language of the user changes no number that is read or written. C++ streams follow std::locale::global, C
// functions setlocale; both may have been called by a program that uses the library.

#include <gtest/gtest.h>

#include <algorithm>
#include <clocale>
#include <functional>
#include <locale>
#include <string>

#include "slipfront/error.hpp"
#include "slipfront/events/catalogue/read.hpp"
#include "slipfront/math/elliptic.hpp"
#include "slipfront/scenario/scenario.hpp"
#include "slipfront/theory/medium/medium.hpp"
#include "system/machine.hpp"

namespace slipfront {
namespace {

/// 1234.5 is written 1.234,5 while this lives: in streams everywhere, in C functions where the machine has such a
/// locale.
class Comma {
 public:
  Comma() : before_(std::locale::global(std::locale(std::locale::classic(), new Punctuation))) {
    for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8"})
      if (std::setlocale(LC_NUMERIC, name)) break;
  }
  Comma(const Comma&) = delete;
  Comma& operator=(const Comma&) = delete;
  ~Comma() {
    std::setlocale(LC_NUMERIC, "C");
    std::locale::global(before_);
  }

 private:
  struct Punctuation : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  std::locale before_;
};

std::string in_both(const std::function<std::string()>& text) {
  const std::string plain = text();
  const Comma comma;
  EXPECT_EQ(text(), plain);
  return plain;
}

TEST(Locale, ChangesNoTextThatIsWritten) {
  const std::string text =
      "[initial]\nstress_left = 1234.5\nstress_right = 0\n[pulse]\ncells = 4000\n[medium]\nshear_modulus = '30.5 "
      "GPa'\n";
  const std::string written = in_both([&text] {
    const auto s = scenario::read_scenario(
        text, "a.toml", {"friction.law=viscous", "friction.coefficient=0.25", "time.end=2.5"}, nullptr);
    return s.text + scenario::command_line(s, "pulse", {1000.5, 0.5}) + std::to_string(s.stress(-1) == 1234.5);
  });
  EXPECT_NE(written.find("1234.5"), std::string::npos);
  EXPECT_NE(written.find("4000"), std::string::npos);
}

TEST(Locale, ChangesNoEventThatIsRead) {
  const std::string text =
      "[event]\nname = 2004\ndate = 2004-09-28\nrupture_velocity = { mean = \"2.75 km/s\", sd = \"1234.5 m/s\" }\n"
      "slip_velocity = \"0.125 m/s\"\n[medium]\npoisson_ratio = 0.125\n";
  in_both([&text] {
    const catalogue::Observation o = catalogue::read_toml(text, "e.toml");
    EXPECT_EQ(o.rupture_velocity_m_s->middle(), 2750);
    EXPECT_EQ(o.slip_velocity_m_s->middle(), 0.125);
    EXPECT_EQ(o.poisson_ratio, 0.125);
    return o.name + " " + o.date;
  });
}

TEST(Locale, ChangesNoMessage) {
  const auto message = [](const std::function<void()>& call) {
    return in_both([&call]() -> std::string {
      try {
        call();
      } catch (const InputError& error) {
        return error.what();
      }
      ADD_FAILURE() << "not refused";
      return {};
    });
  };
  message([] { catalogue::read_toml("[event]\nslip_velocity = { low = -1234.5, high = 2004.5 }\n", "e.toml"); });
  EXPECT_NE(message([] { elliptic::at_psi(-1234.5); }).find("-1234.5"), std::string::npos);
  EXPECT_NE(message([] { medium::plastic_contact_ratio(1234.5); }).find("1234.5"), std::string::npos);
  EXPECT_NE(message([] {
              scenario::read_scenario("[initial]\nstress_left = 1\nstress_right = 0\n", "a.toml",
                                      {"pulse.tolerance=1234.5"}, nullptr);
            }).find("1234.5"),
            std::string::npos);
}

TEST(Locale, ChangesNoLimitOfMemory) {
  in_both([] { return std::to_string(static_cast<long long>(std::min(usable_memory(), 1e18))); });
}

}  // namespace
}  // namespace slipfront
