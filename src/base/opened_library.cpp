// SPDX-License-Identifier: BSD-3-Clause
#include "base/opened_library.hpp"

#include <dlfcn.h>

namespace pnpbs {

namespace {

// RTLD_DEEPBIND: libraries call themselves, too, by names that a host program may have. The
// sanitizers' run-time libraries end the process at the sight of it.
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
