// SPDX-License-Identifier: BSD-3-Clause
#include "io/grid_arrays.hpp"

#include <array>
#include <span>

namespace pnpbs::io {
namespace {

constexpr std::uint8_t vtk_vertex = 1;
constexpr std::uint8_t vtk_line = 3;
constexpr std::uint8_t vtk_triangle = 5;
constexpr std::uint8_t vtk_tetrahedron = 10;
constexpr std::uint8_t vtk_quadratic_edge = 21;
constexpr std::uint8_t vtk_quadratic_triangle = 22;
constexpr std::uint8_t vtk_quadratic_tetrahedron = 24;

template <typename Value>
void append_array(SharedFile& file, const std::vector<Value>& values) {
  file.append([&](Sink& sink) { sink.array(std::span<const Value>(values)); });
}

// Returns an array of a member of the node rows.
template <typename Value>
GridArray of_nodes(const std::string& name, const Contents& all,
                   std::vector<Value> NodeRows::*member) {
  return {name, number_type<Value>(), all.nodes, 1,
          [member](const NodeSource& nodes, SharedFile& file) {
            nodes.for_nodes([&](const NodeRows& rows) { append_array(file, rows.*member); });
          }};
}

// Returns an array of a member of the element rows, or the facet rows, with `values` values per
// row.
template <typename Value>
GridArray of_elements(const std::string& name, const Contents& all,
                      std::vector<Value> ElementRows::*member, int values) {
  return {name, number_type<Value>(), all.elements * values, 1,
          [member](const NodeSource& nodes, SharedFile& file) {
            nodes.for_elements([&](const ElementRows& rows) { append_array(file, rows.*member); });
          }};
}

template <typename Value>
GridArray of_facets(const std::string& name, const Contents& all,
                    std::vector<Value> FacetRows::*member, int values) {
  return {name, number_type<Value>(), all.facets * values, 1,
          [member](const NodeSource& nodes, SharedFile& file) {
            nodes.for_facets([&](const FacetRows& rows) { append_array(file, rows.*member); });
          }};
}

// Returns an array of values that follow from their index. Ranks write blocks in turn.
template <typename Value, typename At>
GridArray computed(const std::string& name, std::int64_t count, At at) {
  return {name, number_type<Value>(), count, 1, [count, at](const NodeSource&, SharedFile& file) {
            constexpr std::int64_t part = 1 << 16;
            for (std::int64_t begin = 0; begin < count; begin += part * file.ranks().size()) {
              const std::int64_t first = begin + part * file.ranks().rank();
              file.append([&](Sink& sink) {
                for (std::int64_t i = first; i < std::min(first + part, count); ++i) {
                  const Value value = at(i);
                  sink.bytes(&value, sizeof value);
                }
              });
            }
          }};
}

std::uint8_t vtk_type(const Contents& all) {
  switch (all.cell_nodes()) {
    case 1:
      return vtk_vertex;
    case 2:
      return vtk_line;
    case 3:
      return all.order == 2 ? vtk_quadratic_edge : vtk_triangle;
    case 4:
      return vtk_tetrahedron;
    case 6:
      return vtk_quadratic_triangle;
    default:
      return vtk_quadratic_tetrahedron;
  }
}

GridArray field_array(const Contents& all, std::size_t field) {
  const OutputField& of = (*all.fields)[field];
  return {of.name, NumberType::real, all.nodes, static_cast<int>(of.components),
          [field](const NodeSource& nodes, SharedFile& file) {
            nodes.for_field(field, [&](const FieldRows& rows) { append_array(file, rows.values); });
          }};
}

}  // namespace

// Returns the arrays of nodes. A grid of facets has the ids only, since the grid of the elements
// has the other arrays.
std::vector<GridArray> point_data(const Contents& all) {
  std::vector<GridArray> data{of_nodes("id", all, &NodeRows::ids)};
  if (!all.is_beside) {
    data.push_back(of_nodes("tag", all, &NodeRows::tags));
    data.push_back(of_nodes("spacing", all, &NodeRows::spacing));
    if (all.is_periodic) data.push_back(of_nodes("partner", all, &NodeRows::partners));
    for (std::size_t k = 0; k < all.field_count(); ++k) data.push_back(field_array(all, k));
  }
  if (all.is_piece) data.push_back(of_nodes("vtkGhostType", all, &NodeRows::ghosts));
  return data;
}

// Returns the arrays of cells. The tag of facets, or the region of elements, comes first, where
// DOLFINx expects it.
std::vector<GridArray> cell_data(const Contents& all) {
  if (all.cells == Cells::nodes) return {};
  if (all.cells == Cells::elements) {
    std::vector<GridArray> data;
    if (all.with_regions) data.push_back(of_elements("region", all, &ElementRows::regions, 1));
    data.push_back(of_elements("quality", all, &ElementRows::quality, 1));
    return data;
  }
  std::vector<GridArray> data{of_facets("tag", all, &FacetRows::tags, 1)};
  if (all.dimension == 3) data.push_back(of_facets("quality", all, &FacetRows::quality, 1));
  return data;
}

GridArray point_array(const Contents& all, int coordinates) {
  return {"Points", NumberType::real, all.nodes, coordinates,
          [given = static_cast<std::size_t>(all.coordinates),
           size = static_cast<std::size_t>(coordinates) * sizeof(double)](const NodeSource& nodes,
                                                                          SharedFile& file) {
            nodes.for_nodes([&](const NodeRows& rows) {
              file.append([&](Sink& sink) {
                for (std::size_t i = 0; i < rows.ids.size(); ++i) {
                  std::array<double, 3> point{};
                  std::copy_n(&rows.x[given * i], given, point.data());
                  sink.bytes(point.data(), size);
                }
              });
            });
          }};
}

GridArray number_array(const Contents& all) {
  return computed<std::int64_t>("number", all.nodes, [](std::int64_t i) { return i + 1; });
}

GridArray zero_array(const Contents& all, int columns) {
  GridArray zeros =
      computed<double>("zeros", all.nodes * columns, [](std::int64_t) { return 0.0; });
  zeros.rows = all.nodes;
  zeros.columns = columns;
  return zeros;
}

GridArray corner_array(const Contents& all) {
  const std::string name = "connectivity";
  const int corners = all.cell_nodes();
  if (all.cells == Cells::elements) return of_elements(name, all, &ElementRows::nodes, corners);
  if (all.cells == Cells::facets) return of_facets(name, all, &FacetRows::nodes, corners);
  return computed<std::int64_t>(name, all.nodes, [](std::int64_t i) { return i; });
}

GridArray cell_ends(const Contents& all) {
  return computed<std::int64_t>(
      "offsets", all.cell_count(),
      [corners = all.cell_nodes()](std::int64_t i) { return corners * (i + 1); });
}

GridArray cell_bounds(const Contents& all) {
  return computed<std::int64_t>(
      "offsets", all.cell_count() + 1,
      [corners = all.cell_nodes()](std::int64_t i) { return corners * i; });
}

GridArray cell_types(const Contents& all) {
  return computed<std::uint8_t>("types", all.cell_count(),
                                [type = vtk_type(all)](std::int64_t) { return type; });
}

}  // namespace pnpbs::io
