// SPDX-License-Identifier: BSD-3-Clause
// Arguments of the user are checked one by one and stored here; check() resolves how they fit
// together.
#include "domain/plane/plane_domain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "base/error.hpp"
#include "base/limits.hpp"
#include "base/point_text.hpp"
#include "domain/given_values.hpp"
#include "domain/plane/copies_of_cell.hpp"
#include "domain/plane/domain_graph.hpp"
#include "domain/plane/domain_resolver.hpp"
#include "domain/plane/outline_tags.hpp"
#include "domain/plane/sampling.hpp"
#include "domain/plane/simplify.hpp"
#include "domain/plane/snapping.hpp"
#include "sphere/area_in_chart.hpp"
#include "sphere/degrees.hpp"
#include "sphere/great_circle.hpp"

namespace pnpbs {

using given_values::read_points, given_values::read_tags, given_values::reject;
using given_values::require_array, given_values::require_count, given_values::require_number;
using given_values::require_tag;

namespace {

void require_interval(double begin, double end) {
  require_number("begin", begin);
  require_number("end", end);
  if (begin == end) reject("begin and end are both " + number_text(begin));
}

void require_not_negative(const char* argument, double value) {
  require_number(argument, value);
  if (value < 0) reject(std::string(argument) + " is " + number_text(value) + ", less than 0");
}

// Angles between points of a sphere that count as opposite and as coincident. [radians]
constexpr double kNearlyOpposite = 3.14159, kSame = 1e-7;

MessageText vertex_text(std::int64_t number, const Point<3>& x) {
  return std::to_string(number) + " " + point_text(x) + " [" + degrees_text(degrees_of(x)) + "]";
}

// Returns the indices of the vertices of a curve on a sphere that do not coincide with the previous
// one; ends are kept. Coastlines often repeat a vertex up to rounding, and the chart could not
// distinguish such vertices.
std::vector<std::int64_t> apart(const std::vector<Point<3>>& vertices, bool closed) {
  const auto same = [&](std::int64_t a, std::int64_t b) {
    return angle_between(vertices[static_cast<std::size_t>(a)],
                         vertices[static_cast<std::size_t>(b)]) < kSame;
  };
  const auto n = static_cast<std::int64_t>(vertices.size());
  std::vector<std::int64_t> kept{0};
  for (std::int64_t v = 1; v < n; ++v)
    if (!same(kept.back(), v)) kept.push_back(v);
  if (!closed && kept.back() != n - 1) {
    if (kept.size() > 1) kept.pop_back();
    kept.push_back(n - 1);
  }
  while (closed && kept.size() > 1 && same(kept.back(), 0)) kept.pop_back();
  if (kept.size() < (closed ? 3 : 2))
    reject("the curve has no extent: all its vertices are the same point");
  return kept;
}

// Returns `end`, or exactly a full turn from `begin` if they differ by a full turn up to rounding.
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
    graph.tags.push_back(tag == 0 ? 1 : tag);  // 0 is no marker, as in Triangle
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
  given_values::require_angle("corner_angle", corner_angle);
  CurveSource source;
  source.kind = CurveSource::Kind::polyline;
  source.role = role;
  source.closed = closed;
  source.points = read_points<2>("coordinates", n, xy);
  source.tags = read_tags("tags", closed ? n : n - 1, tags);
  source.corner_angle = corner_angle;
  given_values::require_distinct_neighbours<2>(source.points, closed);
  add_source(std::move(source));
}

void PlaneDomain::add_great_circles(CurveRole role, bool closed,
                                    const std::vector<Point<3>>& vertices, const std::int32_t* tags,
                                    double corner_angle) {
  const auto n = static_cast<std::int64_t>(vertices.size());
  require_count("n", n, closed ? 3 : 2);
  given_values::require_angle("corner_angle", corner_angle);
  given_values::require_distinct_neighbours<3>(vertices, closed);
  const std::vector<std::int32_t> given_tags = read_tags("tags", closed ? n : n - 1, tags);
  CurveSource source;
  source.kind = CurveSource::Kind::polyline;
  source.role = role;
  source.closed = closed;
  source.corner_angle = corner_angle;
  const std::vector<std::int64_t> kept = apart(vertices, closed);
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const bool is_last = k + 1 == kept.size();
    add_great_circle_arc(source, vertices, given_tags, kept[k],
                         is_last ? (closed ? kept[0] : -1) : kept[k + 1]);
  }
  add_source(std::move(source));
}

// Adds vertex v, and the arc from it to vertex next_v unless that is negative.
void PlaneDomain::add_great_circle_arc(CurveSource& source, const std::vector<Point<3>>& vertices,
                                       const std::vector<std::int32_t>& tags, std::int64_t v,
                                       std::int64_t next_v) const {
  const auto place = [&](std::int64_t i) { return vertices[static_cast<std::size_t>(i)]; };
  const auto add = [&](const Point<2>& u, bool on_the_way) {
    source.points.push_back(u);
    source.on_the_way.push_back(on_the_way);
    source.point_numbers.push_back(v);
  };
  const auto add_segment = [&] {
    source.tags.push_back(tags[static_cast<std::size_t>(v)]);
    source.segment_numbers.push_back(v);
  };
  const Point<3> next = place(next_v < 0 ? v : next_v);
  if (angle_between(place(v), next) > kNearlyOpposite)
    reject("vertices " + vertex_text(v, place(v)) + " and " + vertex_text(next_v, next) +
           " are opposite points of the sphere: the shortest arc between them is not unique");
  if (angle_to_arc(embedding_.chart().projection_centre(), place(v), next) < kSame)
    reject(
        "vertex " + vertex_text(v, place(v)) +
        ": the point that is named as outside of the domain lies on the curve, at this vertex or "
        "between it and the next: name another point");
  add(embedding_.chart().in_chart(place(v)), false);
  if (next_v < 0) return;
  add_segment();
  for (const Point<2>& u : points_on_arc(embedding_.chart(), place(v), next)) {
    add(u, true);
    add_segment();
  }
}

void PlaneDomain::add_arc(CurveRole role, const Point<2>& centre, double radius, double begin,
                          double end, std::int32_t tag) {
  given_values::require_point<2>("centre", centre);
  given_values::require_radius(radius);
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
  graph.points = read_points<2>("coordinates", vertices, xy);
  if (vertex_tags != nullptr) graph.point_tags.assign(vertex_tags, vertex_tags + vertices);
  read_segments(graph, segments, segment_ends, segment_tags);
  const std::vector<Point<2>> points = read_points<2>("hole_points", holes, hole_points);
  add_source(std::move(graph));
  for (std::int64_t h = 0; h < holes; ++h) {
    region_points_.push_back(
        {points[static_cast<std::size_t>(h)], "hole " + std::to_string(first_number + h)});
  }
}

void PlaneDomain::set_corner_angle(double corner_angle) {
  given_values::require_angle("corner_angle", corner_angle);
  corner_angle_ = corner_angle;
  checked_ = false;
}

void PlaneDomain::set_snap(double length) {
  require_not_negative("length", length);
  if (embedding_.is_sphere()) reject("on a sphere no points are moved onto curves");
  snap_ = length;
  checked_ = false;
}

void PlaneDomain::set_fragment(OverlapRule overlap) {
  if (embedding_.is_sphere()) reject("on a sphere curves are not split where they meet");
  fragment_ = overlap;
  checked_ = false;
}

LeftOut PlaneDomain::simplify(const LocalSpacingEvaluator<2>& spacing, const SimplifyRule& rule) {
  require_not_negative("tolerance", rule.tolerance);
  require_not_negative("smallest", rule.smallest);
  std::vector<CurveSource> sources = sources_;
  std::vector<RegionPoint<2>> region_points = region_points_;
  const LeftOut left_out = pnpbs::simplify(sources, region_points, given_nodes_, spacing, rule);
  sources_ = std::move(sources);
  region_points_ = std::move(region_points);
  if (left_out.vertices > 0)
    given_warnings_.emplace_back(
        WarningCode::simplified,
        "simplified: " + std::to_string(left_out.vertices) + " vertices were left out" +
            (left_out.curves > 0
                 ? ", including all of " + std::to_string(left_out.curves) + " closed curves"
                 : ""),
        left_out.vertices);
  checked_ = false;
  return left_out;
}

std::int64_t PlaneDomain::tag_outline(const PlaneFunction& where, std::int32_t tag) {
  require_tag("tag", tag);
  check();
  const std::int64_t count = pnpbs::tag_outline(sources_, resolved_, where, tag);
  if (count > 0) checked_ = false;
  return count;
}

bool PlaneDomain::has_boundary_curve() const {
  return std::ranges::any_of(sources_, [](const CurveSource& source) {
    return source.kind == CurveSource::Kind::graph || source.role == CurveRole::boundary;
  });
}

bool PlaneDomain::is_whole_sphere() const {
  return embedding_.is_sphere() && (closing_ || !has_boundary_curve());
}

// Visits the points that the user gave. The sources and nodes of the closing patch come after them.
template <class Visit>
void PlaneDomain::for_given_points(const Visit& visit) const {
  const std::size_t sources = closing_ ? open_sources_ : sources_.size(),
                    nodes = closing_ ? open_nodes_ : given_nodes_.size();
  for (std::size_t s = 0; s < sources; ++s) std::ranges::for_each(sources_[s].points, visit);
  for (std::size_t f = 0; f < nodes; ++f) visit(given_nodes_[f].position);
}

void PlaneDomain::require_patch_empty(const ClosingPatch& patch) const {
  const auto require_outside = [&](const Point<2>& u) {
    if (dot(u, u) < patch.edge * patch.edge) return;
    reject_domain(
        "on a whole sphere a curve or a fixed node lies closer than 12 spacings to the point that "
        "is named as outside of the domain, at " +
        point_text(u) + ": name another point");
  };
  for_given_points(require_outside);
}

bool PlaneDomain::leaves_room_beyond(double edge) const {
  bool leaves = true;
  for_given_points([&](const Point<2>& u) { leaves = leaves && dot(u, u) < edge * edge; });
  return leaves;
}

void PlaneDomain::close(const ClosingPatch& patch) {
  if (closing_) {
    sources_.resize(open_sources_);
    given_nodes_.resize(open_nodes_);
    closing_.reset();
  }
  open_sources_ = sources_.size();
  open_nodes_ = given_nodes_.size();
  require_patch_empty(patch);
  constexpr double kEachIsACorner = 0;  // degrees
  add_great_circles(CurveRole::boundary, true, {patch.rim.begin(), patch.rim.end()}, nullptr,
                    kEachIsACorner);
  for (const Point<2>& u : patch.nodes) given_nodes_.push_back({u, 0, "a node of the patch"});
  closing_ = {patch.edge, patch.beyond, patch.margin, patch.d};
  checked_ = false;
}

void PlaneDomain::check() {
  if (checked_) return;
  if (is_whole_sphere() && !closing_) return check_open_sphere();
  if (cell_.any()) return check_periodic();
  for (CurveSource& source : sources_)
    if (source.kind == CurveSource::Kind::graph) find_corners(source, corner_angle_);
  if (!embedding_.is_sphere())  // the scale of a chart varies
    if (auto warning = snap_loose_points(sources_, given_nodes_, snap_))
      add_warning(std::move(*warning));
  resolved_ = resolve_domain(sources_, region_points_, given_nodes_, fragment_);
  if (closing_) follow_patch();
  resolved_.warnings.insert(resolved_.warnings.begin(), given_warnings_.begin(),
                            given_warnings_.end());
  checked_ = true;
}

// Marks the nodes of the patch as inner nodes (tag 0). The triangle of the patch has straight edges
// in the chart, so its area is computed from these.
void PlaneDomain::follow_patch() {
  resolved_.area = 0;
  for (BoundaryCurve& curve : resolved_.curves) {
    if (!curve.bounds()) continue;
    curve.tag = 0;
    for (const std::int64_t corner : {curve.corner_begin, curve.corner_end})
      resolved_.corners[static_cast<std::size_t>(corner)].tag = 0;
    const Point<2>&a = curve.points.front(), &b = curve.points.back();
    resolved_.area += (curve.left_inside ? 0.5 : -0.5) * (a[0] * b[1] - a[1] * b[0]);
  }
  for (FixedNode<2>& node : resolved_.fixed_nodes)
    if (is_in_patch(node.position)) node.tag = 0;
}

// Checks an open sphere as if a negligibly small patch closed it.
void PlaneDomain::check_open_sphere() {
  for (const RegionPoint<2>& point : region_points_)
    if (point.is_hole())
      reject_domain("a whole sphere has no holes, and there is one at " + point_text(point.point) +
                    ": add boundary curves around it instead");
  constexpr double kNextToNothing = 1e-3;  // radians
  PlaneDomain closed = *this;
  ClosingPatch patch;
  const double r = 2 * embedding_.chart().radius() / std::tan(kNextToNothing / 2);
  for (std::size_t k = 0; k < 3; ++k) {
    const double turn = 2 * std::numbers::pi * static_cast<double>(k) / 3;
    patch.rim[k] = embedding_.chart().on_sphere({r * std::cos(turn), r * std::sin(turn)});
  }
  patch.edge = patch.beyond = std::numeric_limits<double>::infinity();
  closed.close(patch);
  closed.check();
  resolved_ = std::move(closed.resolved_);
  std::erase_if(resolved_.curves, [](const BoundaryCurve& curve) { return curve.bounds(); });
  checked_ = true;
}

// Resolves the copies of a periodic domain as one domain that is not periodic.
void PlaneDomain::check_periodic() {
  for (CurveSource& source : sources_)
    if (source.kind == CurveSource::Kind::graph) find_corners(source, corner_angle_);
  if (auto warning = snap_loose_points(sources_, given_nodes_, snap_))
    add_warning(std::move(*warning));
  CopiesOfCell copies =
      copies_of_cell(cell_, reach_, side_tags_, flat_, sources_, region_points_, given_nodes_);
  resolved_ = resolve_domain(copies.sources, copies.region_points, copies.fixed_nodes, fragment_,
                             std::ranges::count(flat_, true) > 0);
  resolved_.area = area_of_cell(cell_, resolved_.curves, copies.in_cell);
  resolved_.warnings.insert(resolved_.warnings.begin(), given_warnings_.begin(),
                            given_warnings_.end());
  checked_ = true;
}

double area_on_sphere(const PlaneDomain& domain) {
  const double radius = domain.embedding().radius();
  if (domain.is_whole_sphere()) return 4 * std::numbers::pi * radius * radius;
  double area = 0;
  for (const BoundaryCurve& curve : domain.curves()) {
    if (!curve.bounds()) continue;
    double beside = 0;
    for (std::size_t p = 0; p + 1 < curve.points.size(); ++p)
      beside += chart_area_term(curve.points[p], curve.points[p + 1], radius);
    area += curve.left_inside ? beside : -beside;
  }
  return area;
}

}  // namespace pnpbs
