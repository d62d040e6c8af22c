// SPDX-License-Identifier: BSD-3-Clause
#include "base/opened_library.hpp"

#include <dlfcn.h>

namespace pnpbs {

namespace {

// RTLD_DEEPBIND makes a library resolve its own symbols first, which a host program may define as
// well. The run-time libraries of the sanitizers abort the process if this flag is used.
int open_mode() {
  int mode = RTLD_NOW | RTLD_LOCAL;
#ifdef RTLD_DEEPBIND
  if (!dlsym(RTLD_DEFAULT, "__sanitizer_set_death_callback")) mode |= RTLD_DEEPBIND;
#endif
  return mode;
}

}  // namespace

void* open_library(std::initializer_list<const char*> names) {
  void* library = nullptr;
  for (const char* name : names)
    if (!library) library = dlopen(name, open_mode());
  return library;
}

}  // namespace pnpbs
