#include "interrupts.hpp"

#include <limits.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>

#include "commands.hpp"
#include "system/files/whole_file.hpp"
#include "system/machine.hpp"
#include "system/ranks.hpp"

namespace {

std::atomic<bool> seen = false;
std::atomic<int> watching = 0;
std::atomic<bool> is_patient = false;
/// A line for stderr, and another one for as long as a file does not exist.
struct Meaning {
  using Text = std::array<char, 512>;
  Text line = {}, line_without_file = {};
  std::size_t size = 0, size_without_file = 0;
  std::array<char, PATH_MAX> file = {};  ///< empty: none
};
/// Two of them, so that a signal finds one whole while the other is written.
std::array<Meaning, 2> meanings = {};
std::atomic<std::size_t> current = 0;

static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

[[noreturn]] void end_now() {
  const Meaning& meaning = meanings[current];
  const bool has_file = meaning.file[0] == '\0' || access(meaning.file.data(), F_OK) == 0;
  const char* line = has_file ? meaning.line.data() : meaning.line_without_file.data();
  const std::size_t size = has_file ? meaning.size : meaning.size_without_file;
  if ((!the_ranks || the_ranks->rank() == 0) && ::write(STDERR_FILENO, line, size) < 0) {
    // nobody reads it
  }
  _exit(exit_interrupted);
}

extern "C" void on_interrupt(int) {
  if (watching == 0 || seen) end_now();
  seen = true;
  if (!is_patient) alarm(1);
}

extern "C" void on_alarm(int) {
  if (watching == 0) return;  // it has come to its end
  if (!slipfront::record::is_writing()) end_now();
  alarm(1);
}

/// Returns how many bytes the line has.
std::size_t fill(Meaning::Text& line, std::string_view text) {
  constexpr std::string_view begin = "slipfront: interrupted";
  text = text.substr(0, 400);
  auto end = std::copy(begin.begin(), begin.end(), line.begin());
  end = std::copy(text.begin(), text.end(), end);
  *end++ = '\n';
  return static_cast<std::size_t>(end - line.begin());
}

}  // namespace

void interrupted_means(std::string_view text, const std::string& file) {
  const std::size_t other = 1 - current;
  Meaning& meaning = meanings[other];
  meaning.size = fill(meaning.line, text);
  meaning.size_without_file = fill(meaning.line_without_file, "; nothing has been written yet");
  meaning.file = {};
  if (file.size() < meaning.file.size()) std::copy(file.begin(), file.end(), meaning.file.begin());
  current = other;
}

void end_on_interrupts() {
  interrupted_means("");
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action {};
    sigaction(number, nullptr, &action);
    if (action.sa_handler == SIG_IGN) continue;  // nohup
    action = {};
    action.sa_handler = on_interrupt;
    action.sa_flags = SA_RESTART;
    sigaction(number, &action, nullptr);
  }
}

namespace {
#if !SLIPFRONT_SANITIZED && defined(__linux__)
// The system calls this before the constructors of all libraries, which take half of the time until main begins.
__attribute__((section(".preinit_array"), used)) void (*const end_on_early_interrupts)() = end_on_interrupts;
#endif
}  // namespace

WatchInterrupts::WatchInterrupts(bool patient) {
  std::signal(SIGALRM, on_alarm);
  is_patient = patient;
  ++watching;
}

WatchInterrupts::~WatchInterrupts() { --watching; }

bool interrupted_by_user() { return seen; }
