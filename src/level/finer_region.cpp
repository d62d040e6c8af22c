// SPDX-License-Identifier: BSD-3-Clause
#include "level/finer_region.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>

#include "method/constants.hpp"

namespace pnpbs {

namespace {

// A cell of the lattice of cells whose side is the power of two up to d: its octave and its index.
using CellKey = std::pair<int, std::array<std::int64_t, 3>>;

CellKey cell_of(const Point<3>& x, double d) {
  const int octave = std::ilogb(d);
  const double side = std::ldexp(1.0, octave);
  std::array<std::int64_t, 3> index{};
  for (std::size_t k = 0; k < 3; ++k) index[k] = std::llround(std::floor(x[k] / side));
  return {octave, index};
}

// A point that the search has reached.
struct Reached {
  Point<3> x;
  double far_finer;  // the search continues while d is below this
};

// Returns the points one step away from the last ones in each axis direction, inside the domain and
// one per cell.
std::vector<Reached> neighbours_of(const std::vector<Reached>& last, const std::vector<double>& d,
                                   const std::function<bool(const Point<3>&)>& inside) {
  std::vector<Reached> next;
  std::set<CellKey> seen;
  for (std::size_t i = 0; i < last.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      for (const double step : {-1.0, 1.0}) {
        Reached there = last[i];
        there.x[k] += step * std::ldexp(1.0, std::ilogb(d[i]));
        if (seen.insert(cell_of(there.x, d[i])).second && inside(there.x)) next.push_back(there);
      }
  return next;
}

}  // namespace

SpacingHints<3> finer_region(const std::vector<UndersampledSpacing::Place>& places,
                             const SpacingEvaluator<3>& spacing,
                             const std::function<bool(const Point<3>&)>& inside) {
  constexpr std::size_t kMaxPlaces = 1 << 18;
  // Largest distance of a point in a leaf from the nearest sample, in sides of the leaf.
  constexpr double kFarthest = 0.44;
  const auto values_at = [&](const std::vector<Reached>& reached) {
    std::vector<Point<3>> x;
    for (const Reached& one : reached) x.push_back(one.x);
    std::vector<double> d(x.size());
    spacing(std::ssize(x), x.data(), d.data());
    return d;
  };
  SpacingHints<3> known;
  std::set<CellKey> seen;
  std::vector<Reached> last;
  for (const UndersampledSpacing::Place& place : places) last.push_back({place.x, 0});
  std::vector<double> d = values_at(last);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double sampled = places[i].sampled / places[i].d * d[i];
    last[i].far_finer = method::kFarFiner * sampled;
    known.slopes.push_back(
        {(sampled - d[i]) / (kFarthest * places[i].leaf_side), d[i], last[i].x, true});
    known.in_domain.push_back({last[i].x, d[i]});
    seen.insert(cell_of(last[i].x, d[i]));
  }
  while (!last.empty() && known.in_domain.size() < kMaxPlaces) {
    const std::vector<Reached> next = neighbours_of(last, d, inside);
    const std::vector<double> there = values_at(next);
    last.clear();
    d.clear();
    for (std::size_t i = 0; i < next.size(); ++i) {
      if (there[i] >= next[i].far_finer || !seen.insert(cell_of(next[i].x, there[i])).second)
        continue;
      known.in_domain.push_back({next[i].x, there[i]});
      last.push_back(next[i]);
      d.push_back(there[i]);
    }
  }
  return known;
}

}  // namespace pnpbs
