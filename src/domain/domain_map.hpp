// SPDX-License-Identifier: BSD-3-Clause
// The background tree of a level together with what lies in its leaves: boundary edges, the side
// on which the domain is, samples of d. Answers "is x inside?" and "which edges are near x?".
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "comm/communicator.hpp"
#include "domain/edge_blocks.hpp"
#include "domain/node_limit.hpp"
#include "domain/plane/boundary.hpp"
#include "tree/background_tree.hpp"

namespace pnpbs {

class DomainMap {
 public:
  // Refines the tree until leaves are at most kLeafSpacings times d wide (so at least half of that
  // where d allows) and hold few boundary nodes. d is asked inside the domain only, at five points
  // of each cell, and at the boundary nodes: dips of d between them are not seen.
  // With steepest > 0, cells over which d grows faster than that are refined further, down to a
  // third of their least d, so that the tips of steep funnels are found. Given another tree of the
  // same bounds, it is at least as fine as that.
  // Throws Error(ErrorKind::spacing or ::memory) when d would mean more nodes than the limit
  // allows.
  void build(const Box<2>& bounds, const Boundary& boundary, const SpacingEvaluator& spacing,
             const NodeLimit& limit, double steepest = 0,
             const BackgroundTree<2>* coarsest = nullptr);

  // May a cell that d or the boundary wants split be split? `nodes`: those its samples of d ask
  // for.
  using MaySplit =
      std::function<bool(const BackgroundTree<2>& tree, std::int32_t cell, double nodes)>;
  // The same tree, refined only where may_split allows it. Where that differs between ranks the
  // call is collective, and a failure on one rank is thrown on all.
  void build_part(const Communicator& comm, const Box<2>& bounds, const Boundary& boundary,
                  const SpacingEvaluator& spacing, const NodeLimit& limit,
                  const MaySplit& may_split);

  static constexpr double kLeafSpacings = 4;

  const BackgroundTree<2>& tree() const { return tree_; }
  const Boundary& boundary() const { return *boundary_; }

  bool leaf_outside(std::int32_t leaf) const { return side(leaf) == Side::outside; }
  bool leaf_has_edges(std::int32_t leaf) const {
    return edge_offset_[index(leaf)] < edge_offset_[index(leaf) + 1];
  }
  // Its area in units of the smallest cell there can be.
  static constexpr int kMaxDepth = BackgroundTree<2>::kMaxDepth;
  std::uint64_t leaf_size(std::int32_t leaf) const {
    return std::uint64_t{1} << (2 * (kMaxDepth - tree_.cell(tree_.leaf_cell(leaf)).depth));
  }
  // d that holds the right number of nodes in the leaf, and the least and largest of its samples.
  double leaf_spacing(std::int32_t leaf) const { return leaf_spacing_[index(leaf)]; }
  double leaf_least_spacing(std::int32_t leaf) const { return leaf_least_[index(leaf)]; }
  double leaf_largest_spacing(std::int32_t leaf) const { return leaf_largest_[index(leaf)]; }

  // Is x strictly inside the domain? (On a boundary edge: no.)
  bool inside(const Point<2>& x) const { return inside_in_leaf(tree_.leaf_at(x), x); }
  bool inside_in_leaf(std::int32_t leaf, const Point<2>& x) const;

  // Calls visit(edge index) for every boundary edge that may come within `reach` of x; an edge can
  // come more than once.
  template <class Visit>
  void for_edges_near(const Point<2>& x, double reach, const Visit& visit) const {
    const Box<2> box{{x[0] - reach, x[1] - reach}, {x[0] + reach, x[1] + reach}};
    const auto has_edges = [this](std::int32_t cell) { return cell_has_edges_[index(cell)] != 0; };
    tree_.for_leaves_in(box, has_edges, [&](std::int32_t leaf) { for_edges_of_leaf(leaf, visit); });
  }
  template <class Visit>
  void for_edges_of_leaf(std::int32_t leaf, const Visit& visit) const {
    for (std::int32_t e = edge_offset_[index(leaf)]; e < edge_offset_[index(leaf) + 1]; ++e)
      visit(leaf_edges_[static_cast<std::size_t>(e)]);
  }

  // Does the straight way from a to b cross a boundary edge of the leaf? Not where it ends on one.
  bool edge_between(std::int32_t leaf, const Point<2>& a, const Point<2>& b) const;

  const Point<2>& edge_begin(std::int32_t e) const { return edge_ends_[index(e)].begin; }
  const Point<2>& edge_end(std::int32_t e) const { return edge_ends_[index(e)].end; }
  const BoundaryEdge& edge(std::int32_t e) const { return boundary_->edges[index(e)]; }
  const EdgeBlocks& edge_blocks() const { return edge_blocks_; }

  // Distance from x to the nearest boundary edge, or `reach` if none is nearer.
  double clearance(const Point<2>& x, double reach) const;

 private:
  enum class Side : char { outside, crossed, inside };
  struct Growth;  // what is known of the cells while the tree grows
  void grow(const Communicator& comm, const Box<2>& bounds, Growth growth,
            const MaySplit& may_split);

  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }
  Side side(std::int32_t leaf) const { return side_[index(leaf)]; }
  void gather_edge_ends();
  void keep_leaves(const Growth& growth);

  struct Ends {
    Point<2> begin, end;
  };

  BackgroundTree<2> tree_;
  const Boundary* boundary_ = nullptr;
  std::vector<Ends> edge_ends_;  // of the edges: asked far more often than anything else of them
  EdgeBlocks edge_blocks_;
  std::vector<Side> side_;              // of the leaves
  std::vector<Point<2>> reference_;     // a point in each leaf ...
  std::vector<char> reference_inside_;  // ... and whether it lies inside
  std::vector<double> leaf_spacing_, leaf_least_, leaf_largest_;
  std::vector<char> cell_has_edges_;       // of all cells: can an edge be in it?
  std::vector<std::int32_t> edge_offset_;  // edges of each leaf
  std::vector<std::int32_t> leaf_edges_;
};

}  // namespace pnpbs
