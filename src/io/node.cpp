// SPDX-License-Identifier: BSD-3-Clause
// Triangle's .node format: "nodes dimension attributes markers", then "number x y marker".
#include "io/formats.hpp"

namespace pnpbs::io {

void write_node(const NodeSet& nodes, const PictureStyle& /*style*/, Sink& sink) {
  sink.number(nodes.size());
  sink.text(" 2 0 1\n");
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    sink.number(i + 1);
    sink.text(" ");
    sink.number(nodes.xy[2 * i]);
    sink.text(" ");
    sink.number(nodes.xy[2 * i + 1]);
    sink.text(" ");
    sink.number(nodes.tags[i]);
    sink.text("\n");
  }
  sink.text("# nodes placed by pnpbs\n");
}

}  // namespace pnpbs::io
