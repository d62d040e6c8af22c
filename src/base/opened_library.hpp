// SPDX-License-Identifier: BSD-3-Clause
// Libraries that are opened at run time: PNPBS does without them until then, and they do not meet
// those of the same name that a host program may have.
#pragma once

#include <initializer_list>

namespace pnpbs {

// The first of these, by path or name, that can be opened; nullptr if none can, then dlerror()
// tells why not the last.
void* open_library(std::initializer_list<const char*> names);

}  // namespace pnpbs
