#pragma once

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <string>
#include <utility>

#include "system/machine.hpp"

/// The progress line of long computations.

using slipfront::Clock;
using slipfront::Pace;
using slipfront::seconds_since;

/// Words shown in the progress line.
struct ProgressWords {
  const char* before = "t = ";
  const char* steps = "steps";
  int digits = 4;         ///< digits of the current and the final value
  double unit = 1;        ///< factor of these values
  const char* name = "";  ///< name of their unit, after a blank
};

/// A line that shows the finished fraction, the rate and the remaining time: five times a second on a terminal, where
/// each overwrites the one before, and otherwise once a minute.
class Progress {
 public:
  Progress(double end, bool wanted, std::string label = {}, const ProgressWords& words = {})
      : label_(std::move(label)),
        words_(words),
        end_(end),
        on_(wanted),
        on_terminal_(isatty(STDERR_FILENO) != 0),
        shown_(Clock::now()) {}
  ~Progress() {
    if (drawn_ && on_terminal_) std::fputs("\r\x1b[K", stderr);
  }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void at(double time, long steps) {
    if (!on_ || seconds_since(shown_) < (on_terminal_ ? 0.2 : 60)) return;
    shown_ = Clock::now();
    const double share = time / end_;
    const std::string text = line(time, steps);
    if (on_terminal_) {
      std::string bar(30, '.');
      for (std::size_t i = 0; i < static_cast<std::size_t>(share * 30); ++i) bar[i] = '#';
      fmt::print(stderr, "\r{}{}[{}] {}\x1b[K", label_, label_.empty() ? "" : " ", bar, text);
    } else {
      fmt::print(stderr, "slipfront: {}{}{}\n", label_, label_.empty() ? "" : " ", text);
    }
    std::fflush(stderr);
    drawn_ = true;
  }
  void from(double time, long steps) {
    first_steps_ = steps;
    pace_ = Pace(time);
  }

 private:
  std::string line(double time, long steps) const {
    return fmt::format("{:5.1f} %  {}{:.{}g} of {:.{}g}{}  {:.0f} {}/s  {:.0f} s left", 100 * time / end_,
                       words_.before, words_.unit * time, words_.digits, words_.unit * end_, words_.digits, words_.name,
                       static_cast<double>(steps - first_steps_) / pace_.seconds(), words_.steps,
                       pace_.seconds_left(time, end_));
  }

  std::string label_;  ///< name of the current run, if a command has several
  ProgressWords words_;
  double end_;
  bool on_, on_terminal_, drawn_ = false;
  Clock::time_point shown_;
  Pace pace_{0};
  long first_steps_ = 0;
};
