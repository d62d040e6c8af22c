// SPDX-License-Identifier: BSD-3-Clause
// gmsh's format 2.2, as text: the version that most programs read. Numbers from 1. Boundary edges
// have their tag as physical group, triangles the group 1. Without elements every node is a point
// of its tag's group, since gmsh forgets nodes that belong to nothing.
#include <cmath>
#include <cstdlib>

#include "io/numbered_points.hpp"

namespace pnpbs::io {
namespace {

constexpr std::string_view point = " 15 2 ";    // one node; two tags follow
constexpr std::string_view line = " 1 2 ";      // two nodes
constexpr std::string_view triangle = " 2 2 ";  // three nodes

void write_corners(const std::int64_t* corners, std::size_t count, Sink& sink) {
  for (std::size_t k = 0; k < count; ++k) {
    sink.text(" ");
    sink.number(corners[k] + 1);
  }
  sink.text("\n");
}

void write_points(const NodeSource& nodes, SharedFile& file) {
  file.append_text("$Nodes\n" + std::to_string(nodes.contents().nodes) + "\n");
  append_numbered_points(nodes, file,
                         [](const NodeRows&, std::size_t, Sink& sink) { sink.text(" 0\n"); });
  file.append_text("$EndNodes\n");
}

void write_nodes_as_elements(const NodeSource& nodes, SharedFile& file) {
  nodes.for_nodes([&](const NodeRows& rows) {
    file.append([&](Sink& sink) {
      std::int64_t number = rows.first;
      for (const std::int64_t tag : rows.tags) {
        sink.number(number + 1);
        sink.text(point);
        sink.number(tag);  // physical group
        sink.text(" ");
        sink.number(std::abs(tag) + 1);  // geometric entity
        write_corners(&number, 1, sink);
        ++number;
      }
    });
  });
}

void write_edges(const NodeSource& nodes, SharedFile& file) {
  nodes.for_edges([&](const EdgeRows& rows) {
    file.append([&](Sink& sink) {
      std::int64_t number = rows.first;
      for (std::size_t e = 0; e < rows.tags.size(); ++e) {
        const std::int64_t tag = rows.tags[e];
        sink.number(++number);
        sink.text(line);
        sink.number(tag);  // physical group
        sink.text(" ");
        sink.number(std::abs(tag));  // geometric entity
        write_corners(&rows.ends[2 * e], 2, sink);
      }
    });
  });
}

void write_triangles(const NodeSource& nodes, SharedFile& file) {
  nodes.for_triangles([&](const TriangleRows& rows) {
    file.append([&](Sink& sink) {
      std::int64_t number = nodes.contents().edges + rows.first;
      for (std::size_t t = 0; t < rows.quality.size(); ++t) {
        sink.number(++number);
        sink.text(triangle);
        sink.text("1 1");
        write_corners(&rows.corners[3 * t], 3, sink);
      }
    });
  });
}

}  // namespace

void write_msh(const NodeSource& nodes, SharedFile& file) {
  file.append_text("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n");
  write_points(nodes, file);
  const Contents& all = nodes.contents();
  const std::int64_t elements = all.elements ? all.edges + all.triangles : all.nodes;
  file.append_text("$Elements\n" + std::to_string(elements) + "\n");
  if (all.elements) {
    write_edges(nodes, file);
    write_triangles(nodes, file);
  } else {
    write_nodes_as_elements(nodes, file);
  }
  file.append_text("$EndElements\n");
}

}  // namespace pnpbs::io
