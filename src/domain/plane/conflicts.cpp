// SPDX-License-Identifier: BSD-3-Clause
#include "domain/plane/conflicts.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "base/error.hpp"
#include "base/point_text.hpp"
#include "domain/region_points.hpp"
#include "geometry/plane/segments.hpp"
#include "predicates/plane.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

namespace {

struct Conflict {
  MessageText text;
  bool crosses;  // two segments cross or overlap
};

class Conflicts {
 public:
  explicit Conflicts(const SweptGraph& swept) : swept_(swept) {}

  // Returns at most `max` conflicts, each once. The sweep reports only some crossings, since it
  // drops one of two edges that meet; the others are searched for afterwards.
  std::vector<Conflict> list(std::size_t max) const {
    std::vector<Conflict> found;
    const auto add = [&](Conflict conflict) {
      const auto is_same = [&](const Conflict& other) {
        return other.text.text() == conflict.text.text();
      };
      if (found.size() < max && std::ranges::none_of(found, is_same))
        found.push_back(std::move(conflict));
    };
    for (const SweepConflict& conflict : swept_.sweep.conflicts) add(described(conflict));
    for (const VertexPair& pair : swept_.sweep.coincident)
      if (!is_region_point(pair[0])) add({text_of(pair), false});
    if (!found.empty() && found.size() < max)
      for_crossings([&](std::int32_t edge, std::int32_t other) {
        add(meeting(edge, other));
        return found.size() < max;
      });
    return found;
  }

 private:
  std::string edge_name(std::int32_t edge) const {
    const GraphEdge& of = swept_.graph.edges[edge];
    return swept_.sources[of.source].segment_name(of.segment);
  }
  std::string name_of(std::int32_t vertex) const {
    return vertex_name(swept_.graph.vertices[vertex], swept_.sources, swept_.fixed_nodes);
  }
  const Point<2>& point(std::int32_t vertex) const { return swept_.points[vertex]; }

  bool is_region_point(std::int32_t point) const {
    return static_cast<std::size_t>(point) >= swept_.graph.vertices.size();
  }
  MessageText text_of_region_point_on(std::int32_t point, const std::string& name) const {
    const std::size_t k = static_cast<std::size_t>(point) - swept_.graph.vertices.size();
    return name_and_position<2>(swept_.region_points[k]) + " lies on " + name +
           ": move it into the region it stands for";
  }

  Conflict described(const SweepConflict& conflict) const {
    if (conflict.other >= 0) return meeting(conflict.edge, conflict.other);
    if (is_region_point(conflict.vertex))
      return {text_of_region_point_on(conflict.vertex, edge_name(conflict.edge)), false};
    return {name_of(conflict.vertex) + " " + point_text(point(conflict.vertex)) + " lies on " +
                edge_name(conflict.edge),
            false};
  }

  MessageText text_of(const VertexPair& coincident) const {
    if (is_region_point(coincident[1]))
      return text_of_region_point_on(coincident[1], name_of(coincident[0]));
    return name_of(coincident[0]) + " and " + name_of(coincident[1]) + " touch at " +
           point_text(point(coincident[0]));
  }

  Conflict meeting(std::int32_t first, std::int32_t second) const {
    if (second < first) std::swap(first, second);
    const auto [a, b] = swept_.graph.ends[first];
    const auto [c, d] = swept_.graph.ends[second];
    const bool common_end = a == c || a == d || b == c || b == d;
    const bool on_a_line = orientation(point(a), point(b), point(c)) == 0 &&
                           orientation(point(a), point(b), point(d)) == 0;
    const Point<2> where =
        common_end || on_a_line ? point(c) : crossing_point(point(a), point(b), point(c), point(d));
    const std::string name = edge_name(first), other = edge_name(second);
    const std::string what = common_end || on_a_line ? " overlap at " : " cross at ";
    if (name == other) return {name + " meets itself at " + point_text(where), false};
    return {name + " and " + other + what + point_text(where), true};
  }

  bool cross(std::int32_t edge, std::int32_t other) const {
    const auto [a, b] = swept_.graph.ends[edge];
    const auto [c, d] = swept_.graph.ends[other];
    return cross_properly(point(a), point(b), point(c), point(d));
  }

  // Calls visit(edge, other) for crossing edges until it returns false or the search limit is
  // reached.
  template <class Visit>
  void for_crossings(const Visit& visit) const {
    std::int64_t to_look_at = 10'000'000;
    std::vector<Box<2>> boxes;
    for (const auto& [a, b] : swept_.graph.ends)
      boxes.push_back(joined(Box<2>{point(a), point(a)}, Box<2>{point(b), point(b)}));
    const BoxTree<2> tree(boxes);
    bool goes_on = true;
    for (std::int32_t edge = 0; goes_on && edge < static_cast<std::int32_t>(boxes.size()); ++edge)
      tree.for_meeting(boxes[static_cast<std::size_t>(edge)], [&](std::int32_t other) {
        goes_on = goes_on && --to_look_at > 0;
        if (goes_on && other > edge && cross(edge, other)) goes_on = visit(edge, other);
      });
  }

  const SweptGraph& swept_;
};

}  // namespace

void reject_conflicts(const SweptGraph& swept) {
  constexpr std::size_t kListed = 20;
  const std::vector<Conflict> conflicts = Conflicts(swept).list(kListed + 1);
  if (conflicts.empty()) return;
  MessageText list = conflicts.front().text;
  for (std::size_t k = 1; k < conflicts.size(); ++k)
    list += "; " + (k < kListed ? conflicts[k].text : "and more");
  const bool crosses =
      std::ranges::any_of(conflicts, [](const Conflict& conflict) { return conflict.crosses; });
  reject_domain(list, crosses ? ErrorReason::crossing : ErrorReason::other);
}

}  // namespace pnpbs
