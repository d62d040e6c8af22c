// SPDX-License-Identifier: BSD-3-Clause
// Writer for Peridigm's TextFileDiscretization: "x y z block volume", one line for each particle of
// a body.
#include "io/formats.hpp"
#include "io/particle_fields.hpp"

namespace pnpbs::io {

void write_peridigm(const NodeSource& nodes, SharedFile& file) {
  const std::vector<double> volumes = particle_values(nodes, kVolumeField);
  largest_block(nodes, "peridigm");  // throws for negative tags
  std::size_t before = 0;            // nodes of earlier windows
  file.append_text("# x y z block volume\n");
  nodes.for_nodes([&](const NodeRows& rows) {
    file.append([&](Sink& sink) {
      for (std::size_t i = 0; i < rows.ids.size(); ++i) {
        write_point(rows, i, sink);
        sink.number(block_of(rows, i));
        sink.text(" ");
        sink.number(volumes[before + i]);
        sink.text("\n");
      }
    });
    before += rows.ids.size();
  });
}

}  // namespace pnpbs::io
