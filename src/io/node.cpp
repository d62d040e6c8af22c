// SPDX-License-Identifier: BSD-3-Clause
// Writers of Triangle's and TetGen's formats: .node ("nodes dimension attributes markers", then
// "number x y marker" or "number x y z marker"), .ele ("elements corners attributes", then "number
// corner corner ..." and the region if any has a tag) and TetGen's .face ("faces markers", then
// "number corner corner corner marker"). Numbers start at 1.
#include "io/numbered_rows.hpp"

namespace pnpbs::io {

void write_node(const NodeSource& nodes, SharedFile& file) {
  const Contents& all = nodes.contents();
  file.append_text(std::to_string(all.nodes) + " " + std::to_string(all.coordinates) + " 0 1\n");
  append_numbered_points(nodes, file, [](const NodeRows& rows, std::size_t i, Sink& sink) {
    sink.text(" ");
    sink.number(rows.tags[i]);
    sink.text("\n");
  });
  file.append_text("# nodes placed by pnpbs\n");
}

void write_ele(const NodeSource& nodes, SharedFile& file) {
  const Contents& all = nodes.contents();
  const int corners = all.element_nodes();
  file.append_text(std::to_string(all.elements) + " " + std::to_string(corners) +
                   (all.with_regions ? " 1\n" : " 0\n"));
  nodes.for_elements([&](const ElementRows& rows) {
    file.append([&](Sink& sink) {
      std::int64_t number = rows.first;
      for (std::size_t e = 0; e < rows.quality.size(); ++e) {
        sink.number(++number);
        write_corners(rows.nodes, e, corners, sink);
        if (all.with_regions) {
          sink.text(" ");
          sink.number(rows.regions[e]);
        }
        sink.text("\n");
      }
    });
  });
  file.append_text(all.dimension == 2 ? "# triangles of nodes placed by pnpbs\n"
                                      : "# tetrahedra of nodes placed by pnpbs\n");
}

void write_face(const NodeSource& nodes, SharedFile& file) {
  const Contents& all = nodes.contents();
  file.append_text(std::to_string(all.facets) + " 1\n");
  nodes.for_facets([&](const FacetRows& rows) {
    file.append([&](Sink& sink) {
      std::int64_t number = rows.first;
      for (std::size_t f = 0; f < rows.tags.size(); ++f) {
        sink.number(++number);
        write_corners(rows.nodes, f, all.facet_nodes(), sink);
        sink.text(" ");
        sink.number(rows.tags[f]);
        sink.text("\n");
      }
    });
  });
  file.append_text("# boundary of tetrahedra of nodes placed by pnpbs\n");
}

}  // namespace pnpbs::io
