// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay/delaunay_stars.hpp"

#include <algorithm>

#include "delaunay/listed_reach.hpp"
#include "delaunay/plane/block_hull_stars.hpp"
#include "delaunay/plane/constrained_star.hpp"
#include "delaunay/plane/hull_star.hpp"
#include "dynamics/bubble_force.hpp"

namespace pnpbs {

namespace {

// Finds the stars of consecutive blocks of nodes.
class StarWriter {
  using Entry = DelaunayStars::Entry;

 public:
  // `visibility_is_fresh` says whether the lists and the edges near nodes were built for the
  // present positions.
  StarWriter(const StarInput& input, bool visibility_is_fresh, std::vector<double>& needs)
      : in_(input),
        visibility_is_fresh_(visibility_is_fresh),
        needs_(needs),
        reach_(input.nodes, input.map.tree(), input.buckets, input.lists, input.known) {}

  void operator()(std::int64_t block, std::vector<Entry>& out) {
    const std::int64_t count = in_.nodes.count;
    std::int64_t self[kLanes];
    double listed_reach[kLanes], hull_reach[kLanes];
    block_nodes(block, count, self);
    for (int lane = 0; lane < kLanes; ++lane) {
      const std::int64_t i = self[lane];
      listed_reach[lane] = i < count ? reach_.of(i) : 0;
      hull_reach[lane] = i < count && !in_.near_edges.any(i) ? listed_reach[lane] : 0;
    }
    find_block_hull_stars(in_.lists.block(block), static_cast<std::int32_t>(count),
                          in_.nodes.x[0].data(), in_.nodes.x[1].data(), self, hull_reach, hulls_);
    others_.clear();
    std::size_t longest = 0;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      first_other_[lane] = others_.size();
      size_[lane] = static_cast<std::size_t>(hulls_.size[lane]);
      if (!hulls_.found[lane]) {
        if (self[lane] < count) add_other_star(self[lane], listed_reach[lane]);
        size_[lane] = others_.size() - first_other_[lane];
      }
      longest = std::max(longest, size_[lane]);
    }
    write(self, longest, out);
  }

 private:
  StarPoint point(std::int64_t j) const {
    return {in_.nodes.position(j), in_.nodes.id(j), static_cast<std::int32_t>(j)};
  }

  void add_other_star(std::int64_t i, double listed_reach) {
    const bool near_edges = in_.near_edges.any(i);
    if (!near_edges && listed_reach > 0 && add_hull_star(i, listed_reach)) return;
    const double needs =
        constrained_star(in_, i, near_edges && visibility_is_fresh_ ? listed_reach : 0,
                         std::max(reach_.whatever_is_known(i), in_.nodes.d(i)), others_);
    if (!needs_.empty()) needs_[static_cast<std::size_t>(i)] = needs;
  }

  bool add_hull_star(std::int64_t i, double reach) {
    around_.clear();
    in_.lists.for_neighbours(i, [&](std::int64_t j) { around_.push_back(point(j)); });
    if (!hull_star(point(i), reach, around_)) return false;
    for (const StarPoint& p : around_) others_.push_back({p.node, true});
    return true;
  }

  // Appends the rows of the block: the sizes, then `longest` rows of entries.
  void write(const std::int64_t (&self)[kLanes], std::size_t longest, std::vector<Entry>& out) {
    const std::size_t begin = out.size();
    out.resize(begin + (longest + 1) * kLanes);
    Entry* const sizes = out.data() + begin;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      Entry* const rows = sizes + kLanes + lane;
      const std::size_t n = size_[lane];
      bool closed = n > 0;
      for (std::size_t k = 0; k < n; ++k) {
        rows[k * kLanes] = hulls_.found[lane] ? Entry{hulls_.node[k][lane], true}
                                              : others_[first_other_[lane] + k];
        closed = closed && rows[k * kLanes].flag();
      }
      const Entry filler{n > 0 ? rows[0].value() : self[lane], false};
      for (std::size_t k = n; k < longest; ++k) rows[k * kLanes] = filler;
      sizes[lane] = {static_cast<std::int64_t>(n), closed};
    }
  }

  const StarInput& in_;
  bool visibility_is_fresh_;
  std::vector<double>& needs_;
  ListedReach<2> reach_;
  std::vector<StarPoint> around_;
  BlockHullStars hulls_;
  std::vector<Entry> others_;  // Stars of the block that are not in hulls_.
  std::array<std::size_t, kLanes> first_other_{}, size_{};
};

}  // namespace

void DelaunayStars::build(const StarInput& input) {
  arrangement_ = -1;
  count_ = input.nodes.count;
  needs_.assign(input.known.is_everywhere() ? 0 : static_cast<std::size_t>(count_), 0);
  const bool visibility_is_fresh = input.near_edges.built_where_nodes_are(input.nodes);
  blocks_.build("pnpbs::DelaunayStars::build", block_count(),
                [&] { return StarWriter(input, visibility_is_fresh, needs_); });
  arrangement_ = input.nodes.arrangement();
}

void DelaunayStars::begin_with(std::int64_t i, std::int32_t place) {
  if (place == 0) return;
  const Column star = column(i);
  const std::int32_t n = star.size->value();
  const auto reverse = [&](std::int32_t begin, std::int32_t end) {
    for (--end; begin < end; ++begin, --end) std::swap(star.at(begin), star.at(end));
  };
  reverse(0, place);
  reverse(place, n);
  reverse(0, n);
  for (std::int32_t k = n; k < star.length; ++k) star.at(k) = {star.at(0).value(), false};
}

void DelaunayStars::rewrite(const std::vector<char>& changed,
                            const std::function<std::vector<Entry>(std::int64_t)>& star_of) {
  const auto is_changed = [&](std::int64_t i) {
    return i < count_ && changed[static_cast<std::size_t>(i)] != 0;
  };
  const auto any_changed = [&](std::int64_t b) {
    bool any = false;
    for (std::int64_t i = b * kLanes; i < (b + 1) * kLanes; ++i) any = any || is_changed(i);
    return any;
  };
  const auto write = [&](std::int64_t b, std::vector<Entry>& out) {
    std::array<std::vector<Entry>, kLanes> stars;
    for (std::int64_t lane = 0; lane < kLanes; ++lane) {
      const std::int64_t i = b * kLanes + lane;
      std::vector<Entry>& star = stars[static_cast<std::size_t>(lane)];
      if (is_changed(i))
        star = star_of(i);
      else if (i < count_)
        for_neighbours_in_order(i, [&](std::int64_t j, bool flag) { star.push_back({j, flag}); });
    }
    append_block(b, stars, out);
  };
  blocks_.rewrite("pnpbs::DelaunayStars::rewrite", block_count(), any_changed,
                  [&] { return write; });
}

// Appends the rows of a block: the sizes, then as many rows of entries as the longest star has.
void DelaunayStars::append_block(std::int64_t b,
                                 const std::array<std::vector<Entry>, kLanes>& stars,
                                 std::vector<Entry>& out) const {
  std::size_t longest = 0;
  for (const std::vector<Entry>& star : stars) longest = std::max(longest, star.size());
  const std::size_t begin = out.size();
  out.resize(begin + (longest + 1) * kLanes);
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const std::vector<Entry>& star = stars[lane];
    const std::int64_t self = std::min(b * kLanes + static_cast<std::int64_t>(lane), count_);
    const Entry filler{star.empty() ? self : star[0].value(), false};
    const bool closed = !star.empty() && std::all_of(star.begin(), star.end(),
                                                     [](Entry entry) { return entry.flag(); });
    Entry* const rows = out.data() + begin + lane;
    rows[0] = {std::ssize(star), closed};
    for (std::size_t k = 0; k < longest; ++k)
      rows[(k + 1) * kLanes] = k < star.size() ? star[k] : filler;
  }
}

DelaunayStars::Column DelaunayStars::column(std::int64_t i) {
  const std::span<Entry> rows = blocks_.row(i / kLanes);
  const std::int64_t lane = i % kLanes;
  return {rows.data() + lane, rows.data() + kLanes + lane,
          static_cast<std::int32_t>(rows.size() / kLanes) - 1};
}

std::int32_t DelaunayStars::place_in_star(const Column& star, std::int64_t neighbour) const {
  std::int32_t k = 0;
  while (k < star.size->value() && star.at(k).value() != neighbour) ++k;
  return k;
}

void DelaunayStars::replace(std::int64_t i, std::int64_t neighbour, std::int64_t by) {
  const Column star = column(i);
  for (std::int32_t k = 0; k < star.length; ++k)
    if (star.at(k).value() == neighbour) star.at(k) = {by, star.at(k).flag()};
}

void DelaunayStars::remove(std::int64_t i, std::int64_t neighbour) {
  const Column star = column(i);
  const std::int32_t n = star.size->value(), there = place_in_star(star, neighbour);
  if (there == n) return;
  for (std::int32_t k = there; k + 1 < n; ++k) star.at(k) = star.at(k + 1);
  *star.size = {n - 1, star.size->flag()};
  for (std::int32_t k = n - 1; k < star.length; ++k) star.at(k) = {star.at(0).value(), false};
}

void DelaunayStars::clear(std::int64_t i) {
  const Column star = column(i);
  *star.size = {0, false};
  for (std::int32_t k = 0; k < star.length; ++k) star.at(k) = {i, false};
}

}  // namespace pnpbs
