// SPDX-License-Identifier: BSD-3-Clause
// Names and shapes of the arrays of a checkpoint. The rows of nodes have no fixed order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "io/hdf5.hpp"
#include "placement/placement_impl.hpp"

namespace pnpbs::io {

inline constexpr std::int64_t kCheckpointFormat = 4;
inline constexpr const char* kVtk = "/VTKHDF";
inline constexpr const char* kOwn = "/PNPBS";
inline constexpr const char* kSpacing = "/PNPBS/spacing";
// Returns the dataset of a table of the saved state. Empty tables have none.
inline std::string table_path(const char* name) { return std::string(kOwn) + "/" + name; }

// An array of the file and its position in an array of records. Each record has `given` numbers at
// byte `offset`; the rest of the row in the file is zero.
struct Column {
  hdf5::Array array;
  std::int64_t given;
  std::size_t offset;
};

// Returns the columns of n nodes.
template <int Dim>
std::vector<Column> node_columns(std::int64_t n) {
  using Saved = SavedNode<Dim>;
  using Packed = PackedNode<Dim>;
  using hdf5::Type;
  const std::size_t node = offsetof(Saved, node);
  const std::string own = std::string(kOwn) + "/", vtk = std::string(kVtk) + "/";
  std::vector<Column> columns{
      {{vtk + "Points", Type::real, n, 3}, Dim, node + offsetof(Packed, x)},
      {{vtk + "PointData/id", Type::int64, n}, 1, node + offsetof(Packed, id)},
      {{vtk + "PointData/tag", Type::int32, n}, 1, node + offsetof(Packed, tag)},
      {{vtk + "PointData/spacing", Type::real, n}, 1, node + offsetof(Packed, d)},
      {{own + "velocity", Type::real, n, Dim}, Dim, node + offsetof(Packed, v)},
      {{own + "reference", Type::real, n, Dim}, Dim, node + offsetof(Packed, reference)},
      {{own + "spacing_here", Type::real, n}, 1, offsetof(Saved, spacing)},
      {{own + "carrier", Type::int8, n}, 1, node + offsetof(Packed, carrier)},
      {{own + "boundary_node", Type::int32, n}, 1, node + offsetof(Packed, boundary_node)}};
  if (Dim == 3)
    columns.push_back(
        {{own + "reference_on", Type::int32, n}, 1, node + offsetof(Packed, reference_on)});
  return columns;
}

// Returns the arrays that VTK requires in addition, in which each node is a vertex cell.
inline std::vector<hdf5::Array> vertex_arrays(std::int64_t n) {
  const std::string vtk = std::string(kVtk) + "/";
  return {{vtk + "Types", hdf5::Type::uint8, n},
          {vtk + "Connectivity", hdf5::Type::int64, n},
          {vtk + "Offsets", hdf5::Type::int64, n + 1}};
}

// Sizes of the parts of a spacing that is given at the nodes of an earlier placement. The file has
// one part for each rank that wrote it. Rows of simplices and facets count the nodes of their part
// from 0.
struct PatchSizes {
  std::int64_t nodes = 0, simplices = 0, facets = 0;
};

template <int Dim>
std::vector<Column> patch_node_columns(std::int64_t n) {
  using Node = PatchNode<Dim>;
  const std::string in = std::string(kSpacing) + "/";
  return {{{in + "x", hdf5::Type::real, n, Dim}, Dim, offsetof(Node, x)},
          {{in + "id", hdf5::Type::int64, n}, 1, offsetof(Node, id)},
          {{in + "value", hdf5::Type::real, n}, 1, offsetof(Node, value)}};
}
template <int Dim>
Column simplex_column(std::int64_t n) {
  return {{std::string(kSpacing) + "/simplices", hdf5::Type::int32, n, Dim + 1}, Dim + 1, 0};
}
template <int Dim>
Column facet_column(std::int64_t n) {
  return {{std::string(kSpacing) + "/facets", hdf5::Type::int32, n, Dim}, Dim, 0};
}

// Returns a checksum that does not depend on the order of the parts.
template <int Dim>
std::uint64_t checksum_of(const Patch<Dim>& patch) {
  const auto mix = [](std::uint64_t h, std::int64_t value) {
    return mixed(h ^ static_cast<std::uint64_t>(value));
  };
  std::uint64_t sum = 0;
  for (const PatchNode<Dim>& node : patch.nodes) {
    std::uint64_t h = mix(1, node.id);
    for (const double coordinate : node.x) h = mixed_with(h, coordinate);
    sum += mixed_with(h, node.value);
  }
  const auto add_row = [&](std::uint64_t h, const auto& row) {
    for (const std::int32_t k : row) h = mix(h, patch.nodes[static_cast<std::size_t>(k)].id);
    sum += h;
  };
  for (const auto& row : patch.simplices) add_row(2, row);
  for (const auto& row : patch.border) add_row(3, row);
  return sum;
}

}  // namespace pnpbs::io
