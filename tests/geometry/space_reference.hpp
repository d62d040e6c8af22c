// SPDX-License-Identifier: BSD-3-Clause
// Reference for the predicates of five points in space: determinants of the coordinates themselves
// (not of differences) in exact integers.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/types.hpp"
#include "exact_integer.hpp"

using FivePoints = std::array<pnpbs::Point<3>, 5>;
using FiveIds = std::array<std::int64_t, 5>;

struct SpaceSigns {
  int sphere;               // of a, b, c, d, e: 1 if e is inside and a, b, c, d have orientation 1
  std::array<int, 5> rest;  // orientation of the other four points without each
};

// Exponents such that all coordinates are integer multiples of 2^unit and below 2^top.
struct Units {
  int unit = 1100;
  int top = -1100;

  explicit Units(const FivePoints& points) {
    for (const auto& point : points) {
      for (const double x : point) {
        if (x == 0) continue;
        int exponent;
        auto whole = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
        top = std::max(top, exponent);
        for (exponent -= 53; whole % 2 == 0; whole /= 2) ++exponent;
        unit = std::min(unit, exponent);
      }
    }
  }
};

template <int Capacity>
class SpaceDeterminants {
 public:
  SpaceDeterminants(const FivePoints& points, int unit) {
    for (int i = 0; i < 5; ++i) {
      for (int k = 0; k < 3; ++k) x_[i][k] = Integer(points[i][k], unit);
    }
    for (int i = 0; i < 5; ++i) {
      for (int j = i + 1; j < 5; ++j) pair_[i][j] = x_[i][1] * x_[j][2] - x_[j][1] * x_[i][2];
    }
  }

  // Determinant of the rows (x, y, z, |x|^2, 1) of the points, expanded along the column of |x|^2.
  // Its sign is that of (0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1) and a point inside.
  SpaceSigns signs() const {
    SpaceSigns result;
    Integer sum;
    for (int i = 0; i < 5; ++i) {
      const Integer volume = four_without(i);
      const Integer height = x_[i][0] * x_[i][0] + x_[i][1] * x_[i][1] + x_[i][2] * x_[i][2];
      sum = sum + (i % 2 == 0 ? -height * volume : height * volume);
      result.rest[i] = volume.sign();
    }
    result.sphere = sum.sign();
    return result;
  }

 private:
  using Integer = ExactInteger<Capacity>;

  // Determinant of the rows (x, y, z) of three points, expanded along the column of x.
  Integer three(int i, int j, int k) const {
    return x_[i][0] * pair_[j][k] - x_[j][0] * pair_[i][k] + x_[k][0] * pair_[i][j];
  }

  // Determinant of the rows (1, x, y, z) of four points, expanded along the column of 1.
  Integer four_without(int i) const {
    std::array<int, 4> p;
    for (int k = 0; k < 4; ++k) p[k] = k < i ? k : k + 1;
    return three(p[1], p[2], p[3]) - three(p[0], p[2], p[3]) + three(p[0], p[1], p[3]) -
           three(p[0], p[1], p[2]);
  }

  std::array<std::array<Integer, 3>, 5> x_;
  Integer pair_[5][5];
};

// Computes with enough digits for products of five factors and a few bits, for any coordinates.
inline SpaceSigns space_signs(const FivePoints& points) {
  const Units units(points);
  if (5 * (units.top - units.unit) + 10 < 32 * 24) {
    return SpaceDeterminants<24>(points, units.unit).signs();
  }
  return std::make_unique<SpaceDeterminants<340>>(points, units.unit)->signs();
}

// Returns the sign for heights |x|^2 + s^(rank of the id) with a small s > 0, where the smallest id
// has rank 1. It is the sign of the first nonzero coefficient of this polynomial in s.
inline int perturbed_sphere_sign(const FivePoints& points, const FiveIds& ids) {
  const SpaceSigns signs = space_signs(points);
  std::vector<int> coefficients{signs.sphere, 0, 0, 0, 0, 0};
  for (int i = 0; i < 5; ++i) {
    const auto rank = 1 + std::count_if(ids.begin(), ids.end(),
                                        [&](std::int64_t other) { return other < ids[i]; });
    coefficients[rank] = i % 2 == 0 ? -signs.rest[i] : signs.rest[i];
  }
  for (const int coefficient : coefficients) {
    if (coefficient != 0) return coefficient;
  }
  return 0;
}
