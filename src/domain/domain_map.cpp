// SPDX-License-Identifier: BSD-3-Clause
#include "domain/domain_map.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/lattice.hpp"
#include "domain/segments.hpp"
#include "predicates/plane.hpp"

namespace pnpbs {

namespace {

// A cell with more boundary nodes than this is split whatever d is.
constexpr int kMostBoundaryNodes = 48;
// Where d is sampled in a cell, in units of its side.
constexpr std::array<Point<2>, 5> kSamples{
    {{0.5, 0.5}, {0.25, 0.25}, {0.75, 0.25}, {0.25, 0.75}, {0.75, 0.75}}};

// Does the way from p to q cross edge ab? A vertex exactly on the line pq counts as lying to its
// left, so a way through a vertex crosses none or both or one of its edges as it should.
bool crosses(const Point<2>& p, const Point<2>& q, const Point<2>& a, const Point<2>& b) {
  if ((orientation(p, q, a) >= 0) == (orientation(p, q, b) >= 0)) return false;
  return orientation(a, b, p) * orientation(a, b, q) < 0;
}

bool on_edge(const Point<2>& a, const Point<2>& b, const Point<2>& x) {
  for (int k = 0; k < 2; ++k)
    if (x[k] < std::min(a[k], b[k]) || x[k] > std::max(a[k], b[k])) return false;
  return orientation(a, b, x) == 0;
}

Point<2> point_in(const Box<2>& box, const Point<2>& fraction) {
  return {box.low[0] + fraction[0] * (box.high[0] - box.low[0]),
          box.low[1] + fraction[1] * (box.high[1] - box.low[1])};
}

bool in_box(const Box<2>& box, const Point<2>& x) {
  return x[0] >= box.low[0] && x[0] <= box.high[0] && x[1] >= box.low[1] && x[1] <= box.high[1];
}

int depth_at(const BackgroundTree<2>& tree, const Point<2>& x) {
  return tree.cell(tree.leaf_cell(tree.leaf_at(x))).depth;
}

}  // namespace

struct DomainMap::Growth {
  struct CellState {
    std::int32_t first_edge = 0, last_edge = 0;  // in edges
    Point<2> reference{};
    bool reference_inside = false;
    bool outside = false;
    double least = 0, largest = 0;  // of the samples of d
    double mean_density = 0;        // mean of 1/d^2
  };

  const DomainMap& map;
  const Boundary& boundary;
  const SpacingEvaluator& spacing;
  NodeLimit limit;
  double steepest;
  const BackgroundTree<2>* coarsest;
  std::vector<double> boundary_spacing;
  std::vector<CellState> cells;
  std::vector<std::int32_t> edges;  // of cell after cell
  double nodes_in_leaves = 0;       // estimate for the leaves found so far

  const Point<2>& end_of(std::int32_t node) const {
    return boundary.nodes[static_cast<std::size_t>(node)].position;
  }

  bool inside_from(const CellState& cell, const Point<2>& x, bool* touching = nullptr) const {
    bool inside = cell.reference_inside;
    for (std::int32_t k = cell.first_edge; k < cell.last_edge; ++k) {
      const BoundaryEdge& e = boundary.edges[index(edges[index(k)])];
      if (touching && on_edge(end_of(e.begin), end_of(e.end), x)) *touching = true;
      if (e.left_inside == e.right_inside) continue;
      if (crosses(cell.reference, x, end_of(e.begin), end_of(e.end))) inside = !inside;
    }
    return inside;
  }

  void sample_boundary_nodes() {
    std::vector<Point<2>> positions;
    for (const BoundaryNode& node : boundary.nodes) positions.push_back(node.position);
    boundary_spacing.resize(positions.size());
    spacing(static_cast<std::int64_t>(positions.size()), positions.data(), boundary_spacing.data());
  }

  void start_root(const BackgroundTree<2>& tree) {
    CellState root;
    root.reference = tree.origin();  // strictly outside the domain's bounding box
    root.last_edge = static_cast<std::int32_t>(boundary.edges.size());
    for (std::int32_t e = 0; e < root.last_edge; ++e) edges.push_back(e);
    cells.push_back(root);
  }

  // A child inherits the edges of its parent that meet it; which side its reference point lies on
  // follows from the parent's by the edges between the two.
  void start_child(const BackgroundTree<2>& tree, std::int32_t c, std::int32_t parent) {
    const CellState from = cells[index(parent)];
    const Box<2> box = tree.cell_box(c), room = tree.cell_box_with_room(c);
    CellState cell;
    cell.first_edge = static_cast<std::int32_t>(edges.size());
    for (std::int32_t k = from.first_edge; k < from.last_edge; ++k) {
      const std::int32_t e = edges[index(k)];
      const BoundaryEdge& edge = boundary.edges[index(e)];
      if (segment_may_meet_box(end_of(edge.begin), end_of(edge.end), room)) edges.push_back(e);
    }
    cell.last_edge = static_cast<std::int32_t>(edges.size());
    Point<2> fraction{0.41421356, 0.57721566};
    bool touching = true;
    while (touching) {
      touching = false;
      cell.reference = point_in(box, fraction);
      cell.reference_inside = inside_from(from, cell.reference, &touching);
      fraction = {std::fmod(fraction[0] + 0.6180339887, 1.0),
                  std::fmod(fraction[1] + 0.7548776662, 1.0)};
    }
    cell.outside = cell.first_edge == cell.last_edge && !cell.reference_inside;
    cell.least = from.least;
    cell.largest = from.largest;
    cell.mean_density = from.mean_density;
    cells.push_back(cell);
  }

  // Samples d in the cells first .. last-1, in one batch.
  void sample(const BackgroundTree<2>& tree, std::int32_t first, std::int32_t last) {
    std::vector<Point<2>> points;
    std::vector<std::int32_t> owner;
    points.reserve(kSamples.size() * static_cast<std::size_t>(last - first));
    owner.reserve(points.capacity());
    for (std::int32_t c = first; c < last; ++c) {
      if (cells[index(c)].outside) continue;
      for (const Point<2>& fraction : kSamples) {
        const Point<2> x = point_in(tree.cell_box(c), fraction);
        if (!inside_from(cells[index(c)], x)) continue;
        points.push_back(x);
        owner.push_back(c);
      }
    }
    std::vector<double> d(points.size());
    spacing(static_cast<std::int64_t>(points.size()), points.data(), d.data());
    std::size_t next = 0;
    std::vector<double> values;
    for (std::int32_t c = first; c < last; ++c) {
      values.clear();
      for (; next < owner.size() && owner[next] == c; ++next) values.push_back(d[next]);
      add_boundary_samples(tree.cell_box(c), cells[index(c)], values);
      take_samples(values, cells[index(c)]);
    }
  }

  void add_boundary_samples(const Box<2>& box, const CellState& cell,
                            std::vector<double>& values) const {
    for (std::int32_t k = cell.first_edge; k < cell.last_edge; ++k) {
      const BoundaryEdge& e = boundary.edges[index(edges[index(k)])];
      for (std::int32_t node : {e.begin, e.end})
        if (in_box(box, end_of(node))) values.push_back(boundary_spacing[index(node)]);
    }
  }

  static void take_samples(const std::vector<double>& values, CellState& cell) {
    if (values.empty()) return;  // a sliver of the domain: what the parent cell has must do
    cell.least = values[0];
    cell.largest = values[0];
    double sum = 0;
    for (double d : values) {
      cell.least = std::min(cell.least, d);
      cell.largest = std::max(cell.largest, d);
      sum += 1 / (d * d);
    }
    cell.mean_density = sum / static_cast<double>(values.size());
  }

  bool wants_split(const BackgroundTree<2>& tree, std::int32_t c) const {
    const CellState& cell = cells[index(c)];
    if (cell.outside) return false;
    if (coarsest && depth_at(*coarsest, tree.cell_centre(c)) > tree.cell(c).depth) return true;
    const double side = tree.cell_side(c);
    if (side > kLeafSpacings * cell.least) return true;
    if (steepest > 0 && cell.largest - cell.least > steepest * side && side > 0.35 * cell.least)
      return true;
    return cell.last_edge - cell.first_edge > kMostBoundaryNodes && tree.cell(c).depth < 26;
  }

  // Even with the largest d of each cell there would be more nodes than allowed: stop early.
  void check_count(const BackgroundTree<2>& tree, std::int32_t first, std::int32_t last) {
    double nodes = nodes_in_leaves;
    std::int32_t finest = first;
    for (std::int32_t c = first; c < last; ++c) {
      const CellState& cell = cells[index(c)];
      if (cell.outside || cell.first_edge != cell.last_edge) continue;
      nodes += Lattice<2>::kDensity * std::pow(tree.cell_side(c) / cell.largest, 2);
      if (cells[index(finest)].outside || cell.least < cells[index(finest)].least) finest = c;
    }
    if (nodes <= static_cast<double>(limit.max_nodes)) return limit.require_memory_for(nodes);
    const Point<2> x = tree.cell_centre(finest);
    throw Error(ErrorKind::spacing, "spacing d = " + number_text(cells[index(finest)].least) +
                                        " near (" + number_text(x[0]) + ", " + number_text(x[1]) +
                                        ") would mean about " + number_text(std::round(nodes)) +
                                        " nodes or more; the option max_nodes allows " +
                                        std::to_string(limit.max_nodes) +
                                        ": use a larger spacing or a larger max_nodes");
  }
};

void DomainMap::build(const Box<2>& bounds, const Boundary& boundary,
                      const SpacingEvaluator& spacing, const NodeLimit& limit, double steepest,
                      const BackgroundTree<2>* coarsest) {
  boundary_ = &boundary;
  grow(*serial_communicator(), bounds,
       Growth{*this, boundary, spacing, limit, steepest, coarsest, {}, {}, {}, 0},
       [](const BackgroundTree<2>&, std::int32_t, double) { return true; });
}

void DomainMap::build_part(const Communicator& comm, const Box<2>& bounds, const Boundary& boundary,
                           const SpacingEvaluator& spacing, const NodeLimit& limit,
                           const MaySplit& may_split) {
  boundary_ = &boundary;
  grow(comm, bounds, Growth{*this, boundary, spacing, limit, 0, nullptr, {}, {}, {}, 0}, may_split);
}

void DomainMap::grow(const Communicator& comm, const Box<2>& bounds, Growth growth,
                     const MaySplit& may_split) {
  agreed(comm, [&] {
    gather_edge_ends();
    growth.sample_boundary_nodes();
  });
  std::int32_t parents = 0;  // first cell of the depth above
  const auto split_depth = [&](const BackgroundTree<2>& tree, std::int32_t first, std::int32_t last,
                               std::vector<char>& split) {
    if (first == 0) growth.start_root(tree);
    growth.cells.reserve(static_cast<std::size_t>(tree.cell_count()));
    for (std::int32_t parent = parents; parent < first; ++parent) {
      const std::int32_t child = tree.cell(parent).first_child;
      if (child < 0) continue;
      for (int k = 0; k < BackgroundTree<2>::kChildren; ++k)
        growth.start_child(tree, child + k, parent);
    }
    parents = first;
    agreed(comm, [&] {
      growth.sample(tree, first, last);
      growth.check_count(tree, first, last);
    });
    for (std::int32_t c = first; c < last; ++c) {
      const Growth::CellState& cell = growth.cells[index(c)];
      const double nodes =
          Lattice<2>::kDensity * std::pow(tree.cell_side(c), 2) * cell.mean_density;
      split[index(c - first)] = growth.wants_split(tree, c) && may_split(tree, c, nodes);
      if (!split[index(c - first)] && !cell.outside && cell.first_edge == cell.last_edge)
        growth.nodes_in_leaves += nodes;
    }
  };
  tree_.build(bounds, split_depth, [&](bool more) { return comm.allreduce_max(more) > 0; });
  keep_leaves(growth);
}

void DomainMap::gather_edge_ends() {
  edge_ends_.clear();
  for (const BoundaryEdge& e : boundary_->edges)
    edge_ends_.push_back(
        {boundary_->nodes[index(e.begin)].position, boundary_->nodes[index(e.end)].position});
  edge_blocks_.build(edge_ends_.size(), [this](std::size_t e, int side) {
    return side == 0 ? edge_ends_[e].begin : edge_ends_[e].end;
  });
}

void DomainMap::keep_leaves(const Growth& growth) {
  const std::int32_t leaves = tree_.leaf_count();
  side_.clear();
  reference_.clear();
  reference_inside_.clear();
  leaf_spacing_.clear();
  leaf_least_.clear();
  leaf_largest_.clear();
  leaf_edges_.clear();
  edge_offset_.assign(1, 0);
  cell_has_edges_.clear();
  for (const Growth::CellState& cell : growth.cells)
    cell_has_edges_.push_back(cell.first_edge < cell.last_edge);
  for (std::int32_t leaf = 0; leaf < leaves; ++leaf) {
    const Growth::CellState& cell = growth.cells[index(tree_.leaf_cell(leaf))];
    side_.push_back(cell.outside                        ? Side::outside
                    : cell.first_edge == cell.last_edge ? Side::inside
                                                        : Side::crossed);
    reference_.push_back(cell.reference);
    reference_inside_.push_back(cell.reference_inside);
    leaf_spacing_.push_back(cell.mean_density > 0 ? 1 / std::sqrt(cell.mean_density) : 0);
    leaf_least_.push_back(cell.least);
    leaf_largest_.push_back(cell.largest);
    for (std::int32_t k = cell.first_edge; k < cell.last_edge; ++k)
      leaf_edges_.push_back(growth.edges[index(k)]);
    edge_offset_.push_back(static_cast<std::int32_t>(leaf_edges_.size()));
  }
}

bool DomainMap::inside_in_leaf(std::int32_t leaf, const Point<2>& x) const {
  if (side(leaf) != Side::crossed) return side(leaf) == Side::inside;
  bool inside = reference_inside_[index(leaf)];
  for (std::int32_t k = edge_offset_[index(leaf)]; k < edge_offset_[index(leaf) + 1]; ++k) {
    const std::int32_t e = leaf_edges_[index(k)];
    if (on_edge(edge_begin(e), edge_end(e), x)) return false;
    if (edge(e).left_inside == edge(e).right_inside) continue;
    if (crosses(reference_[index(leaf)], x, edge_begin(e), edge_end(e))) inside = !inside;
  }
  return inside;
}

bool DomainMap::edge_between(std::int32_t leaf, const Point<2>& a, const Point<2>& b) const {
  bool between = false;
  for_edges_of_leaf(leaf, [&](std::int32_t e) {
    between = between || crosses(a, b, edge_begin(e), edge_end(e));
  });
  return between;
}

double DomainMap::clearance(const Point<2>& x, double reach) const {
  double least = reach;
  for_edges_near(x, reach, [&](std::int32_t e) {
    least = std::min(least, distance_to_segment(edge_begin(e), edge_end(e), x));
  });
  return least;
}

}  // namespace pnpbs
