// SPDX-License-Identifier: BSD-3-Clause
// Gathers the results of a placement in the plane from all ranks of the group on rank 0, which is
// acceptable only in a test.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

extern "C" {
#include "rank_program.h"
}

namespace gathered {

using Ids3 = std::array<std::int64_t, 3>;

struct Node {
  std::int64_t id;
  double x, y;
  std::int32_t owner;
};

struct Edge {
  std::int64_t begin, end;  // ids
  std::int32_t tag;
};

struct Triangulation {
  std::vector<Node> nodes;           // by id
  std::vector<Node> ghosts;          // of all ranks
  std::vector<Ids3> triangles;       // counter-clockwise, as returned
  std::vector<Ids3> star_triangles;  // (node, neighbour, next neighbour) of every star
  std::vector<Edge> boundary_edges;
};

inline void require(bool condition, const char* what) {
  if (condition) return;
  std::fprintf(stderr, "rank %d of %d: %s; last error: %s\n", rank, size, what,
               pnpbs_last_error(nullptr));
  MPI_Abort(MPI_COMM_WORLD, 1);
}

inline void require(pnpbs_status status, const char* what) { require(status >= 0, what); }

template <class T>
std::vector<T> on_rank_0(const std::vector<T>& mine) {
  const int bytes = static_cast<int>(mine.size() * sizeof(T));
  std::vector<int> counts(static_cast<std::size_t>(size)), starts(counts.size(), 0);
  MPI_Gather(&bytes, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, group);
  for (std::size_t r = 1; r < counts.size(); ++r) starts[r] = starts[r - 1] + counts[r - 1];
  std::vector<T> all(rank == 0 ? static_cast<std::size_t>(starts.back() + counts.back()) / sizeof(T)
                               : 0);
  MPI_Gatherv(mine.data(), bytes, MPI_BYTE, all.data(), counts.data(), starts.data(), MPI_BYTE, 0,
              group);
  return all;
}

// Returns the nodes of this rank, then its ghosts, in the order of local indices.
inline std::vector<Node> local_nodes(pnpbs_placement p, std::int64_t& owned) {
  std::int64_t ghosts;
  require(pnpbs_placement_ghost_count(p, &ghosts), "ghost count");
  require(pnpbs_placement_count(p, &owned), "count");
  const std::int64_t max = std::max(owned, ghosts);
  std::vector<double> xy(2 * static_cast<std::size_t>(max));
  std::vector<std::int64_t> ids(static_cast<std::size_t>(max));
  std::vector<std::int32_t> owners(static_cast<std::size_t>(max));
  std::vector<Node> nodes;
  const auto append = [&](std::int64_t n) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i)
      nodes.push_back({ids[i], xy[2 * i], xy[2 * i + 1], owners[i]});
  };
  require(pnpbs_placement_get_nodes(p, max, xy.data(), ids.data(), nullptr, nullptr), "nodes");
  std::fill(owners.begin(), owners.end(), rank);
  append(owned);
  require(
      pnpbs_placement_get_ghosts(p, max, xy.data(), ids.data(), nullptr, nullptr, owners.data()),
      "ghosts");
  append(ghosts);
  return nodes;
}

inline std::vector<Ids3> local_triangles(pnpbs_placement p, const std::vector<Node>& nodes) {
  std::int64_t count;
  require(pnpbs_placement_get_triangles(p, 0, &count, nullptr), "triangle count");
  std::vector<std::int64_t> corners(3 * static_cast<std::size_t>(count) + 1);
  require(pnpbs_placement_get_triangles(p, count, &count, corners.data()), "triangles");
  std::vector<Ids3> triangles(static_cast<std::size_t>(count));
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int64_t corner = corners[3 * t + k];
      require(corner >= 0 && corner < static_cast<std::int64_t>(nodes.size()),
              "a corner of a triangle is not local");
      triangles[t][k] = nodes[static_cast<std::size_t>(corner)].id;
    }
  return triangles;
}

inline std::vector<Ids3> local_star_triangles(pnpbs_placement p, const std::vector<Node>& nodes,
                                              std::int64_t owned) {
  std::int64_t entries;
  require(pnpbs_placement_star_size(p, &entries), "star size");
  std::vector<std::int64_t> offsets(static_cast<std::size_t>(owned) + 1),
      neighbours(static_cast<std::size_t>(entries) + 1);
  std::vector<std::int8_t> triangle(neighbours.size());
  require(pnpbs_placement_get_stars(p, entries, offsets.data(), neighbours.data(), triangle.data()),
          "stars");
  const auto id = [&](std::int64_t k) {
    const std::int64_t j = neighbours[static_cast<std::size_t>(k)];
    require(j >= 0 && j < static_cast<std::int64_t>(nodes.size()), "a neighbour is not local");
    return nodes[static_cast<std::size_t>(j)].id;
  };
  std::vector<Ids3> triangles;
  for (std::size_t i = 0; i < static_cast<std::size_t>(owned); ++i)
    for (std::int64_t k = offsets[i]; k < offsets[i + 1]; ++k)
      if (triangle[static_cast<std::size_t>(k)])
        triangles.push_back({nodes[i].id, id(k), id(k + 1 < offsets[i + 1] ? k + 1 : offsets[i])});
  return triangles;
}

inline std::vector<Edge> local_boundary_edges(pnpbs_placement p, const std::vector<Node>& nodes) {
  std::int64_t count;
  require(pnpbs_placement_get_boundary_edges(p, 0, &count, nullptr, nullptr), "edge count");
  std::vector<std::int64_t> ends(2 * static_cast<std::size_t>(count) + 1);
  std::vector<std::int32_t> tags(static_cast<std::size_t>(count) + 1);
  require(pnpbs_placement_get_boundary_edges(p, count, &count, ends.data(), tags.data()), "edges");
  std::vector<Edge> edges;
  for (std::size_t e = 0; e < static_cast<std::size_t>(count); ++e) {
    for (const std::int64_t end : {ends[2 * e], ends[2 * e + 1]})
      require(end >= 0 && end < static_cast<std::int64_t>(nodes.size()),
              "an end of a boundary edge is not local");
    edges.push_back({nodes[static_cast<std::size_t>(ends[2 * e])].id,
                     nodes[static_cast<std::size_t>(ends[2 * e + 1])].id, tags[e]});
  }
  return edges;
}

// Gathers all results. The result is complete on rank 0. Collective.
inline Triangulation gather(pnpbs_placement p) {
  std::int64_t owned;
  const std::vector<Node> nodes = local_nodes(p, owned);
  require(pnpbs_placement_check(p), "check of the results");
  const std::vector<Ids3> triangles = local_triangles(p, nodes);
  Triangulation all;
  all.nodes = on_rank_0(std::vector<Node>(nodes.begin(), nodes.begin() + owned));
  all.ghosts = on_rank_0(std::vector<Node>(nodes.begin() + owned, nodes.end()));
  all.triangles = on_rank_0(triangles);
  all.star_triangles = on_rank_0(local_star_triangles(p, nodes, owned));
  all.boundary_edges = on_rank_0(local_boundary_edges(p, nodes));
  std::sort(all.nodes.begin(), all.nodes.end(),
            [](const Node& a, const Node& b) { return a.id < b.id; });
  return all;
}

}  // namespace gathered
