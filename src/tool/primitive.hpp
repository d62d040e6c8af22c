// SPDX-License-Identifier: BSD-3-Clause
// Simple bodies in words: "ball(0,0,0, 1)".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tool/library.hpp"

namespace pnpbs::tool {

struct Primitive {
  std::string shape;
  std::vector<double> numbers;
};

// Nothing if the text names a file. Throws BadInput if it is no body that we know.
std::optional<Primitive> primitive_in(const std::string& text);

void add(const Primitive& primitive, pnpbs_domain domain, pnpbs_context context);

}  // namespace pnpbs::tool
