#pragma once
/// \file
/// A scenario file as tables of values, its errors, and the units of the model in SI units.

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "slipfront/error.hpp"
#include "slipfront/scenario/keys.hpp"
#include "slipfront/theory/medium/constants.hpp"

namespace slipfront::scenario {

/// Collects the errors of a file, so that one run shows all of them.
class Errors {
 public:
  /// Runs the task. Returns false if it threw an InputError, which is then one of the errors.
  template <class Task>
  bool attempt(Task&& task) {
    try {
      task();
      return true;
    } catch (const InputError& error) {
      add(error);
      return false;
    }
  }
  void add(const InputError& error) {
    found_.insert(found_.end(), error.complaints().begin(), error.complaints().end());
  }
  bool any() const { return !found_.empty(); }
  /// \throws InputError with all errors, if there are any, in the order of their lines.
  void throw_if_any() const;

 private:
  std::vector<Complaint> found_;
};

/// The units of the model in SI units, which follow from the constants of [medium]. Slip, slip velocity and stretch of
/// springs are between the faces, because both move (medium::face_factor).
class ModelUnits {
 public:
  ModelUnits() = default;
  /// If not all constants could be read, `known` is false and every unit is NaN: the file has another error then.
  ModelUnits(const medium::Constants& medium, bool known) : medium_(medium), known_(known) {}

  /// The value of one unit of the model. \throws InputError (problem and allowed only) that names the constants of
  /// [medium] which are missing.
  double si(ModelUnit unit) const;
  /// The elastic constants that were assumed so far, in words; empty if none were.
  const std::string& assumed() const { return assumed_; }
  /// Whether a value was converted.
  bool used() const { return used_; }

 private:
  medium::Constants medium_;
  bool known_ = true;
  mutable std::string assumed_;
  mutable bool used_ = false;
};

/// The SI dimension of a unit of the model.
medium::Dimension dimension_of(ModelUnit unit);

/// One value of a scenario file, independent of the TOML syntax.
struct Value {
  enum class Kind { number, text, truth, array, table, other };
  Kind kind = Kind::other;
  double number = 0;                    ///< the number; 1 or 0 for a truth value
  std::string text = {};                ///< the text, or the number as messages show it
  std::vector<Value> items = {};        ///< items of an array or an inline table
  std::vector<std::string> names = {};  ///< names of the items of an inline table
  std::size_t line = 0;
  bool overridden = false;  ///< came from the command line, not from the file
};

struct Table {
  std::size_t line = 0;
  std::map<std::string, Value, std::less<>> values = {};
};

/// A scenario file with its overrides applied. Keys and values are checked later.
struct Document {
  std::string file;
  std::string text;  ///< TOML that reads back as this document
  std::optional<Value> title;
  std::map<std::string, Table, std::less<>> tables;
  std::string in_si = {};  ///< the first value with a unit (first_in_si); empty in a scenario in units of the model
  ModelUnits units = {};   ///< units for texts such as "2 mm"; known after [medium] was read
  Errors errors = {};      ///< tables that are not known
};

/// Tables that a scenario may have. The table [event] belongs to another command.
const std::vector<std::string_view>& known_tables();

/// Reads a scenario and applies the overrides. \throws InputError for text that is not TOML, or an invalid
/// override.
Document read_document(std::string_view text, const std::string& file, const std::vector<std::string>& overrides);

}  // namespace slipfront::scenario
