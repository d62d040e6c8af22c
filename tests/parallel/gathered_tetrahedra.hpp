// SPDX-License-Identifier: BSD-3-Clause
// Gathers the results of a placement in space from all ranks of the group on rank 0, which is
// acceptable only in a test.
#pragma once

#include "gathered_triangulation.hpp"

namespace gathered {

using Ids4 = std::array<std::int64_t, 4>;

struct SpaceNode {
  std::int64_t id;
  std::array<double, 3> x;
  double d;
  std::int32_t tag, owner;
};

struct OwnedTetrahedron {
  Ids4 ids;
  std::int32_t rank;
};

struct Volume {
  std::vector<SpaceNode> nodes;   // by id
  std::vector<SpaceNode> ghosts;  // of all ranks
  std::vector<OwnedTetrahedron> tetrahedra;
  std::vector<Ids3> boundary;                                // triangles
  std::vector<std::array<std::int64_t, 2>> star_neighbours;  // (node, neighbour) of every star
};

// Returns the nodes of this rank, then its ghosts, in the order of local indices.
inline std::vector<SpaceNode> local_space_nodes(pnpbs_placement p, std::int64_t& owned) {
  std::int64_t ghosts;
  require(pnpbs_placement_ghost_count(p, &ghosts), "ghost count");
  require(pnpbs_placement_count(p, &owned), "count");
  const std::int64_t max = std::max(owned, ghosts);
  const auto room = static_cast<std::size_t>(max);
  std::vector<double> xyz(3 * room), d(room);
  std::vector<std::int64_t> ids(room);
  std::vector<std::int32_t> tags(room), owners(room, rank);
  std::vector<SpaceNode> nodes;
  const auto append = [&](std::int64_t n) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i)
      nodes.push_back(
          {ids[i], {xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]}, d[i], tags[i], owners[i]});
  };
  require(pnpbs_placement_get_nodes(p, max, xyz.data(), ids.data(), tags.data(), d.data()),
          "nodes");
  append(owned);
  require(pnpbs_placement_get_ghosts(p, max, xyz.data(), ids.data(), tags.data(), d.data(),
                                     owners.data()),
          "ghosts");
  append(ghosts);
  return nodes;
}

inline std::int64_t id_at(const std::vector<SpaceNode>& nodes, std::int64_t local) {
  require(local >= 0 && local < static_cast<std::int64_t>(nodes.size()), "a node is not local");
  return nodes[static_cast<std::size_t>(local)].id;
}

inline std::vector<OwnedTetrahedron> local_tetrahedra(pnpbs_placement p,
                                                      const std::vector<SpaceNode>& nodes) {
  std::int64_t count;
  require(pnpbs_placement_get_tetrahedra(p, 0, &count, nullptr), "tetrahedron count");
  std::vector<std::int64_t> corners(4 * static_cast<std::size_t>(count) + 1);
  require(pnpbs_placement_get_tetrahedra(p, count, &count, corners.data()), "tetrahedra");
  std::vector<OwnedTetrahedron> tetrahedra(static_cast<std::size_t>(count));
  for (std::size_t t = 0; t < tetrahedra.size(); ++t) {
    for (std::size_t k = 0; k < 4; ++k) tetrahedra[t].ids[k] = id_at(nodes, corners[4 * t + k]);
    tetrahedra[t].rank = rank;
  }
  return tetrahedra;
}

inline std::vector<Ids3> local_boundary_triangles(pnpbs_placement p,
                                                  const std::vector<SpaceNode>& nodes) {
  std::int64_t count;
  require(pnpbs_placement_get_boundary_triangles(p, 0, &count, nullptr, nullptr), "boundary count");
  std::vector<std::int64_t> corners(3 * static_cast<std::size_t>(count) + 1);
  require(pnpbs_placement_get_boundary_triangles(p, count, &count, corners.data(), nullptr),
          "boundary");
  std::vector<Ids3> triangles(static_cast<std::size_t>(count));
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) triangles[t][k] = id_at(nodes, corners[3 * t + k]);
  return triangles;
}

inline std::vector<std::array<std::int64_t, 2>> local_star_neighbours(
    pnpbs_placement p, const std::vector<SpaceNode>& nodes, std::int64_t owned) {
  std::int64_t entries;
  require(pnpbs_placement_star_size(p, &entries), "star size");
  std::vector<std::int64_t> offsets(static_cast<std::size_t>(owned) + 1),
      neighbours(static_cast<std::size_t>(entries) + 1);
  require(pnpbs_placement_get_stars(p, entries, offsets.data(), neighbours.data(), nullptr),
          "stars");
  std::vector<std::array<std::int64_t, 2>> pairs;
  for (std::size_t i = 0; i < static_cast<std::size_t>(owned); ++i)
    for (std::int64_t k = offsets[i]; k < offsets[i + 1]; ++k)
      pairs.push_back({nodes[i].id, id_at(nodes, neighbours[static_cast<std::size_t>(k)])});
  return pairs;
}

// Gathers all results. The result is complete on rank 0. Collective.
inline Volume gather_volume(pnpbs_placement p) {
  std::int64_t owned;
  const std::vector<SpaceNode> nodes = local_space_nodes(p, owned);
  Volume all;
  all.tetrahedra = on_rank_0(local_tetrahedra(p, nodes));
  all.boundary = on_rank_0(local_boundary_triangles(p, nodes));
  all.star_neighbours = on_rank_0(local_star_neighbours(p, nodes, owned));
  all.nodes = on_rank_0(std::vector<SpaceNode>(nodes.begin(), nodes.begin() + owned));
  all.ghosts = on_rank_0(std::vector<SpaceNode>(nodes.begin() + owned, nodes.end()));
  std::sort(all.nodes.begin(), all.nodes.end(),
            [](const SpaceNode& a, const SpaceNode& b) { return a.id < b.id; });
  return all;
}

}  // namespace gathered
