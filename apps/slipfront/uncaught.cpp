// Memory can run out where no code catches the exception: in static objects of a library before main, or on another
// thread. The program must then end as in any other lack of memory, with one line and the usual exit code.

#include <unistd.h>

#include <cstdlib>
#include <exception>
#include <new>

#include "commands.hpp"
#include "system/machine.hpp"

namespace {

std::terminate_handler handler_of_library = nullptr;

[[noreturn]] void end_in_one_line() {
  try {
    if (const std::exception_ptr thrown = std::current_exception()) std::rethrow_exception(thrown);
  } catch (const std::bad_alloc&) {
    static constexpr char text[] = "slipfront: out of memory\n";
    static_cast<void>(write(STDERR_FILENO, text, sizeof text - 1) + 1);
    _exit(exit_numerics);
  } catch (...) {
  }
  if (handler_of_library) handler_of_library();
  std::abort();
}

void heed_uncaught() { handler_of_library = std::set_terminate(end_in_one_line); }

#if !SLIPFRONT_SANITIZED && defined(__linux__)
// The system calls this before the constructors of all libraries. AddressSanitizer must come first, so builds with it
// install the handler later.
__attribute__((section(".preinit_array"), used)) void (*const before_libraries)() = heed_uncaught;
#else
[[maybe_unused]] const bool heeds_uncaught = (heed_uncaught(), true);
#endif

}  // namespace
