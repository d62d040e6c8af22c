// SPDX-License-Identifier: BSD-3-Clause
// Triangle's .node format, "nodes dimension attributes markers", then "number x y marker"; and its
// .ele format, "triangles corners attributes", then "number corner corner corner". From 1.
#include "io/formats.hpp"

namespace pnpbs::io {

void write_node(const NodeBlock& nodes, SharedFile& file) {
  file.append_text(std::to_string(nodes.nodes.total) + " 2 0 1\n");
  file.append([&](Sink& sink) {
    std::int64_t number = nodes.nodes.first;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      sink.number(++number);
      sink.text(" ");
      sink.number(nodes.xy[2 * i]);
      sink.text(" ");
      sink.number(nodes.xy[2 * i + 1]);
      sink.text(" ");
      sink.number(nodes.tags[i]);
      sink.text("\n");
    }
  });
  file.append_text("# nodes placed by pnpbs\n");
}

void write_ele(const NodeBlock& nodes, SharedFile& file) {
  file.append_text(std::to_string(nodes.triangles.total) + " 3 0\n");
  file.append([&](Sink& sink) {
    std::int64_t number = nodes.triangles.first;
    for (std::size_t t = 0; t < nodes.quality.size(); ++t) {
      sink.number(++number);
      for (std::size_t k = 0; k < 3; ++k) {
        sink.text(" ");
        sink.number(nodes.corners[3 * t + k] + 1);
      }
      sink.text("\n");
    }
  });
  file.append_text("# triangles of nodes placed by pnpbs\n");
}

}  // namespace pnpbs::io
