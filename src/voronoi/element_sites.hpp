// SPDX-License-Identifier: BSD-3-Clause
// Which nodes are closest in some part of an element: mostly its corners alone, but where an angle
// is obtuse others, too.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/chunked_rows.hpp"
#include "base/types.hpp"
#include "comm/communicator.hpp"
#include "mesh/distributed_mesh.hpp"

namespace pnpbs {

// Nodes and elements that a rank knows, by local indices.
template <int Dim>
struct ElementSites {
  double sphere_radius = 0;   // 0: not on a sphere
  std::vector<Point<Dim>> x;  // of nodes, those that the rank owns first
  std::vector<std::int64_t> ids, numbers;

  struct Element {
    std::int64_t first_site;
    std::int32_t sites;
    std::uint32_t boundary;  // bit k: the side opposite to its k-th site is a part of the boundary
  };
  std::vector<Element> elements;
  // Of the elements, as indices of nodes: the corners by id, then the others by id.
  std::vector<std::int32_t> sites;

  std::span<const std::int32_t> of(const Element& element) const {
    return std::span(sites).subspan(static_cast<std::size_t>(element.first_site),
                                    static_cast<std::size_t>(element.sites));
  }
};

// All elements of which a node of this rank is a site. mesh: with a layer of ghost elements. The
// candidates of an element are the corners of all elements that touch it. parts: gets the rows
// (append_parts) of those that this rank owns, which come first. sphere_radius: of the sphere that
// they are on, or 0. Collective.
template <std::size_t Corners, int Dim>
ElementSites<Dim> find_element_sites(const Communicator& comm, const DistributedMesh& mesh,
                                     double sphere_radius, ChunkedRows<double>& parts);

// Triangles of the plane and of surfaces alone, and tetrahedra.
extern template ElementSites<2> find_element_sites<3>(const Communicator&, const DistributedMesh&,
                                                      double, ChunkedRows<double>&);
extern template ElementSites<3> find_element_sites<3>(const Communicator&, const DistributedMesh&,
                                                      double, ChunkedRows<double>&);
extern template ElementSites<3> find_element_sites<4>(const Communicator&, const DistributedMesh&,
                                                      double, ChunkedRows<double>&);

}  // namespace pnpbs
