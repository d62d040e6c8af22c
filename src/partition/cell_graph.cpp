// SPDX-License-Identifier: BSD-3-Clause
#include "partition/cell_graph.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>

#include "tree/leaf_graph.hpp"

namespace pnpbs {

namespace {

// Length of the side (area of the face) that two touching cells share, 0 if they have none in
// common: the product of their common lengths but the shortest, which is that across the face.
template <int Dim>
double shared_face(const Box<Dim>& a, const Box<Dim>& b) {
  std::array<double, Dim> common;
  for (int k = 0; k < Dim; ++k)
    common[k] = std::max(0.0, std::min(a.high[k], b.high[k]) - std::max(a.low[k], b.low[k]));
  std::sort(common.begin(), common.end());
  return std::accumulate(common.begin() + 1, common.end(), 1.0, std::multiplies<>());
}

// Nodes along a unit of length where there are so many in a unit of area (volume).
template <int Dim>
double nodes_per_length(double density) {
  return Dim == 2 ? std::sqrt(density) : std::cbrt(density);
}

// A common face is the whole face of the smaller cell; anything less is rounding.
template <int Dim>
bool is_linked(double face, double smaller_side) {
  return Dim == 2 || face > 0.5 * std::pow(smaller_side, Dim - 1);
}

// What is known of a cell for the links to its neighbours.
template <int Dim>
struct CellExtent {
  Box<Dim> box;
  double side, density;  // work per area (volume)

  CellExtent(const PartitionCells<Dim>& cells, std::int32_t c)
      : box(cells.tree().cell_box(cells.tree().leaf_cell(c))),
        side(cells.tree().cell_side(cells.tree().leaf_cell(c))),
        density(static_cast<double>(cells.work(c)) / std::pow(side, Dim)) {}
};

}  // namespace

template <int Dim>
CellGraph cell_graph(const PartitionCells<Dim>& cells) {
  const BackgroundTree<Dim>& tree = cells.tree();
  LeafGraph<Dim> touching;
  touching.build(tree, std::vector<double>(static_cast<std::size_t>(cells.count()),
                                           std::ldexp(tree.side(), -40)));
  CellGraph result;
  std::vector<std::int32_t> vertex(static_cast<std::size_t>(cells.count()), -1);
  for (std::int32_t c = 0; c < cells.count(); ++c) {
    if (cells.work(c) <= 0) continue;
    vertex[static_cast<std::size_t>(c)] = static_cast<std::int32_t>(result.cell.size());
    result.cell.push_back(c);
  }
  // Weights must add up within the integers of METIS.
  const std::int64_t total =
      std::accumulate(cells.work().begin(), cells.work().end(), std::int64_t{0});
  const std::int64_t scale = std::max<std::int64_t>(1, total / 1000000000);
  for (std::int32_t c : result.cell) {
    const CellExtent<Dim> own(cells, c);
    touching.for_neighbours(c, [&](std::int32_t other) {
      if (other == c || vertex[static_cast<std::size_t>(other)] < 0) return;
      const CellExtent<Dim> near(cells, other);
      // Pairs across the common face: as many as bubbles lie in it.
      double pairs = shared_face<Dim>(own.box, near.box);
      if (!is_linked<Dim>(pairs, std::min(own.side, near.side))) return;
      const double per_length = nodes_per_length<Dim>(std::max(own.density, near.density));
      for (int k = 1; k < Dim; ++k) pairs *= per_length;
      result.neighbour.push_back(vertex[static_cast<std::size_t>(other)]);
      result.cut_weight.push_back(static_cast<std::int32_t>(1 + std::min(pairs, 1e6)));
    });
    result.offset.push_back(static_cast<std::int32_t>(result.neighbour.size()));
    result.weight.push_back(
        static_cast<std::int32_t>(std::max<std::int64_t>(1, cells.work(c) / scale)));
  }
  return result;
}

template CellGraph cell_graph(const PartitionCells<2>&);
template CellGraph cell_graph(const PartitionCells<3>&);

}  // namespace pnpbs
