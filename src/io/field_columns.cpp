// SPDX-License-Identifier: BSD-3-Clause
#include "io/field_columns.hpp"

namespace pnpbs::io {

FieldColumns field_columns(const NodeSource& nodes, std::size_t field) {
  FieldColumns columns{static_cast<std::size_t>((*nodes.contents().fields)[field].components), {}};
  nodes.for_field(field, [&](const FieldRows& rows) {
    columns.values.insert(columns.values.end(), rows.values.begin(), rows.values.end());
  });
  return columns;
}

}  // namespace pnpbs::io
