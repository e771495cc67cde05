#pragma once
/// \file
/// Stops a long run at Ctrl-C and reports its progress to Python. The run does not hold the GIL.

#include <chrono>
#include <exception>
#include <string>
#include <utility>

#include "bindings.hpp"

class Watch {
 public:
  /// `progress` is None, or a function of (time, end, steps, level) that is called at most ten times a second.
  Watch(py::object progress, double end) : progress_(std::move(progress)), end_(end) {}

  /// To be called after each step, without the GIL. Returns whether the run must stop; finish() then throws the reason.
  bool operator()(double time, long steps, const std::string& level = {}) {
    return look([&](Clock::time_point now) {
      if (progress_.is_none() || now < tell_) return;
      progress_(time, end_, steps, level);
      tell_ = Clock::now() + std::chrono::milliseconds(100);
    });
  }
  /// Like operator(), but for work that reports no progress, such as the estimate of errors.
  bool interrupted() {
    return look([](auto) {});
  }

  /// Throws the error that stopped the run, if any. The caller holds the GIL.
  void finish() const {
    if (raised_) std::rethrow_exception(raised_);
  }

 private:
  using Clock = std::chrono::steady_clock;

  template <class Tell>
  bool look(const Tell& tell) {
    const auto now = Clock::now();
    if (now < next_) return false;
    const py::gil_scoped_acquire lock;
    next_ = now + std::chrono::milliseconds(20);
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      tell(now);
    } catch (const py::error_already_set&) {
      raised_ = std::current_exception();
      return true;
    }
    return false;
  }

  py::object progress_;
  double end_;
  std::exception_ptr raised_;
  Clock::time_point next_ = Clock::now() + std::chrono::milliseconds(20), tell_ = next_;
};
