// SPDX-License-Identifier: BSD-3-Clause
// A binary tree of boxes, which finds the boxes that contain a point, lie near it or intersect a
// box. The set of visited boxes depends only on the boxes. Callers must not depend on the order of
// the visits.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/types.hpp"

namespace pnpbs {

// Returns the squared distance of x from the box, which is 0 inside.
template <int Dim>
double squared_gap_to(const Box<Dim>& box, const std::type_identity_t<Point<Dim>>& x) {
  double sum = 0;
  for (int k = 0; k < Dim; ++k) {
    const double gap = std::max({0.0, box.low[k] - x[k], x[k] - box.high[k]});
    sum += gap * gap;
  }
  return sum;
}

// Returns the squared distance between two boxes, which is 0 if they intersect.
template <int Dim>
double squared_gap(const Box<Dim>& a, const Box<Dim>& b) {
  double sum = 0;
  for (int k = 0; k < Dim; ++k) {
    const double gap = std::max({0.0, a.low[k] - b.high[k], b.low[k] - a.high[k]});
    sum += gap * gap;
  }
  return sum;
}

// Returns true if x lies in the box or on its border.
template <int Dim>
bool in_closed_box(const Box<Dim>& box, const std::type_identity_t<Point<Dim>>& x) {
  for (int k = 0; k < Dim; ++k)
    if (!(x[k] >= box.low[k] && x[k] <= box.high[k])) return false;  // also if x is NaN
  return true;
}

// Returns true if the closed boxes intersect.
template <int Dim>
bool boxes_meet(const Box<Dim>& a, const std::type_identity_t<Box<Dim>>& b) {
  for (int k = 0; k < Dim; ++k)
    if (a.low[k] > b.high[k] || b.low[k] > a.high[k]) return false;
  return true;
}

// Returns the smallest box that contains both boxes.
template <int Dim>
Box<Dim> joined(const Box<Dim>& a, const std::type_identity_t<Box<Dim>>& b) {
  Box<Dim> box;
  for (int k = 0; k < Dim; ++k) {
    box.low[k] = std::min(a.low[k], b.low[k]);
    box.high[k] = std::max(a.high[k], b.high[k]);
  }
  return box;
}

// A bounding volume hierarchy over given boxes, which are identified by their indices.
template <int Dim>
class BoxTree {
 public:
  BoxTree() = default;
  explicit BoxTree(std::vector<Box<Dim>> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    if (order_.empty()) return;
    cells_.push_back({{}, 0, static_cast<std::int32_t>(order_.size()), -1});
    for (std::size_t cell = 0; cell < cells_.size(); ++cell) split(cell);
  }

  // Calls visit(box) for every box that contains x. Boxes are closed.
  template <class Visit>
  void for_holding(const Point<Dim>& x, const Visit& visit) const {
    walk([&](const Box<Dim>& box) { return in_closed_box(box, x); }, visit);
  }

  // Calls visit(box) for every box that intersects `other`. Boxes are closed.
  template <class Visit>
  void for_meeting(const Box<Dim>& other, const Visit& visit) const {
    walk([&](const Box<Dim>& box) { return boxes_meet(box, other); }, visit);
  }

  // Calls visit(box) for every box for which enter(box) is true. `enter` is also called for the
  // bounding boxes of the cells of the tree, and a cell for which it is false is skipped. It must
  // therefore be true for a box that contains an entered one.
  template <class Enter, class Visit>
  void for_entered(const Enter& enter, const Visit& visit) const {
    walk(enter, visit);
  }

  // Calls visit(box) for every box whose squared distance from x is at most limit(). The limit may
  // shrink during the visits. Nearer boxes are mostly visited first.
  template <class Limit, class Visit>
  void for_near(const Point<Dim>& x, const Limit& limit, const Visit& visit) const {
    for_near(
        x, limit, [](std::size_t) { return true; }, visit);
  }
  // The same, but skips the cells of the tree for which may_be_near(cell) is false.
  template <class Limit, class MayBeNear, class Visit>
  void for_near(const Point<Dim>& x, const Limit& limit, const MayBeNear& may_be_near,
                const Visit& visit) const {
    if (!cells_.empty())
      near_in_cell(0, squared_gap_to(cells_[0].box, x), x, limit, may_be_near, visit);
  }

  std::size_t cell_count() const { return cells_.size(); }
  // Returns the indices of the boxes in a cell of the tree.
  std::span<const std::int32_t> in_cell(std::size_t c) const {
    return {order_.data() + cells_[c].begin, order_.data() + cells_[c].end};
  }

  // Returns about `many` boxes that together cover all boxes.
  std::vector<Box<Dim>> cover(std::size_t many) const {
    std::vector<Box<Dim>> cover;
    std::vector<std::int32_t> open;
    if (!cells_.empty()) open.push_back(0);
    for (std::size_t next = 0; next < open.size(); ++next) {
      const Cell& cell = cells_[index(open[next])];
      // `open` ends up with about twice as many cells as are returned, since it also contains their
      // ancestors.
      if (cell.child < 0 || open.size() >= 2 * many) {
        cover.push_back(cell.box);
        continue;
      }
      open.push_back(cell.child);
      open.push_back(cell.child + 1);
    }
    return cover;
  }

 private:
  // A cell of the tree.
  struct Cell {
    Box<Dim> box;
    std::int32_t begin, end;  // range of its boxes in order_
    std::int32_t child;       // index of the first of two children, or -1
  };

  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

  void split(std::size_t c) {
    constexpr std::int32_t kLeafSize = 4;
    const std::int32_t begin = cells_[c].begin, end = cells_[c].end;
    Box<Dim> box = boxes_[index(order_[index(begin)])];
    for (std::int32_t i = begin; i < end; ++i) box = joined(box, boxes_[index(order_[index(i)])]);
    cells_[c].box = box;
    if (end - begin <= kLeafSize) return;
    int k = 0;  // the axis of the longest side
    for (int other = 1; other < Dim; ++other)
      if (box.high[k] - box.low[k] < box.high[other] - box.low[other]) k = other;
    const auto twice_middle = [&](std::int32_t b) {
      return boxes_[index(b)].low[k] + boxes_[index(b)].high[k];
    };
    const std::int32_t middle = begin + (end - begin) / 2;
    std::nth_element(
        order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
        [&](std::int32_t a, std::int32_t b) { return twice_middle(a) < twice_middle(b); });
    cells_[c].child = static_cast<std::int32_t>(cells_.size());
    cells_.push_back({{}, begin, middle, -1});
    cells_.push_back({{}, middle, end, -1});
  }

  template <class Enter, class Visit>
  void walk(const Enter& enter, const Visit& visit) const {
    if (!cells_.empty()) walk_cell(0, enter, visit);
  }

  template <class Enter, class Visit>
  void walk_cell(std::int32_t c, const Enter& enter, const Visit& visit) const {
    const Cell& cell = cells_[index(c)];
    if (!enter(cell.box)) return;
    if (cell.child >= 0) {
      walk_cell(cell.child, enter, visit);
      walk_cell(cell.child + 1, enter, visit);
      return;
    }
    for (std::int32_t i = cell.begin; i < cell.end; ++i)
      if (enter(boxes_[index(order_[index(i)])])) visit(order_[index(i)]);
  }

  template <class Limit, class MayBeNear, class Visit>
  void near_in_cell(std::int32_t c, double square, const Point<Dim>& x, const Limit& limit,
                    const MayBeNear& may_be_near, const Visit& visit) const {
    if (square > limit() || !may_be_near(index(c))) return;
    const Cell& cell = cells_[index(c)];
    if (cell.child < 0) {
      for (std::int32_t i = cell.begin; i < cell.end; ++i)
        if (squared_gap_to(boxes_[index(order_[index(i)])], x) <= limit()) visit(order_[index(i)]);
      return;
    }
    std::int32_t first = cell.child, second = cell.child + 1;
    double to_first = squared_gap_to(cells_[index(first)].box, x),
           to_second = squared_gap_to(cells_[index(second)].box, x);
    if (to_second < to_first) {
      std::swap(first, second);
      std::swap(to_first, to_second);
    }
    near_in_cell(first, to_first, x, limit, may_be_near, visit);
    near_in_cell(second, to_second, x, limit, may_be_near, visit);
  }

  std::vector<Box<Dim>> boxes_;
  std::vector<std::int32_t> order_;
  std::vector<Cell> cells_;
};

}  // namespace pnpbs
