// SPDX-License-Identifier: BSD-3-Clause
#include "domain/facet_search.hpp"

#include <utility>

namespace pnpbs {

FacetIndex<3> index_facets(const BoundaryMesh<3>& mesh, const Box<3>& bounds) {
  constexpr std::size_t kMaxFacets = 12;
  constexpr int kMaxDepth = 16;  // where more meet in a node, no cell holds fewer
  FacetCells<3> facets(mesh);
  std::int32_t parents = 0;  // first cell of the depth above
  const auto add_children_before = [&](const BackgroundTree<3>& tree, std::int32_t last) {
    for (std::int32_t parent = parents; parent < last; ++parent)
      if (tree.cell(parent).first_child >= 0) facets.add_children(tree, parent);
    parents = last;
  };
  BackgroundTree<3> tree;
  tree.build(bounds, [&](const BackgroundTree<3>& grown, std::int32_t first, std::int32_t last,
                         std::vector<char>& split) {
    if (first == 0) facets.add_root(grown);
    add_children_before(grown, first);
    for (std::int32_t c = first; c < last; ++c)
      split[static_cast<std::size_t>(c - first)] =
          grown.cell(c).depth < kMaxDepth && facets.facets(c).size() > kMaxFacets;
  });
  add_children_before(tree, tree.cell_count());
  return FacetIndex<3>(std::move(tree), facets);
}

}  // namespace pnpbs
