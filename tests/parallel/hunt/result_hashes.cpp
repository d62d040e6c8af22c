// SPDX-License-Identifier: BSD-3-Clause
// Computes hashes of the results of a placement, independent of order and owners.

#include "result_hashes.hpp"

#include <algorithm>
#include <bit>
#include <vector>

namespace hunt {

namespace {

using Sum = std::uint64_t;

class Hash {
 public:
  void add(std::uint64_t bits) {
    value_ = (value_ ^ bits) * 0x9e3779b97f4a7c15u;
    value_ ^= value_ >> 29;
  }
  void add(std::int64_t number) { add(static_cast<std::uint64_t>(number)); }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
  std::uint64_t value() const { return value_ * 0xbf58476d1ce4e5b9u ^ value_ >> 31; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

// The owned nodes of this rank, followed by its ghosts.
struct Nodes {
  std::int32_t dim = 0;
  std::int64_t own = 0, ghosts = 0;
  std::vector<double> coordinates, spacing, normals;
  std::vector<std::int64_t> ids;
  std::vector<std::int32_t> tags, owners;
};

#define HUNT_TRY(call)                                                    \
  do {                                                                    \
    if (const pnpbs_status status_ = (call); status_ < 0) return status_; \
  } while (false)

pnpbs_status read(pnpbs_placement placement, Nodes& nodes) {
  HUNT_TRY(pnpbs_placement_dimension(placement, &nodes.dim));
  HUNT_TRY(pnpbs_placement_count(placement, &nodes.own));
  HUNT_TRY(pnpbs_placement_ghost_count(placement, &nodes.ghosts));
  const auto all = static_cast<std::size_t>(nodes.own + nodes.ghosts);
  const auto own = static_cast<std::size_t>(nodes.own);
  nodes.coordinates.resize(all * nodes.dim + 1);
  nodes.normals.resize(own * 3 + 1);
  nodes.spacing.resize(all + 1);
  nodes.ids.resize(all + 1);
  nodes.tags.resize(all + 1);
  nodes.owners.resize(all + 1);
  HUNT_TRY(pnpbs_placement_get_nodes(placement, nodes.own, nodes.coordinates.data(),
                                     nodes.ids.data(), nodes.tags.data(), nodes.spacing.data()));
  if (nodes.dim == 3)
    HUNT_TRY(pnpbs_placement_get_normals(placement, nodes.own, nodes.normals.data()));
  return pnpbs_placement_get_ghosts(
      placement, nodes.ghosts, nodes.coordinates.data() + own * nodes.dim, nodes.ids.data() + own,
      nodes.tags.data() + own, nodes.spacing.data() + own, nodes.owners.data());
}

Sum sum_of_nodes(const Nodes& nodes, bool with_normals) {
  Sum sum = 0;
  for (std::int64_t i = 0; i < nodes.own; ++i) {
    Hash hash;
    hash.add(nodes.ids[i]);
    hash.add(std::int64_t{nodes.tags[i]});
    hash.add(nodes.spacing[i]);
    for (int k = 0; k < nodes.dim; ++k)
      hash.add(with_normals ? nodes.normals[3 * i + k] : nodes.coordinates[nodes.dim * i + k]);
    sum += hash.value();
  }
  return sum;
}

// Counts coordinates of ghosts that differ from those of their owners.
pnpbs_status count_wrong_ghosts(pnpbs_placement placement, const Nodes& nodes, Sum& wrong) {
  const std::int64_t all = nodes.own + nodes.ghosts;
  std::vector<double> told(nodes.coordinates);
  std::fill(told.begin() + nodes.own * nodes.dim, told.end(), -1.0);
  HUNT_TRY(pnpbs_placement_update_ghosts(placement, all, nodes.dim, told.data()));
  for (std::int64_t k = nodes.own * nodes.dim; k < all * nodes.dim; ++k)
    wrong +=
        std::bit_cast<std::uint64_t>(told[k]) != std::bit_cast<std::uint64_t>(nodes.coordinates[k]);
  return PNPBS_OK;
}

pnpbs_status sum_of_lists(pnpbs_placement placement, const Nodes& nodes, Sum& sum) {
  std::int64_t size = 0;
  HUNT_TRY(pnpbs_placement_adjacency_size(placement, &size));
  std::vector<std::int64_t> offsets(nodes.own + 1), neighbours(size + 1);
  HUNT_TRY(pnpbs_placement_get_adjacency(placement, size, offsets.data(), neighbours.data()));
  for (std::int64_t i = 0; i < nodes.own; ++i) {
    Hash hash;
    hash.add(nodes.ids[i]);
    for (std::int64_t k = offsets[i]; k < offsets[i + 1]; ++k) hash.add(nodes.ids[neighbours[k]]);
    sum += hash.value();
  }
  return PNPBS_OK;
}

// Hashes the stars. In the plane, neighbours are in cyclic order from the smallest id; in space, in
// the order of ids.
pnpbs_status sum_of_stars(pnpbs_placement placement, const Nodes& nodes, Sum& sum) {
  std::int64_t size = 0;
  HUNT_TRY(pnpbs_placement_star_size(placement, &size));
  std::vector<std::int64_t> offsets(nodes.own + 1), neighbours(size + 1);
  std::vector<std::int8_t> triangle(size + 1);
  HUNT_TRY(pnpbs_placement_get_stars(placement, size, offsets.data(), neighbours.data(),
                                     triangle.data()));
  for (std::int64_t i = 0; i < nodes.own; ++i) {
    std::vector<std::pair<std::int64_t, std::int8_t>> star;
    for (std::int64_t k = offsets[i]; k < offsets[i + 1]; ++k)
      star.emplace_back(nodes.ids[neighbours[k]], triangle[k]);
    if (nodes.dim == 3)
      std::sort(star.begin(), star.end());
    else
      std::rotate(star.begin(), std::min_element(star.begin(), star.end()), star.end());
    Hash hash;
    hash.add(nodes.ids[i]);
    for (const auto& [id, is_triangle] : star) {
      hash.add(id);
      hash.add(std::int64_t{is_triangle});
    }
    sum += hash.value();
  }
  return PNPBS_OK;
}

// Hashes elements by the ids of their corners. Triangles are rotated to begin with the smallest id,
// and corners of tetrahedra are sorted by id.
Sum sum_of_elements(const Nodes& nodes, std::vector<std::int64_t>& corners, std::int64_t count,
                    int each, const std::vector<std::int32_t>& tags) {
  Sum sum = 0;
  for (std::int64_t e = 0; e < count; ++e) {
    std::int64_t* const begin = corners.data() + e * each;
    std::transform(begin, begin + each, begin, [&](std::int64_t i) { return nodes.ids[i]; });
    if (each == 3)
      std::rotate(begin, std::min_element(begin, begin + each), begin + each);
    else
      std::sort(begin, begin + each);
    Hash hash;
    for (int k = 0; k < each; ++k) hash.add(begin[k]);
    hash.add(std::int64_t{tags[e]});
    sum += hash.value();
  }
  return sum;
}

enum class Elements { elements, boundary };

pnpbs_status get(pnpbs_placement placement, int dim, Elements which, std::int64_t capacity,
                 std::int64_t* count, std::int64_t* corners, std::int32_t* tags) {
  if (which == Elements::elements)
    return dim == 2 ? pnpbs_placement_get_triangles(placement, capacity, count, corners)
                    : pnpbs_placement_get_tetrahedra(placement, capacity, count, corners);
  return dim == 2
             ? pnpbs_placement_get_boundary_edges(placement, capacity, count, corners, tags)
             : pnpbs_placement_get_boundary_triangles(placement, capacity, count, corners, tags);
}

pnpbs_status sum_of(pnpbs_placement placement, const Nodes& nodes, Elements which, Sum& sum) {
  const int each = which == Elements::elements ? nodes.dim + 1 : nodes.dim;
  std::int64_t count = 0;
  HUNT_TRY(get(placement, nodes.dim, which, 0, &count, nullptr, nullptr));
  std::vector<std::int64_t> corners(count * each + 1);
  std::vector<std::int32_t> tags(count + 1);
  HUNT_TRY(get(placement, nodes.dim, which, count, &count, corners.data(), tags.data()));
  sum = sum_of_elements(nodes, corners, count, each, tags);
  return PNPBS_OK;
}

}  // namespace

std::uint64_t hash_of(const std::string& text) {
  Hash hash;
  for (const char c : text) hash.add(std::int64_t{c});
  return hash.value();
}

pnpbs_status for_result_hashes(
    pnpbs_placement placement,
    const std::function<void(const char* name, std::uint64_t sum)>& take) {
  Nodes nodes;
  Sum wrong = 0, lists = 0, stars = 0, elements = 0, boundary = 0;
  HUNT_TRY(read(placement, nodes));
  take("nodes", sum_of_nodes(nodes, false));
  if (nodes.dim == 3) take("normals", sum_of_nodes(nodes, true));
  HUNT_TRY(count_wrong_ghosts(placement, nodes, wrong));
  take("wrong-ghosts", wrong);
  HUNT_TRY(sum_of_lists(placement, nodes, lists));
  take("lists", lists);
  HUNT_TRY(sum_of_stars(placement, nodes, stars));
  take("stars", stars);
  HUNT_TRY(sum_of(placement, nodes, Elements::elements, elements));
  take("elements", elements);
  HUNT_TRY(sum_of(placement, nodes, Elements::boundary, boundary));
  take("boundary", boundary);
  return PNPBS_OK;
}

}  // namespace hunt
