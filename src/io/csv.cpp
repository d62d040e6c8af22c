// SPDX-License-Identifier: BSD-3-Clause
// Comma-separated values with one line of names.
#include "io/formats.hpp"

namespace pnpbs::io {

void write_csv(const NodeSource& nodes, SharedFile& file) {
  const auto dimension = static_cast<std::size_t>(nodes.contents().dimension);
  file.append_text(dimension == 2 ? "id,x,y,tag,spacing\n" : "id,x,y,z,tag,spacing\n");
  nodes.for_nodes([&](const NodeRows& rows) {
    file.append([&](Sink& sink) {
      for (std::size_t i = 0; i < rows.ids.size(); ++i) {
        sink.number(rows.ids[i]);
        sink.text(",");
        for (std::size_t k = 0; k < dimension; ++k) {
          sink.number(rows.x[dimension * i + k]);
          sink.text(",");
        }
        sink.number(rows.tags[i]);
        sink.text(",");
        sink.number(rows.spacing[i]);
        sink.text("\n");
      }
    });
  });
}

}  // namespace pnpbs::io
