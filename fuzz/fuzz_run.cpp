// libFuzzer target: whatever scenario is let through can be checked and run, at few cells and for a few steps, as a
// pulse and as a chain. The input chooses from what scenarios are made of: profiles with stress at one point only,
// empty ends, laws, forcings, contact profiles, domains; now and then a value of its own.

#include <fuzzer/FuzzedDataProvider.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "slipfront/chain/run.hpp"
#include "slipfront/error.hpp"
#include "slipfront/pulse/run.hpp"
#include "slipfront/setup/chain.hpp"
#include "slipfront/setup/pulse.hpp"

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

std::string initial(FuzzedDataProvider& data) {
  switch (data.ConsumeIntegralInRange(0, 2)) {
    case 0:
      return "profile = 'step'\nstress_left = " + number(data) + "\nstress_right = " + number(data) + "\n";
    case 1:
      return "profile = 'tanh'\nstress_left = " + number(data) + "\nstress_right = " + number(data) +
             "\nwidth = " + number(data) + "\n";
    default:
      return "profile = 'formula'\nformula = '" +
             one_of<9>(data, {"x==1", "(x==0||x>1)?0.8:0", "x<0?0.8:0", "0.8*exp(-x^2)", "abs(x)<1?0.5:0",
                              "max(0,sin(3*x))", "x>1?0.8:(x<-1?0.8:0)", "0", "0.8"}) +
             "'\n";
  }
}

std::string random_scenario(FuzzedDataProvider& data) {
  const auto sometimes = [&data] { return data.ConsumeIntegralInRange(0, 2) == 0; };
  std::string text = "[initial]\n" + initial(data);
  text += "[friction]\nlaw = '" + one_of<4>(data, {"none", "viscous", "coulomb", "power"}) +
          "'\ncoefficient = " + number(data) + "\n";
  if (sometimes()) text += "exponent = " + number(data) + "\n";
  if (sometimes()) text += "closure = '" + one_of<2>(data, {"paper", "consistent"}) + "'\n";
  if (sometimes())
    text += "[forcing]\nformula = '" + one_of<5>(data, {"0.5", "sin(t)", "x", "1e5*sin(40*x)", "-1"}) + "'\n";
  if (sometimes())
    text += "[interface]\ncontact = '" + one_of<4>(data, {"1+0.2*sin(x)", "2", "x>0?2:1", "1e-3"}) + "'\n";
  if (!sometimes()) text += "[domain]\nleft = " + number(data) + "\nright = " + number(data) + "\n";
  text += "[time]\nend = " + number(data) + "\n";
  text += "[pulse]\ncells = " + std::to_string(data.ConsumeIntegralInRange(4, 40)) + "\n";
  text += "[chain]\nscale = " + std::to_string(data.ConsumeIntegralInRange(1, 40)) + "\n";
  if (sometimes()) text += "periodic = true\n";
  if (sometimes()) text += "left = '" + one_of<3>(data, {"fixed", "free", "absorbing"}) + "'\n";
  if (sometimes()) text += "[output]\nevery = 0.7\n";
  return text;
}

/// Runs a few steps; each number of dislocations and each slip that comes out has to be one.
template <class Run>
void go(Run& run) {
  int steps = 20;
  run.go([&steps] { return --steps <= 0; });
  for (const pulse::Snapshot& snapshot : run.snapshots())
    if (!std::isfinite(snapshot.time) || std::isnan(snapshot.slip_at_origin)) std::abort();
}

template <class Body>
void attempt(const Body& body) {
  try {
    body();
  } catch (const InputError& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) std::abort();
  } catch (const NumericsError&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  FuzzedDataProvider data(bytes, size);
  const std::string text = random_scenario(data);
  attempt([&] {
    const scenario::Scenario s = scenario::read_scenario(text, "fuzz.toml", {}, nullptr);
    attempt([&] {
      const pulse::Problem problem = setup::pulse_problem(s);
      pulse::Run run(problem, setup::pulse_schedule(s, problem));
      go(run);
    });
    attempt([&] {
      const chain::Stretched stretched = setup::chain_problem(s);
      if (chain::problem_of(stretched).grid.sites > 20000) return;
      chain::Run run(stretched, setup::pulse_schedule(s, setup::pulse_problem(s)), chain::Execution{});
      go(run);
    });
  });
  return 0;
}
