// SPDX-License-Identifier: BSD-3-Clause
// Triangle's .node format, "nodes dimension attributes markers", then "number x y marker"; and its
// .ele format, "triangles corners attributes", then "number corner corner corner". From 1.
#include "io/numbered_points.hpp"

namespace pnpbs::io {

void write_node(const NodeSource& nodes, SharedFile& file) {
  file.append_text(std::to_string(nodes.contents().nodes) + " 2 0 1\n");
  append_numbered_points(nodes, file, [](const NodeRows& rows, std::size_t i, Sink& sink) {
    sink.text(" ");
    sink.number(rows.tags[i]);
    sink.text("\n");
  });
  file.append_text("# nodes placed by pnpbs\n");
}

void write_ele(const NodeSource& nodes, SharedFile& file) {
  file.append_text(std::to_string(nodes.contents().triangles) + " 3 0\n");
  nodes.for_triangles([&](const TriangleRows& rows) {
    file.append([&](Sink& sink) {
      std::int64_t number = rows.first;
      for (std::size_t t = 0; t < rows.quality.size(); ++t) {
        sink.number(++number);
        for (std::size_t k = 0; k < 3; ++k) {
          sink.text(" ");
          sink.number(rows.corners[3 * t + k] + 1);
        }
        sink.text("\n");
      }
    });
  });
  file.append_text("# triangles of nodes placed by pnpbs\n");
}

}  // namespace pnpbs::io
