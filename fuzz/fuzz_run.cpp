// libFuzzer target: every scenario that the reader accepts can be checked and run, with few cells and for a few steps,
// as a `pulse` run and as a `chain` run. The input chooses the parts of the scenario: profiles with stress at one point
// only, empty ends, laws, forcings, contact profiles and domains. Some values are random. fuzz/random uses random
// inputs. With SLIPFRONT_COUNT in the environment the program prints at its end how many scenarios ran. With
// SLIPFRONT_PRINT it prints each scenario.

#include <fuzzer/FuzzedDataProvider.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "slipfront/averages/pulse/run.hpp"
#include "slipfront/error.hpp"
#include "slipfront/lattice/chain/run.hpp"
#include "slipfront/scenario/problem.hpp"

using namespace slipfront;

namespace {

template <std::size_t n>
std::string one_of(FuzzedDataProvider& data, const std::array<std::string_view, n>& words) {
  return std::string(words[data.ConsumeIntegralInRange<std::size_t>(0, n - 1)]);
}

std::string number(FuzzedDataProvider& data) {
  if (data.ConsumeIntegralInRange(0, 9) == 0) {
    const double any = data.ConsumeFloatingPoint<double>();
    return std::isfinite(any) ? std::to_string(any) : "nan";
  }
  return one_of<14>(data,
                    {"0", "1", "0.8", "0.855", "0.5", "-4", "4", "1e-3", "1e-9", "0.0045", "20", "-1", "0.1", "3"});
}

/// A number that is allowed in most cases. Otherwise few scenarios would run.
template <std::size_t n>
std::string mostly(FuzzedDataProvider& data, const std::array<std::string_view, n>& words) {
  return data.ConsumeIntegralInRange(0, 15) == 0 ? number(data) : one_of<n>(data, words);
}
std::string stress(FuzzedDataProvider& data) {
  return mostly<10>(data, {"0", "0.8", "0.855", "0.5", "3", "0.0045", "0.1", "20", "0.01", "1"});
}
std::string positive(FuzzedDataProvider& data) {
  return mostly<8>(data, {"1", "0.1", "0.5", "2", "4", "1e-3", "1e-6", "0.3"});
}

/// Points of a table of stress, with gaps and steep walls.
std::vector<std::vector<double>> table_rows(FuzzedDataProvider& data) {
  constexpr std::array<double, 5> stresses{0, 0, 1.2, 0.3, 0.0046}, distances{0.01, 0.05, 0.2, 0.7, 2};
  std::vector<std::vector<double>> rows{{-10, 0.8}};
  while (rows.back()[0] < 10)
    rows.push_back({rows.back()[0] + data.PickValueInArray(distances), data.PickValueInArray(stresses)});
  return rows;
}

std::string initial(FuzzedDataProvider& data) {
  switch (data.ConsumeIntegralInRange(0, 3)) {
    case 3:
      return "profile = 'table'\nfile = 'table.csv'\n";
    case 0:
      return "profile = 'step'\nstress_left = " + stress(data) + "\nstress_right = " + stress(data) + "\n";
    case 1:
      return "profile = 'tanh'\nstress_left = " + stress(data) + "\nstress_right = " + stress(data) +
             "\nwidth = " + positive(data) + "\n";
    default:
      return "profile = 'formula'\nformula = '" +
             one_of<9>(data, {"x==1", "(x==0||x>1)?0.8:0", "x<0?0.8:0", "0.8*exp(-x^2)", "abs(x)<1?0.5:0",
                              "max(0,sin(3*x))", "x>1?0.8:(x<-1?0.8:0)", "0", "0.8"}) +
             "'\n";
  }
}

/// A friction law with its own keys.
std::string friction(FuzzedDataProvider& data) {
  const std::string law = one_of<9>(data, {"none", "viscous", "coulomb", "power", "formula", "n-shaped",
                                           "flash-heating", "slip-weakening", "rate-and-state"});
  std::string text = "[friction]\nlaw = '" + law + "'\n";
  const auto add = [&](const std::string& key) { text += key + " = " + positive(data) + "\n"; };
  const bool strength = law == "flash-heating" || law == "slip-weakening" || law == "rate-and-state";
  text += std::string(strength ? "strength" : "coefficient") + " = " +
          mostly<7>(data, {"0.1", "0.5", "3", "100", "1e5", "1e-3", "0"}) + "\n";
  if (law == "power") add("exponent");
  if (law == "formula")
    text += "formula = '" + one_of<6>(data, {"w", "0.1*sqrt(w)", "0.1+w^2", "1/w", "w/(1+w^3)", "0.01*w^0.1"}) + "'\n";
  if (law == "n-shaped" || law == "flash-heating") add("velocity");
  if (law == "flash-heating") add("weakened");
  if (law == "slip-weakening") add("residual");
  if (law == "slip-weakening" || law == "rate-and-state") add("characteristic_slip");
  if (law == "rate-and-state") {
    add("reference_velocity");
    // In laboratory experiments, strength over direct effect is 40 to 100.
    text += "direct_effect = " + mostly<4>(data, {"1e-3", "1e-2", "1e-5", "0.1"}) + "\n";
    text += "evolution_effect = " + mostly<4>(data, {"1.5e-3", "5e-3", "1e-5", "0.3"}) + "\n";
    if (data.ConsumeIntegralInRange(0, 7) == 0)
      text += "contact_ageing = 0.003\ncontact_time = 1\ndilatancy = 0.02\ndrainage_time = 10\npore_pressure = 0.5\n";
    text += "state = '" + one_of<2>(data, {"ageing", "slip"}) + "'\n";
  }
  return text;
}

std::string random_scenario(FuzzedDataProvider& data) {
  const auto sometimes = [&data] { return data.ConsumeIntegralInRange(0, 2) == 0; };
  std::string text = "[initial]\n" + initial(data);
  text += friction(data);
  if (sometimes()) text += "closure = '" + one_of<2>(data, {"paper", "consistent"}) + "'\n";
  if (sometimes())
    text += "[forcing]\nformula = '" + one_of<6>(data, {"0.5", "sin(t)", "x", "1e5*sin(40*x)", "-1", "0.05*sqrt(t)"}) +
            "'\n";
  if (sometimes())
    text += "[interface]\ncontact = '" + one_of<4>(data, {"1+0.2*sin(x)", "2", "x>0?2:1", "1e-3"}) + "'\n";
  if (!sometimes())
    text += "[domain]\nleft = " + mostly<5>(data, {"-4", "-1", "-10", "-0.1", "0"}) +
            "\nright = " + mostly<5>(data, {"4", "1", "10", "0.1", "0"}) + "\n";
  text += "[time]\nend = " + positive(data) + "\n";
  text += "[pulse]\ncells = " + std::to_string(data.ConsumeIntegralInRange(4, sometimes() ? 40 : 12)) + "\n";
  if (sometimes()) text += "left = '" + one_of<3>(data, {"continued", "fixed", "free"}) + "'\n";
  if (sometimes()) text += "right = '" + one_of<3>(data, {"continued", "fixed", "free"}) + "'\n";
  if (sometimes()) text += "periodic = true\n";
  text += "[chain]\nscale = " + std::to_string(data.ConsumeIntegralInRange(1, 40)) + "\n";
  if (sometimes()) text += "periodic = true\n";
  if (sometimes()) text += "left = '" + one_of<3>(data, {"fixed", "free", "absorbing"}) + "'\n";
  if (sometimes()) text += "model = 'lattice'\n";
  if (sometimes()) text += "spacing = " + positive(data) + "\n";
  if (sometimes()) text += "window = " + positive(data) + "\n";
  if (sometimes()) text += "[output]\nevery = 0.7\n";
  if (data.ConsumeIntegralInRange(0, 7) == 0)
    text += "[loading]\nstiffness = " + positive(data) + "\nvelocity = " + positive(data) + "\nwhere = '" +
            one_of<3>(data, {"everywhere", "left", "right"}) + "'\n";
  return text;
}

long scenarios = 0, pulses = 0, chains = 0;

void say_counts() { std::printf("%ld scenarios: %ld pulse runs and %ld chain runs\n", scenarios, pulses, chains); }

/// Runs a few steps. The slip at x = 0 must be a number at all times, or at no time if x = 0 is outside the domain.
template <class Run>
void go(Run& run) {
  static const int most = std::getenv("SLIPFRONT_COUNT") ? 60 : 20;
  int steps = most;
  run.go([&steps] { return --steps <= 0; });
  for (const output::Snapshot& snapshot : run.snapshots())
    if (!std::isfinite(snapshot.time) ||
        std::isnan(snapshot.slip_at_origin) != std::isnan(run.snapshots().front().slip_at_origin))
      std::abort();
}

template <class Body>
void attempt(const Body& body) {
  try {
    body();
  } catch (const InputError& error) {
    // The message has a line for each error.
    const std::string_view message = error.what();
    if (std::count(message.begin(), message.end(), '\n') + 1 != std::ssize(error.complaints())) std::abort();
  } catch (const NumericsError&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  if (scenarios++ == 0 && std::getenv("SLIPFRONT_COUNT")) std::atexit(say_counts);
  FuzzedDataProvider data(bytes, size);
  const std::string text = random_scenario(data);
  if (std::getenv("SLIPFRONT_PRINT")) std::fputs((text + "\n").c_str(), stderr);
  const std::vector<std::vector<double>> rows = table_rows(data);
  const auto table = [&rows](const std::string&, const std::vector<std::string>&) { return rows; };
  attempt([&] {
    const scenario::Scenario s = scenario::read_scenario(text, "fuzz.toml", {}, table);
    attempt([&] {
      const pulse::Problem problem = scenario::pulse_problem(s);
      pulse::Run run(problem, scenario::pulse_schedule(s, problem));
      ++pulses;
      go(run);
    });
    attempt([&] {
      const chain::ScaledProblem stretched = scenario::chain_problem(s);
      if (!((stretched.right - stretched.left) * stretched.scale / stretched.spacing < 4000)) return;
      chain::Run run(stretched, scenario::pulse_schedule(s, scenario::stated_problem(s)), chain::Execution{});
      ++chains;
      go(run);
    });
  });
  return 0;
}
