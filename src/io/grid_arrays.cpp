// SPDX-License-Identifier: BSD-3-Clause
#include "io/grid_arrays.hpp"

#include <array>
#include <span>

namespace pnpbs::io {
namespace {

constexpr std::uint8_t vtk_vertex = 1;
constexpr std::uint8_t vtk_triangle = 5;
constexpr std::uint8_t vtk_tetrahedron = 10;

template <typename Value>
void append_array(SharedFile& file, const std::vector<Value>& values) {
  file.append([&](Sink& sink) { sink.array(std::span<const Value>(values)); });
}

// An array of the nodes, as `member` of their rows has it.
template <typename Value>
GridArray of_nodes(const std::string& name, const Contents& all,
                   std::vector<Value> NodeRows::*member) {
  return {name, number_type<Value>(), all.nodes, 1,
          [member](const NodeSource& nodes, SharedFile& file) {
            nodes.for_nodes([&](const NodeRows& rows) { append_array(file, rows.*member); });
          }};
}

// The same of the elements, so many values each.
template <typename Value>
GridArray of_elements(const std::string& name, const Contents& all,
                      std::vector<Value> ElementRows::*member, int values) {
  return {name, number_type<Value>(), all.elements * values, 1,
          [member](const NodeSource& nodes, SharedFile& file) {
            nodes.for_elements([&](const ElementRows& rows) { append_array(file, rows.*member); });
          }};
}

// An array of the elements, and behind it, in space, that of the boundary's facets.
template <typename Value>
GridArray with_facets(const GridArray& elements, const Contents& all,
                      std::vector<Value> FacetRows::*member, int values) {
  if (all.dimension == 2) return elements;
  GridArray both = elements;
  both.rows += all.facets * values;
  both.write = [first = elements.write, member](const NodeSource& nodes, SharedFile& file) {
    first(nodes, file);
    nodes.for_facets([&](const FacetRows& rows) { append_array(file, rows.*member); });
  };
  return both;
}

// Values that follow from their number alone; the ranks take turns.
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

// The corners of so many cells.
auto corners_before(const Contents& all) {
  return
      [corners = all.with_elements ? all.element_corners() : 1, facet_corners = all.facet_corners(),
       elements = all.with_elements ? all.elements : all.nodes](std::int64_t cells) {
        const std::int64_t before = std::min(cells, elements);
        return corners * before + facet_corners * (cells - before);
      };
}

}  // namespace

std::int64_t cells_of(const Contents& all) {
  if (!all.with_elements) return all.nodes;
  return all.elements + (all.dimension == 3 ? all.facets : 0);
}

std::vector<GridArray> point_data(const Contents& all) {
  std::vector<GridArray> data{of_nodes("id", all, &NodeRows::ids),
                              of_nodes("tag", all, &NodeRows::tags),
                              of_nodes("spacing", all, &NodeRows::spacing)};
  if (all.is_piece) data.push_back(of_nodes("vtkGhostType", all, &NodeRows::ghosts));
  return data;
}

// In space, elements have the tag 0.
std::vector<GridArray> cell_data(const Contents& all) {
  std::vector<GridArray> data{with_facets(of_elements("quality", all, &ElementRows::quality, 1),
                                          all, &FacetRows::quality, 1)};
  if (all.dimension == 3)
    data.push_back(with_facets(
        computed<std::int32_t>("tag", all.elements, [](std::int64_t) { return std::int32_t{0}; }),
        all, &FacetRows::tags, 1));
  return data;
}

GridArray point_array(const Contents& all) {
  return {"Points", NumberType::real, all.nodes, 3,
          [dimension = static_cast<std::size_t>(all.dimension)](const NodeSource& nodes,
                                                                SharedFile& file) {
            nodes.for_nodes([&](const NodeRows& rows) {
              file.append([&](Sink& sink) {
                for (std::size_t i = 0; i < rows.ids.size(); ++i) {
                  std::array<double, 3> point{};
                  std::copy_n(&rows.x[dimension * i], dimension, point.data());
                  sink.bytes(point.data(), sizeof point);
                }
              });
            });
          }};
}

GridArray corner_array(const Contents& all) {
  if (!all.with_elements)
    return computed<std::int64_t>("connectivity", all.nodes, [](std::int64_t i) { return i; });
  return with_facets(of_elements("connectivity", all, &ElementRows::corners, all.element_corners()),
                     all, &FacetRows::corners, all.facet_corners());
}

GridArray cell_ends(const Contents& all) {
  return computed<std::int64_t>(
      "offsets", cells_of(all),
      [before = corners_before(all)](std::int64_t i) { return before(i + 1); });
}

GridArray cell_bounds(const Contents& all) {
  return computed<std::int64_t>("offsets", cells_of(all) + 1, corners_before(all));
}

GridArray cell_types(const Contents& all) {
  const std::uint8_t element = !all.with_elements   ? vtk_vertex
                               : all.dimension == 2 ? vtk_triangle
                                                    : vtk_tetrahedron;
  return computed<std::uint8_t>(
      "types", cells_of(all),
      [element, elements = all.with_elements ? all.elements : all.nodes](std::int64_t i) {
        return i < elements ? element : vtk_triangle;
      });
}

}  // namespace pnpbs::io
