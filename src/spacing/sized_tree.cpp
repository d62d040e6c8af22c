// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/sized_tree.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "base/error.hpp"
#include "base/lattice.hpp"
#include "base/point_text.hpp"
#include "method/constants.hpp"
#include "spacing/growth_sources.hpp"
#include "tree/box_tree.hpp"
#include "tree/cell_samples.hpp"

namespace pnpbs {

namespace {

// Number of boundary nodes above which a cell is split for any d. A node has about one edge in the
// plane and two triangles in space.
constexpr std::size_t kMaxBoundaryNodes = 48;
constexpr int kMaxDepthByNodes = 26;

bool are_surfaces_alone(const BoundaryMesh<2>&) { return false; }
bool are_surfaces_alone(const BoundaryMesh<3>& boundary) {
  return !boundary.facets.empty() && boundary.facets.front().stands_alone();
}

}  // namespace

template <int Dim>
class SizedTree<Dim>::Growth {
 public:
  struct CellState {
    double min = 0, max = 0;  // range of the samples of d
    double mean_density = 0;  // mean of 1/d^Dim
  };

  struct CellSamples {
    std::vector<Point<Dim>> at;
    std::vector<double> d;

    void add(const Point<Dim>& x, double value) {
      at.push_back(x);
      d.push_back(value);
    }
  };

  Growth(const BoundaryMesh<Dim>& boundary, const SpacingEvaluator<Dim>& spacing,
         const NodeLimit& limit, Refinement by, const std::vector<GrowthSource<Dim>>& known)
      : boundary_(boundary),
        spacing_(spacing),
        limit_(limit),
        by_(by),
        known_(known, kSeenFromSamples),
        surfaces_alone_(are_surfaces_alone(boundary)) {}

  const FacetCells<Dim>& facets() const { return *facets_; }
  const CellState& state(std::int32_t c) const { return cells_[static_cast<std::size_t>(c)]; }

  // d is evaluated at the boundary nodes only once.
  void start() {
    facets_.emplace(boundary_);
    std::vector<Point<Dim>> positions;
    for (const BoundaryNode<Dim>& node : boundary_.nodes) positions.push_back(node.position);
    boundary_spacing_.resize(positions.size());
    spacing_(static_cast<std::int64_t>(positions.size()), positions.data(),
             boundary_spacing_.data());
  }

  void add_root(const BackgroundTree<Dim>& tree) {
    facets_->add_root(tree);
    cells_.assign(1, CellState());
  }

  // Children inherit the state of their parent until they are sampled.
  void add_children(const BackgroundTree<Dim>& tree, std::int32_t parent) {
    facets_->add_children(tree, parent);
    cells_.insert(cells_.end(), BackgroundTree<Dim>::kChildren, CellState(state(parent)));
  }

  void sample(const BackgroundTree<Dim>& tree, std::int32_t first, std::int32_t last);
  void check_count(const BackgroundTree<Dim>& tree, std::int32_t first, std::int32_t last) const;
  bool wants_split(const BackgroundTree<Dim>& tree, std::int32_t c) const;

  // Returns the number of nodes that the samples of d require in the whole cell, including its part
  // outside of the domain.
  double nodes_in(const BackgroundTree<Dim>& tree, std::int32_t c) const {
    return Lattice<Dim>::kDensity * tree.cell_measure(c) * state(c).mean_density;
  }
  void count_leaf(const BackgroundTree<Dim>& tree, std::int32_t c) {
    if (tree.is_image(c)) return;
    nodes_in_leaves_ += surfaces_alone_    ? min_nodes_in(tree, c)
                        : wholly_inside(c) ? nodes_in(tree, c)
                                           : 0;
  }

 private:
  bool wholly_inside(std::int32_t c) const { return !facets_->outside(c) && !facets_->crossed(c); }
  double min_nodes_in(const BackgroundTree<Dim>& tree, std::int32_t c) const;
  void add_boundary_samples(const Box<Dim>& box, std::int32_t c, CellSamples& samples) const;
  Point<Dim> nearest_of_facets(std::int32_t c, const Point<Dim>& x) const;
  void take_samples(const std::vector<double>& values, CellState& cell) const;
  void expect_by_chart(const Box<Dim>& box, const CellSamples& samples, CellState& cell) const;
  void expect_known(const Box<Dim>& box, CellState& cell) const;
  bool holds_many_boundary_nodes(const BackgroundTree<Dim>& tree, std::int32_t c) const;

  void add_samples(const BackgroundTree<Dim>& tree, std::int32_t c, const Point<Dim>& fraction,
                   std::size_t number, std::vector<Point<Dim>>& points) const;

  const BoundaryMesh<Dim>& boundary_;
  const SpacingEvaluator<Dim>& spacing_;
  NodeLimit limit_;
  Refinement by_;
  GrowthSources<Dim> known_;
  bool surfaces_alone_;
  std::optional<FacetCells<Dim>> facets_;
  std::vector<double> boundary_spacing_;
  std::vector<CellState> cells_;
  double nodes_in_leaves_ = 0;  // estimate for the leaves so far
};

// Samples d in the cells first .. last-1, in one batch.
template <int Dim>
void SizedTree<Dim>::Growth::sample(const BackgroundTree<Dim>& tree, std::int32_t first,
                                    std::int32_t last) {
  static constexpr auto kSamples = cell_samples<Dim>();
  std::vector<Point<Dim>> points;
  std::vector<std::int32_t> owner;
  points.reserve(kSamples.size() * static_cast<std::size_t>(last - first));
  owner.reserve(points.capacity());
  for (std::int32_t c = first; c < last; ++c) {
    if (facets_->outside(c)) continue;
    for (std::size_t k = 0; k < kSamples.size(); ++k) add_samples(tree, c, kSamples[k], k, points);
    if (!samples_suffice<Dim>(points.size() - owner.size()))
      add_samples_of_boundary<Dim>(
          tree.cell_box(c),
          [&](const Point<Dim>& x) { return !surfaces_alone_ && facets_->inside(c, x); },
          [&](const Point<Dim>& x) { return nearest_of_facets(c, x); }, points);
    owner.resize(points.size(), c);
  }
  std::vector<double> d(points.size());
  spacing_(static_cast<std::int64_t>(points.size()), points.data(), d.data());
  std::size_t next = 0;
  CellSamples samples;
  for (std::int32_t c = first; c < last; ++c) {
    samples.at.clear();
    samples.d.clear();
    for (; next < owner.size() && owner[next] == c; ++next) samples.add(points[next], d[next]);
    const Box<Dim> box = tree.cell_box(c);
    add_boundary_samples(box, c, samples);
    take_samples(samples.d, cells_[static_cast<std::size_t>(c)]);
    expect_by_chart(box, samples, cells_[static_cast<std::size_t>(c)]);
    expect_known(box, cells_[static_cast<std::size_t>(c)]);
  }
}

// Lowers the smallest d of a cell to the bound by known values near it.
template <int Dim>
void SizedTree<Dim>::Growth::expect_known(const Box<Dim>& box, CellState& cell) const {
  for (const Point<Dim>& fraction : cell_samples<Dim>())
    cell.min = known_.limit(point_in<Dim>(box, fraction), cell.min);
}

// Lowers the smallest d of a cell to what is possible in the chart of a sphere. d is smallest where
// the stretch of the chart is, and the few samples of a large cell may miss that point. But they
// determine d along the sphere.
template <int Dim>
void SizedTree<Dim>::Growth::expect_by_chart(const Box<Dim>& box, const CellSamples& samples,
                                             CellState& cell) const {
  const Embedding<Dim>& embedding = boundary_.embedding;
  if (samples.d.empty() || !embedding.varies_much_in(box)) return;
  double along = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < samples.d.size(); ++k)
    along = std::min(along, embedding.measured_length(samples.at[k], samples.d[k]));
  cell.min = std::min(cell.min, along * embedding.min_stretch_in(box));
}

// Adds the point at which d is evaluated for a sample position: the position itself if it is inside
// the domain. For surfaces without a volume it is the nearest point of a facet; the facets of the
// cell take turns.
template <int Dim>
void SizedTree<Dim>::Growth::add_samples(const BackgroundTree<Dim>& tree, std::int32_t c,
                                         const Point<Dim>& fraction, std::size_t number,
                                         std::vector<Point<Dim>>& points) const {
  const Point<Dim> x = point_in<Dim>(tree.cell_box(c), fraction);
  if (!surfaces_alone_) {
    if (facets_->inside(c, x)) points.push_back(x);
    return;
  }
  const auto facets = facets_->facets(c);
  const auto f = static_cast<std::size_t>(facets[number % facets.size()]);
  const Point<Dim> on_facet = nearest_on(facets_->corners()[f], x);
  if (in_closed_box(tree.cell_box(c), on_facet)) points.push_back(on_facet);
}

template <int Dim>
Point<Dim> SizedTree<Dim>::Growth::nearest_of_facets(std::int32_t c, const Point<Dim>& x) const {
  Point<Dim> nearest{};
  double least = std::numeric_limits<double>::infinity();
  for (const std::int32_t f : facets_->facets(c)) {
    const Point<Dim> y = nearest_on(facets_->corners()[static_cast<std::size_t>(f)], x);
    if (distance<Dim>(x, y) >= least) continue;
    least = distance<Dim>(x, y);
    nearest = y;
  }
  return nearest;
}

template <int Dim>
void SizedTree<Dim>::Growth::add_boundary_samples(const Box<Dim>& box, std::int32_t c,
                                                  CellSamples& samples) const {
  for (const std::int32_t f : facets_->facets(c))
    for (const std::int32_t node : boundary_.facets[static_cast<std::size_t>(f)].corners()) {
      const Point<Dim>& x = boundary_.nodes[static_cast<std::size_t>(node)].position;
      if (in_closed_box(box, x)) samples.add(x, boundary_spacing_[static_cast<std::size_t>(node)]);
    }
}

template <int Dim>
void SizedTree<Dim>::Growth::take_samples(const std::vector<double>& values,
                                          CellState& cell) const {
  if (values.empty()) return;  // in the plane: the state of the parent is kept
  cell.min = values[0];
  cell.max = values[0];
  double sum = 0;
  for (const double d : values) {
    cell.min = std::min(cell.min, d);
    cell.max = std::max(cell.max, d);
    sum += 1 / power<Dim>(d);
  }
  cell.mean_density = sum / static_cast<double>(values.size());
}

template <int Dim>
bool SizedTree<Dim>::Growth::wants_split(const BackgroundTree<Dim>& tree, std::int32_t c) const {
  if (tree.cell(c).depth < tree.depth_of_periods()) return true;
  if (facets_->outside(c)) return false;
  const CellState& cell = state(c);
  const double side = tree.cell_side(c);
  if (side > method::kLeafSpacings * cell.min) return true;
  return by_ == Refinement::spacing_and_boundary && tree.cell(c).depth < kMaxDepthByNodes &&
         holds_many_boundary_nodes(tree, c);
}

// Returns whether the cell has too many facets. In space, hundreds of facets may share a corner,
// and splitting would leave one cell with all of them. If the cell has only one node, the facets of
// this node do not count.
template <int Dim>
bool SizedTree<Dim>::Growth::holds_many_boundary_nodes(const BackgroundTree<Dim>& tree,
                                                       std::int32_t c) const {
  const auto facets = facets_->facets(c);
  if (facets.size() <= kMaxBoundaryNodes * (Dim - 1)) return false;
  if constexpr (Dim == 2) return true;
  const Box<Dim> box = tree.cell_box(c);
  std::int32_t only = -1;
  std::size_t having_it = 0;
  for (const std::int32_t f : facets) {
    bool has = false;
    for (const std::int32_t node : boundary_.facets[static_cast<std::size_t>(f)].corners()) {
      if (!in_closed_box(box, boundary_.nodes[static_cast<std::size_t>(node)].position)) continue;
      if (only >= 0 && node != only) return true;
      only = node;
      has = true;
    }
    having_it += has;
  }
  return facets.size() - having_it > kMaxBoundaryNodes * (Dim - 1);
}

// Returns the number of nodes that the largest d of the cell requires. On average, a surface has
// two thirds of the squared side as its area in a cell that it crosses.
template <int Dim>
double SizedTree<Dim>::Growth::min_nodes_in(const BackgroundTree<Dim>& tree, std::int32_t c) const {
  constexpr double kPart = 2.0 / 3;
  const double sides = tree.cell_side(c) / state(c).max;
  if (surfaces_alone_) return kPart * Lattice<2>::kDensity * sides * sides;
  return wholly_inside(c) ? Lattice<Dim>::kDensity * power<Dim>(sides) : 0;
}

// Stops early: this lower bound, from the largest d of each cell, already exceeds the allowed
// number of nodes.
template <int Dim>
void SizedTree<Dim>::Growth::check_count(const BackgroundTree<Dim>& tree, std::int32_t first,
                                         std::int32_t last) const {
  double nodes = nodes_in_leaves_;
  std::int32_t finest = first;
  for (std::int32_t c = first; c < last; ++c) {
    const double in_cell = facets_->outside(c) || tree.is_image(c) ? 0 : min_nodes_in(tree, c);
    if (in_cell == 0) continue;
    nodes += in_cell;
    if (facets_->outside(finest) || state(c).min < state(finest).min) finest = c;
  }
  if (nodes <= static_cast<double>(limit_.max_nodes)) return limit_.require_memory_for(nodes);
  limit_.report_too_many(nodes, state(finest).min, point_text(tree.cell_centre(finest)));
}

template <int Dim>
void SizedTree<Dim>::build(const TreeBounds<Dim>& bounds, const BoundaryMesh<Dim>& boundary,
                           const SpacingEvaluator<Dim>& spacing, const NodeLimit& limit,
                           Refinement by, const std::vector<GrowthSource<Dim>>& known) {
  Growth growth(boundary, spacing, limit, by, known);
  grow(*serial_communicator(), bounds, growth,
       [](const BackgroundTree<Dim>&, std::int32_t, double) { return true; });
}

template <int Dim>
void SizedTree<Dim>::build_part(const Communicator& comm, const TreeBounds<Dim>& bounds,
                                const BoundaryMesh<Dim>& boundary,
                                const SpacingEvaluator<Dim>& spacing, const NodeLimit& limit,
                                const MaySplit& may_split, Refinement by,
                                const std::vector<GrowthSource<Dim>>& known) {
  Growth growth(boundary, spacing, limit, by, known);
  grow(comm, bounds, growth, may_split);
}

template <int Dim>
void SizedTree<Dim>::grow(const Communicator& comm, const TreeBounds<Dim>& bounds, Growth& growth,
                          const MaySplit& may_split) {
  collective_try(comm, [&] { growth.start(); });
  std::int32_t parents = 0;  // first cell of the previous depth
  const auto add_children_before = [&](const BackgroundTree<Dim>& tree, std::int32_t last) {
    for (std::int32_t parent = parents; parent < last; ++parent)
      if (tree.cell(parent).first_child >= 0) growth.add_children(tree, parent);
    parents = last;
  };
  const auto split_depth = [&](const BackgroundTree<Dim>& tree, std::int32_t first,
                               std::int32_t last, std::vector<char>& split) {
    if (first == 0) growth.add_root(tree);
    add_children_before(tree, first);
    collective_try(comm, [&] {
      growth.sample(tree, first, last);
      growth.check_count(tree, first, last);
    });
    for (std::int32_t c = first; c < last; ++c) {
      const double nodes = growth.nodes_in(tree, c);
      split[static_cast<std::size_t>(c - first)] =
          growth.wants_split(tree, c) &&
          (tree.cell(c).depth < tree.depth_of_periods() || may_split(tree, c, nodes));
      if (!split[static_cast<std::size_t>(c - first)]) growth.count_leaf(tree, c);
    }
  };
  BackgroundTree<Dim> tree;
  tree.build(bounds, split_depth, [&](bool more) { return comm.allreduce_max(more) > 0; });
  // split_depth() is not called for the greatest depth.
  add_children_before(tree, tree.cell_count());
  collective_try(comm, [&] { keep_leaves(std::move(tree), growth); });
}

template <int Dim>
void SizedTree<Dim>::keep_leaves(BackgroundTree<Dim> tree, const Growth& growth) {
  leaf_spacing_.clear();
  leaf_min_.clear();
  leaf_max_.clear();
  for (std::int32_t leaf = 0; leaf < tree.leaf_count(); ++leaf) {
    const auto& cell = growth.state(tree.leaf_cell(leaf));
    const double density = cell.mean_density;
    leaf_spacing_.push_back(density > 0 ? 1 / root<Dim>(density) : 0);
    leaf_min_.push_back(cell.min);
    leaf_max_.push_back(cell.max);
  }
  static_cast<FacetIndex<Dim>&>(*this) = FacetIndex<Dim>(std::move(tree), growth.facets());
}

template class SizedTree<2>;
template class SizedTree<3>;

}  // namespace pnpbs
