// SPDX-License-Identifier: BSD-3-Clause
#include "level/volume/thin_elements.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

#include "base/found_indices.hpp"
#include "base/index.hpp"
#include "base/space_vectors.hpp"
#include "comm/records.hpp"
#include "delaunay/volume/element_rule.hpp"
#include "level/exchange.hpp"
#include "level/finish.hpp"
#include "level/reach.hpp"
#include "level/volume/added_nodes.hpp"
#include "level/volume/opposite_nodes.hpp"
#include "method/constants.hpp"
#include "quality/volume/small_angles.hpp"
#include "shape/sharp_edges.hpp"

namespace pnpbs {

namespace {

// ------------------------------------------------------------------ short edges ----------------

// One end of a short edge.
struct EdgeEnd {
  std::int64_t id, boundary_node;
  Point<3> x;
  double d;
  std::int64_t on_feature;  // 1 if the node lies on a feature, else 0
};

// A short edge between two boundary nodes, the one with the smaller id first.
struct ShortEdge {
  double length;  // over d
  std::array<EdgeEnd, 2> ends;

  auto key() const { return std::tuple(length, ends[0].id, ends[1].id); }
  bool on_features() const { return ends[0].on_feature != 0 && ends[1].on_feature != 0; }
};

// The centroid of a flat element between boundary nodes.
struct SliverMiddle {
  std::array<std::int64_t, 4> ids;  // ids of its nodes, ascending
  Point<3> x;
  double d;

  auto operator<=>(const SliverMiddle& other) const { return ids <=> other.ids; }
  bool operator==(const SliverMiddle& other) const { return ids == other.ids; }
};

// The thin elements, and the changes that may remove them.
struct ThinElements {
  std::vector<ShortEdge> edges;
  std::vector<SliverMiddle> middles;
  std::uint64_t count = 0;
};

using Corners = std::array<std::int64_t, 4>;

bool is_inner(const Level<3>& level, std::int64_t i) {
  return level.nodes.carrier(i) == Carrier::free;
}

EdgeEnd end_at(const Level<3>& level, std::int64_t i) {
  const Nodes<3>& nodes = level.nodes;
  return {nodes.id(i), nodes.boundary_node(i), nodes.position(i), nodes.d(i),
          nodes.carrier(i) != Carrier::surface};
}

bool on_one_sheet(const Level<3>& level, std::int64_t i, std::int64_t j) {
  const LevelGeometry<3>& geometry = level.geometry;
  return geometry.surface().sees(geometry.place(level.nodes, i), geometry.place(level.nodes, j));
}

// Returns the shortest edge of an element, the first of equals by id, with its length over d.
std::tuple<double, std::int64_t, std::int64_t> shortest_edge(const Level<3>& level,
                                                             const Corners& by_id) {
  const Nodes<3>& nodes = level.nodes;
  std::tuple<double, std::int64_t, std::int64_t> shortest{10, -1, -1};
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t l = k + 1; l < 4; ++l) {
      const std::int64_t i = by_id[k], j = by_id[l];
      const double length =
          distance<3>(nodes.position(i), nodes.position(j)) / std::min(nodes.d(i), nodes.d(j));
      if (length < std::get<0>(shortest)) shortest = {length, i, j};
    }
  return shortest;
}

std::optional<ShortEdge> short_edge_of(const Level<3>& level, std::int64_t i, std::int64_t j,
                                       double length) {
  if (is_inner(level, i) || is_inner(level, j)) return {};
  ShortEdge edge{length, {end_at(level, i), end_at(level, j)}};
  if (!edge.on_features() && !on_one_sheet(level, i, j)) return {};
  return edge;
}

// Returns whether two dihedral angles without a common end are wide, so that two edges nearly
// cross.
bool is_flat(const Tetrahedron& t) {
  constexpr double kWide = -0.866;  // cosine: 150 degrees
  const std::array<Point<3>, 4> n = face_normals({t[0].x, t[1].x, t[2].x, t[3].x});
  int wide = 0;
  for (std::size_t f = 0; f < 4; ++f)
    for (std::size_t g = f + 1; g < 4; ++g)
      wide += -dot(n[f], n[g]) < kWide * length(n[f]) * length(n[g]);
  return wide >= 2;
}

// Returns the centroid of a flat element between boundary nodes if there is room for a node.
std::optional<SliverMiddle> middle_of_sliver(const Level<3>& level, const Corners& by_id,
                                             double shortest) {
  const Nodes<3>& nodes = level.nodes;
  if (std::ranges::any_of(by_id, [&](std::int64_t i) { return is_inner(level, i); })) return {};
  const Tetrahedron t = tetrahedron_of(nodes, by_id);
  if (!is_flat(t)) return {};
  const auto on_feature = [&](std::int64_t i) { return nodes.carrier(i) != Carrier::surface; };
  const bool held = std::ranges::count_if(by_id, on_feature) >= 3;
  if (!held && shortest < method::kShortEdge) return {};
  const double room = held ? method::kRoomInHeldSliver : method::kRoomInSliver;
  SliverMiddle middle{{t[0].id, t[1].id, t[2].id, t[3].id}, centroid(t), t[0].d};
  for (const VolumeNode& corner : t) middle.d = std::min(middle.d, corner.d);
  for (const VolumeNode& corner : t)
    if (distance<3>(corner.x, middle.x) < room * middle.d) return {};
  const double clearance = method::kSliverClearance * room * middle.d;
  const SurfaceIndex& index = level.geometry.domain().index();
  if (!index.inside(middle.x) || index.clearance(middle.x, clearance) < clearance) return {};
  return middle;
}

ThinElements own_thin_elements(const Level<3>& level) {
  const Nodes<3>& nodes = level.nodes;
  const SmallAngles small(method::kThinElement);
  const auto is_thin = [&](const Corners& by_id) {
    const Tetrahedron t = tetrahedron_of(nodes, by_id);
    return small.any({t[0].x, t[1].x, t[2].x, t[3].x});
  };
  const auto for_first_at = [&](std::int64_t i, const auto& visit) {
    level.stars.for_simplices(i, [&](const Stars<3>::Corners& others) {
      if (!std::ranges::all_of(others, [&](auto j) { return nodes.id(i) < nodes.id(j); })) return;
      Corners by_id{i, others[0], others[1], others[2]};
      std::ranges::sort(by_id, {}, [&](std::int64_t j) { return nodes.id(j); });
      visit(by_id);
    });
  };
  const auto any_thin_at = [&](std::int64_t i) {
    bool any = false;
    if (nodes.owned(i) != 0)
      for_first_at(i, [&](const Corners& corners) { any = any || is_thin(corners); });
    return any;
  };
  ThinElements found;
  const auto thin_at = indices_where("pnpbs::thin_elements", nodes.count, any_thin_at);
  if (thin_at.empty()) return found;
  const SharpEdges sharp(level.geometry.boundary(), level.geometry.surface().features());
  const auto at_sharp_edge = [&](const Corners& corners) {
    return !sharp.none() && std::ranges::any_of(corners, [&](std::int64_t i) {
      return sharp.any_nearer(nodes.position(i), nodes.d(i));
    });
  };
  const auto in_thin_wall = [&](const Corners& corners) {
    const Tetrahedron t = tetrahedron_of(nodes, corners);
    return connects_thin_wall(level, centroid(t),
                              std::ranges::min_element(t, {}, &VolumeNode::d)->d);
  };
  for (const std::int64_t i : thin_at)
    for_first_at(i, [&](const Corners& corners) {
      if (!is_thin(corners) || at_sharp_edge(corners) || in_thin_wall(corners)) return;
      ++found.count;
      const auto [length, a, b] = shortest_edge(level, corners);
      if (length < method::kShortEdge)
        if (const auto edge = short_edge_of(level, a, b, length)) found.edges.push_back(*edge);
      if (const auto middle = middle_of_sliver(level, corners, length))
        found.middles.push_back(*middle);
    });
  return found;
}

// Returns the thin elements of all ranks, without repetition. If there are too many for one rank,
// only their number is returned. All ranks must call it, and if one rank throws, all ranks throw.
ThinElements thin_elements(Level<3>& level) {
  constexpr std::uint64_t kMost = 100000;
  ThinElements own;
  collective_try(*level.comm, [&] { own = own_thin_elements(level); });
  ThinElements all;
  all.count = level.comm->allreduce_sum(own.count);
  if (level.comm->allreduce_sum(own.edges.size() + own.middles.size()) > kMost) return all;
  all.edges = of_all_ranks(*level.comm, own.edges);
  all.middles = of_all_ranks(*level.comm, own.middles);
  std::ranges::sort(all.edges, {}, &ShortEdge::key);
  all.edges.erase(
      std::unique(all.edges.begin(), all.edges.end(),
                  [](const ShortEdge& a, const ShortEdge& b) { return a.key() == b.key(); }),
      all.edges.end());
  std::ranges::sort(all.middles);
  return all;
}

// ------------------------------------------------------------------ removal --------------------

// The feature nodes next to each feature node along its curves.
class FeatureNeighbours {
 public:
  explicit FeatureNeighbours(const FeatureNodes& laid) : laid_(laid), next_(laid.nodes.size()) {
    for (const std::vector<std::int32_t>& row : laid.along)
      for (std::size_t k = 1; k < row.size(); ++k) {
        next_[index(row[k - 1])].push_back(row[k]);
        next_[index(row[k])].push_back(row[k - 1]);
      }
  }
  const std::vector<std::int32_t>& of(std::int64_t node) const {
    return next_[static_cast<std::size_t>(node)];
  }
  // Returns whether curves that leave these two nodes run side by side.
  bool run_beside(std::int64_t a, std::int64_t b, double d) const {
    for (const std::int32_t p : of(a))
      for (const std::int32_t q : of(b)) {
        if (p == b || q == a || p == q) continue;
        const Point<3> along = way(a, p), beside = way(b, q);
        const double lengths = length(along) * length(beside);
        if (std::min(length(along), length(beside)) > method::kBesideLength * d &&
            dot(along, beside) > method::kBesideCosine * lengths)
          return true;
      }
    return false;
  }

 private:
  Point<3> way(std::int64_t from, std::int32_t to) const {
    return difference(laid_.nodes[index(to)].position,
                      laid_.nodes[static_cast<std::size_t>(from)].position);
  }

  const FeatureNodes& laid_;
  std::vector<std::vector<std::int32_t>> next_;
};

bool is_user_node(const Level<3>& level, const Point<3>& x) {
  return std::ranges::any_of(level.geometry.domain().fixed_nodes(),
                             [&](const FixedNode<3>& node) { return node.position == x; });
}

// The choice of the nodes to remove, the same on all ranks.
class Leaving {
 public:
  explicit Leaving(const Level<3>& level) : level_(level), neighbours_(level.geometry.features()) {}

  void choose(const ShortEdge& edge) {
    const auto& [a, b] = edge.ends;
    if (ids_.contains(a.id) || ids_.contains(b.id)) return;
    if (edge.on_features() && edge.length > method::kRagged &&
        neighbours_.run_beside(a.boundary_node, b.boundary_node, std::min(a.d, b.d)))
      return;
    const bool a_first = rank(b) < rank(a);
    if (!leave(a_first ? a : b, a_first ? b : a)) leave(a_first ? b : a, a_first ? a : b);
  }
  const std::set<std::int64_t>& ids() const { return ids_; }
  std::int64_t on_features() const { return on_features_; }

 private:
  // Returns a sort key. The end with the smaller key is kept if the other can be removed: a corner,
  // and among corners the one with more curves.
  std::tuple<int, std::int64_t, std::int64_t> rank(const EdgeEnd& end) const {
    if (end.on_feature == 0) return {2, 0, end.id};
    const auto node = static_cast<std::size_t>(end.boundary_node);
    return {level_.geometry.features().nodes[node].corner < 0 ? 1 : 0,
            -std::ssize(neighbours_.of(end.boundary_node)), end.id};
  }
  // Removes an end if that is allowed. At most one of two neighbours on a curve is removed.
  bool leave(const EdgeEnd& end, const EdgeEnd& other) {
    if (staying_.contains(end.id) || is_user_node(level_, end.x)) return false;
    if (end.on_feature != 0) {
      if (staying_features_.contains(end.boundary_node)) return false;
      const std::vector<std::int32_t>& next = neighbours_.of(end.boundary_node);
      staying_features_.insert(next.begin(), next.end());
      ++on_features_;
    }
    ids_.insert(end.id);
    staying_.insert(other.id);
    return true;
  }

  const Level<3>& level_;
  FeatureNeighbours neighbours_;
  std::set<std::int64_t> ids_, staying_, staying_features_;
  std::int64_t on_features_ = 0;
};

// Removes nodes of short edges. Returns how many this rank owned; `ids` has those of all ranks.
std::int64_t remove_nodes_of(Level<3>& level, const std::vector<ShortEdge>& edges,
                             std::set<std::int64_t>& ids) {
  if (edges.empty()) return 0;
  Leaving leaving(level);
  for (const ShortEdge& edge : edges) leaving.choose(edge);
  ids = leaving.ids();
  if (ids.empty()) return 0;
  level.left_out += leaving.on_features();
  std::vector<std::int32_t> nodes;  // ghosts included
  std::int64_t own = 0;
  for (std::int32_t i = 0; i < level.nodes.count; ++i) {
    if (!ids.contains(level.nodes.id(i))) continue;
    nodes.push_back(i);
    own += level.nodes.owned(i) != 0;
  }
  delete_nodes(level, nodes);
  return own;
}

// ------------------------------------------------------------------ insertion ------------------

// Returns new nodes for centroids in this rank's leaves, of elements whose nodes are kept. The
// chosen centroids keep a distance from each other.
IncomingNodes<3> nodes_in(const Level<3>& level, const std::vector<SliverMiddle>& middles,
                          const std::set<std::int64_t>& removed) {
  std::vector<SliverMiddle> kept;
  for (const SliverMiddle& middle : middles)
    if (std::ranges::none_of(middle.ids, [&](std::int64_t id) { return removed.contains(id); }) &&
        std::ranges::none_of(kept, [&](const SliverMiddle& other) {
          return distance<3>(other.x, middle.x) < method::kSliversApart * middle.d;
        }))
      kept.push_back(middle);
  IncomingNodes<3> own;
  for (const SliverMiddle& middle : kept) {
    if (!level.tree->owns(level.tree->tree().leaf_at(middle.x))) continue;
    IncomingNode<3> node{middle.x, -1};
    node.d = middle.d;
    own.push_back(node);
  }
  return own;
}

}  // namespace

ThinElementChanges change_nodes_of_thin_elements(Level<3>& level) {
  ThinElementChanges changes;
  for (int round = 0; round < method::kThinRounds; ++round) {
    const ThinElements thin = thin_elements(level);
    changes.thin = thin.count;
    if (thin.count == 0) break;
    std::set<std::int64_t> ids;
    const std::int64_t removed = remove_nodes_of(level, thin.edges, ids);
    IncomingNodes<3> more;
    if (round == 0) collective_try(*level.comm, [&] { more = nodes_in(level, thin.middles, ids); });
    const std::int64_t inserted = std::ssize(more);
    if (level.comm->allreduce_sum(static_cast<std::uint64_t>(removed + inserted)) == 0) break;
    exchange(level, kStarHops);  // nodes have moved, some into leaves of other ranks
    add_nodes(level, std::move(more));
    changes.counts.deleted += removed;
    changes.counts.inserted += inserted;
    make_finish_stars(level, {});
  }
  return changes;
}

}  // namespace pnpbs
