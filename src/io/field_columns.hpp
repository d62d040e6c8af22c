// SPDX-License-Identifier: BSD-3-Clause
// One of the caller's fields at the nodes in this rank's parts of all windows. So no window of
// nodes waits for one of a field.
#pragma once

#include <cstddef>
#include <vector>

#include "io/node_source.hpp"

namespace pnpbs::io {

struct FieldColumns {
  std::size_t components;
  std::vector<double> values;  // [nodes][components]
};

// Collective.
FieldColumns field_columns(const NodeSource& nodes, std::size_t field);

}  // namespace pnpbs::io
