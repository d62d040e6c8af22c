// SPDX-License-Identifier: BSD-3-Clause
#include "initial/initial_fill.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <type_traits>

#include "base/types.hpp"
#include "initial/volume/cubic_lattice.hpp"
#include "method/constants.hpp"

namespace pnpbs {
namespace {

// The hexagonal lattice of the plane: rows of nodes d apart, with every second row shifted by d/2.
class HexagonalRows {
 public:
  // The origin is the low corner of the box. If one lattice fills the whole domain, it is stretched
  // slightly so that rows end at the sides of the box, or continue across the sides of a periodic
  // cell.
  HexagonalRows(double d, const Box<2>& bounds, const PeriodicCell<2>& cell, bool whole)
      : low_(bounds.low), step_(d), row_(d * std::sqrt(0.75)) {
    if (!whole) return;
    const double rows = cell.periodic(1) ? 2 : 1;  // every second row is shifted
    step_ = fitted(step_, bounds.high[0] - bounds.low[0]);
    row_ = fitted(rows * row_, bounds.high[1] - bounds.low[1]) / rows;
  }

  // Calls visit(x) for all nodes in the box and for some beside it.
  template <class Visit>
  void for_nodes(const Box<2>& box, const Visit& visit) const {
    const auto first_row = static_cast<std::int64_t>(std::ceil((box.low[1] - low_[1]) / row_)) - 1;
    for (std::int64_t row = first_row;; ++row) {
      const double y = low_[1] + row_ * static_cast<double>(row);
      if (y >= box.high[1] + 0.5 * row_) break;
      const double shift = low_[0] + (row % 2 != 0 ? 0.5 * step_ : 0.0);
      auto column = static_cast<std::int64_t>(std::ceil((box.low[0] - shift) / step_)) - 1;
      for (;; ++column) {
        const Point<2> x{shift + step_ * static_cast<double>(column), y};
        if (x[0] >= box.high[0] + 0.5 * step_) break;
        visit(x);
      }
    }
  }

 private:
  static double fitted(double step, double extent) {
    const double steps = std::round(extent / step);
    return steps >= 8 ? extent / steps : step;
  }

  Point<2> low_;
  double step_;  // distance between nodes of a row
  double row_;   // distance between rows
};

template <int Dim>
using FillLattice = std::conditional_t<Dim == 2, HexagonalRows, CubicLattice>;

template <int Dim>
bool nearly_constant(const SpacingSummary<Dim>& cell) {
  return cell.max <= method::kPatchVariation * cell.min;
}

template <int Dim>
SpacingSummary<Dim> summary_of_leaf(const SizedTree<Dim>& map, std::int32_t c) {
  const std::int32_t leaf = map.tree().cell(c).leaf;
  SpacingSummary<Dim> own;
  if (map.leaf_outside(leaf) || !map.tree().in_periodic_cell(leaf)) return own;
  own.measure = map.tree().cell_measure(c);
  own.min = map.leaf_min_spacing(leaf);
  own.max = map.leaf_max_spacing(leaf);
  own.nodes = own.measure / power<Dim>(map.leaf_spacing(leaf));
  return own;
}

template <int Dim>
class Fill {
 public:
  Fill(const SizedTree<Dim>& map, const Box<Dim>& bounds,
       const std::function<bool(std::int32_t)>& wanted,
       const std::vector<LeafSummary<Dim>>& unrefined, bool stretched)
      : map_(map),
        bounds_(bounds),
        wanted_(wanted),
        stretched_(stretched),
        cells_(spacing_summaries(map, unrefined)) {}

  std::vector<Point<Dim>> make() {
    descend(0, nullptr);
    return std::move(points_);
  }

 private:
  // Visits the children in Morton order. `patch` is the lattice of the enclosing patch, or null.
  void descend(std::int32_t c, const FillLattice<Dim>* patch) {
    const BackgroundTree<Dim>& tree = map_.tree();
    const SpacingSummary<Dim>& own = cells_[static_cast<std::size_t>(c)];
    if (own.measure == 0) return;
    const bool leaf = tree.cell(c).first_child < 0;
    std::optional<FillLattice<Dim>> lattice;
    if (!patch && nearly_constant(own)) patch = &begin_patch(lattice, own.spacing(), c == 0);
    if (leaf) {
      const std::int32_t here = tree.cell(c).leaf;
      if (patch && wanted_(here)) fill_leaf(here, *patch);  // GradedFill fills the other leaves
    } else {
      for (int k = 0; k < BackgroundTree<Dim>::kChildren; ++k)
        descend(tree.cell(c).first_child + k, patch);
    }
  }

  const FillLattice<Dim>& begin_patch(std::optional<FillLattice<Dim>>& lattice, double d,
                                      bool whole) const {
    const PeriodicCell<Dim>& cell = map_.tree().periodic_cell();
    const Box<Dim>& box = cell.any() ? cell.box() : bounds_;
    if constexpr (Dim == 2) return lattice.emplace(d, box, cell, whole);
    if constexpr (Dim == 3) return lattice.emplace(d, box, whole, stretched_, cell);
  }

  // Only fine_box_holds() decides to which leaf a node on a common border belongs. It uses the same
  // arithmetic as leaf_at(), which determines ids and ranks of nodes; the floating-point box may
  // differ in the last digits.
  void fill_leaf(std::int32_t leaf, const FillLattice<Dim>& lattice) {
    const BackgroundTree<Dim>& tree = map_.tree();
    const Box<Dim> fine_box = tree.fine_box(leaf);
    const double clearance = method::kFillClearance * map_.leaf_spacing(leaf);
    const bool near_facets = facets_near(leaf, clearance);
    lattice.for_nodes(tree.cell_box(tree.leaf_cell(leaf)), [&](const Point<Dim>& x) {
      if (!tree.fine_box_holds(fine_box, x)) return;
      if (!map_.inside_in_leaf(leaf, x)) return;
      if (near_facets && map_.clearance(x, clearance) < clearance) return;
      points_.push_back(x);
    });
  }

  // Returns true if a facet may come within `reach` of a point of the leaf.
  bool facets_near(std::int32_t leaf, double reach) const {
    constexpr double kRoom = 1 + 1e-6;
    const std::int32_t c = map_.tree().leaf_cell(leaf);
    bool any = false;
    map_.for_facets_near(map_.tree().cell_centre(c),
                         kRoom * (0.5 * map_.tree().cell_side(c) + reach),
                         [&](std::int32_t) { any = true; });
    return any;
  }

  const SizedTree<Dim>& map_;
  const Box<Dim>& bounds_;
  const std::function<bool(std::int32_t)>& wanted_;
  bool stretched_;
  std::vector<SpacingSummary<Dim>> cells_;
  std::vector<Point<Dim>> points_;
};

}  // namespace

template <int Dim>
void SpacingSummary<Dim>::add(const SpacingSummary& part) {
  min = std::min(min, part.min);
  max = std::max(max, part.max);
  measure += part.measure;
  nodes += part.nodes;
}

template <int Dim>
std::vector<SpacingSummary<Dim>> spacing_summaries(const SizedTree<Dim>& map,
                                                   const std::vector<LeafSummary<Dim>>& unrefined) {
  const BackgroundTree<Dim>& tree = map.tree();
  std::vector<SpacingSummary<Dim>> cells(static_cast<std::size_t>(tree.cell_count()));
  const auto of = [&](std::int32_t c) -> SpacingSummary<Dim>& {
    return cells[static_cast<std::size_t>(c)];
  };
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf)
    of(tree.leaf_cell(leaf)) = summary_of_leaf(map, tree.leaf_cell(leaf));
  for (const LeafSummary<Dim>& known : unrefined) of(tree.leaf_cell(known.leaf)) = known.spacing;
  for (std::int32_t c = tree.cell_count() - 1; c >= 0; --c)
    if (tree.cell(c).first_child >= 0)
      for (int k = 0; k < BackgroundTree<Dim>::kChildren; ++k)
        of(c).add(of(tree.cell(c).first_child + k));
  return cells;
}

template <int Dim>
std::vector<Point<Dim>> lattice_fill(const SizedTree<Dim>& map, const Box<Dim>& bounds,
                                     const std::function<bool(std::int32_t)>& wanted,
                                     const std::vector<LeafSummary<Dim>>& unrefined,
                                     bool stretched) {
  return Fill<Dim>(map, bounds, wanted, unrefined, stretched).make();
}

template struct SpacingSummary<2>;
template struct SpacingSummary<3>;
template std::vector<SpacingSummary<2>> spacing_summaries(const SizedTree<2>&,
                                                          const std::vector<LeafSummary<2>>&);
template std::vector<SpacingSummary<3>> spacing_summaries(const SizedTree<3>&,
                                                          const std::vector<LeafSummary<3>>&);
template std::vector<Point<2>> lattice_fill<2>(const SizedTree<2>&, const Box<2>&,
                                               const std::function<bool(std::int32_t)>&,
                                               const std::vector<LeafSummary<2>>&, bool);
template std::vector<Point<3>> lattice_fill<3>(const SizedTree<3>&, const Box<3>&,
                                               const std::function<bool(std::int32_t)>&,
                                               const std::vector<LeafSummary<3>>&, bool);

}  // namespace pnpbs
