// SPDX-License-Identifier: BSD-3-Clause
#include "domain/plane/small_loops.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/limits.hpp"
#include "geometry/plane/point_tree.hpp"
#include "predicates/plane.hpp"

namespace pnpbs {

namespace {

class SmallLoops {
 public:
  SmallLoops(const DomainGraph& graph, const std::vector<Chain>& chains,
             const std::vector<double>& d, const std::vector<char>& may_go)
      : graph_(graph), chains_(chains), d_(d), may_go_(may_go) {
    for (const Chain& chain : chains) {
      begins_.push_back(position(chain.vertices.front()));
      boxes_.push_back(empty_box<2>());
      for (const std::int32_t v : chain.vertices) include(boxes_.back(), position(v));
    }
  }

  // From the smallest on: what lies within a loop has been judged before it.
  std::vector<char> run(double smallest) {
    goes_.assign(chains_.size(), 0);
    std::vector<std::size_t> order(chains_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t c) { return size_of(boxes_[c]); });
    if (!order.empty()) order.pop_back();
    for (const GraphVertex& vertex : graph_.vertices)
      if (vertex.degree == 0) begins_.push_back(vertex.position);
    const PointTree begins(begins_);
    for (const std::size_t c : order)
      if (is_small(c, smallest) && !holds_what_stays(c, begins)) goes_[c] = 1;
    return std::move(goes_);
  }

 private:
  const Point<2>& position(std::int32_t vertex) const { return graph_.vertices[vertex].position; }

  bool is_small(std::size_t c, double smallest) const {
    const Chain& chain = chains_[c];
    if (!chain.closed) return false;
    double sum = 0;
    for (std::size_t k = 1; k < chain.vertices.size(); ++k) {
      if (!may_go_[chain.vertices[k]]) return false;
      sum += d_[chain.vertices[k]];
    }
    return size_of(boxes_[c]) < smallest * sum / static_cast<double>(chain.edges.size());
  }

  bool holds_what_stays(std::size_t c, const PointTree& begins) const {
    const Box<2>& box = boxes_[c];
    const Point<2> centre{std::midpoint(box.low[0], box.high[0]),
                          std::midpoint(box.low[1], box.high[1])};
    bool holds = false;
    begins.for_each_near(centre, centre, size_of(box), [&](std::int32_t which, double) {
      const auto other = static_cast<std::size_t>(which);
      if (holds || other == c) return;
      if (other < chains_.size() && goes_[other]) return;
      holds = is_within(begins_[other], chains_[c], graph_);
    });
    return holds;
  }

  const DomainGraph& graph_;
  const std::vector<Chain>& chains_;
  const std::vector<double>& d_;
  const std::vector<char>& may_go_;
  std::vector<Box<2>> boxes_;
  std::vector<Point<2>> begins_;  // a point of each chain, then vertices that end no edge
  std::vector<char> goes_;
};

}  // namespace

std::vector<char> small_loops(const DomainGraph& graph, const std::vector<Chain>& chains,
                              const std::vector<double>& d, const std::vector<char>& may_go,
                              double smallest) {
  return SmallLoops(graph, chains, d, may_go).run(smallest);
}

bool is_within(const Point<2>& point, const Chain& chain, const DomainGraph& graph) {
  bool within = false;
  for (std::size_t k = 0; k + 1 < chain.vertices.size(); ++k) {
    const Point<2>& a = graph.vertices[chain.vertices[k]].position;
    const Point<2>& b = graph.vertices[chain.vertices[k + 1]].position;
    if ((a[1] > point[1]) == (b[1] > point[1])) continue;
    const int side = orientation(a, b, point);
    if ((b[1] > a[1]) == (side > 0)) within = !within;
  }
  return within;
}

}  // namespace pnpbs
