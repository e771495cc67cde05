#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "slipfront/catalogue/observation.hpp"
#include "slipfront/medium/quantity.hpp"

namespace slipfront::catalogue {

/// A quantity that an event may have: its name, which is the same in every format, its dimension, and the member that
/// stores it.
struct Key {
  std::string_view name;
  medium::Dimension dimension;
  std::optional<Measured> Observation::*measured = nullptr;      ///< an observed quantity, > 0, which may be uncertain
  std::optional<double> medium::Constants::*constant = nullptr;  ///< a constant of the medium
};

/// All quantities; the observed ones come first.
const std::vector<Key>& quantity_keys();
const Key* find_key(std::string_view name);

/// Parses `text` and stores it. \throws InputError (value, problem, allowed) for bad text, a bad unit, an uncertainty
/// or a quantity that is not positive.
void store(Observation& observation, const Key& key, std::string_view text, std::string_view default_unit);
/// Like the function above, for a value that is parsed already. `text` is the value as the user wrote it.
void store(Observation& observation, const Key& key, const Measured& measured, std::string_view text);

}  // namespace slipfront::catalogue
