// SPDX-License-Identifier: BSD-3-Clause
// What the user gives is looked at argument by argument here, and kept as it is; how it fits
// together is for check().
#include "domain/plane/plane_domain.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "base/limits.hpp"
#include "base/point_text.hpp"
#include "domain/plane/domain_resolver.hpp"
#include "domain/plane/sampling.hpp"

namespace pnpbs {

namespace {

[[noreturn]] void reject(const std::string& message) { throw Error(ErrorKind::argument, message); }

std::string indexed(const char* name, std::int64_t index) {
  return std::string(name) + "[" + std::to_string(index) + "]";
}

void require_number(const std::string& name, double value) {
  if (is_usable(value)) return;
  reject(name + " is " + number_text(value) + ", expected a number between -1e60 and 1e60");
}

void require_array(const char* name, const void* array, std::int64_t n) {
  if (n > 0 && array == nullptr) reject(std::string(name) + " is NULL");
}

void require_count(const char* name, std::int64_t value, std::int64_t min) {
  if (value >= min && value < (std::int64_t{1} << 31) - 1) return;
  reject(std::string(name) + " is " + std::to_string(value) + ", expected at least " +
         std::to_string(min) + " and less than 2^31 - 1");
}

void require_tag(const std::string& name, std::int32_t tag) {
  if (tag == 0) reject(name + " is 0, expected a nonzero tag (0 marks inner nodes)");
}

std::vector<Point<2>> read_points(const char* name, std::int64_t n, const double* xy) {
  require_array(name, xy, n);
  std::vector<Point<2>> points(static_cast<std::size_t>(n));
  for (std::int64_t i = 0; i < n; ++i) {
    for (const int k : {0, 1}) {
      require_number(indexed(name, i) + "[" + std::to_string(k) + "]", xy[2 * i + k]);
    }
    points[static_cast<std::size_t>(i)] = {xy[2 * i], xy[2 * i + 1]};
  }
  return points;
}

std::vector<std::int32_t> read_tags(const char* name, std::int64_t n, const std::int32_t* tags) {
  if (tags == nullptr) return std::vector<std::int32_t>(static_cast<std::size_t>(n), 1);
  for (std::int64_t i = 0; i < n; ++i) require_tag(indexed(name, i), tags[i]);
  return {tags, tags + n};
}

void require_distinct_neighbours(const std::vector<Point<2>>& points, bool closed) {
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    if (points[i] == points[i + 1]) {
      reject("vertices " + std::to_string(i) + " and " + std::to_string(i + 1) + " are both " +
             point_text(points[i]) + ": the segment between them has no length");
    }
  }
  if (closed && points.front() == points.back()) {
    reject("the first vertex of a closed curve is repeated as the last, vertex " +
           std::to_string(points.size() - 1) + " " + point_text(points.back()) + ": leave it out");
  }
}

void require_interval(double begin, double end) {
  require_number("begin", begin);
  require_number("end", end);
  if (begin == end) reject("begin and end are both " + number_text(begin));
}

// A full circle closes exactly.
double snap_to_full_turn(double begin, double end) {
  constexpr double turn = 2 * std::numbers::pi;
  const double sweep = end - begin;
  if (std::fabs(sweep) > turn * (1 + 1e-9)) {
    reject("end - begin is " + number_text(sweep) + ", more than a full turn of 2 pi");
  }
  return std::fabs(sweep) > turn * (1 - 1e-12) ? begin + std::copysign(turn, sweep) : end;
}

void read_segments(CurveSource& graph, std::int64_t segments, const std::int64_t* segment_ends,
                   const std::int32_t* segment_tags) {
  const auto vertices = static_cast<std::int64_t>(graph.points.size());
  graph.segment_ends.resize(static_cast<std::size_t>(segments));
  for (std::int64_t s = 0; s < segments; ++s) {
    for (const int k : {0, 1}) {
      const std::int64_t end = segment_ends[2 * s + k];
      if (end < 0 || end >= vertices) {
        reject("segment_ends[" + std::to_string(s) + "][" + std::to_string(k) + "] is " +
               std::to_string(end) + ", expected a vertex from 0 to " +
               std::to_string(vertices - 1));
      }
      graph.segment_ends[static_cast<std::size_t>(s)][static_cast<std::size_t>(k)] = end;
    }
    if (segment_ends[2 * s] == segment_ends[2 * s + 1]) {
      reject("segment_ends[" + std::to_string(s) + "] are both " +
             std::to_string(segment_ends[2 * s]) + ": the segment has no length");
    }
    const std::int32_t tag = segment_tags == nullptr ? 1 : segment_tags[s];
    graph.tags.push_back(tag == 0 ? 1 : tag);  // as Triangle: 0 is no marker
  }
}

}  // namespace

void PlaneDomain::add_source(CurveSource source) {
  std::int64_t& given = source.kind == CurveSource::Kind::graph ? graphs_given_ : curves_given_;
  source.number = given;
  sources_.push_back(std::move(source));
  ++given;
  checked_ = false;
}

void PlaneDomain::add_polyline(CurveRole role, bool closed, std::int64_t n, const double* xy,
                               const std::int32_t* tags, double corner_angle) {
  require_count("n", n, closed ? 3 : 2);
  if (!(corner_angle >= 0 && corner_angle <= 180)) {
    reject("corner_angle is " + number_text(corner_angle) + ", expected 0 to 180 degrees");
  }
  CurveSource source;
  source.kind = CurveSource::Kind::polyline;
  source.role = role;
  source.closed = closed;
  source.points = read_points("coordinates", n, xy);
  source.tags = read_tags("tags", closed ? n : n - 1, tags);
  source.corner_angle = corner_angle;
  require_distinct_neighbours(source.points, closed);
  add_source(std::move(source));
}

void PlaneDomain::add_arc(CurveRole role, const Point<2>& centre, double radius, double begin,
                          double end, std::int32_t tag) {
  require_number("centre[0]", centre[0]);
  require_number("centre[1]", centre[1]);
  if (!(radius > 0 && is_usable(radius))) {
    reject("radius is " + number_text(radius) + ", expected a positive number up to 1e60");
  }
  require_interval(begin, end);
  require_tag("tag", tag);
  end = snap_to_full_turn(begin, end);
  CurveSource source;
  source.kind = CurveSource::Kind::smooth;
  source.role = role;
  source.tags = {tag};
  source.evaluate = [centre, radius](std::int64_t n, const double* t, Point<2>* xy) {
    for (std::int64_t i = 0; i < n; ++i) {
      xy[i] = {centre[0] + radius * std::cos(t[i]), centre[1] + radius * std::sin(t[i])};
    }
  };
  CurveSamples samples = sample_arc(source.evaluate, begin, end);
  source.parameters = std::move(samples.parameters);
  source.points = std::move(samples.points);
  for (const Point<2>& point : source.points) {
    if (!is_usable(point)) reject("the arc reaches " + point_text(point) + ", beyond 1e60");
  }
  add_source(std::move(source));
}

void PlaneDomain::add_curve(CurveRole role, CurveFunction curve, double begin, double end,
                            std::int32_t tag) {
  if (!curve) reject("curve is NULL");
  require_interval(begin, end);
  require_tag("tag", tag);
  CurveSource source;
  source.kind = CurveSource::Kind::smooth;
  source.role = role;
  source.tags = {tag};
  source.number = curves_given_;
  CurveSamples samples = sample_curve(curve, begin, end, source.segment_name(0));
  source.parameters = std::move(samples.parameters);
  source.points = std::move(samples.points);
  source.evaluate = std::move(curve);
  add_source(std::move(source));
}

void PlaneDomain::add_pslg(std::int64_t vertices, const double* xy, const std::int32_t* vertex_tags,
                           std::int64_t segments, const std::int64_t* segment_ends,
                           const std::int32_t* segment_tags, std::int64_t holes,
                           const double* hole_points, std::int64_t first_number) {
  require_count("vertices", vertices, 0);
  require_count("segments", segments, 0);
  require_count("holes", holes, 0);
  require_array("segment_ends", segment_ends, segments);
  CurveSource graph;
  graph.kind = CurveSource::Kind::graph;
  graph.first_number = first_number;
  graph.points = read_points("coordinates", vertices, xy);
  if (vertex_tags != nullptr) graph.point_tags.assign(vertex_tags, vertex_tags + vertices);
  read_segments(graph, segments, segment_ends, segment_tags);
  const std::vector<Point<2>> points = read_points("hole_points", holes, hole_points);
  add_source(std::move(graph));
  for (std::int64_t h = 0; h < holes; ++h) {
    holes_.push_back(
        {points[static_cast<std::size_t>(h)], "hole " + std::to_string(first_number + h)});
  }
}

void PlaneDomain::add_hole(const Point<2>& point) {
  require_number("point[0]", point[0]);
  require_number("point[1]", point[1]);
  holes_.push_back({point, "hole " + std::to_string(holes_given_++)});
  checked_ = false;
}

void PlaneDomain::add_fixed_nodes(std::int64_t n, const double* xy, const std::int32_t* tags) {
  require_count("n", n, 0);
  const std::vector<Point<2>> points = read_points("coordinates", n, xy);
  const std::vector<std::int32_t> values = read_tags("tags", n, tags);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::string name = "fixed node " + std::to_string(given_nodes_.size());
    given_nodes_.push_back({points[i], values[i], name});
  }
  checked_ = false;
}

void PlaneDomain::check() {
  if (checked_) return;
  resolved_ = resolve_domain(sources_, holes_, given_nodes_);
  checked_ = true;
}

}  // namespace pnpbs
