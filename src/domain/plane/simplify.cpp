// SPDX-License-Identifier: BSD-3-Clause
// Removes vertices one at a time, those of least importance first (as M. Visvalingam and J. D.
// Whyatt, "Line generalisation by repeated elimination of points", Cartogr. J. 30 (1993) 46-51, but
// measured by distance). A removal sweeps the curve over a triangle. Only triangles that contain no
// other point are allowed, so no point changes its side.
#include "domain/plane/simplify.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <queue>
#include <set>
#include <utility>
#include <vector>

#include "base/limits.hpp"
#include "domain/plane/domain_graph.hpp"
#include "geometry/plane/chains.hpp"
#include "geometry/plane/point_tree.hpp"
#include "geometry/plane/segments.hpp"
#include "predicates/plane.hpp"

namespace pnpbs {
namespace {

// Returns true if the point lies inside the closed chain.
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

// Selects the closed chains that are too small for nodes.
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

  // Visits chains by ascending size, so that chains inside a loop are decided before the loop.
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
  std::vector<Point<2>> begins_;  // a point of each chain, then vertices without edges
  std::vector<char> goes_;
};

// Returns 1 for each closed chain whose extent is less than `smallest` times the mean d at its
// vertices and that encloses nothing that stays. `d` and `may_go` have one entry per vertex. The
// chain of the largest extent always stays.
std::vector<char> small_loops(const DomainGraph& graph, const std::vector<Chain>& chains,
                              const std::vector<double>& d, const std::vector<char>& may_go,
                              double smallest) {
  return SmallLoops(graph, chains, d, may_go).run(smallest);
}

using Kind = CurveSource::Kind;

// A vertex in its chain. Chains follow each other in one array; closed ones do not repeat their
// first vertex.
struct Slot {
  std::int32_t vertex;
  std::int32_t chain;
  std::int64_t before, after;  // remaining neighbours; -1 at the ends of open chains
};

class Simplifier {
 public:
  Simplifier(std::vector<CurveSource>& sources, std::vector<RegionPoint<2>>& region_points,
             const std::vector<FixedNode<2>>& fixed_nodes, const SimplifyRule& rule)
      : sources_(sources),
        region_points_(region_points),
        rule_(rule),
        graph_(join_sources(sources, fixed_nodes, {}, Unite::none, domain_size(sources))) {}

  LeftOut run(const LocalSpacingEvaluator<2>& spacing) {
    std::vector<Point<2>> positions;
    for (const GraphVertex& vertex : graph_.vertices) positions.push_back(vertex.position);
    d_.resize(positions.size());
    spacing(static_cast<std::int64_t>(positions.size()), positions.data(), d_.data());
    find_chains();
    gone_.assign(graph_.vertices.size(), 0);
    leave_out_loops();
    leave_out_vertices(std::move(positions));
    rewrite_sources();
    return left_out_;
  }

 private:
  const Point<2>& position(std::int64_t slot) const {
    return graph_.vertices[slots_[slot].vertex].position;
  }
  const GraphEdge& edge(std::int32_t e) const { return graph_.edges[e]; }
  std::int32_t tag_of(std::int32_t e) const {
    return sources_[edge(e).source].segment_tag(edge(e).segment);
  }

  // ------------------------------------------------------------ chains
  void find_chains() {
    std::vector<char> is_break(graph_.vertices.size(), 0);
    may_go_.assign(graph_.vertices.size(), 1);
    std::vector<std::int32_t> one(graph_.vertices.size(), -1);  // per vertex, one of its edges
    for (std::size_t e = 0; e < graph_.edges.size(); ++e)
      for (const std::int32_t v : graph_.ends[e]) {
        const auto now = static_cast<std::int32_t>(e);
        if (one[v] >= 0 && !are_alike(one[v], now)) is_break[v] = 1;
        one[v] = now;
      }
    for (std::size_t v = 0; v < graph_.vertices.size(); ++v) {
      const GraphVertex& vertex = graph_.vertices[v];
      const bool own = vertex.tag != 0 && one[v] >= 0 && vertex.tag != tag_of(one[v]);
      const bool ends_curve = vertex.source >= 0 && sources_[vertex.source].ends_at(vertex.index);
      if (vertex.degree != 2 || vertex.fixed >= 0 || own || ends_curve) is_break[v] = 1;
      may_go_[v] = !is_break[v] && sources_[edge(one[v]).source].kind != Kind::smooth;
    }
    chains_ = chains_between(is_break, graph_.ends);
  }

  bool are_alike(std::int32_t e, std::int32_t other) const {
    return edge(e).source == edge(other).source && tag_of(e) == tag_of(other);
  }

  void leave_out_loops() {
    loop_goes_ = small_loops(graph_, chains_, d_, may_go_, rule_.smallest);
    for (std::size_t c = 0; c < chains_.size(); ++c) {
      if (!loop_goes_[c]) continue;
      ++left_out_.curves;
      // The first vertex of a closed chain is also its last and is counted once.
      const std::vector<std::int32_t>& vertices = chains_[c].vertices;
      left_out_.vertices += std::count_if(vertices.begin() + 1, vertices.end(),
                                          [this](std::int32_t v) { return was_given(v); });
      for (const std::int32_t v : vertices) gone_[v] = 1;
      std::erase_if(region_points_, [&](const RegionPoint<2>& it) {
        return is_within(it.point, chains_[c], graph_);
      });
    }
  }

  // ------------------------------------------------------------ vertices
  void make_slots() {
    for (std::size_t c = 0; c < chains_.size(); ++c) {
      first_slot_.push_back(static_cast<std::int64_t>(slots_.size()));
      const Chain& chain = chains_[c];
      const auto n = static_cast<std::int64_t>(chain.vertices.size()) - (chain.closed ? 1 : 0);
      for (std::int64_t k = 0; k < n; ++k) {
        const std::int64_t slot = first_slot_.back() + k;
        slots_.push_back({chain.vertices[k], static_cast<std::int32_t>(c), k > 0 ? slot - 1 : -1,
                          k + 1 < n ? slot + 1 : -1});
      }
      if (chain.closed) {
        slots_[first_slot_.back()].before = static_cast<std::int64_t>(slots_.size()) - 1;
        slots_.back().after = first_slot_.back();
      } else if (n == 2) {
        straight_.insert(pair_of(chain.vertices.front(), chain.vertices.back()));
      }
      left_in_chain_.push_back(n);
    }
    first_slot_.push_back(static_cast<std::int64_t>(slots_.size()));
    turn_of_.assign(slots_.size(), 0);
  }

  static std::pair<std::int32_t, std::int32_t> pair_of(std::int32_t a, std::int32_t b) {
    return std::minmax(a, b);
  }

  void leave_out_vertices(std::vector<Point<2>> positions) {
    make_slots();
    for (const RegionPoint<2>& it : region_points_) positions.push_back(it.point);
    const PointTree points(positions);
    // A removal may free vertices that were blocked, so all are queued again until none is removed.
    for (std::int64_t before = -1; before != vertices_gone_;) {
      before = vertices_gone_;
      for (std::size_t s = 0; s < slots_.size(); ++s) offer(static_cast<std::int64_t>(s));
      empty_queue(points, positions);
    }
  }

  void empty_queue(const PointTree& points, const std::vector<Point<2>>& positions) {
    while (!queue_.empty()) {
      const auto [cost, slot, turn] = queue_.top();
      queue_.pop();
      if (turn != turn_of_[slot] || !may_leave(slot) || !sweeps_free(slot, points, positions))
        continue;
      leave_out(slot);
    }
  }

  // Queues the vertex if the tolerance allows its removal. Earlier entries of this slot become
  // invalid.
  void offer(std::int64_t slot) {
    if (slot < 0) return;
    ++turn_of_[slot];
    const Slot& here = slots_[slot];
    if (!may_go_[here.vertex] || gone_[here.vertex]) return;
    const Point<2>&a = position(here.before), &x = position(slot), &b = position(here.after);
    if (std::min(distance<2>(a, x), distance<2>(x, b)) >= d_[here.vertex]) return;
    const double cost = deviation(here);
    if (cost <= rule_.tolerance) queue_.push({cost, slot, turn_of_[slot]});
  }

  // Returns the largest distance, in units of d, of the given vertices between the two neighbours
  // from the segment that would join these.
  double deviation(const Slot& here) const {
    const Point<2>&a = position(here.before), &b = position(here.after);
    double largest = 0;
    for (std::int64_t s = next_given(here.before, here.chain); s != here.after;
         s = next_given(s, here.chain)) {
      const double away = distance_to_segment(a, b, position(s));
      largest = std::max(largest, away / d_[slots_[s].vertex]);
    }
    return largest;
  }

  std::int64_t next_given(std::int64_t slot, std::int32_t chain) const {
    return slot + 1 == first_slot_[chain + 1] ? first_slot_[chain] : slot + 1;
  }

  // Returns true if the curves remain valid without this vertex: a closed one keeps three vertices,
  // and no two curves become the same segment.
  bool may_leave(std::int64_t slot) const {
    const Slot& here = slots_[slot];
    const std::int64_t left = left_in_chain_[here.chain];
    if (chains_[here.chain].closed) return left > 3;
    const bool ends_meet =
        chains_[here.chain].vertices.front() == chains_[here.chain].vertices.back();
    if (left > 3) return left > 4 || !ends_meet;
    const std::int32_t a = slots_[here.before].vertex, b = slots_[here.after].vertex;
    return a != b && straight_.count(pair_of(a, b)) == 0;
  }

  // Returns true if the triangle over which the curve sweeps contains no other point.
  bool sweeps_free(std::int64_t slot, const PointTree& points,
                   const std::vector<Point<2>>& positions) const {
    const Slot& here = slots_[slot];
    const Point<2>&a = position(here.before), &x = position(slot), &b = position(here.after);
    const int side = orientation(a, x, b);
    const double reach = distance_to_segment(a, b, x) * (1 + 1e-12);
    bool free = true;
    points.for_each_near(a, b, reach, [&](std::int32_t p, double) {
      if (!free || p == here.vertex || p == slots_[here.before].vertex ||
          p == slots_[here.after].vertex)
        return;
      if (p < static_cast<std::int32_t>(gone_.size()) && gone_[p]) return;
      const Point<2>& y = positions[p];
      free = orientation(a, x, y) * side < 0 || orientation(x, b, y) * side < 0 ||
             orientation(b, a, y) * side < 0;
    });
    return free;
  }

  // Returns false for vertices that were inserted on great circles.
  bool was_given(std::int32_t v) const {
    const GraphVertex& vertex = graph_.vertices[v];
    if (vertex.source < 0) return true;
    const std::vector<char>& on_the_way = sources_[vertex.source].on_the_way;
    return on_the_way.empty() || !on_the_way[vertex.index];
  }

  void leave_out(std::int64_t slot) {
    const Slot here = slots_[slot];
    gone_[here.vertex] = 1;
    ++vertices_gone_;
    left_out_.vertices += was_given(here.vertex);
    slots_[here.before].after = here.after;
    slots_[here.after].before = here.before;
    if (--left_in_chain_[here.chain] == 2)
      straight_.insert(pair_of(slots_[here.before].vertex, slots_[here.after].vertex));
    offer(here.before);
    offer(here.after);
  }

  // ------------------------------------------------------------ sources
  void rewrite_sources() {
    std::vector<std::vector<std::int32_t>> edges_of(sources_.size()), chains_of(sources_.size());
    for (std::size_t e = 0; e < graph_.edges.size(); ++e)
      edges_of[graph_.edges[e].source].push_back(static_cast<std::int32_t>(e));
    for (std::size_t c = 0; c < chains_.size(); ++c)
      if (!loop_goes_[c])
        chains_of[edge(chains_[c].edges.front()).source].push_back(static_cast<std::int32_t>(c));
    std::vector<CurveSource> left;
    for (std::size_t s = 0; s < sources_.size(); ++s) {
      if (sources_[s].kind == Kind::graph) rewrite_graph(s, chains_of[s]);
      if (sources_[s].kind == Kind::polyline) rewrite_polyline(sources_[s], edges_of[s]);
      if (sources_[s].kind == Kind::graph || !chains_of[s].empty())
        left.push_back(std::move(sources_[s]));
    }
    sources_ = std::move(left);
  }

  // Rewrites a polyline from the remaining vertices of its edges, which include vertices at which
  // other curves met it.
  void rewrite_polyline(CurveSource& source, const std::vector<std::int32_t>& edges) {
    const CurveSource given = source;
    source.points.clear();
    source.on_the_way.clear();
    source.tags.clear();
    source.segment_numbers.clear();
    source.point_numbers.clear();
    for (const std::int32_t e : edges) {
      const std::int32_t begin = graph_.ends[e][0];
      if (gone_[begin]) continue;
      source.points.push_back(graph_.vertices[begin].position);
      source.tags.push_back(given.segment_tag(edge(e).segment));
      source.segment_numbers.push_back(given.segment_number(edge(e).segment));
      source.point_numbers.push_back(given.point_number(edge(e).segment));
    }
    if (given.closed || edges.empty()) return;
    source.points.push_back(graph_.vertices[graph_.ends[edges.back()][1]].position);
    source.point_numbers.push_back(
        given.point_number(static_cast<std::int64_t>(given.points.size()) - 1));
  }

  void rewrite_graph(std::size_t s, const std::vector<std::int32_t>& chains) {
    const CurveSource given = std::move(sources_[s]);
    CurveSource& source = sources_[s];
    source = CurveSource();
    source.kind = Kind::graph;
    source.number = given.number;
    source.first_number = given.first_number;
    std::map<std::int32_t, std::int64_t> point_of;
    const auto point = [&](std::int32_t v) {
      const auto [entry, is_new] = point_of.try_emplace(v, source.points.size());
      if (is_new) add_point(source, given, s, v);
      return entry->second;
    };
    for (const std::int32_t c : chains)
      for (std::int64_t slot = first_slot_[c]; slot < first_slot_[c + 1]; ++slot) {
        const Slot& here = slots_[slot];
        if (gone_[here.vertex] || here.after < 0) continue;
        const std::int64_t segment = edge(chains_[c].edges[slot - first_slot_[c]]).segment;
        const std::int64_t begin = point(here.vertex), end = point(slots_[here.after].vertex);
        source.segment_ends.push_back({begin, end});
        source.tags.push_back(given.segment_tag(segment));
        source.segment_numbers.push_back(given.segment_number(segment));
      }
    for (std::size_t v = 0; v < graph_.vertices.size(); ++v)
      if (graph_.vertices[v].degree == 0 && graph_.vertices[v].source == static_cast<int>(s))
        point(static_cast<std::int32_t>(v));
  }

  void add_point(CurveSource& source, const CurveSource& given, std::size_t s, std::int32_t v) {
    const GraphVertex& vertex = graph_.vertices[v];
    const bool own = vertex.source == static_cast<std::int32_t>(s);
    source.points.push_back(vertex.position);
    source.point_tags.push_back(own ? vertex.tag : 0);
    source.point_numbers.push_back(own ? given.point_number(vertex.index) : 0);
  }

  using Candidate = std::tuple<double, std::int64_t, std::int32_t>;  // cost, slot, turn of the slot

  std::vector<CurveSource>& sources_;
  std::vector<RegionPoint<2>>& region_points_;
  SimplifyRule rule_;
  DomainGraph graph_;
  std::vector<double> d_;  // per vertex, as the next two
  std::vector<char> may_go_, gone_;
  std::vector<Chain> chains_;
  std::vector<char> loop_goes_;  // per chain, as the next two
  std::vector<std::int64_t> first_slot_, left_in_chain_;
  std::vector<Slot> slots_;
  std::vector<std::int32_t> turn_of_;  // per slot: number of calls of offer()
  std::set<std::pair<std::int32_t, std::int32_t>> straight_;  // chains of one segment
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> queue_;
  std::int64_t vertices_gone_ = 0;
  LeftOut left_out_;
};

}  // namespace

LeftOut simplify(std::vector<CurveSource>& sources, std::vector<RegionPoint<2>>& region_points,
                 const std::vector<FixedNode<2>>& fixed_nodes,
                 const LocalSpacingEvaluator<2>& spacing, const SimplifyRule& rule) {
  return Simplifier(sources, region_points, fixed_nodes, rule).run(spacing);
}

}  // namespace pnpbs
