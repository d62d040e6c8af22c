// SPDX-License-Identifier: BSD-3-Clause
// Surfaces that cross, touch or lie on each other and are split into one triangulation.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <vector>

#include "base/limits.hpp"
#include "base/space_vectors.hpp"
#include "core/random.hpp"
#include "expect_error.hpp"
#include "geometry/volume/triangle_contacts.hpp"
#include "geometry/volume/triangles.hpp"
#include "geometry/volume/welding.hpp"
#include "predicates/space.hpp"
#include "predicates/wide_integer.hpp"
#include "run_suite.hpp"
#include "surfaces/arrangement.hpp"
#include "surfaces/nesting.hpp"
#include "surfaces/primitives.hpp"
#include "surfaces/surface_checks.hpp"
#include "surfaces/surface_edges.hpp"
#include "surfaces/thin_triangles.hpp"

namespace {

using P = pnpbs::Point<3>;
using pnpbs::CoveredTriangle;
using pnpbs::SplitAt;
using pnpbs::SurfaceSource;
using pnpbs::SurfaceTriangle;
using pnpbs::Triangulation;

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }
std::int32_t number_of(std::size_t i) { return static_cast<std::int32_t>(i); }

double size_of(const Triangulation& surface) {
  pnpbs::Box<3> box = pnpbs::empty_box<3>();
  for (const P& x : surface.vertices) include(box, x);
  return pnpbs::size_of(box);
}

// Joins sources and welds their vertices, as the domain does.
Triangulation joined(const std::vector<SurfaceSource>& sources) {
  Triangulation surface = pnpbs::join_surfaces(sources);
  const double tolerance = pnpbs::kSameVertex * size_of(surface);
  const auto welded = pnpbs::weld_points(surface.vertices, tolerance);
  for (SurfaceTriangle& triangle : surface.triangles)
    for (std::int32_t& v : triangle.vertices) v = welded[at(v)];
  std::vector<pnpbs::Warning> warnings;
  pnpbs::remove_thin_triangles(surface, tolerance, warnings);
  return surface;
}

struct Arranged {
  Triangulation given, surface;
  std::vector<pnpbs::ArrangedSegment> curves;
  std::vector<CoveredTriangle> covered;
  pnpbs::ArrangementSummary summary;
};

// A piece of a given triangle: its source and number, and the positions of its corners.
struct Part {
  SurfaceTriangle triangle;
  pnpbs::FacetCorners<3> corners;
};

std::vector<Part> parts_of(const Arranged& it) {
  std::vector<Part> parts;
  const auto add = [&](const SurfaceTriangle& triangle) {
    pnpbs::FacetCorners<3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = it.surface.vertices[at(triangle.vertices[k])];
    parts.push_back({triangle, corners});
  };
  for (const SurfaceTriangle& triangle : it.surface.triangles) add(triangle);
  for (const CoveredTriangle& covered : it.covered) add(covered.covered);
  return parts;
}

double height(const pnpbs::FacetCorners<3>& triangle, const P& x) {
  return pnpbs::distance<3>(pnpbs::nearest_on(triangle, x), x);
}

// Checks by all pairs that triangles meet only in common vertices and edges.
void check_conforms(const Triangulation& surface) {
  const std::size_t count = surface.triangles.size();
  for (std::size_t t = 0; t < count; ++t) {
    const auto corners = surface.corners(number_of(t));
    const pnpbs::Box<3> box = surface.box(number_of(t));
    const auto& vertices = surface.triangles[t].vertices;
    const std::set<std::int32_t> own(vertices.begin(), vertices.end());
    ck_assert_int_eq(own.size(), 3);
    for (std::size_t u = t + 1; u < count; ++u) {
      const auto& others = surface.triangles[u].vertices;
      if (!pnpbs::boxes_meet(box, surface.box(number_of(u)))) continue;
      ck_assert_msg(std::set<std::int32_t>(others.begin(), others.end()) != own,
                    "%zu and %zu are one", t, u);
      ck_assert_msg(
          !pnpbs::triangles_meet(corners, vertices, surface.corners(number_of(u)), others),
          "triangles %zu and %zu meet", t, u);
    }
  }
}

// Checks that the parts of each given triangle lie in it, fill it, and have its attributes and
// orientation.
void check_parts(const Arranged& it) {
  const double tolerance = std::max(1e-8 * size_of(it.given), 2 * it.summary.tolerance);
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> given;
  for (std::size_t t = 0; t < it.given.triangles.size(); ++t)
    given[{it.given.triangles[t].source, it.given.triangles[t].number}] = t;
  std::vector<double> area(it.given.triangles.size(), 0);
  for (const Part& part : parts_of(it)) {
    const std::size_t t = given.at({part.triangle.source, part.triangle.number});
    const SurfaceTriangle& parent = it.given.triangles[t];
    ck_assert(parent.tag == part.triangle.tag && parent.inner == part.triangle.inner &&
              parent.by_place == part.triangle.by_place &&
              parent.dividing == part.triangle.dividing);
    const auto corners = it.given.corners(number_of(t));
    for (const P& x : part.corners) ck_assert_double_le(height(corners, x), tolerance);
    const P normal = pnpbs::area_normal(corners);
    area[t] += pnpbs::dot(pnpbs::area_normal(part.corners), normal) / pnpbs::length(normal);
  }
  for (std::size_t t = 0; t < area.size(); ++t) {
    const auto corners = it.given.corners(number_of(t));
    const double expected = pnpbs::length(pnpbs::area_normal(corners));
    double around = 0;
    for (int k = 0; k < 3; ++k)
      around += pnpbs::distance<3>(corners[at(k)], corners[at((k + 1) % 3)]);
    ck_assert_msg(std::fabs(area[t] - expected) <= tolerance * around, "%s: %.17g, not %.17g",
                  it.given.triangle_name(number_of(t)).c_str(), area[t], expected);
  }
}

Arranged arranged(Triangulation given, SplitAt split_at = SplitAt::any_point, double gap = 0) {
  Arranged it{given, std::move(given), {}, {}, {}};
  it.summary = pnpbs::arrange(it.surface, it.curves,
                              {pnpbs::kSameVertex * size_of(it.given), split_at, gap}, it.covered);
  return it;
}

// Splits surfaces and checks the result against all that holds for any of them.
Arranged checked(const std::vector<SurfaceSource>& sources) {
  Arranged it = arranged(joined(sources));
  check_conforms(it.surface);
  check_parts(it);
  ck_assert_int_eq(it.summary.covered, std::ssize(it.covered));
  return it;
}

// The regions between the triangles of an arrangement.
struct Regions {
  const Triangulation& surface;
  pnpbs::SurfaceEdges edges;
  pnpbs::BoxTree<3> tree;
  pnpbs::SurfaceRegions regions;

  explicit Regions(const Triangulation& s)
      : surface(s), edges(s), tree(pnpbs::tree_of(s)), regions(s, edges, tree) {}
  Regions(const Regions&) = delete;

  // Returns the volumes of the bounded regions, in order of size.
  std::vector<double> volumes() const {
    std::vector<double> volumes(at(regions.count()), 0);
    for (std::int32_t t = 0; t < number_of(surface.triangles.size()); ++t) {
      const auto& [a, b, c] = surface.corners(t);
      const P& from = surface.vertices[0];
      const double volume =
          pnpbs::dot(pnpbs::difference(a, from),
                     pnpbs::cross(pnpbs::difference(b, from), pnpbs::difference(c, from))) /
          6;
      volumes[at(regions.back(t))] += volume;
      volumes[at(regions.front(t))] -= volume;
    }
    volumes.erase(volumes.begin());
    std::sort(volumes.begin(), volumes.end());
    return volumes;
  }
};

void expect_volumes(const Triangulation& surface, std::vector<double> expected,
                    double tolerance = 1e-7) {
  const std::vector<double> volumes = Regions(surface).volumes();
  std::sort(expected.begin(), expected.end());
  ck_assert_int_eq(volumes.size(), expected.size());
  for (std::size_t i = 0; i < volumes.size(); ++i)
    ck_assert_double_eq_tol(volumes[i], expected[i], tolerance * expected.back());
}

SurfaceSource named(SurfaceSource source, const char* name) {
  source.name = name;
  if (source.tags.empty()) source.tags.assign(source.triangles.size(), 1);
  return source;
}

SurfaceSource box(const P& low, const P& high, std::int32_t tag = 1) {
  return named(pnpbs::box_surface(low, high, {tag, tag, tag, tag, tag, tag}), "a box");
}

SurfaceSource sheet(const P& a, const P& b, const P& c, const P& d) {
  SurfaceSource source;
  source.vertices = {a, b, c, d};
  source.triangles = {{0, 1, 2}, {0, 2, 3}};
  source.role = pnpbs::SurfaceRole::inner;
  return named(source, "a sheet");
}

// Returns a coarse ball.
SurfaceSource ball(const P& centre, double radius, int rings, int sectors) {
  SurfaceSource source;
  source.vertices = {{centre[0], centre[1], centre[2] + radius}};
  for (int i = 1; i < rings; ++i)
    for (int j = 0; j < sectors; ++j) {
      const double theta = M_PI * i / rings, phi = 2 * M_PI * (j + 0.5 * i) / sectors;
      source.vertices.push_back({centre[0] + radius * std::sin(theta) * std::cos(phi),
                                 centre[1] + radius * std::sin(theta) * std::sin(phi),
                                 centre[2] + radius * std::cos(theta)});
    }
  source.vertices.push_back({centre[0], centre[1], centre[2] - radius});
  const auto node = [&](int i, int j) {
    return i == 0       ? 0
           : i == rings ? 1 + (rings - 1) * sectors
                        : 1 + (i - 1) * sectors + j % sectors;
  };
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < sectors; ++j) {
      if (i + 1 < rings)
        source.triangles.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1)});
      if (i > 0) source.triangles.push_back({node(i, j), node(i + 1, j + 1), node(i, j + 1)});
    }
  return named(source, "a ball");
}

SurfaceSource moved(SurfaceSource source, const std::function<P(const P&)>& map) {
  for (P& x : source.vertices) x = map(x);
  return source;
}

// Returns the points of a surface turned about an axis and shifted, with rounding.
P turned(const P& x) {
  const double c = std::cos(0.7), s = std::sin(0.7), d = std::cos(0.3), r = std::sin(0.3);
  const P y{c * x[0] - s * x[1], s * x[0] + c * x[1], x[2]};
  return {y[0] + 0.1, d * y[1] - r * y[2] - 0.3, r * y[1] + d * y[2] + 0.7};
}

// Returns surfaces as they are; turned, so that vertices lie on edges and faces up to rounding
// only; far from the origin; and in single precision.
std::vector<std::vector<SurfaceSource>> variants(const std::vector<SurfaceSource>& sources) {
  const auto far = [](const P& x) {
    const P y = turned(x);
    return P{y[0] + 1e7, y[1] - 1e6, y[2]};
  };
  const auto single = [](const P& x) {
    P y = turned(x);
    for (double& along : y) {
      // GCC 12 omits the conversion of two numbers at once if nothing prevents it.
      const volatile float rounded = static_cast<float>(along);
      along = double{rounded};
    }
    return y;
  };
  std::vector<std::vector<SurfaceSource>> variants{sources};
  for (const auto& map : std::vector<std::function<P(const P&)>>{turned, far, single}) {
    variants.emplace_back();
    for (const SurfaceSource& source : sources) variants.back().push_back(moved(source, map));
  }
  return variants;
}

// Splits surfaces in all variants and checks the volumes of the regions. Returns the first result.
Arranged expect_bodies(const std::vector<SurfaceSource>& sources,
                       const std::vector<double>& volumes) {
  std::vector<Arranged> results;
  for (const std::vector<SurfaceSource>& variant : variants(sources)) {
    results.push_back(checked(variant));
    expect_volumes(results.back().surface, volumes, results.size() < 4 ? 1e-7 : 1e-5);
  }
  return results[0];
}

// Checks that points have the same region only if they are in the same bodies. in(b, x) returns
// whether body b contains x.
void check_regions(const Triangulation& surface, std::size_t bodies, const pnpbs::Box<3>& bounds,
                   const std::function<bool(std::size_t, const P&)>& in, Random& random) {
  const Regions it(surface);
  std::map<std::int32_t, std::vector<bool>> bodies_of;
  for (int trial = 0; trial < 2000; ++trial) {
    const P x = random.point<3>(bounds);
    std::vector<bool> inside(bodies);
    for (std::size_t b = 0; b < bodies; ++b) inside[b] = in(b, x);
    const auto [entry, is_new] = bodies_of.try_emplace(it.regions.around(x), inside);
    ck_assert(entry->second == inside);
  }
  ck_assert_int_gt(bodies_of.size(), 2);
}

std::set<P> used_positions(const Triangulation& surface) {
  std::set<P> positions;
  for (const SurfaceTriangle& triangle : surface.triangles)
    for (const std::int32_t v : triangle.vertices) positions.insert(surface.vertices[at(v)]);
  return positions;
}

}  // namespace

// ---------------------------------------------------------------- numbers
START_TEST(quotients_are_rounded_to_the_nearest_double) {
  using pnpbs::WideInteger;
  Random random(17);
  for (int trial = 0; trial < 20000; ++trial) {
    // The quotient a / b is a double or the middle between two, or differs by less than 2^-100.
    const double x = std::ldexp(random.between(1, 2), static_cast<int>(random.below(40)) - 20);
    const double above = std::nextafter(x, 4 * x);
    const bool between = random.below(2) == 0;
    const int off = static_cast<int>(random.below(3)) - 1;
    constexpr int kUnit = -200;
    const WideInteger twice = WideInteger(x, kUnit) + WideInteger(between ? above : x, kUnit);
    WideInteger b = WideInteger(1, 0);
    for (std::int64_t factors = 1 + random.below(4); factors > 0; --factors)
      b = b * WideInteger(std::floor(random.between(1, 0x1p53)), 0);
    const WideInteger a = twice * b + WideInteger(off, 0);
    const bool is_odd = std::fmod(std::ldexp(x, 52 - std::ilogb(x)), 2) != 0;
    const double expected = between && (off > 0 || (off == 0 && is_odd)) ? above : x;
    const WideInteger twice_b = b + b;
    ck_assert_double_eq(rounded_quotient(a, twice_b, kUnit), expected);
    ck_assert_double_eq(rounded_quotient(-a, twice_b, kUnit), -expected);
  }
}
END_TEST

// ---------------------------------------------------------------- faces on faces
START_TEST(boxes_on_each_other_share_one_face) {
  // The faces between them are cut along different diagonals.
  SurfaceSource upper = box({0, 0, 1}, {1, 1, 2}, 2);
  for (auto& triangle : upper.triangles)
    for (std::int32_t& v : triangle) v ^= 1;  // mirrored
  for (auto& triangle : upper.triangles) std::swap(triangle[1], triangle[2]);
  const Arranged it = expect_bodies({box({0, 0, 0}, {1, 1, 1}, 1), upper}, {1, 1});
  ck_assert_int_eq(it.summary.new_vertices, 1);  // where the diagonals cross
  ck_assert_int_eq(it.summary.covered, 4);
  ck_assert_int_eq(it.summary.split, 4);
  ck_assert_int_eq(it.surface.triangles.size(), 24);
  for (const CoveredTriangle& covered : it.covered) {
    const SurfaceTriangle& stays = it.surface.triangles[at(covered.triangle)];
    ck_assert(stays.tag == 1 && covered.covered.tag == 2);
    std::set<std::int32_t> a(stays.vertices.begin(), stays.vertices.end()),
        b(covered.covered.vertices.begin(), covered.covered.vertices.end());
    ck_assert(a == b);
  }
}
END_TEST

START_TEST(equal_faces_become_one_without_new_vertices) {
  const Triangulation given =
      joined({box({0, 0, 0}, {1, 1, 1}, 1), moved(box({0, 0, 0}, {1, 1, 1}, 2), [](const P& x) {
                return P{x[0], x[1], 2 - x[2]};
              })});
  const Arranged it = arranged(given, SplitAt::contacts);
  check_conforms(it.surface);
  check_parts(it);
  ck_assert(it.summary.covered == 2 && it.summary.split == 0 && it.summary.rounds == 0);
  ck_assert_int_eq(it.surface.triangles.size(), 22);
  expect_volumes(it.surface, {1, 1});
}
END_TEST

START_TEST(shifted_boxes_share_a_part_of_a_face) {
  for (const double shift : {0.25, 0.3}) {
    const Arranged it =
        expect_bodies({box({0, 0, 0}, {1, 1, 1}, 1),
                       box({shift, shift / 2, 1}, {shift + 1, shift / 2 + 1, 2}, 2)},
                      {1, 1});
    double shared = 0;
    for (const CoveredTriangle& covered : it.covered)
      shared += pnpbs::length(pnpbs::area_normal(it.surface.corners(covered.triangle)));
    ck_assert_double_eq_tol(shared, (1 - shift) * (1 - shift / 2), 1e-12);
  }
}
END_TEST

START_TEST(a_smaller_box_stands_on_a_face) {
  const Arranged it = expect_bodies(
      {box({0, 0, 0}, {1, 1, 1}), box({0.25, 0.25, 1}, {0.5, 0.75, 1.5})}, {1, 0.0625});
}
END_TEST

START_TEST(many_stacked_boxes_share_faces_and_edges) {
  std::vector<SurfaceSource> boxes;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) {
        const double a = 0.37 * k, b = 0.21 * i;  // layers and rows are shifted
        boxes.push_back(box({i + a, j + b, double(k)}, {i + a + 1, j + b + 1, k + 1.0}));
      }
  const Arranged it = expect_bodies(boxes, std::vector<double>(27, 1.0));
}
END_TEST

START_TEST(three_faces_lie_on_each_other) {
  const Arranged it =
      expect_bodies({box({0, 0, 0}, {1, 1, 1}), box({0.5, 0.5, 1}, {2, 2, 2}),
                     sheet({0.25, 0.25, 1}, {0.75, 0.25, 1}, {0.75, 0.75, 1}, {0.25, 0.75, 1})},
                    {1, 2.25});
  std::map<std::int32_t, int> times;
  for (const CoveredTriangle& covered : it.covered) ++times[covered.triangle];
  ck_assert(std::any_of(times.begin(), times.end(), [](const auto& t) { return t.second == 2; }));
}
END_TEST

// ---------------------------------------------------------------- curves
// Checks that segments meet triangles and each other in common vertices or along whole edges only,
// and that the parts of each segment have its length.
static void check_curves(const Arranged& it, const std::vector<std::array<P, 2>>& given) {
  std::vector<double> lengths(given.size(), 0);
  const auto& positions = it.surface.vertices;
  for (const auto& [ends, number] : it.curves) {
    const P &a = positions[at(ends[0])], &b = positions[at(ends[1])];
    if (at(number) < given.size()) lengths[at(number)] += pnpbs::distance<3>(a, b);
    for (std::int32_t t = 0; t < number_of(it.surface.triangles.size()); ++t) {
      const auto& triangle = it.surface.triangles[at(t)];
      const P middle = pnpbs::halfway(a, b);
      const bool has_both = triangle.has(ends[0]) && triangle.has(ends[1]);
      if (!has_both && ends[0] != ends[1])
        ck_assert_double_gt(height(it.surface.corners(t), middle), 1e-9);
      for (const std::int32_t end : ends)
        if (!triangle.has(end))
          ck_assert_double_gt(height(it.surface.corners(t), positions[at(end)]), 1e-9);
      if (!triangle.has(ends[0]) && !triangle.has(ends[1]))
        ck_assert(!pnpbs::segment_meets(a, b, it.surface.corners(t)));
    }
  }
  for (std::size_t s = 0; s < given.size(); ++s)
    ck_assert_double_eq_tol(lengths[s], pnpbs::distance<3>(given[s][0], given[s][1]), 1e-8);
}

START_TEST(curves_and_points_are_split_with_surfaces) {
  const std::vector<std::array<P, 2>> given{
      {P{0.3, 0.4, -1}, P{0.6, 0.2, 2}},         // through the box and the sheet
      {P{0.2, 0.8, 0.5}, P{2, 0.8, 0.5}},        // in the sheet, and out of the box
      {P{0.5, 0.1, 0.5}, P{0.5, 0.9, 0.5}},      // in the sheet, across the one before
      {P{0.5, 0.5, 0}, P{0.5, 0.5, 0.25}},       // from a diagonal of the floor
      {P{0.25, 0.75, 0.1}, P{0.75, 0.75, 0.1}},  // crosses the next one
      {P{0.5, 0.6, 0.1}, P{0.5, 0.9, 0.1}},
      {P{0.1, 0, 0}, P{0.7, 0, 0}}};  // on an edge of the box
  const std::vector<P> points{{0.25, 0.25, 0.5}, {1, 0.3, 0.6}, {0.5, 0.75, 0.1}};
  for (const bool is_turned : {false, true}) {
    const auto map = [is_turned](const P& x) { return is_turned ? turned(x) : x; };
    std::vector<SurfaceSource> sources{
        box({0, 0, 0}, {1, 1, 1}),
        sheet({-0.5, -0.5, 0.5}, {1.5, -0.5, 0.5}, {1.5, 1.5, 0.5}, {-0.5, 1.5, 0.5})};
    for (SurfaceSource& source : sources) source = moved(source, map);
    Arranged it{joined(sources), {}, {}, {}, {}};
    it.surface = it.given;
    const auto add = [&](const P& x) {
      it.surface.vertices.push_back(map(x));
      return number_of(it.surface.vertices.size()) - 1;
    };
    for (const auto& [a, b] : given)
      it.curves.push_back({{add(a), add(b)}, number_of(it.curves.size())});
    for (const P& x : points) {
      const std::int32_t v = add(x);
      it.curves.push_back({{v, v}, number_of(it.curves.size())});
    }
    it.summary = pnpbs::arrange(it.surface, it.curves, {2e-9}, it.covered);
    check_conforms(it.surface);
    check_parts(it);
    check_curves(it, given);
    expect_volumes(it.surface, {0.5, 0.5});
    std::map<std::int32_t, int> parts;
    for (const auto& [ends, number] : it.curves) ++parts[number];
    ck_assert(parts[0] == 4 && parts[3] == 1 && parts[4] == 2 && parts[5] == 2);
    ck_assert(parts[1] >= 4 && parts[2] >= 2 && parts[6] >= 1);
  }
}
END_TEST

// ---------------------------------------------------------------- gaps
START_TEST(gaps_and_overlaps_within_a_length_are_closed) {
  for (const double off : {1e-6, -1e-6, 3e-8})
    for (const bool is_turned : {false, true}) {
      std::vector<SurfaceSource> sources{box({0, 0, 0}, {1, 1, 1}, 1),
                                         box({0.25, -0.5, 1 + off}, {1.5, 0.75, 2}, 2)};
      if (is_turned)
        for (SurfaceSource& source : sources) source = moved(source, turned);
      Arranged it = arranged(joined(sources), SplitAt::any_point, 2e-6);
      check_conforms(it.surface);
      check_parts(it);
      expect_volumes(it.surface, {1, 1.5625}, 1e-5);
      double shared = 0;
      for (const CoveredTriangle& covered : it.covered)
        shared += pnpbs::length(pnpbs::area_normal(it.surface.corners(covered.triangle)));
      ck_assert_double_eq_tol(shared, 0.75 * 0.75, 1e-5);
      it = arranged(joined(sources), SplitAt::any_point, 1e-8);
      ck_assert_double_eq_tol(it.summary.tolerance, 1.6e-7, 1e-15);
      ck_assert(it.covered.empty());
    }
}
END_TEST

// Returns a block, and two sheets through it with a tiny angle between them, all turned.
static std::vector<SurfaceSource> block_with_near_sheets(double angle) {
  const auto height_of = [angle](double x, double y) {
    return 0.5 + angle * (x - 0.37 * y - 0.31);
  };
  const auto corner = [&](double x, double y) { return P{x, y, height_of(x, y)}; };
  std::vector<SurfaceSource> sources{
      box({0, 0, 0}, {1, 1, 1}), sheet({-1, -1, 0.5}, {2, -1, 0.5}, {2, 2, 0.5}, {-1, 2, 0.5}),
      sheet(corner(-1, -1), corner(2, -1), corner(2, 2), corner(-1, 2))};
  sources[1].name = "the first sheet";
  sources[2].name = "the second sheet";
  for (SurfaceSource& source : sources) source = moved(source, turned);
  return sources;
}

START_TEST(near_sheets_are_split_or_named) {
  for (double angle = 1e-13; angle < 1e-4; angle *= 3) {
    const Triangulation given = joined(block_with_near_sheets(angle));
    try {
      check_conforms(arranged(given).surface);
    } catch (const pnpbs::Error& error) {
      for (const char* part : {"the first sheet", "the second sheet", "set_snap", "--snap"})
        ck_assert_msg(error.message().text().find(part) != std::string::npos, "%s",
                      error.message().text().c_str());
    }
    const Arranged closed = arranged(given, SplitAt::any_point, 3e-4);
    check_conforms(closed.surface);
    expect_volumes(closed.surface, {0.5, 0.5}, 1e-3);
  }
}
END_TEST

// ---------------------------------------------------------------- sheets
START_TEST(a_sheet_cuts_a_box) {
  const Arranged it = expect_bodies(
      {box({0, 0, 0}, {1, 1, 1}), sheet({-1, -1, 0.3}, {2, -1, 0.3}, {2, 2, 0.3}, {-1, 2, 0.3})},
      {0.3, 0.7});
}
END_TEST

START_TEST(a_sheet_ends_on_the_sides_of_a_box) {
  const SurfaceSource across = sheet({0, 0, 0.5}, {1, 0, 0.5}, {1, 1, 0.5}, {0, 1, 0.5});
  const Arranged it = expect_bodies({box({0, 0, 0}, {1, 1, 1}), across}, {0.5, 0.5});
  // A sheet at a half meets the diagonals of the sides in new vertices.
  ck_assert_int_eq(it.summary.new_vertices, 4);
}
END_TEST

START_TEST(vertices_on_edges_need_no_new_ones) {
  SurfaceSource half = sheet({0, 0, 0}, {1, 0, 0}, {1, 1, 1}, {0, 1, 1});
  half.vertices.push_back({0.5, 0, 0});
  half.triangles = {{0, 4, 3}, {4, 2, 3}, {4, 1, 2}};
  half.tags.assign(3, 1);
  const Arranged it = arranged(joined({box({0, 0, 0}, {1, 1, 1}), half}), SplitAt::any_point);
  check_conforms(it.surface);
  check_parts(it);
  const auto& last = it.summary;
  ck_assert_int_ge(last.split, 2);
  expect_volumes(it.surface, {0.5, 0.5});
}
END_TEST

START_TEST(a_baffle_goes_through_a_wall) {
  const Arranged it =
      expect_bodies({box({0, 0, 0}, {2, 1, 1}),
                     sheet({1, 0.2, -0.5}, {1, 0.8, -0.5}, {1, 0.8, 0.5}, {1, 0.2, 0.5})},
                    {2});
}
END_TEST

START_TEST(a_sheet_stands_on_the_floor) {
  // Its lower edge lies within a triangle of the floor and is joined to it.
  const std::vector<SurfaceSource> sources{
      box({0, 0, 0}, {2, 1, 1}),
      sheet({1.2, 0.1, 0}, {1.7, 0.3, 0}, {1.7, 0.3, 0.5}, {1.2, 0.1, 0.5})};
  for (const std::vector<SurfaceSource>& variant : variants(sources)) {
    const Arranged it = checked(variant);
    const pnpbs::SurfaceEdges edges(it.surface);
    std::array<int, 4> times{};
    for (std::size_t e = 0; e < edges.count(); ++e) ++times.at(edges.sides(e).size());
    ck_assert_int_eq(times[1], 3);
    ck_assert_int_eq(times[3], 1);
    ck_assert_int_eq(it.summary.new_vertices, 0);
  }
}
END_TEST

START_TEST(a_tip_touches_the_floor) {
  SurfaceSource tip;
  tip.vertices = {{1.5, 0.3, 0}, {1.7, 0.3, 0.5}, {1.3, 0.4, 0.5}, {1.3, 0.2, 0.5}};
  tip.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  for (const auto& variant : variants({box({0, 0, 0}, {2, 1, 1}), named(tip, "a tip")})) {
    const Arranged it = checked(variant);
    ck_assert_int_eq(it.surface.triangles.size(), 12 + 2 + 4);
    ck_assert_int_eq(it.summary.new_vertices, 0);
  }
}
END_TEST

START_TEST(short_coordinates_are_exact) {
  // The gap of 1 is less than the tolerance of numbers of single precision.
  constexpr double kSize = 0x1p18;
  const Arranged it = checked(
      {box({0, 0, 0}, {kSize, kSize, kSize}), box({0, 0, kSize + 1}, {kSize, kSize, 2 * kSize})});
  ck_assert(it.summary.rounds == 0 && it.covered.empty());
}
END_TEST

START_TEST(nothing_changes_where_splitting_is_excluded) {
  const Triangulation crossing =
      joined({box({0, 0, 0}, {1, 1, 1}), box({0.5, 0.4, 0.3}, {2, 2, 2})});
  // These touch as well.
  const Triangulation both = joined({box({0, 0, 0}, {1, 1, 1}), box({0.25, 0.25, 1}, {1, 2, 2}),
                                     box({0.5, 0.4, 0.3}, {2, 2, 1.5})});
  const Triangulation touching =
      joined({box({0, 0, 0}, {1, 1, 1}), box({0.25, 0.25, 1}, {2, 2, 2})});
  const auto expect_same = [](const Triangulation& given, SplitAt split_at) {
    const Arranged it = arranged(given, split_at);
    ck_assert(it.covered.empty() && it.summary.split == 0);
    ck_assert_int_eq(it.surface.triangles.size(), given.triangles.size());
    ck_assert_int_eq(it.surface.vertices.size(), given.vertices.size());
  };
  expect_same(crossing, SplitAt::contacts);
  expect_same(both, SplitAt::contacts);
  const Arranged it = arranged(touching, SplitAt::contacts);
  check_conforms(it.surface);
  check_parts(it);
  ck_assert(!it.covered.empty());
}
END_TEST

START_TEST(new_vertices_have_names) {
  Triangulation given = joined({box({0, 0, 0}, {1, 1, 1}), box({0.5, 0.4, 0.3}, {2, 2, 2})});
  given.vertices.push_back({0.3, 0.3, 0.3});  // a point of a curve, which no surface has
  const Arranged it = arranged(given);
  ck_assert_int_eq(it.surface.given.size(), it.surface.vertices.size());
  for (std::size_t v = given.vertices.size(); v < it.surface.vertices.size(); ++v)
    ck_assert(it.surface.vertex_name(number_of(v)).text().starts_with("the intersection at ("));
  ck_assert_int_gt(it.summary.new_vertices, 0);
}
END_TEST

START_TEST(surfaces_that_do_not_meet_stay) {
  const Triangulation given =
      joined({ball({0, 0, 0}, 1, 8, 12), ball({0, 0, 0}, 0.5, 8, 12), box({3, 0, 0}, {4, 1, 1})});
  const Arranged it = arranged(given);
  ck_assert(it.summary.rounds == 0 && it.summary.split == 0 && it.covered.empty());
  for (std::size_t t = 0; t < given.triangles.size(); ++t)
    ck_assert(it.surface.triangles[t].vertices == given.triangles[t].vertices);
}
END_TEST

// ---------------------------------------------------------------- bodies that cross
START_TEST(regions_of_crossing_boxes_are_those_of_their_bounds) {
  Random random(5);
  for (int round = 0; round < WHEN_SANITIZED(4, 16); ++round) {
    // Coordinates on a coarse lattice make many faces, edges and corners coincide.
    const bool lattice = round % 2 == 0;
    const std::size_t count = 4 + at(random.below(5));
    std::vector<SurfaceSource> sources;
    std::vector<pnpbs::Box<3>> bounds;
    while (bounds.size() < count) {
      P a = random.point<3>({{0, 0, 0}, {1, 1, 1}}), b = random.point<3>({{0, 0, 0}, {1, 1, 1}});
      bool thin = false;
      for (std::size_t k = 0; k < 3; ++k) {
        if (lattice) a[k] = std::round(6 * a[k]) / 6, b[k] = std::round(6 * b[k]) / 6;
        if (a[k] > b[k]) std::swap(a[k], b[k]);
        thin = thin || b[k] - a[k] < 0.1;
      }
      if (thin) continue;
      bounds.push_back({a, b});
      sources.push_back(box(a, b, number_of(bounds.size())));
    }
    const Arranged it = checked(sources);
    check_regions(
        it.surface, count, {{0, 0, 0}, {1, 1, 1}},
        [&](std::size_t b, const P& x) { return pnpbs::in_closed_box(bounds[b], x); }, random);
    double all = 0;
    for (const double volume : Regions(it.surface).volumes()) all += volume;
    double expected = 0;  // the volume of the union, from the cells between all coordinates
    std::array<std::set<double>, 3> along;
    for (const auto& b : bounds)
      for (std::size_t k = 0; k < 3; ++k) along[k].insert({b.low[k], b.high[k]});
    for (auto x = along[0].begin(); std::next(x) != along[0].end(); ++x)
      for (auto y = along[1].begin(); std::next(y) != along[1].end(); ++y)
        for (auto z = along[2].begin(); std::next(z) != along[2].end(); ++z) {
          const P high{*std::next(x), *std::next(y), *std::next(z)};
          const P middle{(*x + high[0]) / 2, (*y + high[1]) / 2, (*z + high[2]) / 2};
          if (std::any_of(bounds.begin(), bounds.end(),
                          [&](const auto& b) { return pnpbs::in_closed_box(b, middle); }))
            expected += (high[0] - *x) * (high[1] - *y) * (high[2] - *z);
        }
    ck_assert_double_eq_tol(all, expected, 1e-7);
  }
}
END_TEST

START_TEST(regions_of_crossing_balls_are_those_of_their_triangles) {
  Random random(9);
  for (int round = 0; round < WHEN_SANITIZED(2, 6); ++round) {
    std::vector<SurfaceSource> sources;
    std::vector<Triangulation> alone;
    for (int b = 0; b < 5; ++b) {
      sources.push_back(ball(random.point<3>({{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}}),
                             random.between(0.4, 0.8), 8, 12));
      alone.push_back(pnpbs::join_surfaces({sources.back()}));
    }
    const Arranged it = checked(sources);
    std::vector<std::unique_ptr<Regions>> balls;
    for (const Triangulation& one : alone) balls.push_back(std::make_unique<Regions>(one));
    check_regions(
        it.surface, balls.size(), {{-1.2, -1.2, -1.2}, {1.2, 1.2, 1.2}},
        [&](std::size_t b, const P& x) { return balls[b]->regions.around(x) != 0; }, random);
  }
}
END_TEST

START_TEST(a_soup_of_triangles_is_split) {
  Random random(3);
  for (int round = 0; round < WHEN_SANITIZED(6, 30); ++round) {
    SurfaceSource soup;
    // Every third soup is on a lattice, every third is in one plane.
    const int kind = round % 3;
    for (int t = 0; t < 25; ++t) {
      const auto first = number_of(soup.vertices.size());
      for (int k = 0; k < 3; ++k) {
        P x = random.point<3>({{0, 0, 0}, {1, 1, 1}});
        if (kind == 1)
          for (double& along : x) along = std::floor(4 * along);
        if (kind == 2) x[2] = 0.5 * x[0];
        soup.vertices.push_back(x);
      }
      soup.triangles.push_back({first, first + 1, first + 2});
    }
    const Arranged it = checked({named(soup, "soup")});
    ck_assert_int_gt(it.summary.split, 10);
  }
}
END_TEST

START_TEST(the_order_of_the_triangles_does_not_matter) {
  Random random(12);
  Triangulation given = joined({ball({0, 0, 0}, 1, 8, 12), moved(box({0, 0, 0}, {1, 1, 1}), turned),
                                ball({0.3, 0.4, 0.2}, 0.9, 8, 12)});
  const Arranged first = arranged(given);
  for (int round = 0; round < 5; ++round) {
    random.shuffle(given.triangles);
    for (SurfaceTriangle& triangle : given.triangles)
      std::rotate(triangle.vertices.begin(), triangle.vertices.begin() + random.below(3),
                  triangle.vertices.end());
    const Arranged again = arranged(given);
    ck_assert(used_positions(first.surface) == used_positions(again.surface));
    ck_assert_int_eq(first.surface.triangles.size(), again.surface.triangles.size());
  }
}
END_TEST

// Two long triangles over a bent line, with a short edge at the bend, and a vertex below them. Each
// diagonal of the upper four vertices makes one thin triangle.
START_TEST(a_short_edge_between_long_ones_is_collapsed) {
  constexpr double kBend = 0.004, kShort = 1e-7, kTolerance = 1e-9;
  for (const bool other_diagonal : {false, true}) {
    Triangulation surface{{"surface 0"},
                          {{}},
                          {{-1, -kBend, 0},
                           {-kShort / 2, 0, 0},
                           {kShort / 2, 0, 0},
                           {1, -kBend, 0},
                           {0, -1, -1},
                           {0, -1, 1}},
                          {},
                          {}};
    surface.given.assign(surface.vertices.size(), {-1, -1});
    std::vector<std::array<std::int32_t, 3>> corners{{0, 4, 1}, {1, 4, 2}, {2, 4, 3},
                                                     {0, 5, 4}, {3, 4, 5}, {0, 3, 5}};
    if (other_diagonal)
      corners.insert(corners.end(), {{0, 1, 3}, {1, 2, 3}});
    else
      corners.insert(corners.end(), {{0, 1, 2}, {0, 2, 3}});
    for (const auto& triangle : corners)
      surface.triangles.push_back(
          {triangle, 1, 0, static_cast<std::int32_t>(surface.triangles.size()), false});
    std::vector<std::array<std::int32_t, 2>> merged;
    ck_assert(!pnpbs::remove_thin_pieces(surface, kTolerance, merged));
    ck_assert(merged == (std::vector<std::array<std::int32_t, 2>>{{2, 1}}));
    ck_assert_int_eq(surface.triangles.size(), 6);
    const pnpbs::SurfaceEdges edges(surface);
    ck_assert_int_eq(edges.count(), 9);
    for (std::size_t e = 0; e < edges.count(); ++e) ck_assert_int_eq(edges.sides(e).size(), 2);
  }
}
END_TEST

TEST_SUITE(test_arrangement) {
  return run_suite("arrangement", {quotients_are_rounded_to_the_nearest_double,
                                   boxes_on_each_other_share_one_face,
                                   equal_faces_become_one_without_new_vertices,
                                   shifted_boxes_share_a_part_of_a_face,
                                   a_smaller_box_stands_on_a_face,
                                   many_stacked_boxes_share_faces_and_edges,
                                   three_faces_lie_on_each_other,
                                   curves_and_points_are_split_with_surfaces,
                                   gaps_and_overlaps_within_a_length_are_closed,
                                   near_sheets_are_split_or_named,
                                   a_sheet_cuts_a_box,
                                   a_sheet_ends_on_the_sides_of_a_box,
                                   vertices_on_edges_need_no_new_ones,
                                   a_baffle_goes_through_a_wall,
                                   a_sheet_stands_on_the_floor,
                                   a_tip_touches_the_floor,
                                   short_coordinates_are_exact,
                                   nothing_changes_where_splitting_is_excluded,
                                   new_vertices_have_names,
                                   surfaces_that_do_not_meet_stay,
                                   regions_of_crossing_boxes_are_those_of_their_bounds,
                                   regions_of_crossing_balls_are_those_of_their_triangles,
                                   a_soup_of_triangles_is_split,
                                   a_short_edge_between_long_ones_is_collapsed,
                                   the_order_of_the_triangles_does_not_matter});
}
