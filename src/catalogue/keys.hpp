#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "slipfront/catalogue/observation.hpp"
#include "slipfront/medium/quantity.hpp"

namespace slipfront::catalogue {

/// A quantity that an event may carry: its one name in every format, what it is, and where it goes.
struct Key {
  std::string_view name;
  medium::Dimension dimension;
  std::optional<Measured> Observation::*measured = nullptr;      ///< observed, may be uncertain; > 0
  std::optional<double> medium::Constants::*constant = nullptr;  ///< of the medium
};

/// All quantities; observed ones first.
const std::vector<Key>& quantity_keys();
const Key* find_key(std::string_view name);

/// Parses `text` and stores it. \throws InputError (value, problem, allowed) for bad text, a bad unit, an uncertainty
/// or a quantity that is not positive.
void store(Observation& observation, const Key& key, std::string_view text, std::string_view default_unit);
/// What was parsed already; `text` as it was written.
void store(Observation& observation, const Key& key, const Measured& measured, std::string_view text);

}  // namespace slipfront::catalogue
