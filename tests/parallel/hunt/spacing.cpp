// SPDX-License-Identifier: BSD-3-Clause
// Evaluates the random spacings, chooses their parameters and passes them to a placement.

#include "spacing.hpp"

#include <cmath>

namespace hunt {

namespace {

std::int32_t spacing_at(std::int64_t n, std::int32_t dim, const double* x, double* d, void* user) {
  const Spacing& spacing = *static_cast<const Spacing*>(user);
  for (std::int64_t i = 0; i < n; ++i)
    d[i] = spacing.at({x[dim * i], x[dim * i + 1], dim == 3 ? x[dim * i + 2] : 0});
  return 0;
}

// Returns a point of the body or near it, in the frame of the body.
Point point_near(Random& random, const Body& body) {
  Point at{};
  if (!body.meshes.empty()) {
    const auto& points = body.meshes.back().points;
    at = points[static_cast<std::size_t>(random.bits() % points.size())];
  } else if (!body.curves.empty()) {
    const auto& points = body.curves[0].points;
    const auto& [x, y] = points[static_cast<std::size_t>(random.bits() % points.size())];
    at = {x, y, 0};
  } else if (!body.solids.empty()) {
    at = body.solids[0].a;
  }
  for (int k = 0; k < body.dim; ++k) at[k] += random.between(-2, 2);
  return at;
}

}  // namespace

double Spacing::at(const Point& world) const {
  if (kind == Kind::constant) return frame.scale * base;
  const Point away = frame.to_body(world) - from;
  double square = 0;
  for (int k = 0; k < directions; ++k) square += away[k] * away[k];
  const double distance = std::sqrt(square);
  if (kind == Kind::grows) return frame.scale * (base + slope * distance);
  const double layer = distance / width;
  if (kind == Kind::layers)
    return frame.scale * base * (static_cast<long long>(layer) % 2 ? factor : 1);
  const double part = layer - std::floor(layer);
  return frame.scale * base * (1 + (factor - 1) * 4 * part * (1 - part));
}

std::string Spacing::name() const {
  const char* names[] = {"constant", "grows", "layers", "waves"};
  return names[static_cast<int>(kind)];
}

Spacing random_spacing(Random& random, const Body& body) {
  Spacing spacing;
  spacing.frame = body.frame;
  const double which = random.unit();
  spacing.kind = which < 0.35   ? Spacing::Kind::constant
                 : which < 0.75 ? Spacing::Kind::grows
                 : which < 0.9  ? Spacing::Kind::layers
                                : Spacing::Kind::waves;
  spacing.slope = random.scale(0.03, random.chance(0.2) ? 5 : 0.6);
  spacing.directions = random.pick(1, body.dim);
  spacing.width = random.scale(1.5, 12);
  spacing.factor = random.scale(1.2, 4);
  spacing.from = point_near(random, body);
  return spacing;
}

pnpbs_status set(pnpbs_placement placement, const Spacing& spacing) {
  if (spacing.kind == Spacing::Kind::constant)
    return pnpbs_placement_set_spacing_constant(placement, spacing.at({}));
  return pnpbs_placement_set_spacing_callback(placement, spacing_at,
                                              const_cast<Spacing*>(&spacing));
}

}  // namespace hunt
