// SPDX-License-Identifier: BSD-3-Clause
// Comma-separated values with one line of names.
#include "io/formats.hpp"

namespace pnpbs::io {

void write_csv(const NodeBlock& nodes, SharedFile& file) {
  file.append_text("id,x,y,tag,spacing\n");
  file.append([&](Sink& sink) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      sink.number(nodes.ids[i]);
      sink.text(",");
      sink.number(nodes.xy[2 * i]);
      sink.text(",");
      sink.number(nodes.xy[2 * i + 1]);
      sink.text(",");
      sink.number(nodes.tags[i]);
      sink.text(",");
      sink.number(nodes.spacing[i]);
      sink.text("\n");
    }
  });
}

}  // namespace pnpbs::io
