// SPDX-License-Identifier: BSD-3-Clause
// C interface: spheres.
#include <algorithm>
#include <cmath>

#include "api/domain_calls.hpp"
#include "api/sphere_points.hpp"
#include "base/point_text.hpp"
#include "domain/given_values.hpp"
#include "results/results.hpp"
#include "sphere/degrees.hpp"

using namespace pnpbs;
using namespace pnpbs::api;

namespace {

void require_degrees(std::int64_t i, const double* degrees) {
  constexpr double kMostTurns = 3600;
  const auto reject = [&](int k, const char* expected) {
    throw Error(ErrorKind::argument, "argument degrees[" + std::to_string(i) + "][" +
                                         std::to_string(k) + "] = " + number_text(degrees[k]) +
                                         ": expected a " + expected);
  };
  if (!(std::fabs(degrees[0]) <= kMostTurns)) reject(0, "longitude in degrees");
  if (!(std::fabs(degrees[1]) <= 90)) reject(1, "latitude from -90 to 90 degrees");
}

}  // namespace

Embedding<2> pnpbs::api::sphere_of(const PlacementObject& object) {
  const NodalResults& results = object.placement->results();
  return results.kind() == GeometryKind::sphere
             ? static_cast<const Results<2>&>(results).embedding()
             : Embedding<2>();
}

MessageText pnpbs::api::in_degrees(const Embedding<2>& sphere, const MessageText& message) {
  if (!sphere.is_sphere()) return message;
  const auto moved = [&sphere](NamedPoint point) {
    if (point.dimension != 2) return point;
    point.x = sphere.in_space({point.x[0], point.x[1]});
    point.dimension = 3;
    return point;
  };
  const auto words = [&](const NamedPoint& point, const std::string& text) {
    return point.dimension == 2 ? "(" + degrees_text(degrees_of(moved(point).x)) + ")" : text;
  };
  return with_points_replaced(message, words, moved);
}

// Keeps the message as it is if there is no memory for the new one.
void pnpbs::api::convert_to_degrees(const Embedding<2>& sphere, Context& context) noexcept {
  if (!sphere.is_sphere()) return;
  try {
    context.last_error.message = in_degrees(sphere, context.last_error.message);
    thread_error() = context.last_error;
  } catch (...) {
  }
}

pnpbs_status pnpbs_domain_create_sphere(pnpbs_context context, double radius, const double* outside,
                                        pnpbs_domain* domain) {
  return guarded(context, [&](Context& owner) {
    require_pointer(domain, "domain");
    *domain = nullptr;
    require_not_in_callback(owner);
    given_values::require_radius(radius);
    require_pointer(outside, "outside");
    auto object = std::make_shared<DomainObject>();
    object->context = require(context);
    object->plane = std::make_shared<PlaneDomain>(
        StereographicChart(radius, require_direction("outside", outside)));
    *domain = domains().add(std::move(object));
    return PNPBS_OK;
  });
}

// The coordinates of the poles and of the meridian of 180 degrees are exact.
pnpbs_status pnpbs_sphere_points(double radius, int64_t n, const double* degrees,
                                 double* coordinates) {
  return guarded([&] {
    given_values::require_radius(radius);
    require_count(n, "n");
    if (n > 0) require_pointer(degrees, "degrees");
    if (n > 0) require_pointer(coordinates, "coordinates");
    for (std::int64_t i = 0; i < n; ++i) require_degrees(i, degrees + 2 * i);
    for (std::int64_t i = 0; i < n; ++i) {
      const double turn = std::remainder(degrees[2 * i], 360), latitude = degrees[2 * i + 1];
      const double across = std::fabs(latitude) == 90 ? 0 : radius * std::cos(kDegree * latitude);
      const bool opposite = std::fabs(turn) == 180;
      coordinates[3 * i] = across * (opposite ? -1 : std::cos(kDegree * turn));
      coordinates[3 * i + 1] = opposite ? 0 : across * std::sin(kDegree * turn);
      coordinates[3 * i + 2] = radius * std::sin(kDegree * latitude);
    }
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_sphere_degrees(int64_t n, const double* coordinates, double* degrees) {
  return guarded([&] {
    const std::vector<Point<3>> points = require_directions("coordinates", n, coordinates);
    if (n > 0) require_pointer(degrees, "degrees");
    for (const Point<3>& x : points) {
      const Point<2> at = degrees_of(x);
      degrees = std::copy(at.begin(), at.end(), degrees);
    }
    return PNPBS_OK;
  });
}
