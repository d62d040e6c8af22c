// SPDX-License-Identifier: BSD-3-Clause
#include "geo/chains.hpp"

#include <algorithm>

#include "base/error.hpp"

namespace pnpbs::geo {
namespace {

using Index = std::int64_t;

// The edges at every place.
class Incidence {
 public:
  Incidence(const std::vector<Edge>& edges, Index places)
      : begin_(static_cast<std::size_t>(places) + 1, 0), edges_(2 * edges.size()) {
    for (const Edge& edge : edges) ++begin_[edge.begin + 1], ++begin_[edge.end + 1];
    for (std::size_t p = 1; p < begin_.size(); ++p) begin_[p] += begin_[p - 1];
    std::vector<Index> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t e = 0; e < edges.size(); ++e)
      for (const Index place : {edges[e].begin, edges[e].end})
        edges_[next[place]++] = static_cast<Index>(e);
  }

  Index degree(Index place) const { return begin_[place + 1] - begin_[place]; }
  const Index* at(Index place) const { return edges_.data() + begin_[place]; }

 private:
  std::vector<Index> begin_, edges_;
};

Index other_end(const Edge& edge, Index place) {
  return edge.begin == place ? edge.end : edge.begin;
}

// Marks what is left of the edges when all those are taken away, again and again, that end where
// no other does.
std::vector<char> without_branches(const std::vector<Edge>& edges, const Incidence& incidence,
                                   std::vector<Index>& degree) {
  std::vector<char> left(edges.size(), 1);
  std::vector<Index> loose;
  for (std::size_t p = 0; p < degree.size(); ++p)
    if (degree[p] == 1) loose.push_back(static_cast<Index>(p));
  while (!loose.empty()) {
    const Index place = loose.back();
    loose.pop_back();
    for (Index k = 0; k < incidence.degree(place); ++k) {
      const Index e = incidence.at(place)[k];
      if (!left[e]) continue;
      left[e] = 0;
      --degree[place];
      const Index other = other_end(edges[e], place);
      if (--degree[other] == 1) loose.push_back(other);
    }
  }
  return left;
}

class ChainMaker {
 public:
  ChainMaker(const std::vector<Edge>& edges, Index places)
      : edges_(edges), incidence_(edges, places), used_(edges.size(), 0) {}

  std::vector<Curve> run() {
    std::vector<Curve> chains;
    for (Index e = 0; e < static_cast<Index>(edges_.size()); ++e)
      if (!used_[e]) chains.push_back(chain_with(e));
    return chains;
  }

 private:
  // Where one curve goes on: two edges of the same role meet, and no other.
  bool is_passed(Index place) const {
    if (incidence_.degree(place) != 2) return false;
    const Index* edges = incidence_.at(place);
    return edges_[edges[0]].role == edges_[edges[1]].role;
  }

  Index next_edge(Index place, Index edge) const {
    const Index* edges = incidence_.at(place);
    return edges[0] == edge ? edges[1] : edges[0];
  }

  // Back along the curve to where it begins; all around it, if it is closed, to where it is.
  std::pair<Index, Index> begin_of(Index edge) const {
    Index at = edge, place = edges_[edge].begin;
    while (is_passed(place)) {
      const Index before = next_edge(place, at);
      if (before == edge) return {edge, edges_[edge].begin};
      place = other_end(edges_[before], place);
      at = before;
    }
    return {at, place};
  }

  Curve chain_with(Index edge) {
    auto [at, place] = begin_of(edge);
    Curve curve{edges_[at].role == EdgeRole::boundary, false, {place}, {}};
    for (;;) {
      used_[at] = 1;
      curve.tags.push_back(edges_[at].tag);
      place = other_end(edges_[at], place);
      if (place == curve.places.front()) {
        curve.closed = true;
        return curve;
      }
      curve.places.push_back(place);
      if (!is_passed(place)) return curve;
      at = next_edge(place, at);
    }
  }

  const std::vector<Edge>& edges_;
  Incidence incidence_;
  std::vector<char> used_;
};

}  // namespace

void settle_lines(std::vector<Edge>& edges, std::int64_t places, bool beside_polygons,
                  const WordsFor& where) {
  std::vector<char> closed(edges.size(), 0);
  if (!beside_polygons) {
    const Incidence incidence(edges, places);
    std::vector<Index> degree(static_cast<std::size_t>(places));
    for (Index p = 0; p < places; ++p) degree[p] = incidence.degree(p);
    closed = without_branches(edges, incidence, degree);
    const auto odd = std::find_if(degree.begin(), degree.end(), [](Index d) { return d % 2 != 0; });
    if (odd != degree.end())
      throw Error(ErrorKind::domain, std::to_string(*odd) + " lines that are closed meet at " +
                                         where(odd - degree.begin()) +
                                         ": they do not tell what is inside; polygons would");
  }
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (edges[e].role == EdgeRole::line)
      edges[e].role = closed[e] ? EdgeRole::boundary : EdgeRole::inner;
}

std::vector<Curve> chains_of(const std::vector<Edge>& edges, std::int64_t places) {
  return ChainMaker(edges, places).run();
}

}  // namespace pnpbs::geo
