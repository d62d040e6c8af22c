/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Prevents a program from opening HDF5, when preloaded as a library. */
#define _GNU_SOURCE /* for RTLD_NEXT */
#include <dlfcn.h>
#include <string.h>

void* dlopen(const char* path, int mode) {
  static void* (*real)(const char*, int);
  if (!real) *(void**)&real = dlsym(RTLD_NEXT, "dlopen");
  return real(path && strstr(path, "hdf5") ? "nowhere/libhdf5.so" : path, mode);
}
