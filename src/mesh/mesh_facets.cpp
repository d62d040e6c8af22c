// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/mesh_facets.hpp"

#include <algorithm>

namespace pnpbs {

namespace {

// Returns the index of the corner of `element` that is not a corner of `facet`, or -1 if `facet` is
// not a facet of the element.
template <std::size_t Corners>
int opposite_corner(const MeshElement<Corners>& element,
                    const std::array<std::int64_t, Corners - 1>& facet) {
  int opposite = -1;
  std::size_t common = 0;
  for (std::size_t k = 0; k < Corners; ++k)
    if (std::ranges::find(facet, element.corners[k]) != facet.end())
      ++common;
    else
      opposite = static_cast<int>(k);
  return common == Corners - 1 ? opposite : -1;
}

// The facets of owned nodes with the elements on their sides, packed for the ranks that own these
// elements.
template <std::size_t Corners>
class FacetFinder {
 public:
  FacetFinder(const RankRanges& elements, const ElementsAtNodes<Corners>& at_nodes)
      : elements_(elements), at_nodes_(at_nodes) {}

  // Adds a facet. `node` is one of its corners and owned by this rank, so that all elements at it
  // are known.
  void add(std::int64_t node, const std::array<std::int64_t, Corners - 1>& corners,
           std::int32_t tag) {
    MeshFacet<Corners> facet{corners, {kNoElement, kNoElement}, {-1, -1}, tag};
    std::size_t found = 0;
    at_nodes_.at(node, [&](const MeshElement<Corners>& element) {
      const int opposite = opposite_corner(element, corners);
      if (opposite < 0 || found == 2) return;
      facet.elements[found] = element.number;
      facet.opposite[found++] = static_cast<std::int8_t>(opposite);
    });
    if (found == 0) return;
    if (found == 2 && facet.elements[1] < facet.elements[0]) {
      std::swap(facet.elements[0], facet.elements[1]);
      std::swap(facet.opposite[0], facet.opposite[1]);
    }
    send(facet);
  }

  const Outbox& found() const { return outgoing_; }

 private:
  void send(const MeshFacet<Corners>& facet) {
    const int first = elements_.owner(facet.elements[0]);
    pack(outgoing_.to(first), facet);
    if (facet.elements[1] == kNoElement) return;
    const int second = elements_.owner(facet.elements[1]);
    if (second != first) pack(outgoing_.to(second), facet);
  }

  const RankRanges& elements_;
  const ElementsAtNodes<Corners>& at_nodes_;
  Outbox outgoing_;
};

// Adds the edges that belong to a single triangle. The owner of the end with the smaller number
// adds an edge.
void add_open_edges(const RankRanges& nodes, const ElementsAtNodes<3>& at_nodes,
                    FacetFinder<3>& finder) {
  struct Edge {
    std::int64_t end;
    std::array<std::int64_t, 2> turning;  // in the orientation of its triangle
    std::int32_t tag;
  };
  std::vector<Edge> edges;
  for (std::int64_t node = nodes.first(); node < nodes.end(); ++node) {
    edges.clear();
    at_nodes.at(node, [&](const MeshElement<3>& triangle) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int64_t a = triangle.corners[k], b = triangle.corners[(k + 1) % 3];
        if (std::min(a, b) == node) edges.push_back({std::max(a, b), {a, b}, triangle.tag});
      }
    });
    std::ranges::sort(edges, {}, &Edge::end);
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const bool again = (e > 0 && edges[e - 1].end == edges[e].end) ||
                         (e + 1 < edges.size() && edges[e + 1].end == edges[e].end);
      if (!again) finder.add(node, edges[e].turning, edges[e].tag);
    }
  }
}

}  // namespace

template <std::size_t Corners, int Dim>
std::vector<MeshFacet<Corners>> facets_of_owned_elements(const Results<Dim>& results,
                                                         const std::vector<std::int64_t>& numbers,
                                                         const RankRanges& nodes,
                                                         const RankRanges& elements,
                                                         const ElementsAtNodes<Corners>& at_nodes) {
  FacetFinder<Corners> finder(elements, at_nodes);
  if constexpr (Corners == Dim) {
    add_open_edges(nodes, at_nodes, finder);
  } else {
    const auto add = [&](const std::array<std::int64_t, Dim>& places, std::int32_t tag) {
      std::array<std::int64_t, Dim> corners;
      for (std::size_t k = 0; k < Dim; ++k)
        corners[k] = numbers[static_cast<std::size_t>(places[k])];
      finder.add(corners[0], corners, tag);
    };
    results.for_facets(add);
  }
  return deliver<MeshFacet<Corners>>(results.communicator(), finder.found());
}

template PNPBS_FACETS_OF(3, 2);
template PNPBS_FACETS_OF(3, 3);
template PNPBS_FACETS_OF(4, 3);

}  // namespace pnpbs
