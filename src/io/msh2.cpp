// SPDX-License-Identifier: BSD-3-Clause
// Writer of Gmsh's format 2.2 as text, for programs that do not read later versions. Numbers start
// at 1. Facets have their tag as physical group, and elements that of their region or of the
// inside. Without elements every node becomes a point element in the group of its tag, since Gmsh
// drops nodes without elements.
#include <cmath>
#include <cstdlib>

#include "io/msh_data.hpp"
#include "io/msh_groups.hpp"
#include "io/msh_periodic.hpp"
#include "io/numbered_rows.hpp"

namespace pnpbs::io {
namespace {

// Element types, followed by the number of tags, 2.
constexpr std::string_view point_code = " 15 2 ";
constexpr std::string_view line_code = " 1 2 ";
constexpr std::string_view triangle_code = " 2 2 ";
constexpr std::string_view tetrahedron_code = " 4 2 ";
constexpr std::string_view second_order_line_code = " 8 2 ";
constexpr std::string_view second_order_triangle_code = " 9 2 ";
constexpr std::string_view second_order_tetrahedron_code = " 11 2 ";

std::string_view code_of(int nodes, int order) {
  if (order == 2)
    return nodes == 3   ? second_order_line_code
           : nodes == 6 ? second_order_triangle_code
                        : second_order_tetrahedron_code;
  return nodes == 2 ? line_code : nodes == 3 ? triangle_code : tetrahedron_code;
}

void write_points(const NodeSource& nodes, SharedFile& file) {
  file.append_text("$Nodes\n" + std::to_string(nodes.contents().nodes) + "\n");
  const std::string_view rest = nodes.contents().dimension == 2 ? " 0\n" : "\n";  // z
  append_numbered_points(nodes, file,
                         [&](const NodeRows&, std::size_t, Sink& sink) { sink.text(rest); });
  file.append_text("$EndNodes\n");
}

void write_nodes_as_elements(const NodeSource& nodes, SharedFile& file) {
  nodes.for_nodes([&](const NodeRows& rows) {
    file.append([&](Sink& sink) {
      std::int64_t number = rows.first;
      for (const std::int64_t tag : rows.tags) {
        sink.number(number + 1);
        sink.text(point_code);
        sink.number(tag);  // physical group
        sink.text(" ");
        sink.number(std::abs(tag) + 1);  // geometric entity
        sink.text(" ");
        sink.number(++number);
        sink.text("\n");
      }
    });
  });
}

void write_facets(const NodeSource& nodes, SharedFile& file) {
  const Contents& all = nodes.contents();
  nodes.for_facets([&](const FacetRows& rows) {
    file.append([&](Sink& sink) {
      std::int64_t number = rows.first;
      for (std::size_t f = 0; f < rows.tags.size(); ++f) {
        const std::int64_t tag = rows.tags[f];
        sink.number(++number);
        sink.text(code_of(all.facet_nodes(), all.order));
        sink.number(tag);  // physical group
        sink.text(" ");
        sink.number(std::abs(tag));  // geometric entity
        write_msh_nodes(rows.nodes, f, all.facet_nodes(), sink);
        sink.text("\n");
      }
    });
  });
}

void write_elements(const NodeSource& nodes, const MshGroups& groups, SharedFile& file) {
  const Contents& all = nodes.contents();
  nodes.for_elements([&](const ElementRows& rows) {
    file.append([&](Sink& sink) {
      std::int64_t number = all.facets + rows.first;
      for (std::size_t e = 0; e < rows.quality.size(); ++e) {
        sink.number(++number);
        sink.text(code_of(all.element_nodes(), all.order));
        const MshGroup* region =
            all.with_regions ? group_of(groups.regions, rows.regions[e]) : nullptr;
        const std::int64_t group = (region ? *region : groups.inside).number;
        sink.number(group);
        sink.text(" ");
        sink.number(group);
        write_msh_nodes(rows.nodes, e, all.element_nodes(), sink);
        sink.text("\n");
      }
    });
  });
}

// Writes the names of the groups with positive numbers.
void write_names(const MshGroups& groups, bool with_inside, SharedFile& file) {
  std::vector<const MshGroup*> named;
  for (const MshGroup& group : groups.tagged)
    if (group.rows.tag > 0) named.push_back(&group);
  for (const MshGroup& region : groups.regions) named.push_back(&region);
  if (with_inside) named.push_back(&groups.inside);
  file.append_text(physical_names(named));
}

}  // namespace

void write_msh2(const NodeSource& nodes, SharedFile& file) {
  file.append_text("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n");
  const Contents& all = nodes.contents();
  const MshGroups groups = msh_groups(nodes);
  write_names(groups, all.with_elements && groups.inside.rows.count > 0, file);
  write_points(nodes, file);
  const std::int64_t elements = all.with_elements ? all.facets + all.elements : all.nodes;
  file.append_text("$Elements\n" + std::to_string(elements) + "\n");
  if (all.with_elements) {
    write_facets(nodes, file);
    write_elements(nodes, groups, file);
  } else {
    write_nodes_as_elements(nodes, file);
  }
  file.append_text("$EndElements\n");
  MshPeriodic(nodes, groups, file).append(2, file);
  append_node_data(nodes, file);
}

}  // namespace pnpbs::io
