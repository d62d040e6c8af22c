/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Implements the faults of fault_calls.h by wrappers of the system's file calls. */
#define _GNU_SOURCE /* for RTLD_NEXT and the calls for large files */
#include "fault_calls.h"

#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/uio.h>
#include <unistd.h>

#define FILES 4096

static long until = -1; /* not atomic, as one thread accesses files */
static const char* failed;
static char aside[FILES]; /* whether the file of this descriptor is a temporary one */

void fault_arm(long n) {
  failed = NULL;
  until = n;
}

const char* fault_happened(void) { return failed; }

/* Returns whether the path is a temporary file of the library. Files of Open MPI end in .sm and
 * have similar names; faults in these would crash it. */
static int is_aside(const char* path) {
  return path && strstr(path, ".pnpbs-") != NULL && !strstr(path, ".sm");
}
static int is_open_aside(int file) { return file >= 0 && file < FILES && aside[file]; }

/* Returns whether a call on a temporary file is to fail. */
static int fails(const char* call) {
  const char* log = getenv("PNPBS_FAULT_LOG");
  if (until < 0 || until-- > 0) return 0;
  failed = call;
  if (log) {
    FILE* file = fopen(log, "w");
    if (file) fprintf(file, "%s\n", call), fclose(file);
  }
  return 1;
}

__attribute__((constructor)) static void arm_by_environment(void) {
  const char *at = getenv("PNPBS_FAULT_AT"), *rank = getenv("PNPBS_FAULT_RANK");
  const char* mine = getenv("OMPI_COMM_WORLD_RANK");
  if (!at || (rank && (!mine || strcmp(rank, mine) != 0))) return;
  fault_arm(atol(at));
}

/* Defines `real`, a pointer to the function of the system. */
#define REAL(result, name, ...)       \
  static result (*real)(__VA_ARGS__); \
  if (!real) *(void**)&real = dlsym(RTLD_NEXT, name)

#define OPENS(name)                                              \
  int name(const char* path, int flags, ...) {                   \
    mode_t mode = 0;                                             \
    int file;                                                    \
    REAL(int, #name, const char*, int, ...);                     \
    if (flags & O_CREAT) {                                       \
      va_list more;                                              \
      va_start(more, flags);                                     \
      mode = va_arg(more, mode_t);                               \
      va_end(more);                                              \
    }                                                            \
    if (is_aside(path) && fails("open")) {                       \
      errno = EMFILE;                                            \
      return -1;                                                 \
    }                                                            \
    file = real(path, flags, mode);                              \
    if (file >= 0 && file < FILES) aside[file] = is_aside(path); \
    return file;                                                 \
  }
OPENS(open)
OPENS(open64)

int close(int file) {
  const int bad = is_open_aside(file) && fails("close");
  REAL(int, "close", int);
  if (file >= 0 && file < FILES) aside[file] = 0;
  if (real(file) != 0) return -1;
  if (!bad) return 0;
  errno = EIO;
  return -1;
}

#define WRITES(name, parameters, types, arguments) \
  ssize_t name parameters {                        \
    REAL(ssize_t, #name, types);                   \
    if (is_open_aside(file) && fails("write")) {   \
      errno = ENOSPC;                              \
      return -1;                                   \
    }                                              \
    return real arguments;                         \
  }
#define LIST(...) __VA_ARGS__
WRITES(write, (int file, const void* data, size_t n), LIST(int, const void*, size_t),
       (file, data, n))
WRITES(pwrite, (int file, const void* data, size_t n, off_t at),
       LIST(int, const void*, size_t, off_t), (file, data, n, at))
WRITES(pwrite64, (int file, const void* data, size_t n, off64_t at),
       LIST(int, const void*, size_t, off64_t), (file, data, n, at))
WRITES(writev, (int file, const struct iovec* data, int n), LIST(int, const struct iovec*, int),
       (file, data, n))
WRITES(pwritev, (int file, const struct iovec* data, int n, off_t at),
       LIST(int, const struct iovec*, int, off_t), (file, data, n, at))
WRITES(pwritev64, (int file, const struct iovec* data, int n, off64_t at),
       LIST(int, const struct iovec*, int, off64_t), (file, data, n, at))

#define NAMES(name, parameters, types, arguments, concerns) \
  int name parameters {                                     \
    REAL(int, #name, types);                                \
    if ((concerns) && fails(#name)) {                       \
      errno = EIO;                                          \
      return -1;                                            \
    }                                                       \
    return real arguments;                                  \
  }
NAMES(rename, (const char* from, const char* to), LIST(const char*, const char*), (from, to),
      is_aside(from) || is_aside(to))
NAMES(link, (const char* from, const char* to), LIST(const char*, const char*), (from, to),
      is_aside(to))
NAMES(unlink, (const char* path), LIST(const char*), (path), is_aside(path))
