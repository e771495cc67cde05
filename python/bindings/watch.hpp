#pragma once
/// \file
/// What a long run without the GIL looks out for: Ctrl-C, and somebody who wants to know how far it is.

#include <chrono>
#include <exception>
#include <string>
#include <utility>

#include "bindings.hpp"

class Watch {
 public:
  /// `progress`: None, or called now and then with (time, end, steps, level).
  Watch(py::object progress, double end) : progress_(std::move(progress)), end_(end) {}

  /// RunRequest after each step, without the GIL. Whether to stop: then finish() throws.
  bool operator()(double time, long steps, const std::string& level = {}) {
    return look([&](Clock::time_point now) {
      if (progress_.is_none() || now < tell_) return;
      progress_(time, end_, steps, level);
      tell_ = Clock::now() + std::chrono::milliseconds(100);
    });
  }
  /// The same for work beside the run, which tells no progress.
  bool interrupted() {
    return look([](auto) {});
  }

  /// With the GIL: raises what stopped the run, if anything did.
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
