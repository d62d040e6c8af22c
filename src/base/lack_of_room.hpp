// SPDX-License-Identifier: BSD-3-Clause
// Errors that mean: there is no room for the nodes that d asks for.
#pragma once

#include "base/error.hpp"

namespace pnpbs {

inline bool is_lack_of_room(const Error& error) {
  return error.kind() == ErrorKind::spacing || error.kind() == ErrorKind::memory;
}

}  // namespace pnpbs
