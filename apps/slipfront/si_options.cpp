#include "si_options.hpp"

#include <cmath>

#include "slipfront/error.hpp"

void add_si_options(CommandLine& command, SiOptions& options) {
  const Option si = command.flag("--si", options.si, "Results in SI units; needs --contact-ratio");
  command.option("--contact-ratio", "A", options.contact_ratio, "Contact ratio A, for --si")
      .in_range(1e-300, 1.0)
      .needs(si);
  const auto add = [&](const char* name, std::string& text, const char* otherwise, const char* type) {
    command.option(name, type, text, std::string("Constant of the rock, for --si (default: ") + otherwise + ")")
        .needs(si);
  };
  add("--p-wave-speed", options.rock.p_wave_speed, "6 km/s", "SPEED");
  add("--poisson-ratio", options.rock.poisson_ratio, "0.3", "RATIO");
  add("--shear-modulus", options.rock.shear_modulus, "30 GPa", "MODULUS");
}

ResultUnits::ResultUnits(const SiOptions& options) {
  if (!options.si) return;
  if (!options.contact_ratio)
    throw slipfront::InputError({.file = "command line",
                                 .key = "--si",
                                 .problem = "it needs --contact-ratio",
                                 .allowed = "--contact-ratio A, such as 0.003"});
  const auto rock = slipfront::medium::elastic({}, slipfront::medium::defaults_of(options.rock));
  values_ = {.mu = rock.shear_modulus,
             .nu = rock.poisson_ratio,
             .A = *options.contact_ratio,
             .b = std::nan(""),  // no result has it
             .c = rock.speed};
}

slipfront::medium::UnitInSi ResultUnits::of(std::string_view unit) const {
  if (unit.empty()) return {1, ""};
  return values_ ? slipfront::medium::in_si(unit, *values_) : slipfront::medium::UnitInSi{1, std::string(unit)};
}
