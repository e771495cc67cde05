#include "interrupts.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>

#include "commands.hpp"
#include "slipfront/ranks.hpp"
#include "slipfront/record/text_file.hpp"

namespace {

std::atomic<bool> seen = false;
std::atomic<int> watching = 0;
std::atomic<bool> is_patient = false;
/// Two texts, so that a signal finds one whole while the other is written.
std::array<std::array<char, 512>, 2> lines = {};
std::array<std::size_t, 2> sizes = {};
std::atomic<std::size_t> current = 0;

static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

[[noreturn]] void end_now() {
  const std::size_t line = current;
  if ((!the_ranks || the_ranks->rank() == 0) && ::write(STDERR_FILENO, lines[line].data(), sizes[line]) < 0) {
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

}  // namespace

void interrupted_means(std::string_view text) {
  constexpr std::string_view begin = "slipfront: interrupted";
  const std::size_t other = 1 - current;
  auto& line = lines[other];
  text = text.substr(0, 400);
  auto end = std::copy(begin.begin(), begin.end(), line.begin());
  end = std::copy(text.begin(), text.end(), end);
  *end++ = '\n';
  sizes[other] = static_cast<std::size_t>(end - line.begin());
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

WatchInterrupts::WatchInterrupts(bool patient) {
  std::signal(SIGALRM, on_alarm);
  is_patient = patient;
  ++watching;
}

WatchInterrupts::~WatchInterrupts() { --watching; }

bool interrupted_by_user() { return seen; }
