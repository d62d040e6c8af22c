// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay/volume/volume_stars.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "delaunay/listed_reach.hpp"
#include "delaunay/volume/circumsphere.hpp"
#include "delaunay/volume/volume_star.hpp"
#include "delaunay/volume/word_of_bits.hpp"

namespace pnpbs {

namespace {

// The corners' mean, added up in the order of their ids: the same bits whoever asks.
Point<3> centroid(const Tetrahedron& ordered) {
  Point<3> sum{};
  for (const VolumeNode& corner : ordered)
    for (std::size_t k = 0; k < 3; ++k) sum[k] += corner.x[k];
  for (double& along : sum) along *= 0.25;
  return sum;
}

// Is it so thin that its volume is a small part of a regular one with its longest edge?
bool is_flat_cap(const TetrahedronCorners& x) {
  constexpr double kFlat = 0.2;
  const Point<3> u = difference(x[1], x[0]), v = difference(x[2], x[0]), w = difference(x[3], x[0]);
  const double longest = longest_edge(x);
  const double regular = longest * longest * longest * std::numbers::sqrt2 / 2;  // six times
  return std::fabs(dot_product(u, cross_product(v, w))) < kFlat * regular;
}

// Finds the stars of one node after the other.
class StarWriter {
 public:
  StarWriter(const VolumeStarInput& input, std::vector<double>& needs)
      : in_(input),
        needs_(needs),
        reach_(input.nodes, input.tree, input.buckets, input.lists, input.known) {}

  void operator()(std::int64_t i, std::vector<std::int32_t>& out) {
    const double needs = find_star(i);
    if (!needs_.empty()) needs_[static_cast<std::size_t>(i)] = needs;
    if (needs > 0) {
      out.push_back(VolumeStars::header(0, false));
      return;
    }
    star_.finish([&](const VolumeStar::Corners& corners) { return in_domain(i, corners); });
    write(out);
  }

 private:
  static std::size_t index(std::int32_t k) { return static_cast<std::size_t>(k); }

  VolumeNode node(std::int64_t j) const {
    return {in_.nodes.position(j), in_.nodes.d(j), in_.nodes.id(j)};
  }

  void add(std::int64_t j) {
    star_.add(node(j));
    candidates_.push_back(static_cast<std::int32_t>(j));
  }

  // Returns 0, or how far the nodes would have to be known.
  double find_star(std::int64_t i) {
    star_.start(node(i));
    candidates_.clear();
    double reach = in_.complete && !in_.complete(i) ? 0 : reach_.of(i);
    if (reach > 0) {
      add_listed(i);
    } else {
      reach = std::max(reach_.whatever_is_known(i), in_.nodes.d(i));
      if (!in_.known.covers(in_.tree, box_around<3>(in_.nodes.position(i), reach))) return reach;
      add_all_within(i, reach);
    }
    while (!star_.wrap(reach)) {
      if (!all_is_known()) return star_.search_reach();
      if (!add_what_may_matter()) break;
    }
    return 0;
  }

  void add_listed(std::int64_t i) {
    in_.lists.for_neighbours(i, [&](std::int64_t j) {
      if (squared_distance<3>(in_.nodes.position(i), in_.nodes.position(j)) > 0) add(j);
    });
  }

  void add_all_within(std::int64_t i, double reach) {
    const Point<3> x = in_.nodes.position(i);
    in_.tree.for_leaves_in(box_around<3>(x, reach), [&](std::int32_t leaf) {
      for (std::int32_t j = in_.buckets.begin(leaf); j < in_.buckets.end(leaf); ++j) {
        const double gap = squared_distance<3>(x, in_.nodes.position(j));
        if (gap > 0 && gap <= reach * reach) add(j);
      }
    });
  }

  bool may_matter_in(std::int32_t cell) const {
    return star_.may_matter_in(in_.tree.cell_box_with_room(cell));
  }
  Box<3> search_box() const { return box_around<3>(star_.centre().x, star_.search_reach()); }

  bool all_is_known() const {
    return in_.known.covers(in_.tree, search_box(),
                            [&](std::int32_t cell) { return may_matter_in(cell); });
  }

  // Among n nodes from the first one on.
  void find_what_may_matter(std::int32_t first, std::int32_t n) {
    const auto& x = in_.nodes.x;
    std::uint64_t bits =
        star_.may_matter_bits({x[0].data() + first, x[1].data() + first, x[2].data() + first},
                              static_cast<std::size_t>(n));
    for (; bits != 0; bits &= bits - 1) {
      const std::int32_t j = first + std::countr_zero(bits);
      if (star_.may_matter(in_.nodes.position(j)) &&
          std::find(candidates_.begin(), candidates_.end(), j) == candidates_.end())
        found_.push_back(j);
    }
  }

  // Returns whether there was any such node.
  bool add_what_may_matter() {
    constexpr std::int32_t kNodes = kWord;
    found_.clear();
    in_.tree.for_leaves_in(
        search_box(), [&](std::int32_t cell) { return may_matter_in(cell); },
        [&](std::int32_t leaf) {
          for (std::int32_t first = in_.buckets.begin(leaf); first < in_.buckets.end(leaf);
               first += kNodes)
            find_what_may_matter(first, std::min(kNodes, in_.buckets.end(leaf) - first));
        });
    for (const std::int32_t j : found_) add(j);
    return !found_.empty();
  }

  // A pure function of the four corners. One that is flat between boundary nodes is nothing but
  // their rounding, or what a curved surface rises between them.
  bool in_domain(std::int64_t i, const VolumeStar::Corners& corners) const {
    if (in_.facets == nullptr) return true;
    const auto held = [&](std::int64_t node) { return in_.nodes.carrier(node) != Carrier::free; };
    std::array<std::int64_t, 4> node{i};
    Tetrahedron tetrahedron{star_.centre()};
    int held_nodes = held(i);
    for (std::size_t k = 0; k < 3; ++k) {
      node[k + 1] = candidates_[index(corners[k])];
      held_nodes += held(node[k + 1]);
      tetrahedron[k + 1] = star_.candidates()[index(corners[k])];
    }
    if (held_nodes < 2) return true;
    const Tetrahedron t = ordered_by_id(tetrahedron);
    if (held_nodes == 4) {
      const TetrahedronCorners x{t[0].x, t[1].x, t[2].x, t[3].x};
      if (circumsphere(x).flat) return false;
      if (is_flat_cap(x) && in_.on_one_surface && in_.on_one_surface(node)) return false;
    }
    const Point<3> middle = centroid(t);
    return in_.facets->inside(middle) || in_.facets->on_inner_facet(middle);
  }

  void write(std::vector<std::int32_t>& out) const {
    const auto node_at = [&](std::int32_t place) {
      return candidates_[index(star_.neighbours()[index(place)])];
    };
    const std::size_t n = star_.neighbours().size();
    out.push_back(VolumeStars::header(n, star_.closed()));
    for (const std::int32_t k : star_.neighbours()) out.push_back(candidates_[index(k)]);
    for (const VolumeStar::Corners& triangle : star_.triangles()) {
      if (n <= index(VolumeStars::kMaxPlaces)) {
        out.push_back(VolumeStars::pack(triangle));
      } else {
        for (const std::int32_t place : triangle) out.push_back(node_at(place));
      }
    }
  }

  const VolumeStarInput& in_;
  std::vector<double>& needs_;
  ListedReach<3> reach_;
  VolumeStar star_;
  std::vector<std::int32_t> candidates_, found_;  // nodes
};

}  // namespace

void VolumeStars::build(const VolumeStarInput& input) {
  needs_.assign(input.known.is_everywhere() ? 0 : static_cast<std::size_t>(input.nodes.count), 0);
  rows_.build("pnpbs::VolumeStars::build", input.nodes.count,
              [&] { return StarWriter(input, needs_); });
}

}  // namespace pnpbs
