// SPDX-License-Identifier: BSD-3-Clause
#include "voronoi/element_sites.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/chunked_rows.hpp"
#include "base/counting_sort.hpp"
#include "base/rank_limit.hpp"
#include "comm/records.hpp"
#include "voronoi/divided_element.hpp"
#include "voronoi/small_node_set.hpp"
#include "voronoi/sphere_parts.hpp"

namespace pnpbs {
namespace {

// Ratio up to which a node that is not a corner counts as being as close as the corners, and thus
// as a site. Equally close nodes are sites too, because two of them can share a side of the
// element.
constexpr double kAsClose = 1 + 1e-12;  // [squared distance]
constexpr double kAboveRounding = 1 + 1e-9;

// Finds the sites of one element after another: its corners and those of their neighbours that are
// as close as the corners in some part of it.
template <int Dim, std::size_t Corners>
class SiteFinder {
 public:
  // neighbours[i] must contain the nodes that share an element with node i.
  SiteFinder(const ElementSites<Dim>& nodes, const ChunkedRows<std::int32_t>& neighbours)
      : nodes_(nodes), neighbours_(neighbours) {}

  // Appends the sites of the element with these corners, which must be ordered by id.
  void find(const std::array<std::int32_t, Corners>& corners, std::vector<std::int32_t>& sites) {
    list_vertices(corners);
    sites.insert(sites.end(), corners.begin(), corners.end());
    const std::size_t first_other = sites.size();
    for (const std::int32_t node : near(corners))
      if (is_close(node)) sites.push_back(node);
    const auto others = sites.begin() + static_cast<std::ptrdiff_t>(first_other);
    std::sort(others, sites.end(), [&](std::int32_t a, std::int32_t b) { return id(a) < id(b); });
    for (auto other = others; other != sites.end(); ++other)
      x_.push_back(nodes_.x[static_cast<std::size_t>(*other)]);
    divided_.set(x_);
  }

  // Returns the last element with the faces between its corners. It is valid until the next call of
  // find.
  DividedElement<Dim, Corners>& divided() { return divided_; }

 private:
  // Lists the vertices of the corners' cells within the element, as if the corners were the only
  // sites.
  void list_vertices(const std::array<std::int32_t, Corners>& corners) {
    x_.clear();
    for (const std::int32_t corner : corners)
      x_.push_back(nodes_.x[static_cast<std::size_t>(corner)]);
    divided_.set(x_);
    divided_.divide_among_corners();
    count_ = 0;
    middle_ = {};
    for (const Point<Dim>& corner : x_)
      for (std::size_t k = 0; k < Dim; ++k) middle_[k] += corner[k] / Corners;
    squared_reach_ = 0;
    for (std::size_t b = 1, face = 0; b < Corners; ++b)
      for (std::size_t a = 0; a < b; ++a, ++face)
        for (const Point<Dim>& vertex : divided_.faces_of_corners()[face].points())
          add_vertex(vertex, x_[a]);
  }
  void add_vertex(const Point<Dim>& vertex, const Point<Dim>& closest) {
    if (count_ == squared_distances_.size()) {
      for (auto& coordinates : vertices_) coordinates.resize(2 * count_ + 1);
      squared_distances_.resize(2 * count_ + 1);
    }
    for (std::size_t k = 0; k < Dim; ++k) vertices_[k][count_] = vertex[k];
    const double squared = squared_distance<Dim>(vertex, closest) * kAsClose;
    squared_distances_[count_++] = squared;
    enclose(squared_distance<Dim>(middle_, vertex), squared);
  }
  // Extends the reach for one vertex, given its squared distances from the middle and from the
  // closest corners. A node farther from the middle than the reach is at no vertex closer than the
  // corners.
  void enclose(double from_middle, double from_corners) {
    // (a + b)^2 <= 2 (a^2 + b^2), so that a root is rarely necessary.
    if (2 * (from_middle + from_corners) * kAboveRounding <= squared_reach_) return;
    const double reach = std::sqrt(from_middle) + std::sqrt(from_corners);
    squared_reach_ = std::max(squared_reach_, reach * reach * kAboveRounding);
  }
  double squared_distance_to(std::size_t vertex, const Point<Dim>& x) const {
    double sum = 0;
    for (std::size_t k = 0; k < Dim; ++k)
      sum += (vertices_[k][vertex] - x[k]) * (vertices_[k][vertex] - x[k]);
    return sum;
  }

  // Returns the neighbours within reach without duplicates and corners. The loops have no branches:
  // a node that is not kept is overwritten by the next one.
  std::span<const std::int32_t> near(const std::array<std::int32_t, Corners>& corners) {
    std::size_t most = 0;
    for (const std::int32_t corner : corners) most += neighbours_.row(corner).size();
    if (near_.size() < most) near_.resize(most);
    const Point<Dim> middle = middle_;
    const double squared_reach = squared_reach_;
    std::int32_t* const nodes = near_.data();
    std::size_t within = 0, kept = 0;
    for (const std::int32_t corner : corners)
      for (const std::int32_t node : neighbours_.row(corner)) {
        nodes[within] = node;
        const Point<Dim>& x = nodes_.x[static_cast<std::size_t>(node)];
        within += squared_distance<Dim>(middle, x) <= squared_reach;
      }
    for (std::size_t k = 0; k < within; ++k) {
      const std::int32_t node = nodes[k];
      nodes[kept] = node;
      const bool known = has({nodes, kept}, node), corner = has(corners, node);
      kept += static_cast<std::size_t>(!known && !corner);
    }
    return {nodes, kept};
  }
  bool is_close(std::int32_t node) const {
    const Point<Dim>& x = nodes_.x[static_cast<std::size_t>(node)];
    unsigned close = 0;
    for (std::size_t v = 0; v < count_; ++v)
      close |= static_cast<unsigned>(squared_distance_to(v, x) <= squared_distances_[v]);
    return close != 0;
  }
  std::int64_t id(std::int32_t node) const { return nodes_.ids[static_cast<std::size_t>(node)]; }

  const ElementSites<Dim>& nodes_;
  const ChunkedRows<std::int32_t>& neighbours_;
  DividedElement<Dim, Corners> divided_;
  std::vector<Point<Dim>> x_;  // Positions of the sites.
  // Coordinates of the vertices, and squared distances to the closest corners, in separate arrays
  // for vector instructions.
  std::array<std::vector<double>, Dim> vertices_;
  std::vector<double> squared_distances_;
  std::size_t count_ = 0;
  std::vector<std::int32_t> near_;
  Point<Dim> middle_{};  // Mean of the corners.
  double squared_reach_ = 0;
};

// Returns for each node the nodes that share an element with it.
template <std::size_t Corners>
ChunkedRows<std::int32_t> neighbours_in_elements(const DistributedMesh& mesh) {
  const std::vector<std::int32_t>& corners = mesh.element_corners;
  const auto key = [&](std::int64_t k) { return corners[static_cast<std::size_t>(k)]; };
  const std::int64_t nodes = static_cast<std::int64_t>(mesh.numbers.size());
  CountingSort by_node(static_cast<std::int64_t>(corners.size()), static_cast<std::int32_t>(nodes),
                       key);
  std::vector<std::int64_t> at_nodes(corners.size());  // Indices in corners.
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

// Returns for each element the sides that belong to the boundary. Bit k is the side opposite to
// corner k.
std::vector<std::uint32_t> boundary_sides(const DistributedMesh& mesh) {
  std::vector<std::uint32_t> sides(mesh.element_numbers.size());
  for (std::size_t f = 0; f < mesh.facet_tags.size(); ++f)
    if (!mesh.facet_inner[f])
      sides[static_cast<std::size_t>(mesh.facet_elements[2 * f])] |= 1U << mesh.facet_opposite[f];
  return sides;
}

// Sorts the corners of an element by id. Returns the bits of its sides in this order.
template <std::size_t Corners>
std::uint32_t sort_corners(const DistributedMesh& mesh, std::size_t element, std::uint32_t sides,
                           std::array<std::int32_t, Corners>& corners) {
  std::array<std::pair<std::int64_t, std::size_t>, Corners> order;  // Id and index of each corner.
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

// Finds the sites and the parts of the elements that this rank owns. Both use the faces between
// corners, so that they are computed once.
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

// A site of an element in a message to the ranks that own a site of the element. The sites of an
// element are consecutive.
template <int Dim>
struct SentSite {
  std::int64_t number, id;
  Point<Dim> x;
  std::int32_t sites;  // Number of sites of the element.
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

// Adds the received elements, and their nodes that this rank does not have yet.
template <int Dim>
void add_arrived(const std::vector<SentSite<Dim>>& arrived, ElementSites<Dim>& found) {
  std::unordered_map<std::int64_t, std::int32_t> index;  // Node index by number.
  if (!arrived.empty())
    for (std::size_t n = 0; n < found.numbers.size(); ++n)
      index[found.numbers[n]] = static_cast<std::int32_t>(n);
  for (std::size_t s = 0; s < arrived.size(); ++s) {
    const SentSite<Dim>& site = arrived[s];
    // A site that does not belong to the last element begins a new one.
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
