// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/facet_tree.hpp"

#include <utility>
#include <vector>

namespace pnpbs {

template <int Dim>
FacetIndex<Dim> index_facets(const BoundaryMesh<Dim>& mesh, const Box<Dim>& bounds) {
  constexpr std::size_t kMaxFacets = 12;
  constexpr int kMaxDepth = 16;  // where more meet in a node, no cell holds fewer
  FacetCells<Dim> facets(mesh);
  std::int32_t parents = 0;  // first cell of the depth above
  const auto add_children_before = [&](const BackgroundTree<Dim>& tree, std::int32_t last) {
    for (std::int32_t parent = parents; parent < last; ++parent)
      if (tree.cell(parent).first_child >= 0) facets.add_children(tree, parent);
    parents = last;
  };
  BackgroundTree<Dim> tree;
  tree.build(bounds, [&](const BackgroundTree<Dim>& grown, std::int32_t first, std::int32_t last,
                         std::vector<char>& split) {
    if (first == 0) facets.add_root(grown);
    add_children_before(grown, first);
    for (std::int32_t c = first; c < last; ++c)
      split[static_cast<std::size_t>(c - first)] =
          grown.cell(c).depth < kMaxDepth && facets.facets(c).size() > kMaxFacets;
  });
  add_children_before(tree, tree.cell_count());
  return FacetIndex<Dim>(std::move(tree), facets);
}

template FacetIndex<2> index_facets(const BoundaryMesh<2>&, const Box<2>&);
template FacetIndex<3> index_facets(const BoundaryMesh<3>&, const Box<3>&);

}  // namespace pnpbs
