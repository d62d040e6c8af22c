// SPDX-License-Identifier: BSD-3-Clause
#include "stars/delaunay_stars.hpp"

#include <algorithm>
#include <limits>

#include "stars/constrained_star.hpp"
#include "stars/hull_star.hpp"

namespace pnpbs {

namespace {

double least_spacing_around(const Buckets<2>& buckets, std::int32_t bucket) {
  double least = std::numeric_limits<double>::infinity();
  buckets.for_neighbours(
      bucket, [&](std::int32_t b) { least = std::min(least, buckets.least_spacing(b)); });
  return least;
}

}  // namespace

void DelaunayStars::build(const StarInput& input) {
  const Nodes<2>& nodes = input.nodes;
  const std::int64_t chunks = (nodes.count + kChunkNodes - 1) / kChunkNodes;
  chunks_.resize(static_cast<std::size_t>(chunks));
  for_each_guarded("pnpbs::DelaunayStars::build", chunks, [&](std::int64_t c) {
    Chunk& chunk = chunks_[static_cast<std::size_t>(c)];
    chunk.entries.clear();
    std::vector<StarPoint> around;
    std::int32_t bucket = -1;
    double least = 0;
    for (std::int64_t k = 0; k < kChunkNodes; ++k) {
      chunk.offset[static_cast<std::size_t>(k)] = static_cast<std::int32_t>(chunk.entries.size());
      const std::int64_t i = c * kChunkNodes + k;
      if (i >= nodes.count) continue;
      if (input.buckets.bucket_of(i) != bucket) {
        bucket = input.buckets.bucket_of(i);
        least = least_spacing_around(input.buckets, bucket);
      }
      // The lists hold every node nearer than this.
      const double reach = 0.5 * input.lists.radius() * (nodes.d(i) + least);
      bool found = false;
      if (!input.near_edges.any(i)) {
        around.clear();
        input.lists.for_neighbours(i, [&](std::int64_t j) {
          around.push_back({nodes.position(j), nodes.id(j), static_cast<std::int32_t>(j)});
        });
        found = hull_star({nodes.position(i), nodes.id(i), static_cast<std::int32_t>(i)}, reach,
                          around);
        if (found)
          for (const StarPoint& p : around)
            chunk.entries.push_back({static_cast<std::uint32_t>(p.node), 1});
      }
      if (!found) constrained_star(input, i, std::max(reach, nodes.d(i)), chunk.entries);
    }
    chunk.offset[kChunkNodes] = static_cast<std::int32_t>(chunk.entries.size());
  });
}

}  // namespace pnpbs
