// SPDX-License-Identifier: BSD-3-Clause
// Libraries that are opened at run time. PNPBS runs without them until a function of theirs is
// needed. Their symbols do not clash with those of a library of the same name in the host program.
#pragma once

#include <initializer_list>

namespace pnpbs {

// Opens the first library of the list that can be opened, by path or name. Returns nullptr if there
// is none; dlerror() then describes the failure of the last.
void* open_library(std::initializer_list<const char*> names);

}  // namespace pnpbs
