#pragma once

#include <string>
#include <string_view>

/// Handling of the signals SIGINT (Ctrl-C), SIGTERM and SIGHUP.

/// The program calls this at its start. From then on, such a signal ends the program at once with exit code 130. It
/// prints one line: "interrupted", followed by the text of interrupted_means.
void end_on_interrupts();

/// Sets the text that follows "interrupted" from now on, such as "; nothing was written". Text after 400 bytes is cut.
/// While `file` does not exist, the text is replaced by "; nothing has been written yet".
void interrupted_means(std::string_view text, const std::string& file = {});

/// While this object exists, the first signal only makes interrupted_by_user() true, and the work has a second to end.
/// After that second, or at a second signal, the program ends as above, and the last complete file remains. It does not
/// end while it writes a file. If `patient`, the time is not limited: this is for a rank that waits for the writing
/// rank.
class WatchInterrupts {
 public:
  explicit WatchInterrupts(bool patient = false);
  ~WatchInterrupts();
  WatchInterrupts(const WatchInterrupts&) = delete;
  WatchInterrupts& operator=(const WatchInterrupts&) = delete;
};

bool interrupted_by_user();
