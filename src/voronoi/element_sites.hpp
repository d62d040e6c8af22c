// SPDX-License-Identifier: BSD-3-Clause
// The sites of elements, i.e. the nodes that are closest in some part of an element. These are
// usually its corners only. If an angle is obtuse, there can be others.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/chunked_rows.hpp"
#include "base/types.hpp"
#include "comm/communicator.hpp"
#include "mesh/distributed_mesh.hpp"

namespace pnpbs {

// The nodes and elements of a rank, by local indices.
template <int Dim>
struct ElementSites {
  double sphere_radius = 0;   // 0 if not on a sphere.
  std::vector<Point<Dim>> x;  // Positions of nodes, owned ones first.
  std::vector<std::int64_t> ids, numbers;

  struct Element {
    std::int64_t first_site;
    std::int32_t sites;
    // Bit k says whether the side opposite to corner k belongs to the boundary.
    std::uint32_t boundary;
  };
  std::vector<Element> elements;
  // Node indices of the sites of all elements: for each element the corners by id, then the others
  // by id.
  std::vector<std::int32_t> sites;

  std::span<const std::int32_t> of(const Element& element) const {
    return std::span(sites).subspan(static_cast<std::size_t>(element.first_site),
                                    static_cast<std::size_t>(element.sites));
  }
};

// Returns all elements that have a node of this rank as a site. `mesh` must have a layer of ghost
// elements. Candidates for sites of an element are the corners of all elements that touch it.
// `parts` receives the rows (append_parts) of the elements owned by this rank, which come first.
// `sphere_radius` is 0 if the elements are not on a sphere. Collective.
template <std::size_t Corners, int Dim>
ElementSites<Dim> find_element_sites(const Communicator& comm, const DistributedMesh& mesh,
                                     double sphere_radius, ChunkedRows<double>& parts);

// Instances for triangles of the plane, triangles of surfaces alone, and tetrahedra.
extern template ElementSites<2> find_element_sites<3>(const Communicator&, const DistributedMesh&,
                                                      double, ChunkedRows<double>&);
extern template ElementSites<3> find_element_sites<3>(const Communicator&, const DistributedMesh&,
                                                      double, ChunkedRows<double>&);
extern template ElementSites<3> find_element_sites<4>(const Communicator&, const DistributedMesh&,
                                                      double, ChunkedRows<double>&);

}  // namespace pnpbs
