#pragma once

#include <vector>

#include "slipfront/error.hpp"

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

}  // namespace slipfront::scenario
