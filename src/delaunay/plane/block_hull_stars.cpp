// SPDX-License-Identifier: BSD-3-Clause
// Inversion about the node transforms the star to a convex hull, as in hull_star. A neighbour
// belongs to it if the inverted points before it, at it and after it turn left. All neighbours that
// do not are removed at once, and this is repeated until none is left to remove. Every decision
// must hold by a margin far above rounding errors; otherwise the lane is given up.
#include "delaunay/plane/block_hull_stars.hpp"

#include <cmath>

#include "dynamics/bubble_force.hpp"

namespace pnpbs {

namespace {

// Margin by which the squared diameters of circles must be below the squared reach. It covers the
// errors of cross products here and of circle_diameter. The relative error of its area is 1e-10 if
// no neighbour is nearer than kMinGap.
constexpr double kCircleMargin = 1 - 1e-8;
constexpr double kMinGap = 1e-4;  // [reach]
// Range of reaches for which products of six lengths neither overflow nor lose bits.
constexpr double kMinReach = 1e-30, kMaxReach = 1e30;

// Sorts after all keys, whatever index its low bits hold.
constexpr std::int32_t kNoKey = 0x7ffffff0;
constexpr std::int32_t kKeyIndex = kMaxListed - 1;
constexpr double kQuarterTurn = 1 << 24;
constexpr std::int32_t kTurnMask = (1 << 26) - 1;

using Lanes = double[kLanes];
using Integers = std::int32_t[kLanes];

class BlockHull {
 public:
  BlockHull(const ListBlock& list, std::int32_t pad, const double* x, const double* y,
            const std::int64_t (&self)[kLanes], const double (&reach)[kLanes])
      : entries_(list.entries), listed_(list.length) {
    gather(pad, x, y, self);
    for (int lane = 0; lane < kLanes; ++lane) {
      const double min_gap = kMinGap * reach[lane];
      sure_[lane] = reach[lane] > kMinReach && reach[lane] < kMaxReach &&
                    nearest_[lane] > min_gap * min_gap && left_[lane] >= 3;
    }
    key_by_angle();
  }

  void find(const double (&reach)[kLanes], BlockHullStars& stars) {
    length_ = listed_;
    do {
      sort();
      length_ = longest();
      close_ring();
    } while (drop_outsiders());
    check_circles(reach);
    for (int lane = 0; lane < kLanes; ++lane) {
      stars.found[lane] = sure_[lane] != 0;
      stars.size[lane] = left_[lane];
    }
    for (int k = 0; k < length_; ++k)
#pragma omp simd
      for (int lane = 0; lane < kLanes; ++lane)
        stars.node[k][lane] = entries_[(key_[k][lane] & kKeyIndex) * kLanes + lane];
  }

 private:
  // Computes the positions relative to the node and finds the nearest neighbour.
  void gather(std::int32_t pad, const double* x, const double* y,
              const std::int64_t (&self)[kLanes]) {
    Lanes own_x, own_y;
    for (int lane = 0; lane < kLanes; ++lane) {
      own_x[lane] = x[self[lane]];
      own_y[lane] = y[self[lane]];
      nearest_[lane] = 1e300;
      nearest_place_[lane] = 0;
      left_[lane] = 0;
    }
    for (int k = 0; k < listed_; ++k) {
#pragma omp simd
      for (int lane = 0; lane < kLanes; ++lane) {
        const std::int32_t j = entries_[k * kLanes + lane];
        const double dx = x[j] - own_x[lane], dy = y[j] - own_y[lane];
        const double square = j != pad ? dx * dx + dy * dy : 1e300;
        const double min = nearest_[lane];
        const std::int32_t nearer = square < min ? -1 : 0;
        nearest_[lane] = square < min ? square : min;
        nearest_place_[lane] = (nearest_place_[lane] & ~nearer) | (k & nearer);
        left_[lane] += j != pad ? 1 : 0;
        dx_[k][lane] = dx;
        dy_[k][lane] = dy;
      }
    }
  }

  // Returns a number that increases with the angle of (dx, dy), by kQuarterTurn per right angle.
  static std::int32_t angle(double dx, double dy) {
    const double t = dy / (std::fabs(dx) + std::fabs(dy) + 1e-300);
    return static_cast<std::int32_t>(kQuarterTurn * (dx >= 0 ? t : 2 - t));
  }

  // A key consists of the angle from the nearest neighbour and, in its low bits, of the index in
  // the list. The angles are approximate. Later checks verify the order that results.
  void key_by_angle() {
    Integers first;
#pragma omp simd
    for (int lane = 0; lane < kLanes; ++lane) {
      const std::int32_t place = nearest_place_[lane];
      first[lane] = angle(dx_[place][lane], dy_[place][lane]);
    }
    for (int k = 0; k < listed_; ++k) {
#pragma omp simd
      for (int lane = 0; lane < kLanes; ++lane) {
        const std::int32_t turn = (angle(dx_[k][lane], dy_[k][lane]) - first[lane]) & kTurnMask;
        key_[k][lane] = k < left_[lane] ? turn * kMaxListed + k : kNoKey;
      }
    }
  }

  void sort() {
    for (int k = 1; k < length_; ++k) {
      for (int m = k; m > 0; --m) {
#pragma omp simd
        for (int lane = 0; lane < kLanes; ++lane) {
          const std::int32_t a = key_[m - 1][lane], b = key_[m][lane];
          key_[m - 1][lane] = a < b ? a : b;
          key_[m][lane] = a < b ? b : a;
        }
      }
    }
  }

  int longest() const {
    std::int32_t max = 0;
    for (int lane = 0; lane < kLanes; ++lane) max = left_[lane] > max ? left_[lane] : max;
    return max;
  }

  // Stores the positions in order. The first and second follow again after the last.
  void close_ring() {
    for (int k = 0; k < length_ + 2; ++k) {
      const int row = k < length_ ? k : 0;
#pragma omp simd
      for (int lane = 0; lane < kLanes; ++lane) {
        const std::int32_t after = k - left_[lane];
        const std::int32_t again = after == 1 ? key_[1][lane] : key_[0][lane];
        const std::int32_t key = after < 0 ? key_[row][lane] : again;
        const std::int32_t place = key & kKeyIndex;
        const double px = dx_[place][lane], py = dy_[place][lane];
        x_[k][lane] = px;
        y_[k][lane] = py;
        square_[k][lane] = px * px + py * py;
      }
    }
    for (int k = 0; k < length_ + 1; ++k) {
#pragma omp simd
      for (int lane = 0; lane < kLanes; ++lane) {
        const double left = x_[k][lane] * y_[k + 1][lane];
        const double right = y_[k][lane] * x_[k + 1][lane];
        const double size = std::fabs(left) + std::fabs(right);
        const bool fine = left - right > kMinTurn * size || k >= left_[lane];
        cross_[k][lane] = left - right;
        cross_size_[k][lane] = size;
        sure_[lane] &= fine ? 1 : 0;
      }
    }
  }

  // Removes the neighbours that are not on the hull. Returns whether there were any in lanes that
  // are not given up.
  bool drop_outsiders() {
    Integers dropped{};
    for (int k = 1; k < length_ + 1; ++k) {
      const int row = k < length_ ? k : 0;
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
        const std::int32_t here = k <= left_[lane] ? 1 : 0;
        const std::int32_t inside = bend > kMinBend * size ? 1 : 0;
        const std::int32_t outside = bend < -kMinBend * size ? 1 : 0;
        sure_[lane] &= (inside | outside) | (1 - here);
        const std::int32_t drop = outside & here & sure_[lane];
        // The nearest neighbour is last here and first in the keys. It always belongs to the star.
        key_[row][lane] |= k < left_[lane] ? kNoKey & -drop : 0;
        dropped[lane] += drop;
      }
    }
    std::int32_t any = 0;
    for (int lane = 0; lane < kLanes; ++lane) {
      left_[lane] -= dropped[lane];
      any += dropped[lane];
    }
    return any > 0;
  }

  // Requires every circle through the node and two consecutive neighbours to lie within its reach.
  void check_circles(const double (&reach)[kLanes]) {
    for (int k = 0; k < length_; ++k) {
#pragma omp simd
      for (int lane = 0; lane < kLanes; ++lane) {
        const double sx = x_[k + 1][lane] - x_[k][lane], sy = y_[k + 1][lane] - y_[k][lane];
        // The diameter is the product of the three sides over twice the area.
        const double sides = square_[k][lane] * square_[k + 1][lane] * (sx * sx + sy * sy);
        const double max = reach[lane] * cross_[k][lane];
        const bool fine = sides <= kCircleMargin * max * max || k >= left_[lane];
        sure_[lane] &= fine ? 1 : 0;
      }
    }
  }

  const std::int32_t* entries_;
  int listed_;
  int length_ = 0;  // Length of the longest star.
  Integers left_;   // Listed neighbours that are not removed.
  Integers sure_;   // 0 if the lane is given up.
  Lanes nearest_;   // Squared distance.
  Integers nearest_place_;
  Lanes dx_[kMaxListed], dy_[kMaxListed];  // Sorted like the list.
  Integers key_[kMaxListed];
  Lanes x_[kMaxListed + 2], y_[kMaxListed + 2], square_[kMaxListed + 2];  // Sorted.
  // Cross products of each neighbour and the next, and the sums of the sizes of their terms.
  Lanes cross_[kMaxListed + 1], cross_size_[kMaxListed + 1];
};

}  // namespace

void find_block_hull_stars(const ListBlock& list, std::int32_t pad, const double* x,
                           const double* y, const std::int64_t (&self)[kLanes],
                           const double (&reach)[kLanes], BlockHullStars& stars) {
  if (list.length < 3 || list.length > kMaxListed) {
    for (bool& found : stars.found) found = false;
    return;
  }
  BlockHull(list, pad, x, y, self, reach).find(reach, stars);
}

}  // namespace pnpbs
