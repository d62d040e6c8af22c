// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/leaf_points.hpp"

#include <array>
#include <cmath>
#include <numeric>

#include "base/lattice.hpp"
#include "method/constants.hpp"
#include "spacing/sized_tree.hpp"
#include "tree/cell_samples.hpp"

namespace pnpbs {

template <int Dim>
LeafPoints<Dim>::LeafPoints(const LineOfSight<Dim>& ways, std::vector<Point<Dim>> places)
    : ways_(ways), places_(std::move(places)) {
  root_.build(ways.bounds(),
              [](const BackgroundTree<Dim>&, std::int32_t, std::int32_t, std::vector<char>&) {});
  sort_nodes();
}

template <int Dim>
const Point<Dim>& LeafPoints<Dim>::node(std::int64_t n) const {
  const std::int64_t of_boundary = ways_.node_count();
  return n < of_boundary ? ways_.node(n) : places_[static_cast<std::size_t>(n - of_boundary)];
}

template <int Dim>
void LeafPoints<Dim>::sort_nodes() {
  fine_of_nodes_.clear();
  std::vector<FineIndex<Dim>> fine;
  for (std::int64_t n = 0; n < ways_.node_count() + std::ssize(places_); ++n)
    fine.push_back(root_.fine_index(node(n)));
  nodes_.resize(fine.size());
  std::iota(nodes_.begin(), nodes_.end(), 0);
  const auto at = [](std::int64_t n) { return static_cast<std::size_t>(n); };
  std::stable_sort(nodes_.begin(), nodes_.end(), [&](std::int64_t a, std::int64_t b) {
    return morton_before(fine[at(a)], fine[at(b)]);
  });
  for (const std::int64_t n : nodes_) fine_of_nodes_.push_back(fine[at(n)]);
}

template <int Dim>
double LeafPoints<Dim>::side_of(const LeafCell<Dim>& cell) const {
  return std::ldexp(root_.side(), -cell.depth);
}

template <int Dim>
Box<Dim> LeafPoints<Dim>::box_of(const LeafCell<Dim>& cell) const {
  const double side = side_of(cell);
  Box<Dim> box;
  for (int k = 0; k < Dim; ++k) {
    box.low[k] = root_.origin()[k] + side * cell.index[k];
    box.high[k] = root_.origin()[k] + side * (cell.index[k] + 1.0);
  }
  return box;
}

template <int Dim>
void LeafPoints<Dim>::add_points(const GrowthLeaf<Dim>& leaf,
                                 std::vector<Point<Dim>>& points) const {
  for (const Point<Dim>& sample : cell_samples<Dim>()) {
    const Point<Dim> x = point_in<Dim>(box_of(leaf.cell), sample);
    if (leaf.side == GrowthLeaf<Dim>::Side::inside || ways_.inside(x)) points.push_back(x);
  }
  if (leaf.has_nodes) for_nodes_in(leaf.cell, [&](std::int64_t n) { points.push_back(node(n)); });
}

template <int Dim>
std::size_t LeafPoints<Dim>::samples_inside(const LeafCell<Dim>& cell) const {
  static constexpr auto kSamples = cell_samples<Dim>();
  return static_cast<std::size_t>(std::ranges::count_if(kSamples, [&](const Point<Dim>& sample) {
    return ways_.inside(point_in<Dim>(box_of(cell), sample));
  }));
}

template <int Dim>
void LeafPoints<Dim>::add_places(const std::vector<Point<Dim>>& places) {
  places_.insert(places_.end(), places.begin(), places.end());
  sort_nodes();
}

// The points come from the additive recurrence by powers of the root of r^4 = r + 1 (M. Roberts,
// "The unreasonable effectiveness of quasirandom sequences", 2018). No two of them lie in a plane
// parallel to the faces, as layers of fine d may.
template <int Dim>
void LeafPoints<Dim>::add_probes(const GrowthLeaf<Dim>& leaf,
                                 std::vector<Point<Dim>>& points) const {
  constexpr std::array<double, 3> kSteps = {0.8191725133961645, 0.6710436067037893,
                                            0.5497004779019703};
  const double in_row = std::min(std::ceil(side_of(leaf.cell) / leaf.min), method::kLeafSpacings);
  for (int k = 1; k <= static_cast<int>(power<Dim>(in_row)); ++k) {
    Point<Dim> fraction;
    for (std::size_t axis = 0; axis < Dim; ++axis)
      fraction[axis] = k * kSteps[axis] - std::floor(k * kSteps[axis]);
    const Point<Dim> x = point_in<Dim>(box_of(leaf.cell), fraction);
    if (leaf.side == GrowthLeaf<Dim>::Side::inside || ways_.inside(x)) points.push_back(x);
  }
}

template <int Dim>
void LeafPoints<Dim>::add_points_in_sliver(const GrowthLeaf<Dim>& leaf,
                                           std::vector<Point<Dim>>& points) const {
  const double reach = Dim * side_of(leaf.cell);
  add_points(leaf, points);
  add_samples_of_boundary<Dim>(
      box_of(leaf.cell), [this](const Point<Dim>& x) { return ways_.inside(x); },
      [&](const Point<Dim>& x) { return ways_.nearest_of_boundary(x, reach); }, points);
}

template <int Dim>
void LeafPoints<Dim>::add_points_beside(const GrowthLeaf<Dim>& leaf,
                                        std::vector<Point<Dim>>& points) const {
  const Box<Dim> box = box_of(leaf.cell);
  for (int k = 0; k < Dim; ++k)
    for (const double side : {-1.0, 1.0}) {
      Point<Dim> x = middle_of<Dim>(box);
      x[k] += side * side_of(leaf.cell);
      if (in_closed_box(ways_.bounds(), x) && ways_.inside(x)) points.push_back(x);
    }
}

template class LeafPoints<2>;
template class LeafPoints<3>;

}  // namespace pnpbs
