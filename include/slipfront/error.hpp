#pragma once
/// \file
/// The three ways a call can fail. Each carries one line for a person; the command line maps them to exit codes.

#include <cstddef>
#include <stdexcept>
#include <string>

namespace slipfront {

/// What is wrong with one value, and where it stands. Empty or zero fields are left out of the text.
struct Complaint {
  std::string file = {};     ///< path, "stdin" or "command line"
  std::size_t line = 0;      ///< counted from 1
  std::string key = {};      ///< key, column or option
  std::string value = {};    ///< as it was written
  std::string problem = {};  ///< what is wrong
  std::string allowed = {};  ///< what would be accepted
};

/// One line: `file:line: key = 'value': problem; allowed: ...`. Control characters are shown as '?', long values are
/// cut.
std::string one_line(const Complaint& complaint);

/// Bad usage or input (exit code 2).
class InputError : public std::invalid_argument {
 public:
  explicit InputError(Complaint complaint);
  const Complaint& complaint() const noexcept { return complaint_; }

 private:
  Complaint complaint_;
};

/// A file that cannot be read or written (exit code 3).
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The numerics gave up (exit code 4).
class NumericsError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace slipfront
