/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A library to preload, with which HDF5 cannot be opened. */
#define _GNU_SOURCE /* RTLD_NEXT */
#include <dlfcn.h>
#include <string.h>

void* dlopen(const char* path, int mode) {
  static void* (*real)(const char*, int);
  if (!real) *(void**)&real = dlsym(RTLD_NEXT, "dlopen");
  return real(path && strstr(path, "hdf5") ? "nowhere/libhdf5.so" : path, mode);
}
