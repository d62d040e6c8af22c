// SPDX-License-Identifier: BSD-3-Clause
#include "level/ghost_stars.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <exception>
#include <span>
#include <utility>
#include <vector>

#include "base/index_by_id.hpp"
#include "comm/records.hpp"
#include "neighbors/rings.hpp"

namespace pnpbs {

namespace {

std::size_t index(std::int64_t i) { return static_cast<std::size_t>(i); }

// Packs a star into 64-bit words: a distance within which all its nodes lie, the number of the
// following words, and the star with ids in place of nodes.
void pack_star(const Level<3>& level, std::int32_t i, const Translation<3>& to, Bytes& bytes) {
  constexpr double kRoundingMargin = 1 + 1e-9;
  const Nodes<3>& nodes = level.nodes;
  double square = 0;
  level.stars.for_neighbours(i, [&](std::int64_t j) {
    square = std::max(square, squared_distance<3>(nodes.position(i), nodes.position(j)));
  });
  const std::span<const std::int32_t> star = level.stars.row(i);
  std::vector<std::int64_t> words{std::bit_cast<std::int64_t>(kRoundingMargin * std::sqrt(square)),
                                  std::ssize(star)};
  VolumeStars::renumber(
      star, [&](std::int32_t j) { return to.id(nodes.id(j)); }, words);
  for (const std::int64_t word : words) pack(bytes, word);
}

// Calls visit(i, reach, star) for each star in the messages, with ids in place of nodes.
template <class Visit>
void for_stars(const std::vector<GhostData>& received, const Visit& visit) {
  for (const GhostData& data : received) {
    if (data.ghosts.empty()) continue;  // an empty message has no address to copy from
    std::vector<std::int64_t> words(data.bytes.size() / sizeof(std::int64_t));
    std::memcpy(words.data(), data.bytes.data(), data.bytes.size());
    std::size_t at = 0;
    for (const std::int32_t i : data.ghosts) {
      const std::span<const std::int64_t> star(words.data() + at + 2, index(words[at + 1]));
      visit(i, std::bit_cast<double>(words[at]), star);
      at += 2 + star.size();
    }
  }
}

// Stores the stars in the messages, or requests the nodes that they lack.
void store_stars(const std::vector<GhostData>& received, const IndexById& by_id,
                 FunctionRef<void(std::int64_t, double)> request, VolumeStars& stars,
                 std::int64_t count) {
  constexpr std::int32_t kUnknown = -1;
  std::vector<std::int32_t> rows;
  std::vector<std::pair<std::size_t, std::size_t>> row_of(index(count));
  std::vector<char> complete(index(count), 0);
  for_stars(received, [&](std::int32_t i, double reach, std::span<const std::int64_t> star) {
    const std::size_t first = rows.size();
    VolumeStars::renumber(
        star, [&](std::int64_t id) { return by_id.of(id); }, rows);
    const auto begin = rows.begin() + static_cast<std::ptrdiff_t>(first);
    complete[index(i)] = std::find(begin, rows.end(), kUnknown) == rows.end();
    row_of[index(i)] = {first, rows.size()};
    if (!complete[index(i)]) request(i, reach);
  });
  stars.replace(complete, [&](std::int64_t i, std::vector<std::int32_t>& out) {
    const auto [first, last] = row_of[index(i)];
    out.insert(out.end(), rows.data() + first, rows.data() + last);
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
