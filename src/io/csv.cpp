// SPDX-License-Identifier: BSD-3-Clause
// Comma-separated values with one line of names.
#include "io/formats.hpp"

namespace pnpbs::io {

void write_csv(const NodeSource& nodes, SharedFile& file) {
  file.append_text("id,x,y,tag,spacing\n");
  nodes.for_nodes([&](const NodeRows& rows) {
    file.append([&](Sink& sink) {
      for (std::size_t i = 0; i < rows.ids.size(); ++i) {
        sink.number(rows.ids[i]);
        sink.text(",");
        sink.number(rows.xy[2 * i]);
        sink.text(",");
        sink.number(rows.xy[2 * i + 1]);
        sink.text(",");
        sink.number(rows.tags[i]);
        sink.text(",");
        sink.number(rows.spacing[i]);
        sink.text("\n");
      }
    });
  });
}

}  // namespace pnpbs::io
