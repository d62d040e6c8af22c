// SPDX-License-Identifier: BSD-3-Clause
// The background tree of a level, refined by d and the boundary, with what lies in its leaves: the
// facets of the boundary, and samples of d.
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

// What a tree is refined by. The boundary of a plane level has nodes that d asks for; the surfaces
// of a volume may be far finer than d, and have an index of their own.
enum class Refinement { spacing, spacing_and_boundary };

template <int Dim>
constexpr Refinement kLevelRefinement{Dim == 2 ? Refinement::spacing_and_boundary
                                               : Refinement::spacing};

template <int Dim>
class SizedTree : public FacetIndex<Dim> {
 public:
  // Refines the tree until leaves are at most method::kLeafSpacings times d wide (so at least half
  // of that where d allows) and hold few boundary nodes. d is asked inside the domain only, at the
  // cell_samples of each cell, and at the boundary nodes: dips of d between them are not seen,
  // unless they are among the values known.
  // Throws Error(ErrorKind::spacing or ::memory) when d would mean more nodes than the limit
  // allows.
  void build(const Box<Dim>& bounds, const BoundaryMesh<Dim>& boundary,
             const SpacingEvaluator<Dim>& spacing, const NodeLimit& limit,
             Refinement by = Refinement::spacing_and_boundary,
             const std::vector<GrowthSource<Dim>>& known = {});

  // May a cell that d or the boundary wants split be split? `nodes`: those its samples of d ask
  // for.
  using MaySplit =
      std::function<bool(const BackgroundTree<Dim>& tree, std::int32_t cell, double nodes)>;
  // The same tree, refined only where may_split allows it. Where that differs between ranks the
  // call is collective, and a failure on one rank is thrown on all.
  void build_part(const Communicator& comm, const Box<Dim>& bounds,
                  const BoundaryMesh<Dim>& boundary, const SpacingEvaluator<Dim>& spacing,
                  const NodeLimit& limit, const MaySplit& may_split,
                  Refinement by = Refinement::spacing_and_boundary,
                  const std::vector<GrowthSource<Dim>>& known = {});

  // Its area (volume) in units of a cell of depth kSizeDepth: the smallest there can be in the
  // plane; in space, where these are too many, smaller ones count as nothing.
  static constexpr int kMaxDepth = BackgroundTree<Dim>::kMaxDepth;
  static constexpr int kSizeDepth = Dim * kMaxDepth < 64 ? kMaxDepth : 60 / Dim;
  std::uint64_t leaf_size(std::int32_t leaf) const {
    const BackgroundTree<Dim>& tree = this->tree();
    const int above = kSizeDepth - tree.cell(tree.leaf_cell(leaf)).depth;
    return above < 0 ? 0 : std::uint64_t{1} << (Dim * above);
  }
  // d that holds the right number of nodes in the leaf, and the least and largest of its samples.
  double leaf_spacing(std::int32_t leaf) const { return at(leaf_spacing_, leaf); }
  double leaf_min_spacing(std::int32_t leaf) const { return at(leaf_min_, leaf); }
  double leaf_max_spacing(std::int32_t leaf) const { return at(leaf_max_, leaf); }

 private:
  class Growth;  // what is known of the cells while the tree grows
  void grow(const Communicator& comm, const Box<Dim>& bounds, Growth& growth,
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
