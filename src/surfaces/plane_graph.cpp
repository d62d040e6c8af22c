// SPDX-License-Identifier: BSD-3-Clause
#include "surfaces/plane_graph.hpp"

#include <algorithm>
#include <utility>

#include "base/index.hpp"
#include "base/limits.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

namespace {

using Segment = std::array<std::int32_t, 2>;

class SegmentSplitter {
 public:
  SegmentSplitter(ExactPoints& points, int k, std::vector<Segment> segments)
      : points_(points), k_(k), segments_(std::move(segments)), boxes_(segments_.size()) {
    for (Segment& segment : segments_)
      if (points_.precedes(k_, segment[1], segment[0])) std::swap(segment[0], segment[1]);
    std::sort(segments_.begin(), segments_.end());
    segments_.erase(std::unique(segments_.begin(), segments_.end()), segments_.end());
    boxes_.clear();
    for (const auto& [a, b] : segments_) {
      boxes_.push_back(empty_box<2>());
      for (const std::int32_t end : {a, b})
        include(boxes_.back(), projection(k_, points_.position(end)));
    }
  }

  PlaneGraph run() {
    find_meeting();
    // After sorting, the points within each segment are consecutive.
    std::sort(within_.begin(), within_.end());
    within_.erase(std::unique(within_.begin(), within_.end()), within_.end());
    PlaneGraph graph;
    std::vector<Segment> edges;
    std::vector<std::int32_t> along;
    auto next = within_.begin();
    for (std::size_t s = 0; s < segments_.size(); ++s) {
      along = {segments_[s][0], segments_[s][1]};
      for (; next != within_.end() && next->first == s; ++next) along.push_back(next->second);
      sort(along);
      graph.points.insert(graph.points.end(), along.begin(), along.end());
      for (std::size_t i = 1; i < along.size(); ++i) edges.push_back({along[i - 1], along[i]});
    }
    sort(graph.points);
    const std::vector<std::pair<std::int32_t, std::int32_t>> index_of = indices(graph.points);
    for (Segment& edge : edges)
      for (std::int32_t& end : edge)
        end = std::lower_bound(index_of.begin(), index_of.end(), std::pair(end, 0))->second;
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    graph.edges = std::move(edges);
    return graph;
  }

 private:
  // Sorts distinct points in the lexicographic order of the projection.
  void sort(std::vector<std::int32_t>& points) const {
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    std::sort(points.begin(), points.end(),
              [&](std::int32_t a, std::int32_t b) { return points_.precedes(k_, a, b); });
  }

  static std::vector<std::pair<std::int32_t, std::int32_t>> indices(
      const std::vector<std::int32_t>& points) {
    std::vector<std::pair<std::int32_t, std::int32_t>> indices;
    for (std::size_t i = 0; i < points.size(); ++i)
      indices.emplace_back(points[i], static_cast<std::int32_t>(i));
    std::sort(indices.begin(), indices.end());
    return indices;
  }

  void find_meeting() {
    constexpr std::size_t kFew = 24;  // A tree does not pay for so few segments.
    const std::size_t count = segments_.size();
    if (count <= kFew) {
      for (std::size_t s = 0; s < count; ++s)
        for (std::size_t t = s + 1; t < count; ++t)
          if (boxes_meet(boxes_[s], boxes_[t])) meet(s, t);
      return;
    }
    const BoxTree<2> tree(boxes_);
    std::vector<std::size_t> others;
    for (std::size_t s = 0; s < count; ++s) {
      others.clear();
      tree.for_meeting(boxes_[s], [&](std::int32_t t) {
        if (index(t) > s) others.push_back(index(t));
      });
      std::sort(others.begin(), others.end());
      for (const std::size_t t : others) meet(s, t);
    }
  }

  // Splits two segments where they meet.
  void meet(std::size_t s, std::size_t t) {
    const auto [a, b] = segments_[s];
    const auto [c, d] = segments_[t];
    const int side_c = points_.orientation(k_, a, b, c), side_d = points_.orientation(k_, a, b, d);
    if (side_c * side_d > 0) return;
    const int side_a = points_.orientation(k_, c, d, a), side_b = points_.orientation(k_, c, d, b);
    if (side_a * side_b > 0) return;
    if (side_c * side_d < 0 && side_a * side_b < 0) {
      const std::int32_t x = points_.on_lines(k_, a, b, c, d);
      within_.emplace_back(s, x);
      within_.emplace_back(t, x);
      return;
    }
    if (side_c == 0) add_if_between(s, c);
    if (side_d == 0) add_if_between(s, d);
    if (side_a == 0) add_if_between(t, a);
    if (side_b == 0) add_if_between(t, b);
  }

  // Adds a point that lies on the line of a segment if it lies between its ends.
  void add_if_between(std::size_t s, std::int32_t p) {
    const auto& [a, b] = segments_[s];
    if (p != a && p != b && points_.precedes(k_, a, p) && points_.precedes(k_, p, b))
      within_.emplace_back(s, p);
  }

  ExactPoints& points_;
  int k_;
  std::vector<Segment> segments_;  // each in lexicographic order
  std::vector<Box<2>> boxes_;
  std::vector<std::pair<std::size_t, std::int32_t>> within_;  // a segment and a point within it
};

}  // namespace

PlaneGraph split_segments(ExactPoints& points, int k,
                          std::vector<std::array<std::int32_t, 2>> segments) {
  return SegmentSplitter(points, k, std::move(segments)).run();
}

}  // namespace pnpbs
