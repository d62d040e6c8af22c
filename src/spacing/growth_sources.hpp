// SPDX-License-Identifier: BSD-3-Clause
// A search tree over sources that limit d around them, such as points or facets. The limit of all
// sources at x is the minimum of d + g |x - y|.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "spacing/growth_source.hpp"
#include "tree/box_tree.hpp"

namespace pnpbs {

template <int Dim>
Box<Dim> box_of(const GrowthSource<Dim>& source) {
  return {source.x, source.x};
}

// A set of sources with a growth. Source requires d, limit(x, growth) and box_of().
template <int Dim, class Source = GrowthSource<Dim>>
class GrowthSources {
 public:
  GrowthSources() = default;
  explicit GrowthSources(std::vector<Source> sources, double growth = 0)
      : sources_(std::move(sources)), growth_(growth) {
    if (sources_.empty()) return;
    cells_.push_back({{}, 0, 0, sources_.size(), 0});
    for (std::size_t cell = 0; cell < cells_.size(); ++cell) split(cell);
  }

  // Returns the limit at x if it is below `bound`, otherwise `bound`.
  double limit(const Point<Dim>& x, double bound) const { return limit(x, bound, growth_); }
  // Returns the same for another growth.
  double limit(const Point<Dim>& x, double bound, double growth) const {
    if (!cells_.empty()) look_into(0, least_in(0, x, growth), x, growth, bound);
    return bound;
  }

 private:
  // A node of the search tree: a contiguous range of sources.
  struct Cell {
    Box<Dim> box;
    double min;                     // smallest d of its sources
    std::size_t begin, end, child;  // child: index of the first of two children, or 0
  };

  void split(std::size_t c) {
    constexpr std::size_t kLeafSize = 8;
    const auto begin = sources_.begin() + static_cast<std::ptrdiff_t>(cells_[c].begin),
               end = sources_.begin() + static_cast<std::ptrdiff_t>(cells_[c].end);
    cells_[c].box = box_of(*begin);
    cells_[c].min = begin->d;
    for (auto source = begin; source != end; ++source) {
      cells_[c].box = joined(cells_[c].box, box_of(*source));
      cells_[c].min = std::min(cells_[c].min, source->d);
    }
    if (cells_[c].end - cells_[c].begin <= kLeafSize) return;
    const Box<Dim> box = cells_[c].box;
    std::size_t longest = 0;
    for (std::size_t k = 1; k < Dim; ++k)
      if (box.high[longest] - box.low[longest] < box.high[k] - box.low[k]) longest = k;
    const std::size_t middle = (cells_[c].begin + cells_[c].end) / 2;
    std::nth_element(begin, sources_.begin() + static_cast<std::ptrdiff_t>(middle), end,
                     [longest](const Source& a, const Source& b) {
                       const Box<Dim> of_a = box_of(a), of_b = box_of(b);
                       return of_a.low[longest] + of_a.high[longest] <
                              of_b.low[longest] + of_b.high[longest];
                     });
    cells_[c].child = cells_.size();
    cells_.push_back({{}, 0, cells_[c].begin, middle, 0});
    cells_.push_back({{}, 0, middle, cells_[c].end, 0});
  }

  double least_in(std::size_t c, const Point<Dim>& x, double growth) const {
    return cells_[c].min + growth * std::sqrt(squared_gap_to(cells_[c].box, x));
  }

  // Lowers the bound to the limits of the sources in a cell. Sources whose limits differ from the
  // minimum by rounding only are all evaluated, so the result has the same bits for any order of
  // the sources.
  void look_into(std::size_t c, double least, const Point<Dim>& x, double growth,
                 double& bound) const {
    constexpr double kRounding = 1 - 1e-12;
    if (!(kRounding * least < bound)) return;
    const Cell& cell = cells_[c];
    if (cell.child == 0) {
      for (std::size_t s = cell.begin; s < cell.end; ++s)
        bound = std::min(bound, sources_[s].limit(x, growth));
      return;
    }
    std::size_t first = cell.child, second = cell.child + 1;
    double by_first = least_in(first, x, growth), by_second = least_in(second, x, growth);
    if (by_second < by_first) {
      std::swap(first, second);
      std::swap(by_first, by_second);
    }
    look_into(first, by_first, x, growth, bound);
    look_into(second, by_second, x, growth, bound);
  }

  std::vector<Source> sources_;
  double growth_ = 0;
  std::vector<Cell> cells_;
};

}  // namespace pnpbs
