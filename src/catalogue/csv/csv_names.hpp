#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "catalogue/csv/csv_header.hpp"

namespace slipfront::catalogue {

/// The quantity that a published name such as "vr", "rupturespeed" or "momentmagnitude" stands for. The name has small
/// letters and no blanks. Null if it stands for none.
const Key* quantity_of_name(std::string_view name);

/// The role of a column that holds no quantity, such as "event" or "latitude".
std::optional<Column::Role> role_of_name(std::string_view name);

/// Words that may precede the name of a quantity and do not change it, such as "mean" or "estimated".
bool is_neutral(std::string_view word);

/// Whether a word belongs to a physical quantity: "velocity", "stress", "moment", "energy", ...
bool is_physical_word(std::string_view word);

/// A word for an error: "err", "sd", "sigma", "+-". Its value is the number of standard deviations; 0 for other words.
double deviations_of(std::string_view word);

}  // namespace slipfront::catalogue
