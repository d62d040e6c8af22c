// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/plane/chains.hpp"

#include <cstddef>
#include <utility>

namespace pnpbs {

namespace {

class ChainWalk {
 public:
  ChainWalk(const std::vector<char>& is_break, const std::vector<std::array<std::int32_t, 2>>& ends)
      : is_break_(is_break), ends_(ends), walked_(ends.size(), 0), two_(is_break.size(), {-1, -1}) {
    for (std::size_t e = 0; e < ends.size(); ++e)
      for (const std::int32_t vertex : ends[e]) {
        auto& [first, second] = two_[vertex];
        (first < 0 ? first : second) = static_cast<std::int32_t>(e);
      }
  }

  std::vector<Chain> run() {
    for (std::size_t e = 0; e < ends_.size(); ++e)
      for (const int side : {0, 1})
        if (!walked_[e] && is_break(ends_[e][side])) walk(static_cast<std::int32_t>(e), side);
    for (std::size_t e = 0; e < ends_.size(); ++e)
      if (!walked_[e]) {
        walk(static_cast<std::int32_t>(e), 0);
        chains_.back().closed = true;
      }
    return std::move(chains_);
  }

 private:
  bool is_break(std::int32_t vertex) const { return is_break_[vertex]; }

  void walk(std::int32_t edge, int side) {
    Chain chain;
    std::int32_t at = ends_[edge][side];
    chain.vertices.push_back(at);
    while (!walked_[edge]) {
      walked_[edge] = 1;
      const auto& [a, b] = ends_[edge];
      at = a == at ? b : a;
      chain.edges.push_back(edge);
      chain.vertices.push_back(at);
      if (is_break(at)) break;
      const auto& [first, second] = two_[at];
      edge = first == edge ? second : first;
    }
    chains_.push_back(std::move(chain));
  }

  const std::vector<char>& is_break_;
  const std::vector<std::array<std::int32_t, 2>>& ends_;
  std::vector<char> walked_;                      // One per edge.
  std::vector<std::array<std::int32_t, 2>> two_;  // Two edges of each vertex.
  std::vector<Chain> chains_;
};

}  // namespace

std::vector<Chain> chains_between(const std::vector<char>& is_break,
                                  const std::vector<std::array<std::int32_t, 2>>& ends) {
  return ChainWalk(is_break, ends).run();
}

}  // namespace pnpbs
