// SPDX-License-Identifier: BSD-3-Clause
// The background tree of a level, refined by d and the boundary, with the boundary facets and the
// samples of d in its leaves.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "comm/communicator.hpp"
#include "domain/node_limit.hpp"
#include "domain/spacing_evaluator.hpp"
#include "geometry/facet_index.hpp"
#include "spacing/growth_source.hpp"
#include "tree/background_tree.hpp"

namespace pnpbs {

// The criteria by which a tree is refined. The boundary of a plane level is discretised by d. The
// surfaces of a volume may be far finer than d and have an index of their own, so the tree ignores
// them.
enum class Refinement { spacing, spacing_and_boundary };

template <int Dim>
constexpr Refinement kLevelRefinement{Dim == 2 ? Refinement::spacing_and_boundary
                                               : Refinement::spacing};

// A background tree with facets and samples of d in its leaves.
template <int Dim>
class SizedTree : public FacetIndex<Dim> {
 public:
  // Refines the tree until its leaves are at most method::kLeafSpacings times d wide, and hold few
  // boundary nodes. Leaves are then at least half as wide as that where d permits. d is evaluated
  // at the cell_samples of each cell inside the domain and at the boundary nodes. Dips of d between
  // these points are not detected unless `known` contains them. Throws Error(ErrorKind::spacing or
  // ::memory) if d requires more nodes than the limit allows.
  void build(const TreeBounds<Dim>& bounds, const BoundaryMesh<Dim>& boundary,
             const SpacingEvaluator<Dim>& spacing, const NodeLimit& limit,
             Refinement by = Refinement::spacing_and_boundary,
             const std::vector<GrowthSource<Dim>>& known = {});

  // Returns whether a cell may be split that should be split. `nodes` is the number of nodes that
  // its samples of d require.
  using MaySplit =
      std::function<bool(const BackgroundTree<Dim>& tree, std::int32_t cell, double nodes)>;
  // Builds the same tree, but splits a cell only if may_split allows it.
  // Collective if may_split differs between ranks. If one rank throws, all ranks throw.
  void build_part(const Communicator& comm, const TreeBounds<Dim>& bounds,
                  const BoundaryMesh<Dim>& boundary, const SpacingEvaluator<Dim>& spacing,
                  const NodeLimit& limit, const MaySplit& may_split,
                  Refinement by = Refinement::spacing_and_boundary,
                  const std::vector<GrowthSource<Dim>>& known = {});

  // Returns the area or volume of a leaf in units of a cell of depth kSizeDepth. In the plane this
  // is the smallest possible cell; in space, where such units would overflow, smaller leaves have
  // size 0.
  static constexpr int kMaxDepth = BackgroundTree<Dim>::kMaxDepth;
  static constexpr int kSizeDepth = Dim * kMaxDepth < 64 ? kMaxDepth : 60 / Dim;
  std::uint64_t leaf_size(std::int32_t leaf) const {
    const BackgroundTree<Dim>& tree = this->tree();
    const int above = kSizeDepth - tree.cell(tree.leaf_cell(leaf)).depth;
    return above < 0 ? 0 : std::uint64_t{1} << (Dim * above);
  }
  // Returns a d for which a lattice in the leaf has the number of nodes that the samples require.
  // The other functions return the smallest and the largest sample.
  double leaf_spacing(std::int32_t leaf) const { return at(leaf_spacing_, leaf); }
  double leaf_min_spacing(std::int32_t leaf) const { return at(leaf_min_, leaf); }
  double leaf_max_spacing(std::int32_t leaf) const { return at(leaf_max_, leaf); }

 private:
  class Growth;  // state of the cells while the tree grows
  void grow(const Communicator& comm, const TreeBounds<Dim>& bounds, Growth& growth,
            const MaySplit& may_split);
  void keep_leaves(BackgroundTree<Dim> tree, const Growth& growth);
  static double at(const std::vector<double>& values, std::int32_t leaf) {
    return values[static_cast<std::size_t>(leaf)];
  }

  std::vector<double> leaf_spacing_, leaf_min_, leaf_max_;
};

extern template class SizedTree<2>;
extern template class SizedTree<3>;

}  // namespace pnpbs
