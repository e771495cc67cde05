#pragma once
/// \file
/// The three ways in which a call can fail. Each exception has a message of one line for the user, or of one line for
/// each error in the input. The program maps exceptions to exit codes.

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace slipfront {

/// An error in one value, with its location. The message omits empty and zero fields.
struct Complaint {
  std::string file = {};     ///< path, "stdin" or "command line"
  std::size_t line = 0;      ///< counted from 1
  std::string key = {};      ///< key, column or option
  std::string value = {};    ///< as the user wrote it
  std::string problem = {};  ///< the error
  std::string allowed = {};  ///< accepted values
};

/// The message, one line: `FILE:LINE: key = 'value': problem; allowed: ...`. It shows control characters as '?' and
/// cuts long values.
std::string one_line(const Complaint& complaint);

/// Bad usage or input (exit code 2).
class InputError : public std::invalid_argument {
 public:
  explicit InputError(Complaint complaint);
  /// Several errors. The message has a line for each.
  InputError(Complaint first, std::vector<Complaint> others);
  /// The first error.
  const Complaint& complaint() const noexcept { return complaints_.front(); }
  const std::vector<Complaint>& complaints() const noexcept { return complaints_; }

 private:
  std::vector<Complaint> complaints_;
};

/// A file that cannot be read or written (exit code 3).
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A computation failed numerically (exit code 4).
class NumericsError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace slipfront
