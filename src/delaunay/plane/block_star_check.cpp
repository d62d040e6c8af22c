// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay/plane/block_star_check.hpp"

#include <cmath>

#include "delaunay/plane/block_hull_stars.hpp"

namespace pnpbs {

namespace {

using Lanes = double[kLanes];
using Integers = std::int32_t[kLanes];

// Squares of lengths for which the products of six lengths neither overflow nor lose bits.
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
  // Positions relative to the node: of the neighbours in their order, then of the first two again.
  // (What shorter stars are filled up with is the first.)
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
  Lanes min_of_others_;  // squared distance
  Lanes x_[kMaxListed + 2], y_[kMaxListed + 2], square_[kMaxListed + 2];
  Lanes cross_[kMaxListed + 1], cross_size_[kMaxListed + 1];  // of one and the next
};

}  // namespace

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

}  // namespace pnpbs
