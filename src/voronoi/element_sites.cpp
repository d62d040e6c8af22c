// SPDX-License-Identifier: BSD-3-Clause
#include "voronoi/element_sites.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <unordered_map>
#include <utility>

#include "base/counting_sort.hpp"
#include "base/rank_limit.hpp"
#include "comm/records.hpp"
#include "voronoi/few_nodes.hpp"
#include "voronoi/site_finder.hpp"
#include "voronoi/sphere_parts.hpp"

namespace pnpbs {

namespace {

// The nodes that have an element in common with each node.
template <std::size_t Corners>
ChunkedRows<std::int32_t> neighbours_in_elements(const DistributedMesh& mesh) {
  const std::vector<std::int32_t>& corners = mesh.element_corners;
  const auto key = [&](std::int64_t k) { return corners[static_cast<std::size_t>(k)]; };
  const std::int64_t nodes = static_cast<std::int64_t>(mesh.numbers.size());
  CountingSort by_node(static_cast<std::int64_t>(corners.size()), static_cast<std::int32_t>(nodes),
                       key);
  std::vector<std::int64_t> at_nodes(corners.size());  // places in corners
  by_node.for_places(key, [&](std::int64_t k, std::int32_t place) {
    at_nodes[static_cast<std::size_t>(place)] = k;
  });
  ChunkedRows<std::int32_t> neighbours;
  neighbours.build("pnpbs::voronoi::neighbours", nodes, [&] {
    return [&](std::int64_t node, std::vector<std::int32_t>& out) {
      const std::size_t n = static_cast<std::size_t>(node), begin = out.size();
      for (std::int32_t k = by_node.start()[n]; k < by_node.start()[n + 1]; ++k) {
        const std::size_t element =
            static_cast<std::size_t>(at_nodes[static_cast<std::size_t>(k)]) / Corners;
        for (std::size_t c = 0; c < Corners; ++c) {
          const std::int32_t corner = corners[element * Corners + c];
          if (corner != node && !has(std::span(out).subspan(begin), corner)) out.push_back(corner);
        }
      }
    };
  });
  return neighbours;
}

template <int Dim>
void copy_nodes(const DistributedMesh& mesh, ElementSites<Dim>& to) {
  to.ids = mesh.ids;
  to.numbers = mesh.numbers;
  to.x.resize(mesh.numbers.size());
  for (std::size_t n = 0; n < to.x.size(); ++n)
    std::copy_n(mesh.x.begin() + static_cast<std::ptrdiff_t>(Dim * n), Dim, to.x[n].begin());
}

// Of each element here the sides that are parts of the boundary, by their opposite corners: bit k
// for its k-th corner.
std::vector<std::uint32_t> boundary_sides(const DistributedMesh& mesh) {
  std::vector<std::uint32_t> sides(mesh.element_numbers.size());
  for (std::size_t f = 0; f < mesh.facet_tags.size(); ++f)
    if (!mesh.facet_inner[f])
      sides[static_cast<std::size_t>(mesh.facet_elements[2 * f])] |= 1U << mesh.facet_opposite[f];
  return sides;
}

// The corners of an element by id, and the bits of its sides in this order.
template <std::size_t Corners>
std::uint32_t sort_corners(const DistributedMesh& mesh, std::size_t element, std::uint32_t sides,
                           std::array<std::int32_t, Corners>& corners) {
  std::array<std::pair<std::int64_t, std::size_t>, Corners> order;  // id, which corner
  const std::int32_t* const from = mesh.element_corners.data() + Corners * element;
  for (std::size_t c = 0; c < Corners; ++c)
    order[c] = {mesh.ids[static_cast<std::size_t>(from[c])], c};
  std::ranges::sort(order);
  std::uint32_t sorted = 0;
  for (std::size_t c = 0; c < Corners; ++c) {
    corners[c] = from[order[c].second];
    sorted |= (sides >> order[c].second & 1U) << c;
  }
  return sorted;
}

// Those of the elements that this rank owns, and their parts: both begin with the faces between
// corners.
template <std::size_t Corners, int Dim>
void find_own(const DistributedMesh& mesh, ElementSites<Dim>& found, ChunkedRows<double>& parts) {
  const auto neighbours = neighbours_in_elements<Corners>(mesh);
  const std::vector<std::uint32_t> sides = boundary_sides(mesh);
  found.elements.resize(static_cast<std::size_t>(mesh.owned_elements));
  ChunkedRows<std::int32_t> rows;
  rows.build_with(parts, "pnpbs::voronoi::sites", mesh.owned_elements, [&] {
    return [&, finder = SiteFinder<Dim, Corners>(found, neighbours),
            rows_of = PartRows<Dim, Corners>(found.sphere_radius)](
               std::int64_t element, std::vector<std::int32_t>& out,
               std::vector<double>& parts_out) mutable {
      const std::size_t e = static_cast<std::size_t>(element);
      std::array<std::int32_t, Corners> corners;
      found.elements[e].boundary = sort_corners(mesh, e, sides[e], corners);
      finder.find(corners, out);
      rows_of.append(finder.divided(), parts_out);
    };
  });
  std::size_t sites = 0;
  for (std::int64_t e = 0; e < mesh.owned_elements; ++e) sites += rows.row(e).size();
  found.sites.reserve(sites);
  for (std::int64_t e = 0; e < mesh.owned_elements; ++e) {
    const auto row = std::as_const(rows).row(e);
    auto& element = found.elements[static_cast<std::size_t>(e)];
    element.first_site = static_cast<std::int64_t>(found.sites.size());
    element.sites = static_cast<std::int32_t>(row.size());
    found.sites.insert(found.sites.end(), row.begin(), row.end());
  }
}

// A site of an element on its way to the ranks that own a site of it. The sites of an element
// follow each other.
template <int Dim>
struct SentSite {
  std::int64_t number, id;
  Point<Dim> x;
  std::int32_t sites;  // of the element
  std::uint32_t boundary;
};

template <int Dim>
Outbox elements_for_others(const Communicator& comm, const DistributedMesh& mesh,
                           const ElementSites<Dim>& found) {
  Outbox outgoing;
  std::vector<std::int32_t> ranks;
  for (const auto& element : found.elements) {
    ranks.clear();
    for (const std::int32_t site : found.of(element))
      ranks.push_back(mesh.owners[static_cast<std::size_t>(site)]);
    std::ranges::sort(ranks);
    ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
    for (const std::int32_t rank : ranks) {
      if (rank == comm.rank()) continue;
      for (const std::int32_t site : found.of(element)) {
        const std::size_t n = static_cast<std::size_t>(site);
        pack(outgoing.to(rank), SentSite<Dim>{found.numbers[n], found.ids[n], found.x[n],
                                              element.sites, element.boundary});
      }
    }
  }
  return outgoing;
}

// Adds what has come, and the nodes that are new here.
template <int Dim>
void add_arrived(const std::vector<SentSite<Dim>>& arrived, ElementSites<Dim>& found) {
  std::unordered_map<std::int64_t, std::int32_t> index;  // by number
  if (!arrived.empty())
    for (std::size_t n = 0; n < found.numbers.size(); ++n)
      index[found.numbers[n]] = static_cast<std::int32_t>(n);
  for (std::size_t s = 0; s < arrived.size(); ++s) {
    const SentSite<Dim>& site = arrived[s];
    // The first site of an element has the element with it.
    const bool within =
        !found.elements.empty() && found.elements.back().first_site + found.elements.back().sites >
                                       static_cast<std::int64_t>(found.sites.size());
    if (!within)
      found.elements.push_back(
          {static_cast<std::int64_t>(found.sites.size()), site.sites, site.boundary});
    const auto [known, is_new] =
        index.try_emplace(site.number, static_cast<std::int32_t>(found.numbers.size()));
    if (is_new) {
      found.numbers.push_back(site.number);
      found.ids.push_back(site.id);
      found.x.push_back(site.x);
    }
    found.sites.push_back(known->second);
  }
  require_fits_rank(static_cast<std::int64_t>(found.numbers.size()), "nodes");
}

}  // namespace

template <std::size_t Corners, int Dim>
ElementSites<Dim> find_element_sites(const Communicator& comm, const DistributedMesh& mesh,
                                     double sphere_radius, ChunkedRows<double>& parts) {
  ElementSites<Dim> found;
  found.sphere_radius = sphere_radius;
  copy_nodes(mesh, found);
  find_own<Corners>(mesh, found, parts);
  add_arrived(deliver<SentSite<Dim>>(comm, elements_for_others(comm, mesh, found)), found);
  return found;
}

template ElementSites<2> find_element_sites<3>(const Communicator&, const DistributedMesh&, double,
                                               ChunkedRows<double>&);
template ElementSites<3> find_element_sites<3>(const Communicator&, const DistributedMesh&, double,
                                               ChunkedRows<double>&);
template ElementSites<3> find_element_sites<4>(const Communicator&, const DistributedMesh&, double,
                                               ChunkedRows<double>&);

}  // namespace pnpbs
