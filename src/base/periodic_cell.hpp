// SPDX-License-Identifier: BSD-3-Clause
// The cell of a periodic domain, which repeats along some axes. The nodes of the domain lie in the
// cell. Every node has an image in each translated copy of the cell; a rank has the images near its
// own nodes as ghosts. Positions are multiples of a step, and so are the periods. A translation is
// therefore exact, and what is computed from the images of nodes equals, to the last bit, what is
// computed from the nodes themselves.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "base/types.hpp"

namespace pnpbs {

// Counts the periods between a copy of the cell and the cell itself, along each axis.
template <int Dim>
using Image = std::array<std::int32_t, Dim>;

template <int Dim>
class PeriodicCell {
 public:
  // Farthest copy of the cell that a rank has nodes of, along each axis.
  static constexpr std::int32_t kFarthest = 7;

  PeriodicCell() = default;  // a domain that is not periodic
  // Along the axes with `periodic`, the domain has the period high - low, rounded to the step.
  PeriodicCell(const Box<Dim>& box, const std::array<bool, Dim>& periodic) : box_(box) {
    double farthest = 0;
    for (int k = 0; k < Dim; ++k) {
      if (!periodic[k]) continue;
      const double period = box.high[k] - box.low[k];
      const double ends = std::max(std::fabs(box.low[k]), std::fabs(box.high[k]));
      farthest = std::max(farthest, ends + (kFarthest + 1) * period);
    }
    if (farthest == 0) return;
    // An even number of steps, so that a translation does not change how ties are rounded.
    step_ = std::ldexp(1.0, std::ilogb(farthest) + 1 - kDigits);
    for (int k = 0; k < Dim; ++k) {
      if (!periodic[k]) continue;
      period_[k] = 2 * step_ * std::round((box.high[k] - box.low[k]) / (2 * step_));
      box_.low[k] = step_ * std::round(box.low[k] / step_);
      box_.high[k] = box_.low[k] + period_[k];
    }
  }

  bool any() const { return step_ > 0; }
  bool periodic(int k) const { return period_[k] > 0; }
  double period(int k) const { return period_[k]; }
  const Box<Dim>& box() const { return box_; }

  // Returns the copy of the cell that contains x.
  Image<Dim> image_of(const Point<Dim>& x) const {
    Image<Dim> image{};
    for (int k = 0; k < Dim; ++k) {
      if (!periodic(k) || !std::isfinite(x[k])) continue;
      const double periods = std::floor((x[k] - box_.low[k]) / period_[k]);
      image[k] = static_cast<std::int32_t>(std::clamp(periods, -1e9, 1e9));
      const double at = x[k] - image[k] * period_[k];
      image[k] += (at >= box_.high[k]) - (at < box_.low[k]);
    }
    return image;
  }
  // Returns the point from which x differs by the periods to the image.
  Point<Dim> seen_from(const Image<Dim>& image, Point<Dim> x) const {
    for (int k = 0; k < Dim; ++k) x[k] -= image[k] * period_[k];
    return x;
  }
  // Returns the point of the cell that x is an image of.
  Point<Dim> in_cell(const Point<Dim>& x) const { return any() ? seen_from(image_of(x), x) : x; }

  // Returns the multiple of the step nearest to a displacement or to a point.
  Point<Dim> rounded(Point<Dim> x) const {
    for (int k = 0; k < Dim; ++k)
      if (periodic(k)) x[k] = rounded(x[k]);
    return x;
  }
  double rounded(double x) const {
    const double shift = step_ * 0x1.8p52;
    return (x + shift) - shift;
  }

  // Ids of nodes. Ids of images of a node follow that of the node, in an order that is the same
  // from whichever copy of the cell they are seen. Without a periodic axis, the id of node n is n.
  std::int64_t id_of(std::int64_t n) const { return any() ? n * kImages + kHome : n; }
  std::int64_t number_of(std::int64_t id) const { return any() && id >= 0 ? id / kImages : id; }
  // Returns the id of the node itself for the id of an image of it.
  std::int64_t home_id(std::int64_t id) const { return any() ? id_of(number_of(id)) : id; }
  Image<Dim> image_of_id(std::int64_t id) const {
    Image<Dim> image{};
    if (!any()) return image;
    std::int64_t code = id % kImages;
    for (int k = 0; k < Dim; ++k, code /= kAlong)
      image[k] = static_cast<std::int32_t>(code % kAlong) - kFarthest;
    return image;
  }
  // Returns by how much the id of a node exceeds that of the node in the cell.
  static std::int64_t id_shift(const Image<Dim>& image) {
    std::int64_t shift = 0;
    for (int k = Dim - 1; k >= 0; --k) shift = shift * kAlong + image[k];
    return shift;
  }

 private:
  static constexpr int kDigits = 51;
  static constexpr std::int64_t kAlong = 2 * kFarthest + 1;
  static constexpr std::int64_t kImages = Dim == 2 ? kAlong * kAlong : kAlong * kAlong * kAlong;
  static constexpr std::int64_t kHome = kFarthest * (1 + kAlong + (Dim == 2 ? 0 : kAlong * kAlong));

  Box<Dim> box_{};
  Point<Dim> period_{};  // 0 along axes that are not periodic
  double step_ = 0;
};

// The change of positions and ids where another copy of the cell takes the place of the cell.
template <int Dim>
struct Translation {
  const PeriodicCell<Dim>& cell;
  Image<Dim> image;  // the copy that the result is seen from

  Point<Dim> operator()(const Point<Dim>& x) const { return cell.seen_from(image, x); }
  Box<Dim> operator()(const Box<Dim>& box) const { return {(*this)(box.low), (*this)(box.high)}; }
  // Returns the point that the translation leads to x.
  Point<Dim> back(Point<Dim> x) const {
    for (int k = 0; k < Dim; ++k) x[k] += image[k] * cell.period(k);
    return x;
  }
  std::int64_t id(std::int64_t id) const { return id - PeriodicCell<Dim>::id_shift(image); }
};

}  // namespace pnpbs
