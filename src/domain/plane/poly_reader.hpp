// SPDX-License-Identifier: BSD-3-Clause
// Reads Triangle's .poly format (https://www.cs.cmu.edu/~quake/triangle.poly.html): vertices,
// segments, holes; regional attributes are skipped.
#pragma once

#include <string>
#include <string_view>

#include "domain/plane/plane_domain.hpp"

namespace pnpbs {

// Adds what the file describes. If it holds no vertices ("0 2 0 0"), they are read from the .node
// file beside it. Throws Error(ErrorKind::file, "file:line: ...") and then adds nothing.
void read_poly_file(PlaneDomain& domain, const std::string& path);

// The same from text. `name` stands for the file in messages.
void parse_poly(PlaneDomain& domain, std::string_view text, const std::string& name);

}  // namespace pnpbs
