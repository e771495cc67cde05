/* Makes the n-th call of a kind fail, as if memory ran out, or the disk were full or broken. Preload this library:
     LD_PRELOAD=libfailing_calls.so FAIL_CALL=malloc FAIL_AT=3 program ...
   FAIL_CALL   malloc (also calloc, realloc and the aligned ones), open, write, fsync, rename, close
   FAIL_AT     number of the call that fails, from 1. With FAIL_ON=1 all later calls fail too, as on a full disk.
   FAIL_LEAST  smallest allocation that is counted and may fail, in bytes
   FAIL_TRACE  file that gets a line for each call if no call is to fail: its number, and a hash of its stack
   FAIL_REPORT file that gets the number of counted calls, and "failed" if one of them failed, with "in HDF5" if HDF5 or
               netCDF made the call: these libraries can crash then
   A program may call fail_calls(kind, n) to count from there. Calls on standard input, output and error count like
   others if they use these functions; those within stdio do not. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <execinfo.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <unistd.h>

extern void* __libc_malloc(size_t);
extern void* __libc_calloc(size_t, size_t);
extern void* __libc_realloc(void*, size_t);
extern void* __libc_memalign(size_t, size_t);

/* All forked processes share this state, so the n-th call of all processes together fails. */
struct state {
  char wanted[16];
  long fail_at, seen, failed, in_hdf5;
};
static struct state before_mapping, *state = &before_mapping;
static int counted; /* whether calls of this process and its forks count; those of the waiting parent do not */
static int fail_on;
size_t least; /* smallest allocation that may fail */
static int trace = -1;
static __thread int tracing; /* backtrace allocates too */

void fail_calls(const char* kind, long n) {
  state->fail_at = n;
  state->seen = state->failed = 0;
  if (kind[0] != 0) state->in_hdf5 = 0; /* stays known after the last call */
  strncpy(state->wanted, kind, sizeof state->wanted - 1);
  counted = kind[0] != 0;
}

long calls_failed(void) { return state->failed; }
long failed_in_hdf5(void) { return state->in_hdf5; }

/* Uses system calls only, because it also runs within a call that fails. */
static void report(void) {
  const char* path = getenv("FAIL_REPORT");
  if (path == NULL) return;
  char line[64];
  const int length = snprintf(line, sizeof line, "%ld%s%s\n", state->seen, state->failed ? " failed" : "",
                              state->in_hdf5 ? " in HDF5" : "");
  const int file = (int)syscall(SYS_openat, AT_FDCWD, path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (file < 0) return;
  syscall(SYS_write, file, line, length);
  syscall(SYS_close, file);
}

__attribute__((constructor)) static void begin(void) {
  const char* text = getenv("FAIL_LEAST");
  least = text ? strtoul(text, NULL, 10) : 0;
  fail_on = getenv("FAIL_ON") != NULL;
  if (getenv("FAIL_TRACE") != NULL)
    trace = (int)syscall(SYS_openat, AT_FDCWD, getenv("FAIL_TRACE"), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  void* shared = mmap(NULL, sizeof *state, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (shared != MAP_FAILED) state = shared;
  atexit(report);
  if (getenv("FAIL_CALL") != NULL) fail_calls(getenv("FAIL_CALL"), getenv("FAIL_AT") ? atol(getenv("FAIL_AT")) : 0);
}

static void note_place(long n) {
  void* places[48];
  char line[64];
  unsigned long hash = 5381;
  tracing = 1;
  const int depth = backtrace(places, 48);
  for (int i = 0; i < depth; ++i) hash = hash * 33 ^ (unsigned long)places[i];
  syscall(SYS_write, trace, line, snprintf(line, sizeof line, "%ld %lx\n", n, hash));
  tracing = 0;
}

static int is_in_hdf5(void) {
  void* places[64];
  tracing = 1;
  const int depth = backtrace(places, 64);
  int found = 0;
  for (int i = 0; i < depth && !found; ++i) {
    Dl_info from;
    found = dladdr(places[i], &from) != 0 && from.dli_fname != NULL &&
            (strstr(from.dli_fname, "libhdf5") != NULL || strstr(from.dli_fname, "libnetcdf") != NULL);
  }
  tracing = 0;
  return found;
}

static int fails(const char* kind) {
  if (!counted || tracing || strcmp(state->wanted, kind) != 0) return 0;
  const long n = __atomic_add_fetch(&state->seen, 1, __ATOMIC_RELAXED);
  if (trace >= 0 && state->fail_at == 0) note_place(n);
  if (n != state->fail_at && !(fail_on && state->fail_at > 0 && n > state->fail_at)) return 0;
  state->failed = 1;
  state->in_hdf5 |= is_in_hdf5();
  report();
  return 1;
}

/* An OpenMP runtime (libgomp or libomp of BLAS) ends the program if it gets no memory or cannot read /proc. The dynamic
   loader does so if it gets no memory for thread-local data. Our program cannot prevent that, so these calls do not
   fail. A search for the caller takes longer than most programs need between two calls, so we store the answers. */
static int ends_the_program(const void* caller) {
  static unsigned long answers[4096]; /* the caller, and in the lowest bit the answer */
  static __thread int asking;
  if (asking || state->wanted[0] == 0) return 0;
  const unsigned long address = (unsigned long)caller << 1;
  unsigned long* place = &answers[(address >> 1 ^ address >> 13) % 4096];
  const unsigned long answer = __atomic_load_n(place, __ATOMIC_RELAXED);
  if ((answer & ~1ul) == address && answer != 0) return (int)(answer & 1);
  asking = 1;
  Dl_info from;
  const int found = dladdr(caller, &from) != 0 && from.dli_fname != NULL &&
                    (strstr(from.dli_fname, "omp.so") != NULL || strstr(from.dli_fname, "/ld-linux") != NULL);
  asking = 0;
  __atomic_store_n(place, address | (unsigned long)found, __ATOMIC_RELAXED);
  return found;
}

static int memory_fails(size_t size, const void* caller) {
  return size >= least && strcmp(state->wanted, "malloc") == 0 && !ends_the_program(caller) && fails("malloc");
}

void* malloc(size_t size) {
  if (memory_fails(size, __builtin_return_address(0))) {
    errno = ENOMEM;
    return NULL;
  }
  return __libc_malloc(size);
}

void* calloc(size_t count, size_t size) {
  if (memory_fails(count * size, __builtin_return_address(0))) {
    errno = ENOMEM;
    return NULL;
  }
  return __libc_calloc(count, size);
}

void* realloc(void* old, size_t size) {
  if (size > 0 && memory_fails(size, __builtin_return_address(0))) {
    errno = ENOMEM;
    return NULL;
  }
  return __libc_realloc(old, size);
}

void* aligned_alloc(size_t alignment, size_t size) {
  if (memory_fails(size, __builtin_return_address(0))) {
    errno = ENOMEM;
    return NULL;
  }
  return __libc_memalign(alignment, size);
}

int posix_memalign(void** at, size_t alignment, size_t size) {
  if (memory_fails(size, __builtin_return_address(0))) return ENOMEM;
  *at = __libc_memalign(alignment, size);
  return *at == NULL ? ENOMEM : 0;
}

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

static int real_open(const char* name, const void* caller, const char* path, int flags, va_list more) {
  if (!ends_the_program(caller) && fails("open")) {
    errno = EMFILE;
    return -1;
  }
  const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) ? va_arg(more, mode_t) : 0;
  return ((int (*)(const char*, int, ...))dlsym(RTLD_NEXT, name))(path, flags, mode);
}

int open(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const int file = real_open("open", __builtin_return_address(0), path, flags, more);
  va_end(more);
  return file;
}

int open64(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const int file = real_open("open64", __builtin_return_address(0), path, flags, more);
  va_end(more);
  return file;
}

FILE* fopen(const char* path, const char* mode) {
  if (!ends_the_program(__builtin_return_address(0)) && fails("open")) {
    errno = EMFILE;
    return NULL;
  }
  return REAL(fopen)(path, mode);
}

FILE* fopen64(const char* path, const char* mode) {
  if (!ends_the_program(__builtin_return_address(0)) && fails("open")) {
    errno = EMFILE;
    return NULL;
  }
  return REAL(fopen64)(path, mode);
}

ssize_t write(int file, const void* data, size_t size) {
  if (fails("write")) {
    errno = ENOSPC;
    return -1;
  }
  return REAL(write)(file, data, size);
}

ssize_t pwrite(int file, const void* data, size_t size, off_t at) {
  if (fails("write")) {
    errno = ENOSPC;
    return -1;
  }
  return REAL(pwrite)(file, data, size, at);
}

ssize_t pwrite64(int file, const void* data, size_t size, off64_t at) {
  if (fails("write")) {
    errno = ENOSPC;
    return -1;
  }
  return REAL(pwrite64)(file, data, size, at);
}

int fsync(int file) {
  if (fails("fsync")) {
    errno = EIO;
    return -1;
  }
  return REAL(fsync)(file);
}

int rename(const char* from, const char* to) {
  if (fails("rename")) {
    errno = EIO;
    return -1;
  }
  return REAL(rename)(from, to);
}

int close(int file) {
  const int bad = fails("close"); /* the descriptor is gone nevertheless, as after a write-back that failed */
  const int result = REAL(close)(file);
  if (!bad) return result;
  errno = EIO;
  return -1;
}
