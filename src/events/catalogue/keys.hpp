#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "slipfront/events/catalogue/observation.hpp"
#include "slipfront/text/quantity.hpp"

namespace slipfront::catalogue {

/// A quantity that an event may have: its name, which is the same in every format, its dimension, and the member that
/// stores it.
struct Key {
  std::string_view name;
  medium::Dimension dimension;
  std::optional<MeasuredValue> Observation::*measured = nullptr;  ///< an observed quantity, > 0, which may be uncertain
  std::optional<double> medium::Constants::*constant = nullptr;   ///< a constant of the medium
};

/// All quantities of events; the observed ones come first.
const std::vector<Key>& quantity_keys();
/// The quantities of fronts in the laboratory.
const std::vector<Key>& front_keys();
const Key* find_key(std::string_view name, const std::vector<Key>& keys = quantity_keys());

/// Texts that an event may have: name, date, ..., and what a quantity is, such as `stress_drop_is`.
const std::vector<std::string_view>& text_keys();
/// Stores one of these texts. \throws InputError (value, problem, allowed).
void store_text(Observation& observation, std::string_view key, const std::string& text);

/// Parses `text` and stores it. \throws InputError (value, problem, allowed) for bad text, a bad unit, an uncertainty
/// or a quantity that is not positive.
void store(Observation& observation, const Key& key, std::string_view text, std::string_view default_unit);
/// Like the function above, for a value that is parsed already. `text` is the value as the user wrote it.
void store(Observation& observation, const Key& key, const MeasuredValue& measured, std::string_view text);

/// The value of a quantity. Absent if the observation has none.
std::optional<MeasuredValue> value_of(const Observation& observation, const Key& key);

/// Fills in quantities that follow from others, with a warning for each.
///
/// - slip = moment / (shear_modulus rupture_area), if neither slip nor slip velocity is known. The moment may be that
/// of
///   the moment magnitude, and the area that of length and width.
/// - rupture velocity = rupture_length / duration, if it is not known: an apparent velocity.
///
/// `shear_modulus` in Pa; `speed` c in m/s, which an apparent velocity must not reach.
void derive(Observation& observation, double shear_modulus, double speed);

/// The stress drop of a front in the laboratory from the shear stresses before and after it, if it is not known.
/// \throws InputError if the stress after it is not the smaller one.
void derive_stress_drop(Observation& observation);

}  // namespace slipfront::catalogue
