#include "record/netcdf/isolated.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>
#include <string_view>

#include "foundation/sanitized.hpp"
#include "record/netcdf/dataset_file.hpp"
#include "slipfront/error.hpp"

namespace slipfront::record {
namespace {

std::recursive_mutex& library_mutex() {
  static std::recursive_mutex mutex;
  return mutex;
}

bool is_copy = false;

/// The first byte that the copy sends: how its work ended.
enum class End : char { done = 'd', input = 'i', file = 'f', memory = 'm' };

/// A message of several fields, each preceded by its length.
class Message {
 public:
  explicit Message(End end) { text_ += static_cast<char>(end); }
  Message& add(std::string_view field) {
    const std::uint64_t size = field.size();
    text_.append(reinterpret_cast<const char*>(&size), sizeof size).append(field);
    return *this;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// Reads the fields of a message. A missing field is empty, and `whole()` is then false.
class Fields {
 public:
  explicit Fields(std::string_view text) : text_(text) {}
  std::string next() {
    std::uint64_t size = 0;
    whole_ = whole_ && text_.size() >= sizeof size;
    if (whole_) std::memcpy(&size, text_.data(), sizeof size);
    whole_ = whole_ && text_.size() - sizeof size >= size;
    if (!whole_) return {};
    std::string field(text_.substr(sizeof size, static_cast<std::size_t>(size)));
    text_.remove_prefix(sizeof size + field.size());
    return field;
  }
  bool whole() const { return whole_; }

 private:
  std::string_view text_;
  bool whole_ = true;
};

bool send(int pipe, std::string_view text) {
  while (!text.empty()) {
    const ssize_t size = ::write(pipe, text.data(), text.size());
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(size));
  }
  return true;
}

/// Discards the error messages of the libraries. The program prints an error as one line itself.
void silence_libraries() {
  if (SLIPFRONT_SANITIZED) return;  // the reports of the sanitizer must be seen
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere < 0) return;
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  close(nowhere);
}

/// Seconds of processor time that the copy may use: `seconds`, or less if this process has a lower limit. The result is
/// below the hard limit, where the system kills a process with a signal that does not give the reason.
unsigned long processor_limit(unsigned long seconds) {
  rlimit own{};
  if (getrlimit(RLIMIT_CPU, &own) != 0) return seconds;
  const rlim_t most = own.rlim_max == RLIM_INFINITY || own.rlim_max < 2 ? own.rlim_max : own.rlim_max - 1;
  return std::min({static_cast<rlim_t>(seconds), own.rlim_cur, most});
}

/// Makes SIGXCPU end the copy after `seconds` of processor time (0: no limit). The copy leaves no core file.
void limit_processor(unsigned long seconds) {
  rlimit limit{};
  setrlimit(RLIMIT_CORE, &limit);
  if (seconds == 0 || getrlimit(RLIMIT_CPU, &limit) != 0) return;
  limit.rlim_cur = processor_limit(seconds);
  setrlimit(RLIMIT_CPU, &limit);
}

/// Runs the copy. It exits directly, without the destructors of this program and without flushing stdio.
[[noreturn]] void live_as_copy(pid_t parent, int pipe, const std::function<std::string()>& work,
                               unsigned long seconds) {
  is_copy = true;
  limit_processor(seconds);
  prctl(PR_SET_PDEATHSIG, SIGKILL);   // without its parent, no process would rename the file
  if (getppid() != parent) _exit(1);  // the parent ended before the line above
  sigset_t others;                    // the parent handles Ctrl-C and similar signals
  sigfillset(&others);
  for (const int crash : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU}) {
    std::signal(crash, SIG_DFL);
    sigdelset(&others, crash);
  }
  sigprocmask(SIG_BLOCK, &others, nullptr);
  silence_libraries();
  bool sent = false;
  try {
    try {
      sent = send(pipe, Message(End::done).add(work()).text());
    } catch (const InputError& error) {
      const Complaint& c = error.complaint();
      Message message(End::input);
      message.add(c.file).add(std::to_string(c.line)).add(c.key).add(c.value).add(c.problem).add(c.allowed);
      sent = send(pipe, message.text());
    } catch (const std::bad_alloc&) {
      sent = send(pipe, "m");
    } catch (const std::exception& error) {
      sent = send(pipe, Message(End::file).add(error.what()).text());
    }
  } catch (...) {  // no memory left to send the reason
  }
  _exit(sent ? 0 : 1);
}

std::string result_of(const std::string& text, const std::string& name, const std::string& failed, int status,
                      unsigned long seconds) {
  if (text == "m") throw std::bad_alloc();
  Fields fields(text.empty() ? std::string_view() : std::string_view(text).substr(1));
  const End end = text.empty() ? End::memory : static_cast<End>(text[0]);
  if (end == End::input) {
    Complaint c{.file = fields.next()};
    c.line = static_cast<std::size_t>(std::strtoull(fields.next().c_str(), nullptr, 10));
    for (std::string* field : {&c.key, &c.value, &c.problem, &c.allowed}) *field = fields.next();
    if (fields.whole()) throw InputError(c);
  } else if (end == End::file || end == End::done) {
    std::string field = fields.next();
    if (fields.whole() && end == End::file) throw FileError(field);
    if (fields.whole()) return field;
  }
  if (seconds > 0 && WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
    throw FileError(
        name + ": " + failed + ": the NetCDF library did not end within " + std::to_string(processor_limit(seconds)) +
        " s of processor time; it needs less for any intact file of this size, so the file is probably damaged");
  std::string reason = "the NetCDF library failed";
  if (WIFSIGNALED(status)) reason += std::string(" (") + strsignal(WTERMSIG(status)) + ")";
  throw FileError(name + ": " + failed + ": " + reason);
}

/// HDF5 prints its errors, in each thread that has not asked for silence. The NetCDF library asks in its first thread
/// only. We look the function up because we do not need HDF5 otherwise.
void silence_hdf5() {
  using SetAuto = int (*)(std::int64_t stack, void* print, void* data);
  static const auto set_auto = reinterpret_cast<SetAuto>(dlsym(RTLD_DEFAULT, "H5Eset_auto2"));
  if (set_auto) set_auto(0, nullptr, nullptr);  // 0: the stack of this thread
}

}  // namespace

std::unique_lock<std::recursive_mutex> lock_netcdf() {
  auto lock = is_copy ? std::unique_lock<std::recursive_mutex>() : std::unique_lock(library_mutex());
  silence_hdf5();
  return lock;
}

std::string isolated(const std::string& name, const std::string& failed, const std::function<std::string()>& work,
                     unsigned long seconds) {
  if (is_copy) return work();
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return work();
  const pid_t parent = getpid();
  pid_t copy = -1;
  {
    const auto nobody_is_within = lock_netcdf();
    copy = fork();
    if (copy == 0) {
      close(ends[0]);
      live_as_copy(parent, ends[1], work, seconds);
    }
  }
  close(ends[1]);
  if (copy < 0) {
    close(ends[0]);
    return work();
  }
  std::string text;
  std::exception_ptr exception;
  try {
    char buffer[1 << 16];
    for (;;) {
      const ssize_t size = ::read(ends[0], buffer, sizeof buffer);
      if (size < 0 && errno == EINTR) continue;
      if (size <= 0) break;
      text.append(buffer, static_cast<std::size_t>(size));
    }
  } catch (const std::bad_alloc&) {
    exception = std::current_exception();
  }
  close(ends[0]);
  int status = 0;
  while (waitpid(copy, &status, 0) < 0 && errno == EINTR) {
  }
  if (exception) std::rethrow_exception(exception);
  return result_of(text, name, failed, status, seconds);
}

}  // namespace slipfront::record
