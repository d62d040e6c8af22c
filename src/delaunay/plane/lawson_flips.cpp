// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay/plane/lawson_flips.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <utility>
#include <vector>

#include "delaunay/delaunay_stars.hpp"
#include "delaunay/plane/block_hull_stars.hpp"
#include "dynamics/bubble_force.hpp"
#include "predicates/plane.hpp"

namespace pnpbs {
namespace {

// The result of checking whether the stars of a block of nodes are still Delaunay, one node per
// SIMD lane. It covers what plain floating point can prove.
struct BlockStarCheck {
  // The star is proven to turn exactly once around the node and to be convex after inversion, so
  // that each edge from the node is locally Delaunay. Only stars of triangles alone can be proven.
  bool holds[kLanes];
  // Whether the first neighbour is nearer than all others. Valid only where holds is set.
  bool begins_with_nearest[kLanes];
};

using Lanes = double[kLanes];
using Integers = std::int32_t[kLanes];

// Range of squared lengths for which products of six lengths neither overflow nor lose bits.
constexpr double kMinSquare = 1e-60, kMaxSquare = 1e60;

class BlockCheck {
 public:
  explicit BlockCheck(const DelaunayStars::Block& stars)
      : entries_(stars.entries), length_(stars.length) {
    for (int lane = 0; lane < kLanes; ++lane) {
      size_[lane] = stars.sizes[lane].value();
      sure_[lane] = stars.sizes[lane].flag() && size_[lane] >= 3 ? 1 : 0;
    }
  }

  void look(const double* x, const double* y, const std::int64_t (&self)[kLanes]) {
    gather(x, y, self);
    check_turns();
    check_bends();
  }

  void tell(BlockStarCheck& check) const {
    for (int lane = 0; lane < kLanes; ++lane) {
      check.holds[lane] = sure_[lane] != 0;
      check.begins_with_nearest[lane] = min_of_others_[lane] > square_[0][lane];
    }
  }

 private:
  // Computes the positions relative to the node, in the order of the neighbours. The first two
  // follow again after the last, as shorter stars are padded with their first neighbour.
  void gather(const double* x, const double* y, const std::int64_t (&self)[kLanes]) {
    Lanes own_x, own_y;
    for (int lane = 0; lane < kLanes; ++lane) {
      own_x[lane] = x[self[lane]];
      own_y[lane] = y[self[lane]];
      min_of_others_[lane] = kMaxSquare;
    }
    for (int k = 0; k < length_ + 2; ++k) {
#pragma omp simd
      for (int lane = 0; lane < kLanes; ++lane) {
        const std::int32_t first = k < length_ ? k : 0;
        const std::int32_t row = k == size_[lane] + 1 ? 1 : first;
        const std::int32_t j = entries_[row * kLanes + lane].value();
        const double dx = x[j] - own_x[lane], dy = y[j] - own_y[lane];
        const double square = dx * dx + dy * dy;
        x_[k][lane] = dx;
        y_[k][lane] = dy;
        square_[k][lane] = square;
        const bool other = k > 0 && k < size_[lane];
        min_of_others_[lane] =
            other && square < min_of_others_[lane] ? square : min_of_others_[lane];
        sure_[lane] &= square > kMinSquare && square < kMaxSquare ? 1 : 0;
      }
    }
  }

  void check_turns() {
    for (int k = 0; k < length_ + 1; ++k) {
#pragma omp simd
      for (int lane = 0; lane < kLanes; ++lane) {
        const double left = x_[k][lane] * y_[k + 1][lane];
        const double right = y_[k][lane] * x_[k + 1][lane];
        const double size = std::fabs(left) + std::fabs(right);
        const bool fine = left - right > kMinTurn * size || k > size_[lane];
        cross_[k][lane] = left - right;
        cross_size_[k][lane] = size;
        sure_[lane] &= fine ? 1 : 0;
      }
    }
  }

  void check_bends() {
    for (int k = 1; k < length_ + 1; ++k) {
#pragma omp simd
      for (int lane = 0; lane < kLanes; ++lane) {
        const double left = x_[k - 1][lane] * y_[k + 1][lane];
        const double right = y_[k - 1][lane] * x_[k + 1][lane];
        const double before = square_[k - 1][lane], at = square_[k][lane],
                     after = square_[k + 1][lane];
        const double bend =
            after * cross_[k - 1][lane] + before * cross_[k][lane] - at * (left - right);
        const double size = after * cross_size_[k - 1][lane] + before * cross_size_[k][lane] +
                            at * (std::fabs(left) + std::fabs(right));
        const bool fine = bend > kMinBend * size || k > size_[lane];
        sure_[lane] &= fine ? 1 : 0;
      }
    }
  }

  const DelaunayStars::Entry* entries_;
  int length_;
  Integers size_, sure_;
  Lanes min_of_others_;  // Squared distance.
  Lanes x_[kMaxListed + 2], y_[kMaxListed + 2], square_[kMaxListed + 2];
  // Cross products of each neighbour and the next, and the sums of the sizes of their terms.
  Lanes cross_[kMaxListed + 1], cross_size_[kMaxListed + 1];
};

// Checks the stars of a block. `x` and `y` are the positions of all nodes and of the far point
// that follows them.
void check_block_stars(const DelaunayStars::Block& stars, const double* x, const double* y,
                       const std::int64_t (&self)[kLanes], BlockStarCheck& check) {
  if (stars.length < 3 || stars.length > kMaxListed) {
    for (bool& holds : check.holds) holds = false;
    return;
  }
  BlockCheck block(stars);
  block.look(x, y, self);
  block.tell(check);
}

using Entry = DelaunayStars::Entry;
using Star = std::vector<Entry>;

// Minimum number of nodes per node beside an edge to be flipped. With more flips, finding all stars
// takes no longer.
constexpr std::int64_t kFewFlips = 16;

std::size_t index(std::int64_t i) { return static_cast<std::size_t>(i); }

// Return the index that follows or precedes k cyclically in a star.
std::size_t after(const Star& star, std::size_t k) { return k + 1 < star.size() ? k + 1 : 0; }
std::size_t before(const Star& star, std::size_t k) { return k > 0 ? k - 1 : star.size() - 1; }

class StarRules {
 public:
  StarRules(const Nodes<2>& nodes, const IncidentSectors& sectors)
      : nodes_(nodes), sectors_(sectors) {}

  // Returns whether the star must begin with the nearest neighbour. Stars of nodes with boundary
  // edges begin with the neighbour on one of these instead.
  bool begins_with_nearest(std::int64_t i) const {
    const std::int32_t b = nodes_.boundary_node(i);
    return b < 0 || sectors_.begin(b) == sectors_.end(b);
  }

  // Returns whether triangles cover the part of the domain around the node.
  bool is_whole(std::int64_t i, const Star& star) const {
    const auto gaps =
        std::count_if(star.begin(), star.end(), [](Entry neighbour) { return !neighbour.flag(); });
    if (begins_with_nearest(i)) return star.size() >= 3 && gaps == 0;
    const std::int32_t b = nodes_.boundary_node(i);
    std::ptrdiff_t outside = 0;
    for (std::int32_t k = sectors_.begin(b); k < sectors_.end(b); ++k)
      outside += sectors_.edge(k).inside_after ? 0 : 1;
    return star.size() >= 2 && gaps == outside;
  }

  bool turns_over(std::int64_t i, const Star& star) const {
    for (std::size_t k = 0; k < star.size(); ++k)
      if (star[k].flag() &&
          orientation(x(i), x(star[k].value()), x(star[after(star, k)].value())) <= 0)
        return true;
    return false;
  }

  // Returns whether the edge to the neighbour at index `place` lies between two triangles and is
  // not locally Delaunay.
  bool needs_flip(std::int64_t i, const Star& star, std::size_t place) const {
    const Entry right = star[before(star, place)], at = star[place];
    if (!right.flag() || !at.flag() || is_boundary_edge(i, at.value())) return false;
    const std::int64_t a = right.value(), b = at.value(), c = star[after(star, place)].value();
    return in_circle_perturbed(x(i), x(a), x(b), x(c), nodes_.id(i), nodes_.id(a), nodes_.id(b),
                               nodes_.id(c)) > 0;
  }

  // Returns the index of the nearest neighbour; of several, of the one with the smallest id.
  template <class ForNeighbours>
  std::int32_t nearest(std::int64_t i, const ForNeighbours& for_neighbours) const {
    std::int32_t place = 0, best = 0;
    std::int64_t id = 0;
    double gap = std::numeric_limits<double>::infinity();
    for_neighbours([&](std::int64_t j) {
      const double own = squared_distance<2>(x(i), x(j));
      if (own < gap || (own == gap && nodes_.id(j) < id)) {
        best = place;
        gap = own;
        id = nodes_.id(j);
      }
      ++place;
    });
    return best;
  }

 private:
  Point<2> x(std::int64_t i) const { return nodes_.position(i); }

  bool is_boundary_edge(std::int64_t i, std::int64_t j) const {
    const std::int32_t b = nodes_.boundary_node(i), c = nodes_.boundary_node(j);
    return b >= 0 && c >= 0 && sectors_.joined(b, c);
  }

  const Nodes<2>& nodes_;
  const IncidentSectors& sectors_;
};

Star star_of(const DelaunayStars& stars, std::int64_t i) {
  Star star;
  stars.for_neighbours_in_order(i, [&](std::int64_t j, bool triangle) {
    star.push_back({j, triangle});
  });
  return star;
}

void begin_with_nearest(const StarRules& rules, DelaunayStars& stars, std::int64_t i) {
  if (!rules.begins_with_nearest(i)) return;
  stars.begin_with(i, rules.nearest(i, [&](const auto& visit) { stars.for_neighbours(i, visit); }));
}

enum class Verdict : char { holds, needs_flips, is_broken };

// Checks the star of node i. If it holds, the star is rotated to begin with the required neighbour.
Verdict judge(const StarRules& rules, DelaunayStars& stars, std::int64_t i) {
  const Star star = star_of(stars, i);
  if (!rules.is_whole(i, star) || rules.turns_over(i, star)) return Verdict::is_broken;
  for (std::size_t k = 0; k < star.size(); ++k)
    if (rules.needs_flip(i, star, k)) return Verdict::needs_flips;
  begin_with_nearest(rules, stars, i);
  return Verdict::holds;
}

std::vector<Verdict> judge_all(const Nodes<2>& nodes, const StarRules& rules,
                               DelaunayStars& stars) {
  std::vector<Verdict> verdicts(index(nodes.count), Verdict::holds);
  for_each("pnpbs::restore_by_flips", stars.block_count(), [&](std::int64_t b) {
    std::int64_t self[kLanes];
    BlockStarCheck check;
    block_nodes(b, nodes.count, self);
    check_block_stars(std::as_const(stars).block(b), nodes.x[0].data(), nodes.x[1].data(), self,
                      check);
    for (int lane = 0; lane < kLanes; ++lane) {
      const std::int64_t i = self[lane];
      if (i == nodes.count) break;
      if (!check.holds[lane])
        verdicts[index(i)] = judge(rules, stars, i);
      else if (!check.begins_with_nearest[lane])
        begin_with_nearest(rules, stars, i);
    }
  });
  return verdicts;
}

class Flips {
 public:
  Flips(const Nodes<2>& nodes, const StarRules& rules, DelaunayStars& stars)
      : nodes_(nodes), rules_(rules), stars_(stars) {}

  void look_at_edges_of(std::int64_t i) {
    stars_.for_neighbours(i, [&](std::int64_t j) { edges_.emplace_back(i, j); });
  }

  void flip_all() {
    while (!edges_.empty()) {
      const auto [i, j] = edges_.back();
      edges_.pop_back();
      const Star& star = star_to_change(i);
      const std::size_t place = place_in(star, j);
      if (place < star.size() && rules_.needs_flip(i, star, place)) flip(i, place);
    }
  }

  void write_stars() {
    std::vector<char> changed(index(nodes_.count), 0);
    for (auto& [i, changed_star] : changed_) {
      Star& star = changed_star;  // Clang 14 cannot capture structured bindings.
      changed[index(i)] = 1;
      if (rules_.begins_with_nearest(i)) {
        const std::int32_t nearest = rules_.nearest(i, [&star](const auto& visit) {
          for (const Entry neighbour : star) visit(neighbour.value());
        });
        std::rotate(star.begin(), star.begin() + nearest, star.end());
      }
    }
    stars_.rewrite(changed, [&](std::int64_t i) { return changed_.at(i); });
  }

 private:
  Star& star_to_change(std::int64_t i) {
    const auto [found, is_new] = changed_.try_emplace(i);
    if (is_new) found->second = star_of(stars_, i);
    return found->second;
  }

  static std::size_t place_in(const Star& star, std::int64_t j) {
    return index(std::find_if(star.begin(), star.end(), [&](Entry e) { return e.value() == j; }) -
                 star.begin());
  }

  void remove(std::int64_t from, std::int64_t j) {
    Star& star = star_to_change(from);
    star.erase(star.begin() + static_cast<std::ptrdiff_t>(place_in(star, j)));
  }

  void insert_after(std::int64_t into, std::int64_t there, std::int64_t j) {
    Star& star = star_to_change(into);
    star.insert(star.begin() + static_cast<std::ptrdiff_t>(place_in(star, there)) + 1, {j, true});
  }

  // Replaces the edge from i to j by the edge between the corners on its right and on its left.
  void flip(std::int64_t i, std::size_t place) {
    const Star& star = star_to_change(i);
    const std::int64_t j = star[place].value(), right = star[before(star, place)].value(),
                       left = star[after(star, place)].value();
    remove(i, j);
    remove(j, i);
    insert_after(left, i, right);
    insert_after(right, j, left);
    edges_.insert(edges_.end(), {{i, right}, {i, left}, {j, right}, {j, left}});
  }

  const Nodes<2>& nodes_;
  const StarRules& rules_;
  DelaunayStars& stars_;
  std::unordered_map<std::int64_t, Star> changed_;
  std::vector<std::pair<std::int64_t, std::int64_t>> edges_;  // Edges to be checked.
};

}  // namespace

bool restore_by_flips(const Nodes<2>& nodes, const IncidentSectors& sectors, DelaunayStars& stars) {
  if (!stars.are_of(nodes)) return false;
  const StarRules rules(nodes, sectors);
  const std::vector<Verdict> verdicts = judge_all(nodes, rules, stars);
  if (std::count(verdicts.begin(), verdicts.end(), Verdict::is_broken) > 0) return false;
  const auto flips = std::count(verdicts.begin(), verdicts.end(), Verdict::needs_flips);
  if (flips == 0) return true;
  if (flips > nodes.count / kFewFlips) return false;
  Flips all(nodes, rules, stars);
  for (std::int64_t i = 0; i < nodes.count; ++i)
    if (verdicts[index(i)] == Verdict::needs_flips) all.look_at_edges_of(i);
  all.flip_all();
  all.write_stars();
  return true;
}

}  // namespace pnpbs
