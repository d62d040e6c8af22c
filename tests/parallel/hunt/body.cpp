// SPDX-License-Identifier: BSD-3-Clause
// Adds bodies to domains and evaluates their level sets; measures, scales and refines meshes.

#include "body.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace hunt {

Point operator+(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point operator*(double factor, const Point& a) {
  return {factor * a[0], factor * a[1], factor * a[2]};
}
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double length(const Point& a) { return std::sqrt(dot(a, a)); }
Point unit(const Point& a) { return (1 / length(a)) * a; }

Point Frame::to_world(const Point& x) const {
  return scale * Point{dot(rotation[0], x), dot(rotation[1], x), dot(rotation[2], x)} + offset;
}

Point Frame::to_body(const Point& x) const {
  const Point from = (1 / scale) * (x - offset);
  return from[0] * rotation[0] + from[1] * rotation[1] + from[2] * rotation[2];
}

double nodes_of(double area, double volume) { return 1.15 * area + 1.2 * volume; }

double area_of(const Mesh& mesh) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Point &from = mesh.points[a], &to = mesh.points[b], &third = mesh.points[c];
    area += length(cross(to - from, third - from)) / 2;
  }
  return area;
}

double volume_of(const Mesh& mesh) {
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    volume += dot(mesh.points[a], cross(mesh.points[b], mesh.points[c])) / 6;
  return std::fabs(volume);
}

void scale_to(Mesh& mesh, double nodes) {
  const double area = area_of(mesh), volume = volume_of(mesh);
  double low = 1e-6, high = 1e6;
  for (int round = 0; round < 100; ++round) {
    const double middle = std::sqrt(low * high);
    const double there = nodes_of(area * middle * middle, volume * middle * middle * middle);
    (there < nodes ? low : high) = middle;
  }
  for (Point& point : mesh.points) point = low * point;
}

void refine(Mesh& mesh, int times) {
  for (; times > 0; --times) {
    std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t> middles;
    const auto middle = [&](std::int64_t a, std::int64_t b) {
      const auto [place, is_new] =
          middles.try_emplace(std::minmax(a, b), static_cast<std::int64_t>(mesh.points.size()));
      if (is_new) mesh.points.push_back(0.5 * (mesh.points[a] + mesh.points[b]));
      return place->second;
    };
    Mesh finer;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto [a, b, c] = mesh.triangles[t];
      const std::int64_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.triangles.insert(finer.triangles.end(),
                             {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
      if (!mesh.tags.empty()) finer.tags.insert(finer.tags.end(), 4, mesh.tags[t]);
    }
    mesh.triangles = std::move(finer.triangles);
    mesh.tags = std::move(finer.tags);
  }
}

namespace {

// Returns the signed distance to a box, negative inside.
double to_box(const Point& low, const Point& high, const Point& x) {
  Point outside{};
  double most = -1e300;
  for (int k = 0; k < 3; ++k) {
    const double away = std::max(low[k] - x[k], x[k] - high[k]);
    most = std::max(most, away);
    outside[k] = std::max(away, 0.0);
  }
  return most > 0 ? length(outside) : most;
}

double to_capsule(const Point& a, const Point& b, const Point& x) {
  const Point along = b - a;
  const double square = dot(along, along);
  const double at = square > 0 ? std::clamp(dot(x - a, along) / square, 0.0, 1.0) : 0;
  return length(x - a - at * along);
}

std::int32_t level_at(std::int64_t n, std::int32_t, const double* x, double* f, void* user) {
  const Body& body = *static_cast<const Body*>(user);
  for (std::int64_t i = 0; i < n; ++i) {
    const Point at = body.frame.to_body({x[3 * i], x[3 * i + 1], x[3 * i + 2]});
    f[i] = body.frame.scale * level_of(body, at);
  }
  return 0;
}

pnpbs_status add_level_set(const Body& body, pnpbs_domain domain) {
  Point low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  for (int corner = 0; corner < 8; ++corner) {
    Point at;
    for (int k = 0; k < 3; ++k) at[k] = corner >> k & 1 ? body.high[k] : body.low[k];
    at = body.frame.to_world(at);
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], at[k]);
      high[k] = std::max(high[k], at[k]);
    }
  }
  return pnpbs_domain_add_level_set(domain, level_at, const_cast<Body*>(&body), low.data(),
                                    high.data(), body.frame.scale * body.resolution, 1);
}

pnpbs_status add_mesh(const Body& body, const Mesh& mesh, pnpbs_domain domain) {
  std::vector<Point> points;
  for (const Point& point : mesh.points) points.push_back(body.frame.to_world(point));
  return pnpbs_domain_add_surface(
      domain, mesh.role, static_cast<std::int64_t>(points.size()), points[0].data(),
      static_cast<std::int64_t>(mesh.triangles.size()), mesh.triangles[0].data(),
      mesh.tags.empty() ? nullptr : mesh.tags.data(), 40);
}

pnpbs_status add_curve(const Body& body, const Curve& curve, pnpbs_domain domain) {
  std::vector<double> points;
  for (const auto& [x, y] : curve.points) {
    const Point at = body.frame.to_world({x, y, 0});
    points.insert(points.end(), {at[0], at[1]});
  }
  return pnpbs_domain_add_polyline(domain, curve.role, curve.closed,
                                   static_cast<std::int64_t>(curve.points.size()), points.data(),
                                   nullptr, curve.corner_angle);
}

// Boxes and cylinders are aligned with the axes, so the frame must not rotate them.
pnpbs_status add_blocks(const Body& body, pnpbs_domain domain) {
  pnpbs_status status = PNPBS_OK;
  for (const auto& [low, high] : body.boxes)
    if (status >= 0)
      status = pnpbs_domain_add_box(domain, body.frame.to_world(low).data(),
                                    body.frame.to_world(high).data(), 1);
  for (std::size_t c = 0; c < body.cylinders.size(); ++c)
    if (status >= 0)
      status = pnpbs_domain_add_cylinder(domain, body.frame.to_world(body.cylinders[c][0]).data(),
                                         body.frame.to_world(body.cylinders[c][1]).data(),
                                         body.frame.scale * body.radii[c], 2);
  return status;
}

pnpbs_status add_fixed(const Body& body, pnpbs_domain domain) {
  std::vector<double> points;
  for (const Point& fixed : body.fixed) {
    const Point at = body.frame.to_world(fixed);
    points.insert(points.end(), at.begin(), at.begin() + body.dim);
  }
  return pnpbs_domain_add_fixed_nodes(domain, static_cast<std::int64_t>(body.fixed.size()),
                                      points.data(), nullptr);
}

}  // namespace

double level_of(const Body& body, const Point& x) {
  double f = 1e300;
  for (const Solid& solid : body.solids) {
    const double away =
        (solid.is_box ? to_box(solid.a, solid.b, x) : to_capsule(solid.a, solid.b, x)) -
        solid.radius;
    f = solid.taken_away ? std::max(f, -away) : std::min(f, away);
  }
  return f;
}

pnpbs_status add(const Body& body, pnpbs_domain domain) {
  pnpbs_status status = body.filled ? PNPBS_OK : pnpbs_domain_set_filled(domain, 0);
  if (status >= 0 && !body.file.empty())
    status = body.dim == 2
                 ? pnpbs_domain_read_poly(domain, body.file.c_str())
                 : pnpbs_domain_read_surface(domain, PNPBS_BOUNDARY, body.file.c_str(), 40);
  for (const Mesh& mesh : body.meshes)
    if (status >= 0) status = add_mesh(body, mesh, domain);
  if (status >= 0 && !body.solids.empty()) status = add_level_set(body, domain);
  if (status >= 0) status = add_blocks(body, domain);
  for (const Curve& curve : body.curves)
    if (status >= 0) status = add_curve(body, curve, domain);
  if (status >= 0 && !body.fixed.empty()) status = add_fixed(body, domain);
  return status;
}

}  // namespace hunt
