// SPDX-License-Identifier: BSD-3-Clause
#include "spacing/scattered_spacing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>

#include "base/cholesky.hpp"
#include "base/error.hpp"
#include "base/point_text.hpp"
#include "base/space_vectors.hpp"
#include "base/started_execution.hpp"
#include "domain/given_values.hpp"
#include "sphere/degrees.hpp"
#include "sphere/great_circle.hpp"

namespace pnpbs {
namespace {

// A point near x, with its position relative to x.
template <int Dim>
struct CloudSample {
  Point<Dim> way;
  double value, weight;
};

// Returns the share of its weight that a point keeps behind another one. `way` leads from x to the
// other point and `onwards` from there to the point. The share is 0 if the point lies behind the
// other one, and 1 if it lies beside it or in front.
template <int Dim>
double part_not_hidden(const Point<Dim>& way, const Point<Dim>& onwards) {
  constexpr double kHidden = 0.7;  // cosine of the angle at which the share becomes 0
  const double along = dot(way, onwards);
  if (along <= 0) return 1;
  const double cosine = along / std::sqrt(dot(way, way) * dot(onwards, onwards));
  return std::max(0.0, 1 - cosine / kHidden);
}

// Reduces the weights of hidden samples. `samples` must be sorted by distance.
template <int Dim>
void weaken_hidden(std::span<CloudSample<Dim>> samples) {
  for (std::size_t far = 1; far < samples.size(); ++far) {
    double part = 1;
    for (std::size_t near = 0; near < far && part > 0; ++near) {
      Point<Dim> onwards = samples[far].way;
      for (int i = 0; i < Dim; ++i) onwards[i] -= samples[near].way[i];
      part = std::min(part, part_not_hidden<Dim>(samples[near].way, onwards));
    }
    samples[far].weight *= part;
  }
}

// Normalises the weights to the sum 1. Makes them equal if all are 0.
template <int Dim>
void share_out(std::span<CloudSample<Dim>> samples) {
  double sum = 0;
  for (const CloudSample<Dim>& sample : samples) sum += sample.weight;
  const double equal = 1 / static_cast<double>(samples.size());
  for (CloudSample<Dim>& sample : samples) sample.weight = sum > 0 ? sample.weight / sum : equal;
}

// Changes the weights to those that the samples have in the value at the origin of a plane fitted
// by weighted least squares. No weight changes by more than kMaxFactor, so all remain positive.
// Linear functions are reproduced if this bound is not reached.
template <int Dim>
void fit_plane(std::span<CloudSample<Dim>> samples) {
  Point<Dim> mean{};
  for (const CloudSample<Dim>& sample : samples)
    for (int i = 0; i < Dim; ++i) mean[i] += sample.weight * sample.way[i];
  SquareMatrix<Dim> normal{};
  double trace = 0;
  for (const CloudSample<Dim>& sample : samples) {
    Point<Dim> way = sample.way;
    for (int i = 0; i < Dim; ++i) way[i] -= mean[i];
    for (int i = 0; i < Dim; ++i)
      for (int j = 0; j <= i; ++j) normal[i][j] += sample.weight * way[i] * way[j];
    trace += sample.weight * dot(way, way);
  }
  if (!(trace > 0)) return;
  // Values at points on a line do not determine the slope across it; this makes it 0.
  constexpr double kFlat = 1e-10;
  for (int i = 0; i < Dim; ++i) normal[i][i] += kFlat * trace;
  if (!factor_cholesky(normal)) return;
  constexpr double kMaxFactor = 3;
  Point<Dim> tilt = mean;
  solve_factored(normal, tilt.data());
  const double at_mean = 1 + dot(tilt, mean);
  for (CloudSample<Dim>& sample : samples)
    sample.weight *= std::clamp(at_mean - dot(tilt, sample.way), 1 / kMaxFactor, kMaxFactor);
  share_out(samples);
}

// Returns the vector from x to y. On a sphere it has the length of the arc and the arc's initial
// direction (the azimuthal equidistant projection about x).
template <int Dim, int Across>
Point<Across> way_between(const Point<Dim>& x, const Point<Dim>& y) {
  Point<Across> way{};
  if constexpr (Across == Dim) {
    for (int c = 0; c < Dim; ++c) way[c] = y[c] - x[c];
  } else {
    const Point<3> chord = difference(y, x), east = east_at(x), north = cross(unit_vector(x), east);
    const double along = length(x) * angle_between(x, y);
    way = {dot(chord, east), dot(chord, north)};
    const double flat = length(way);
    if (!(flat > 0)) return {along, 0};
    for (double& part : way) part *= along / flat;
  }
  return way;
}

}  // namespace

template <int Dim, int Across>
ScatteredSpacing<Dim, Across>::ScatteredSpacing(const GivenField<Dim, Across + 1>& field) {
  std::vector<std::size_t> order(field.points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return field.points[a] != field.points[b] ? field.points[a] < field.points[b] : a < b;
  });
  std::vector<Box<Dim>> boxes;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const Point<Dim>& x = field.points[order[k]];
    const double value = field.values[order[k]];
    if (!points_.empty() && points_.back() == x) {
      if (value == values_.back()) continue;
      const auto name = [&](std::size_t i) {
        return given_values::indexed(field.values_name, static_cast<std::int64_t>(i)) + " = " +
               number_text(field.values[i]);
      };
      throw Error(ErrorKind::spacing, name(order[k - 1]) + " and " + name(order[k]) +
                                          " are both at " + point_text(x) +
                                          ": a point has one spacing");
    }
    points_.push_back(x);
    values_.push_back(value);
    boxes.push_back({x, x});
  }
  tree_ = BoxTree<Dim>(std::move(boxes));
  collect_hints();
}

template <int Dim, int Across>
typename ScatteredSpacing<Dim, Across>::Neighbours ScatteredSpacing<Dim, Across>::nearest(
    const Point<Dim>& x) const {
  Neighbours near;
  const auto limit = [&] {
    return near.found <= kNeighbours ? std::numeric_limits<double>::infinity()
                                     : near.nearest[kNeighbours].square;
  };
  tree_.for_near(x, limit, [&](std::int32_t point) {
    const Neighbour one{squared_distance<Dim>(points_[static_cast<std::size_t>(point)], x), point};
    const auto begin = near.nearest.begin(), end = begin + near.found;
    const auto place = std::upper_bound(begin, end, one);
    if (place == near.nearest.end()) return;
    const bool full = near.found > kNeighbours;
    std::move_backward(place, full ? end - 1 : end, full ? end : end + 1);
    *place = one;
    if (!full) ++near.found;
  });
  return near;
}

template <int Dim, int Across>
double ScatteredSpacing<Dim, Across>::at(const Point<Dim>& x) const {
  const Neighbours near = nearest(x);
  const auto value = [&](int k) {
    return values_[static_cast<std::size_t>(near.nearest[static_cast<std::size_t>(k)].point)];
  };
  const double nearest_square = near.nearest[0].square;
  if (nearest_square == 0) return value(0);

  constexpr int kFits = 2;
  const int n = near.counting();
  const double beyond =
      near.found > n ? std::sqrt(nearest_square / near.nearest[kNeighbours].square) : 0;
  const double unit = std::sqrt(near.nearest[static_cast<std::size_t>(n - 1)].square);
  std::array<CloudSample<Across>, kNeighbours> around;
  const std::span samples(around.data(), static_cast<std::size_t>(n));
  for (int k = 0; k < n; ++k) {
    const Neighbour& one = near.nearest[static_cast<std::size_t>(k)];
    CloudSample<Across>& sample = around[static_cast<std::size_t>(k)];
    sample.weight = std::sqrt(nearest_square / one.square) - beyond;
    sample.way = way_between<Dim, Across>(x, points_[static_cast<std::size_t>(one.point)]);
    for (double& along : sample.way) along /= unit;
    sample.value = value(k) - value(0);
  }
  share_out<Across>(samples);
  weaken_hidden<Across>(samples);
  share_out<Across>(samples);
  for (int fit = 0; fit < kFits; ++fit) fit_plane<Across>(samples);
  double rise = 0;
  for (const CloudSample<Across>& sample : samples) rise += sample.weight * sample.value;
  return value(0) + rise;
}

template <int Dim, int Across>
void ScatteredSpacing<Dim, Across>::evaluate(std::int64_t n, const Point<Dim>* x, double* d) const {
  for_each_if_started("pnpbs::ScatteredSpacing::evaluate", n,
                      [=, this](std::int64_t i) { d[i] = at(x[i]); });
}

template <int Dim, int Across>
void ScatteredSpacing<Dim, Across>::collect_hints() {
  constexpr int kNearest = Across + 1;
  const auto count = static_cast<std::int64_t>(points_.size());
  std::vector<std::array<Neighbour, kNearest>> nearest_ones(points_.size());
  for_each_if_started("pnpbs::ScatteredSpacing::collect_hints", count, [&](std::int64_t i) {
    const auto at = static_cast<std::size_t>(i);
    const Neighbours near = nearest(points_[at]);  // the first one is the point itself
    for (std::size_t k = 0; k < kNearest; ++k) {
      const bool is_there = static_cast<int>(k) + 1 < near.found;
      nearest_ones[at][k] = near.nearest[is_there ? k + 1 : 0];
    }
  });
  for (std::size_t i = 0; i < points_.size(); ++i) {
    known_.values.push_back({points_[i], values_[i]});
    for (const Neighbour& one : nearest_ones[i]) {
      const auto other = static_cast<std::size_t>(one.point);
      if (!(one.square > 0)) continue;
      known_.slopes.push_back({std::fabs(values_[other] - values_[i]) / std::sqrt(one.square),
                               std::min(values_[other], values_[i]),
                               middle_of<Dim>(points_[i], points_[other])});
    }
  }
}

template <int Dim, int Across>
std::optional<GivenExtent<Dim>> ScatteredSpacing<Dim, Across>::extent() const {
  constexpr double endless = std::numeric_limits<double>::infinity();
  Box<Dim> box{points_.front(), points_.front()};
  for (const Point<Dim>& x : points_) box = joined(box, Box<Dim>{x, x});
  const double along = std::pow(static_cast<double>(points_.size()), 1.0 / Dim);
  for (int k = 0; k < Dim; ++k) {
    const double side = box.high[k] - box.low[k];
    const double reach = side > 0 ? side / along : endless;
    box.low[k] -= reach;
    box.high[k] += reach;
  }
  return GivenExtent<Dim>{"cloud of points", "d is near that of the nearest points", box};
}

template class ScatteredSpacing<2>;
template class ScatteredSpacing<3>;
template class ScatteredSpacing<3, 2>;

SphereScatteredSpacing::SphereScatteredSpacing(const SphereField& field, double radius)
    : ScatteredSpacing<3, 2>(field), radius_(radius), middle_{}, angle_(std::numbers::pi) {
  for (const Point<3>& x : field.points) middle_ = shifted(middle_, 1 / radius, x);
  constexpr double kOnePlace = 1e-9;
  double widest = 0;
  for (const Point<3>& x : field.points) widest = std::max(widest, angle_between(middle_, x));
  if (widest > kOnePlace)
    angle_ = widest + 2 * widest / std::sqrt(static_cast<double>(field.points.size()));
}

std::optional<GivenExtent<3>> SphereScatteredSpacing::extent() const {
  return GivenExtent<3>{"cloud of points", "d is near that of the nearest points", {}};
}

void SphereScatteredSpacing::distance_to_extent(std::int64_t n, const Point<3>* x,
                                                double* distances) const {
  for (std::int64_t i = 0; i < n; ++i)
    distances[i] = radius_ * std::max(0.0, angle_between(middle_, x[i]) - angle_);
}

}  // namespace pnpbs
