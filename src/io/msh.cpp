// SPDX-License-Identifier: BSD-3-Clause
// gmsh's format 2.2, as text: the version that most programs read. Numbers from 1. Boundary edges
// have their tag as physical group, triangles the group 1. Without elements every node is a point
// of its tag's group, since gmsh forgets nodes that belong to nothing.
#include <cstdlib>

#include "io/formats.hpp"

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

void write_points(const NodeBlock& nodes, SharedFile& file) {
  file.append_text("$Nodes\n" + std::to_string(nodes.nodes.total) + "\n");
  file.append([&](Sink& sink) {
    std::int64_t number = nodes.nodes.first;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      sink.number(++number);
      sink.text(" ");
      sink.number(nodes.xy[2 * i]);
      sink.text(" ");
      sink.number(nodes.xy[2 * i + 1]);
      sink.text(" 0\n");
    }
  });
  file.append_text("$EndNodes\n");
}

void write_nodes_as_elements(const NodeBlock& nodes, SharedFile& file) {
  file.append([&](Sink& sink) {
    std::int64_t number = nodes.nodes.first;
    for (const std::int64_t tag : nodes.tags) {
      sink.number(number + 1);
      sink.text(point);
      sink.number(tag);  // physical group
      sink.text(" ");
      sink.number(std::abs(tag) + 1);  // geometric entity
      write_corners(&number, 1, sink);
      ++number;
    }
  });
}

void write_edges(const NodeBlock& nodes, SharedFile& file) {
  file.append([&](Sink& sink) {
    std::int64_t number = nodes.edges.first;
    for (std::size_t e = 0; e < nodes.edge_tags.size(); ++e) {
      const std::int64_t tag = nodes.edge_tags[e];
      sink.number(++number);
      sink.text(line);
      sink.number(tag);  // physical group
      sink.text(" ");
      sink.number(std::abs(tag));  // geometric entity
      write_corners(&nodes.edge_ends[2 * e], 2, sink);
    }
  });
}

void write_triangles(const NodeBlock& nodes, SharedFile& file) {
  file.append([&](Sink& sink) {
    std::int64_t number = nodes.edges.total + nodes.triangles.first;
    for (std::size_t t = 0; t < nodes.quality.size(); ++t) {
      sink.number(++number);
      sink.text(triangle);
      sink.text("1 1");
      write_corners(&nodes.corners[3 * t], 3, sink);
    }
  });
}

}  // namespace

void write_msh(const NodeBlock& nodes, SharedFile& file) {
  file.append_text("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n");
  write_points(nodes, file);
  const std::int64_t elements =
      nodes.elements ? nodes.edges.total + nodes.triangles.total : nodes.nodes.total;
  file.append_text("$Elements\n" + std::to_string(elements) + "\n");
  if (nodes.elements) {
    write_edges(nodes, file);
    write_triangles(nodes, file);
  } else {
    write_nodes_as_elements(nodes, file);
  }
  file.append_text("$EndElements\n");
}

}  // namespace pnpbs::io
