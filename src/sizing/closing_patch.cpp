// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/closing_patch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/lattice.hpp"
#include "base/point_text.hpp"
#include "base/space_vectors.hpp"
#include "comm/communicator.hpp"
#include "sizing/closing_disc.hpp"

namespace pnpbs {

namespace {

// Radii of the patch and of the disc. [d] At 12 d from the projection point the chart grows by a
// sixth from node to node, which bubbles can follow. The disc is larger because its border is
// artificial.
constexpr double kRadius = 12, kRadiusOfDisc = 17;
// Upper bounds of these radii [radians]
constexpr double kMostOfSphere = 1.6, kMostOfSphereForDisc = 2.4;
// Depth to which free nodes may enter between the last nodes of the patch.
constexpr double kSeam = 0.5;  // [d]
// Part of the patch around the point whose nodes stay fixed in the finish as well. The chart grows
// by more than a third from node to node there.
constexpr double kFixed = 0.5;  // [radius of the patch]
constexpr double kSameSpacing = 0.02;
// Distance from the projection point within which d is not evaluated, because the chart cannot
// represent the point.
constexpr double kNotNearer = 0.25;  // [d]

Point<3> opposite(const Point<3>& x) { return {-x[0], -x[1], -x[2]}; }

double area_of(const StereographicChart& chart) {
  return 4 * std::numbers::pi * chart.radius() * chart.radius();
}

// Returns the chart projected from the opposite point.
StereographicChart opposite_of(const StereographicChart& chart) {
  return {chart.radius(), opposite(chart.projection_centre())};
}

// A spacing given in one chart, converted to the chart of the opposite side. Within `least` of the
// projection point of the first chart it is constant along each ray.
class FromOtherSide : public Spacing<2> {
 public:
  FromOtherSide(const Spacing<2>& spacing, const StereographicChart& chart,
                const StereographicChart& other, double least)
      : spacing_(spacing), chart_(chart), other_(other), least_(least) {}

  void evaluate(std::int64_t n, const Point<2>* v, double* d) const override {
    std::vector<Point<2>> u(static_cast<std::size_t>(n));
    std::vector<double> factor(u.size());
    for (std::size_t i = 0; i < u.size(); ++i) {
      u[i] = chart_.in_chart(other_.on_sphere(not_too_near(v[i])));
      factor[i] = other_.stretch(v[i]) / chart_.stretch(u[i]);
    }
    evaluate_spacing<2>(spacing_, area_of(chart_), n, u.data(), d);
    for (std::size_t i = 0; i < u.size(); ++i) d[i] *= factor[i];
  }

  SpacingHints<2> spacing_hints() const override {
    SpacingHints<2> known = spacing_.spacing_hints();
    turn_all(known.values, [](auto& value) -> Point<2>& { return value.x; });
    turn_all(known.in_domain, [](auto& value) -> Point<2>& { return value.x; });
    turn_all(known.slopes, [](auto& slope) -> Point<2>& { return slope.at; });
    return known;
  }

 private:
  // Converts hints to the other chart, except those that it cannot represent.
  template <class Known, class PlaceOf>
  void turn_all(std::vector<Known>& all, const PlaceOf& place_of) const {
    std::size_t kept = 0;
    for (Known& known : all) {
      Point<2>& u = place_of(known);
      const Point<2> v = other_.in_chart(chart_.on_sphere(u));
      const double stretch = other_.stretch(v);
      if (!(stretch < StereographicChart::kMaxStretch)) continue;
      known.d *= stretch / chart_.stretch(u);
      u = v;
      all[kept++] = known;
    }
    all.erase(all.begin() + static_cast<std::ptrdiff_t>(kept), all.end());
  }

  Point<2> not_too_near(const Point<2>& v) const {
    const double r = std::hypot(v[0], v[1]);
    if (r >= least_) return v;
    return r > 0 ? Point<2>{v[0] * (least_ / r), v[1] * (least_ / r)} : Point<2>{least_, 0};
  }

  const Spacing<2>& spacing_;
  const StereographicChart &chart_, &other_;
  double least_;
};

// Returns d on the sphere at the projection point of the chart.
double spacing_at_point(const Spacing<2>& spacing, const StereographicChart& chart) {
  constexpr double kFirst = 1e-3;
  const StereographicChart other = opposite_of(chart);
  const Point<2> at{0, 0};
  double d = 0;
  FromOtherSide(spacing, chart, other, kFirst * chart.radius()).evaluate(1, &at, &d);
  FromOtherSide(spacing, chart, other, kNotNearer * d).evaluate(1, &at, &d);
  return d;
}

// Rotates x by the rotation that maps c to p; both must have length 1.
Point<3> turned(const Point<3>& x, const Point<3>& c, const Point<3>& p) {
  const Point<3> sum{c[0] + p[0], c[1] + p[1], c[2] + p[2]};
  const double along = dot(sum, x) / (1 + dot(c, p)), twice = 2 * dot(c, x);
  Point<3> y;
  for (std::size_t k = 0; k < 3; ++k) y[k] = x[k] - along * sum[k] + twice * p[k];
  return y;
}

// Shrinks the triangle around the projection point until, in the chart, all other nodes lie well
// inside the straight edges between the triangle's corners. In a regular lattice the circumcircles
// of adjacent triangles pass through the point, and these triangles are flat in the chart
// otherwise.
void shrink_rim(const StereographicChart& chart, ClosingPatch& patch) {
  constexpr double kStep = 0.94, kInside = 0.97;
  constexpr int kMostSteps = 8;
  const Point<3> point = chart.projection_centre();
  const auto all_inside = [&] {
    std::array<Point<2>, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = chart.in_chart(patch.rim[k]);
    return std::ranges::all_of(patch.nodes, [&](const Point<2>& u) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Point<2>&a = corners[k], &b = corners[(k + 1) % 3];
        const Point<2> across{b[1] - a[1], a[0] - b[0]};
        if (dot(across, u) / dot(across, a) > kInside) return false;
      }
      return true;
    });
  };
  for (int step = 0; step < kMostSteps && !all_inside(); ++step)
    for (Point<3>& corner : patch.rim) {
      for (std::size_t k = 0; k < 3; ++k) corner[k] = point[k] + kStep * (corner[k] - point[k]);
      const double factor = chart.radius() / length(corner);
      for (double& x : corner) x *= factor;
    }
}

// Rotates nodes on the sphere so that the triangle of the first three is centred at the projection
// point.
std::vector<Point<3>> turned_to_point(const StereographicChart& chart,
                                      std::vector<Point<3>> nodes) {
  Point<3> middle{};
  for (std::size_t corner = 0; corner < 3; ++corner) middle = shifted(middle, 1, nodes[corner]);
  const Point<3> from = unit_vector(middle), to = unit_vector(chart.projection_centre());
  for (Point<3>& x : nodes) x = turned(x, from, to);
  return nodes;
}

// Removes nodes that protrude from the patch, because no lattice fits around them.
void remove_protruding_nodes(const StereographicChart& chart, const Spacing<2>& spacing,
                             ClosingPatch& patch) {
  constexpr double kNear = 1.35;  // [d at the node]
  constexpr int kFewest = 4;
  std::vector<Point<3>> all(patch.rim.begin(), patch.rim.end());
  for (const Point<2>& u : patch.nodes) all.push_back(chart.on_sphere(u));
  std::vector<double> d(patch.nodes.size());
  evaluate_spacing<2>(spacing, area_of(chart), std::ssize(d), patch.nodes.data(), d.data());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < patch.nodes.size(); ++i) {
    const double reach = kNear * d[i] / chart.stretch(patch.nodes[i]);
    const auto near = std::ranges::count_if(
        all, [&](const Point<3>& x) { return distance<3>(x, all[i + 3]) < reach; });
    if (near > kFewest) patch.nodes[kept++] = patch.nodes[i];  // the node itself is counted as well
  }
  patch.nodes.resize(kept);
}

// Returns the radius of the patch for d in radians. [radians]
double last_of_patch(double d) { return std::min(kRadius * d, kMostOfSphere); }

// Returns the distance from the origin of the chart that corresponds to this angle from the
// projection point.
double edge_in_chart(const StereographicChart& chart, double angle) {
  return 2 * chart.radius() / std::tan(angle / 2);
}

ClosingPatch closing_patch(const StereographicChart& chart, const Spacing<2>& spacing) {
  const double radius = chart.radius();
  const StereographicChart other = opposite_of(chart);
  ClosingPatch patch;
  patch.d = spacing_at_point(spacing, chart);
  const double d = patch.d / radius;  // d on the sphere in radians
  if (d > kMostAtPoint)
    throw Error(ErrorKind::spacing,
                "the spacing at the point that is named as outside of the domain is " +
                    number_text(patch.d) + ": on a whole sphere of radius " + number_text(radius) +
                    " it must be at most " + number_text(kMostAtPoint * radius) +
                    " there: name another point");
  const FromOtherSide around(spacing, chart, other, kNotNearer * patch.d);
  const std::vector<Point<3>> nodes = turned_to_point(
      chart, nodes_around(other, around, std::min(kRadiusOfDisc * d, kMostOfSphereForDisc)));
  std::copy_n(nodes.begin(), 3, patch.rim.begin());
  const double last = last_of_patch(d);
  patch.edge = edge_in_chart(chart, last);
  patch.beyond = edge_in_chart(chart, last - kSeam * d);
  patch.margin = edge_in_chart(chart, kFixed * last);
  for (std::size_t n = 3; n < nodes.size(); ++n) {
    const Point<2> u = chart.in_chart(nodes[n]);
    if (dot(u, u) >= patch.edge * patch.edge) patch.nodes.push_back(u);
  }
  remove_protruding_nodes(chart, spacing, patch);
  shrink_rim(chart, patch);
  return patch;
}

bool is_closed_for(const PlaneDomain& domain, const Spacing<2>& spacing) {
  if (!domain.closing()) return false;
  const double d = spacing_at_point(spacing, domain.embedding().chart());
  return std::fabs(d / domain.closing()->d - 1) < kSameSpacing;
}

}  // namespace

std::shared_ptr<const PlaneDomain> closed_before_sizing(
    const std::shared_ptr<const PlaneDomain>& domain, const SizingField<2>& spacing,
    double wanted_nodes) {
  if (!domain->is_whole_sphere() || wanted_nodes == 0) return closed_domain(domain, spacing);
  constexpr double kALittleLess = 0.99;
  const StereographicChart& chart = domain->embedding().chart();
  const double even = std::sqrt(Lattice<2>::kDensity * area_of(chart) / wanted_nodes),
               d = std::min(even, kALittleLess * kMostAtPoint * chart.radius());
  return closed_domain(domain, spacing.coarsened(d / spacing_at_point(spacing, chart)));
}

std::shared_ptr<const VolumeDomain> closed_before_sizing(
    const std::shared_ptr<const VolumeDomain>& domain, const SizingField<3>&, double) {
  return domain;
}

std::shared_ptr<const PlaneDomain> closed_domain(const std::shared_ptr<const PlaneDomain>& domain,
                                                 const Spacing<2>& spacing) {
  if (!domain->is_whole_sphere() || is_closed_for(*domain, spacing)) return domain;
  auto closed = std::make_shared<PlaneDomain>(*domain);
  closed->close(closing_patch(domain->embedding().chart(), spacing));
  closed->check();
  return closed;
}

std::shared_ptr<const VolumeDomain> closed_domain(const std::shared_ptr<const VolumeDomain>& domain,
                                                  const Spacing<3>&) {
  return domain;
}

bool can_be_closed(const PlaneDomain& domain, const Spacing<2>& spacing) {
  if (!domain.is_whole_sphere()) return true;
  const StereographicChart& chart = domain.embedding().chart();
  const double d = spacing_at_point(spacing, chart) / chart.radius();
  return d <= kMostAtPoint && domain.leaves_room_beyond(edge_in_chart(chart, last_of_patch(d)));
}
bool can_be_closed(const VolumeDomain&, const Spacing<3>&) { return true; }

double factor_closed_for(const PlaneDomain& domain, const Spacing<2>& spacing) {
  if (!domain.closing()) return 1;
  return domain.closing()->d / spacing_at_point(spacing, domain.embedding().chart());
}
double factor_closed_for(const VolumeDomain&, const Spacing<3>&) { return 1; }

}  // namespace pnpbs
