// SPDX-License-Identifier: BSD-3-Clause
#include "io/msh_data.hpp"

namespace pnpbs::io {

namespace {

// Gmsh knows scalars, vectors and tensors of space; what is missing is 0.
std::int64_t components_of_gmsh(std::int64_t components) {
  return components == 1 ? 1 : components <= 3 ? 3 : 9;
}

// Its name, its time, and its time step, components and rows.
std::string heading(const OutputField& field, std::int64_t nodes) {
  return "$NodeData\n1\n\"" + field.name + "\"\n1\n0\n3\n0\n" +
         std::to_string(components_of_gmsh(field.components)) + "\n" + std::to_string(nodes) + "\n";
}

void append_rows(const NodeSource& nodes, std::size_t k, SharedFile& file) {
  const auto components = static_cast<std::size_t>((*nodes.contents().fields)[k].components);
  const auto written = components_of_gmsh(static_cast<std::int64_t>(components));
  nodes.for_field(k, [&](const FieldRows& rows) {
    file.append([&](Sink& sink) {
      std::int64_t number = rows.first;
      for (std::size_t at = 0; at < rows.values.size(); at += components) {
        sink.number(++number);
        for (std::size_t c = 0; c < static_cast<std::size_t>(written); ++c) {
          sink.text(" ");
          sink.number(c < components ? rows.values[at + c] : 0.0);
        }
        sink.text("\n");
      }
    });
  });
}

}  // namespace

void append_node_data(const NodeSource& nodes, SharedFile& file) {
  const Contents& all = nodes.contents();
  for (std::size_t k = 0; k < all.field_count(); ++k) {
    file.append_text(heading((*all.fields)[k], all.nodes));
    append_rows(nodes, k, file);
    file.append_text("$EndNodeData\n");
  }
}

}  // namespace pnpbs::io
