#pragma once

#include <string>
#include <string_view>

/// Ctrl-C (SIGINT), SIGTERM and SIGHUP.

/// From the start of the program: such a signal ends it at once with exit code 130 and one line, "interrupted" and what
/// interrupted_means says.
void end_on_interrupts();

/// Sets what an interruption means from now on, such as "; nothing was written". At most 400 bytes are kept. A text
/// that speaks of a file is replaced by "; nothing has been written yet" while `file` does not exist.
void interrupted_means(std::string_view text, const std::string& file = {});

/// While it lives the first signal is seen by interrupted_by_user(), and the work has a second to come to its end:
/// then, unless a file is being written, or at a second signal, the program ends like above, leaving what was written
/// last. `patient`: it has all the time it takes (a rank that waits for the one which writes).
class WatchInterrupts {
 public:
  explicit WatchInterrupts(bool patient = false);
  ~WatchInterrupts();
  WatchInterrupts(const WatchInterrupts&) = delete;
  WatchInterrupts& operator=(const WatchInterrupts&) = delete;
};

bool interrupted_by_user();
