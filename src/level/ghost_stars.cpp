// SPDX-License-Identifier: BSD-3-Clause
#include "level/ghost_stars.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <exception>
#include <span>
#include <vector>

#include "base/index_by_id.hpp"
#include "comm/records.hpp"
#include "neighbors/rings.hpp"

namespace pnpbs {

namespace {

std::size_t index(std::int64_t i) { return static_cast<std::size_t>(i); }

// Packs a star: a distance within which all its nodes lie, its length, and the star with ids in
// place of nodes.
void pack_star(const Level<3>& level, std::int32_t i, const Translation<3>& to, Bytes& bytes) {
  constexpr double kRoundingMargin = 1 + 1e-9;
  const Nodes<3>& nodes = level.nodes;
  double square = 0;
  level.stars.for_neighbours(i, [&](std::int64_t j) {
    square = std::max(square, squared_distance<3>(nodes.position(i), nodes.position(j)));
  });
  const std::span<const std::int32_t> star = level.stars.row(i);
  pack(bytes, kRoundingMargin * std::sqrt(square));
  pack(bytes, static_cast<std::int32_t>(star.size()));
  const std::size_t ids_end = VolumeStars::header_and_nodes(star[0], star.size());
  pack(bytes, star[0]);
  for (std::size_t k = 1; k < ids_end; ++k) pack(bytes, to.id(nodes.id(star[k])));
  for (std::size_t k = ids_end; k < star.size(); ++k) pack(bytes, star[k]);
}

// Appends the star at `at` in a message to `rows`, with the nodes of this rank in place of ids, or
// -1. Advances `at`. Returns the distance within which its nodes lie.
double take_star(const char*& at, const IndexById& by_id, std::vector<std::int32_t>& rows) {
  const auto take = [&at]<class T>(T value) {
    std::memcpy(&value, at, sizeof value);
    at += sizeof value;
    return value;
  };
  const double reach = take(double{});
  const auto size = static_cast<std::size_t>(take(std::int32_t{}));
  const std::int32_t header = take(std::int32_t{});
  const std::size_t ids_end = VolumeStars::header_and_nodes(header, size);
  rows.push_back(header);
  for (std::size_t k = 1; k < ids_end; ++k) rows.push_back(by_id.of(take(std::int64_t{})));
  for (std::size_t k = ids_end; k < size; ++k) rows.push_back(take(std::int32_t{}));
  return reach;
}

// Stores the stars in the messages, or requests the nodes that they lack.
void store_stars(const std::vector<GhostData>& received, const IndexById& by_id,
                 FunctionRef<void(std::int64_t, double)> request, VolumeStars& stars,
                 std::int64_t count) {
  constexpr std::int32_t kUnknown = -1;
  std::vector<const char*> star_at(index(count));
  std::vector<char> complete(index(count), 0);
  std::vector<std::int32_t> star;
  for (const GhostData& data : received) {
    const char* at = data.bytes.data();
    for (const std::int32_t i : data.ghosts) {
      star_at[index(i)] = at;
      star.clear();
      const double reach = take_star(at, by_id, star);
      complete[index(i)] = std::ranges::find(star, kUnknown) == star.end();
      if (!complete[index(i)]) request(i, reach);
    }
  }
  stars.replace(complete, [&](std::int64_t i, std::vector<std::int32_t>& out) {
    const char* at = star_at[index(i)];
    take_star(at, by_id, out);
  });
}

}  // namespace

void receive_ghost_stars(Level<3>& level, int rings,
                         FunctionRef<void(std::int64_t i, double reach)> request) {
  const Nodes<3>& nodes = level.nodes;
  IndexById by_id;
  std::vector<std::int64_t> ring;
  std::vector<char> reached, wanted;
  std::exception_ptr failure;
  attempt(failure, [&] {
    if (rings > 0) by_id = IndexById(nodes);
    reached.assign(nodes.owned.data(), nodes.owned.data() + nodes.count);
    for (std::int64_t i = 0; i < nodes.count; ++i)
      if (nodes.owned(i)) ring.push_back(i);
  });
  for (int r = 0; r < rings; ++r) {
    attempt(failure, [&] {
      ring = next_ring(level.stars, ring, reached);
      wanted.assign(reached.size(), 0);
      for (const std::int64_t i : ring) wanted[index(i)] = 1;
    });
    std::vector<GhostData> received;
    {
      const PhaseTimer timer(level.timers, Phase::exchange);
      received = level.ghosts.receive_from_owners(
          *level.comm, wanted,
          [&](std::int32_t i, const Translation<3>& to, Bytes& bytes) {
            pack_star(level, i, to, bytes);
          },
          failure);
    }
    attempt(failure, [&] { store_stars(received, by_id, request, level.stars, nodes.count); });
  }
  agree_on_failure(*level.comm, failure);
}

}  // namespace pnpbs
