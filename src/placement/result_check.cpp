// SPDX-License-Identifier: BSD-3-Clause
#include "placement/result_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "base/limits.hpp"
#include "base/mixed_hash.hpp"
#include "base/point_text.hpp"
#include "comm/records.hpp"
#include "predicates/plane.hpp"

namespace pnpbs {

namespace {

[[noreturn]] void fail(const std::string& what) {
  throw Error(ErrorKind::internal, "the check of the results failed: " + what);
}

struct PlacedId {
  std::int64_t id;
  Point<2> x;
};

std::string text_of(const PlacedId& node) {
  return std::to_string(node.id) + " " + point_text(node.x);
}

// Two numbers of a node of another rank's, to look for there.
struct ListedPair {
  std::int64_t of, listed;  // ids: the list of `of` must have `listed`
  std::int32_t owner;       // of `of`
};

struct StarTriangle {
  std::int64_t of, next, last;  // ids: the star of `of` must have `next` and then `last`
  std::int32_t owner;           // of `of`
};

class ResultCheck {
 public:
  explicit ResultCheck(PlacementOf<2>& placement)
      : p_(placement),
        comm_(placement.communicator()),
        level_(placement.level()),
        nodes_(level_.nodes),
        boundary_(level_.ground.boundary()),
        owned_(placement.count()) {
    sectors_.build(boundary_);
  }

  void check() const {
    check_ids();
    check_places();
    check_sides();
    check_boundary_nodes();
    check_lists();
    check_stars();
    check_area();
  }

 private:
  Point<2> position(std::int64_t i) const { return nodes_.position(i); }
  std::string name(std::int64_t i) const {
    return std::to_string(nodes_.id(i)) + " " + point_text(position(i));
  }
  template <class Visit>
  void for_owned(const Visit& visit) const {
    for (std::int64_t place = 0; place < owned_; ++place) visit(p_.node_at(place));
  }
  std::int64_t owned_node(std::int64_t id) const;
  std::vector<PlacedId> gathered_by(std::uint64_t (*key)(const PlacedId&)) const;

  void check_ids() const;
  void check_places() const;
  void check_sides() const;
  void check_boundary_nodes() const;

  bool lists(std::int64_t i, std::int64_t id) const;
  void check_lists() const;

  bool star_has(std::int64_t i, std::int64_t next, std::int64_t last) const;
  void check_stars() const;
  void check_star(std::int64_t i, std::vector<StarTriangle>& elsewhere) const;
  void check_corner(std::int64_t corner, std::int64_t next, std::int64_t last,
                    std::vector<StarTriangle>& elsewhere) const;
  void check_sides_of(std::int64_t i, std::int64_t j, bool left, bool right) const;
  void check_boundary_edges_of(std::int64_t i) const;

  double area_of_triangles(double unit) const;
  void check_area() const;

  PlacementOf<2>& p_;
  const Communicator& comm_;
  const Level<2>& level_;
  const Nodes<2>& nodes_;
  const Boundary& boundary_;
  IncidentSectors sectors_;
  std::int64_t owned_;
};

// ------------------------------------------------------------------ nodes ----------------------

// The owned node with this id, or -1.
std::int64_t ResultCheck::owned_node(std::int64_t id) const {
  std::int64_t low = 0, high = owned_;
  while (low < high) {
    const std::int64_t middle = low + (high - low) / 2;
    if (nodes_.id(p_.node_at(middle)) < id)
      low = middle + 1;
    else
      high = middle;
  }
  if (low == owned_) return -1;
  const std::int64_t i = p_.node_at(low);
  return nodes_.id(i) == id ? i : -1;
}

// The nodes of all ranks, distributed by their keys: those with the same key come to the same rank.
std::vector<PlacedId> ResultCheck::gathered_by(std::uint64_t (*key)(const PlacedId&)) const {
  std::vector<PlacedId> mine;
  mine.reserve(static_cast<std::size_t>(owned_));
  for_owned([&](std::int64_t i) { mine.push_back({nodes_.id(i), position(i)}); });
  if (comm_.size() == 1) return mine;
  const auto ranks = static_cast<std::uint64_t>(comm_.size());
  return redistribute(comm_, mine,
                      [&](const PlacedId& node) { return static_cast<int>(key(node) % ranks); });
}

void ResultCheck::check_ids() const {
  std::vector<PlacedId> nodes =
      gathered_by([](const PlacedId& node) { return mixed(static_cast<std::uint64_t>(node.id)); });
  std::ranges::sort(nodes, {}, &PlacedId::id);
  const auto twice = std::ranges::adjacent_find(nodes, {}, &PlacedId::id);
  if (twice != nodes.end())
    fail("two nodes have the id " + text_of(*twice) + " and " + point_text(twice[1].x));
  if (!nodes.empty() && nodes.front().id < 0)
    fail("node " + text_of(nodes.front()) + " has a negative id");
}

void ResultCheck::check_places() const {
  for_owned([&](std::int64_t i) {
    if (!is_usable(position(i))) fail("node " + name(i) + " lies nowhere");
  });
  std::vector<PlacedId> nodes = gathered_by([](const PlacedId& node) {
    // + 0.0 makes one place of the two zeros.
    return mixed_with(mixed_with(0, node.x[0] + 0.0), node.x[1] + 0.0);
  });
  std::ranges::sort(nodes, {}, &PlacedId::x);
  const auto twice = std::ranges::adjacent_find(nodes, {}, &PlacedId::x);
  if (twice != nodes.end())
    fail("nodes " + text_of(twice[0]) + " and " + text_of(twice[1]) + " lie in one place");
}

void ResultCheck::check_sides() const {
  for_owned([&](std::int64_t i) {
    const std::int32_t b = nodes_.boundary_node(i);
    if (b < 0) {
      if (!level_.map().inside(position(i))) fail("node " + name(i) + " does not lie inside");
    } else if (position(i) != boundary_.nodes[static_cast<std::size_t>(b)].position) {
      fail("node " + name(i) + " is on the boundary, but not where that was laid: " +
           point_text(boundary_.nodes[static_cast<std::size_t>(b)].position));
    }
  });
}

void ResultCheck::check_boundary_nodes() const {
  std::vector<std::int64_t> times(boundary_.nodes.size(), 0);
  for_owned([&](std::int64_t i) {
    if (nodes_.boundary_node(i) >= 0) ++times[static_cast<std::size_t>(nodes_.boundary_node(i))];
  });
  comm_.allreduce_sum(times);
  const auto wrong = std::ranges::find_if(times, [](std::int64_t n) { return n != 1; });
  if (wrong == times.end()) return;
  const auto b = static_cast<std::size_t>(wrong - times.begin());
  fail("the boundary's node " + point_text(boundary_.nodes[b].position) + " comes " +
       std::to_string(*wrong) + " times");
}

// ------------------------------------------------------------------ lists ----------------------

bool ResultCheck::lists(std::int64_t i, std::int64_t id) const {
  bool found = false;
  level_.lists().for_neighbours(i, [&](std::int64_t j) { found = found || nodes_.id(j) == id; });
  return found;
}

void ResultCheck::check_lists() const {
  std::vector<ListedPair> elsewhere;
  const auto require_listed = [&](std::int64_t i, std::int64_t id) {
    if (!lists(i, id))
      fail("node " + name(i) + " is in the adjacency list of node " + std::to_string(id) +
           ", which is not in its own");
  };
  for_owned([&](std::int64_t i) {
    std::int64_t before = -1;
    level_.lists().for_neighbours(i, [&](std::int64_t j) {
      if (j == i || nodes_.id(j) <= before)
        fail("the adjacency list of node " + name(i) + " has node " + name(j) +
             " out of the order of ids");
      before = nodes_.id(j);
      if (nodes_.owned(j))
        require_listed(j, nodes_.id(i));
      else
        elsewhere.push_back({nodes_.id(j), nodes_.id(i), level_.tree->owner_at(position(j))});
    });
  });
  if (comm_.size() == 1) return;
  for (const ListedPair& pair :
       redistribute(comm_, elsewhere, [](const ListedPair& pair) { return pair.owner; })) {
    const std::int64_t i = owned_node(pair.of);
    if (i < 0)
      fail("node " + std::to_string(pair.listed) + " has node " + std::to_string(pair.of) +
           " in its adjacency list, which is not its owner's");
    require_listed(i, pair.listed);
  }
}

// ------------------------------------------------------------------ stars ----------------------

// Does the star of node i have the triangle with these two, in this order?
bool ResultCheck::star_has(std::int64_t i, std::int64_t next, std::int64_t last) const {
  bool found = false;
  level_.stars.for_simplices(i, [&](const DelaunayStars::Corners& others) {
    found = found || (nodes_.id(others[0]) == next && nodes_.id(others[1]) == last);
  });
  return found;
}

void ResultCheck::check_stars() const {
  std::vector<StarTriangle> elsewhere;
  for_owned([&](std::int64_t i) {
    check_star(i, elsewhere);
    check_boundary_edges_of(i);
  });
  if (comm_.size() == 1) return;
  for (const StarTriangle& t :
       redistribute(comm_, elsewhere, [](const StarTriangle& t) { return t.owner; })) {
    const std::int64_t i = owned_node(t.of);
    if (i < 0 || !star_has(i, t.next, t.last))
      fail("the star of node " + (i < 0 ? std::to_string(t.of) : name(i)) +
           " lacks the triangle with nodes " + std::to_string(t.next) + " and " +
           std::to_string(t.last));
  }
}

void ResultCheck::check_star(std::int64_t i, std::vector<StarTriangle>& elsewhere) const {
  std::vector<std::pair<std::int64_t, bool>> star;
  level_.stars.for_neighbours_in_order(
      i, [&](std::int64_t j, bool triangle) { star.emplace_back(j, triangle); });
  const std::size_t n = star.size();
  if (n < 2) fail("the star of node " + name(i) + " has less than two neighbours");
  for (std::size_t k = 0; k < n; ++k) {
    const auto [j, left] = star[k];
    check_sides_of(i, j, left, star[(k + n - 1) % n].second);
    for (std::size_t l = 0; l < k; ++l)
      if (star[l].first == j) fail("the star of node " + name(i) + " has " + name(j) + " twice");
    if (!left) continue;
    const std::int64_t next = star[(k + 1) % n].first;
    if (orientation(position(i), position(j), position(next)) <= 0)
      fail("the triangle of nodes " + name(i) + ", " + name(j) + " and " + name(next) +
           " is not counter-clockwise");
    check_corner(j, next, i, elsewhere);
    check_corner(next, i, j, elsewhere);
  }
}

// A triangle must be in the star of this corner of it, too.
void ResultCheck::check_corner(std::int64_t corner, std::int64_t next, std::int64_t last,
                               std::vector<StarTriangle>& elsewhere) const {
  if (!nodes_.owned(corner))
    elsewhere.push_back({nodes_.id(corner), nodes_.id(next), nodes_.id(last),
                         level_.tree->owner_at(position(corner))});
  else if (!star_has(corner, nodes_.id(next), nodes_.id(last)))
    fail("the star of node " + name(corner) + " lacks the triangle with nodes " + name(next) +
         " and " + name(last));
}

// On which sides of the edge from node i to node j there are triangles.
void ResultCheck::check_sides_of(std::int64_t i, std::int64_t j, bool left, bool right) const {
  bool left_inside = true, right_inside = true;
  const std::int32_t b = nodes_.boundary_node(i), c = nodes_.boundary_node(j);
  for (std::int32_t k = b < 0 ? 0 : sectors_.begin(b); b >= 0 && k < sectors_.end(b); ++k) {
    if (sectors_.edge(k).other != c) continue;
    const BoundaryEdge& e = boundary_.facets[static_cast<std::size_t>(sectors_.edge(k).edge)];
    left_inside = e.begin == b ? e.left_inside : e.right_inside;
    right_inside = e.begin == b ? e.right_inside : e.left_inside;
  }
  if (left == left_inside && right == right_inside) return;
  const auto side = [](bool is_left) { return is_left ? "left" : "right"; };
  const bool on_left = left != left_inside;
  fail("the edge from node " + name(i) + " to node " + name(j) + " has " +
       ((on_left ? left : right) ? "a triangle outside the domain, on its "
                                 : "no triangle on its ") +
       side(on_left));
}

// Every edge of the boundary must be an edge of the star.
void ResultCheck::check_boundary_edges_of(std::int64_t i) const {
  const std::int32_t b = nodes_.boundary_node(i);
  if (b < 0) return;
  for (std::int32_t k = sectors_.begin(b); k < sectors_.end(b); ++k) {
    const std::int32_t other = sectors_.edge(k).other;
    if (other == b) continue;  // a fixed node
    bool found = false;
    level_.stars.for_neighbours(
        i, [&](std::int64_t j) { found = found || nodes_.boundary_node(j) == other; });
    if (!found)
      fail("the boundary's edge from node " + name(i) + " to " +
           point_text(boundary_.nodes[static_cast<std::size_t>(other)].position) +
           " is no edge of the triangulation");
  }
}

// ------------------------------------------------------------------ area -----------------------

// A sum with no order: in 2^-40 of the unit.
double ResultCheck::area_of_triangles(double unit) const {
  double mine = 0;
  p_.for_elements([&](const std::array<std::int64_t, 3>& places) {
    const auto [a, b, c] = places;
    const Point<2> x = position(p_.node_at(a)), y = position(p_.node_at(b)),
                   z = position(p_.node_at(c));
    mine += 0.5 * ((y[0] - x[0]) * (z[1] - x[1]) - (y[1] - x[1]) * (z[0] - x[0]));
  });
  constexpr double kFine = 0x1p40, kMax = 1e6;
  const double parts = std::clamp(mine / unit, 0.0, kMax) * kFine;
  const std::uint64_t sum = comm_.allreduce_sum(static_cast<std::uint64_t>(parts));
  return static_cast<double>(sum) / kFine * unit;
}

// What the boundary's edges enclose, and how far rounding may put it off.
struct Enclosed {
  double area = 0, rounding = 0;
};

Enclosed enclosed_by(const Boundary& boundary, const Box<2>& bounds) {
  constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
  Enclosed sum;
  for (const BoundaryEdge& e : boundary.facets) {
    if (e.left_inside == e.right_inside) continue;
    const Point<2>&a = boundary.nodes[static_cast<std::size_t>(e.begin)].position,
          &b = boundary.nodes[static_cast<std::size_t>(e.end)].position;
    const double left = (a[0] - bounds.low[0]) * (b[1] - bounds.low[1]);
    const double right = (a[1] - bounds.low[1]) * (b[0] - bounds.low[0]);
    sum.area += (e.left_inside ? 0.5 : -0.5) * (left - right);
    sum.rounding += 4 * kEpsilon * (std::fabs(left) + std::fabs(right));
  }
  return sum;
}

void ResultCheck::check_area() const {
  constexpr double kTolerance = 1e-9;
  const Enclosed enclosed = enclosed_by(boundary_, level_.ground.bounds());
  if (!(enclosed.area > enclosed.rounding)) return;  // too thin to be measured
  const double area = area_of_triangles(enclosed.area);
  if (std::fabs(area - enclosed.area) <= kTolerance * enclosed.area + enclosed.rounding) return;
  fail("the triangles have the area " + number_text(area) + ", the boundary encloses " +
       number_text(enclosed.area));
}

}  // namespace

void check_results(PlacementOf<2>& placement) {
  placement.prepare_stars();
  ResultCheck(placement).check();
}

void check_results(PlacementOf<3>&) {
  throw Error(ErrorKind::unsupported, "results in space are not checked yet");
}

}  // namespace pnpbs
