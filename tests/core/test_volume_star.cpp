// SPDX-License-Identifier: BSD-3-Clause
// The star of a single node in space against all empty spheres, found by testing all tetrahedra.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "delaunay/volume/volume_star.hpp"
#include "geometry/run_suite.hpp"
#include "predicates/space.hpp"
#include "quick_assert.hpp"
#include "random.hpp"

using pnpbs::VolumeNode;
using pnpbs::VolumeStar;
using P = pnpbs::Point<3>;
using Ids = std::array<std::int64_t, 4>;
using Set = std::vector<VolumeNode>;

namespace {

constexpr double kEverywhere = 1e100;  // a d for which all tetrahedra satisfy the rule

// More than twice the digits of double, so that tetrahedra that are flat up to rounding have a
// sphere.
#ifdef __SIZEOF_FLOAT128__
__extension__ using Quad = __float128;
#else
using Quad = long double;
#endif
using Vector = std::array<Quad, 3>;

Quad dot(const Vector& p, const Vector& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }
Vector cross(const Vector& p, const Vector& q) {
  return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}

// The centre c solves 2 c u_i = u_i^2 for the edges u_i from one corner.
bool keeps_the_rule(const Set& corners) {
  double d = corners[0].d;
  for (const VolumeNode& corner : corners) d = std::min(d, corner.d);
  if (d == kEverywhere) return true;
  std::array<Vector, 3> u;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) u[i][k] = Quad{corners[i].x[k]} - Quad{corners[3].x[k]};
  const Quad volume = dot(u[0], cross(u[1], u[2])), limit = 2 * pnpbs::kMaxRadius * d * volume;
  Vector centre{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector across = cross(u[(i + 1) % 3], u[(i + 2) % 3]);
    for (std::size_t k = 0; k < 3; ++k) centre[k] += dot(u[i], u[i]) * across[k];
  }
  return dot(centre, centre) <= limit * limit;
}

int in_sphere_of(const Set& t, const VolumeNode& e) {
  return pnpbs::orientation(t[0].x, t[1].x, t[2].x, t[3].x) *
         pnpbs::in_sphere_perturbed(t[0].x, t[1].x, t[2].x, t[3].x, e.x, t[0].id, t[1].id, t[2].id,
                                    t[3].id, e.id);
}

Ids ids_of(const Set& corners) {
  Ids ids{corners[0].id, corners[1].id, corners[2].id, corners[3].id};
  std::sort(ids.begin(), ids.end());
  return ids;
}

std::set<Ids> all_elements(const Set& set) {
  std::set<Ids> elements;
  const auto has = [](const Set& t, const VolumeNode& e) {
    return std::any_of(t.begin(), t.end(), [&](const VolumeNode& n) { return n.id == e.id; });
  };
  for (std::size_t a = 0; a < set.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      for (std::size_t c = 0; c < b; ++c)
        for (std::size_t d = 0; d < c; ++d) {
          const Set t{set[a], set[b], set[c], set[d]};
          if (pnpbs::orientation(t[0].x, t[1].x, t[2].x, t[3].x) == 0) continue;
          if (std::all_of(
                  set.begin(), set.end(),
                  [&](const VolumeNode& e) { return has(t, e) || in_sphere_of(t, e) < 0; }) &&
              keeps_the_rule(t))
            elements.insert(ids_of(t));
        }
  return elements;
}

// Builds the star of node i from its `first` nearest nodes, and then from those that may change it.
VolumeStar star_in(const Set& set, std::size_t i, std::size_t first, Random& random) {
  Set others;
  for (std::size_t k = 0; k < set.size(); ++k)
    if (k != i) others.push_back(set[k]);
  random.shuffle(others);
  const auto gap = [&](const VolumeNode& n) { return pnpbs::distance<3>(n.x, set[i].x); };
  std::stable_sort(others.begin(), others.end(),
                   [&](const VolumeNode& a, const VolumeNode& b) { return gap(a) < gap(b); });
  const double reach = first < others.size() ? gap(others[first]) : kEverywhere;
  Set left(others.begin() + static_cast<std::ptrdiff_t>(std::min(first, others.size())),
           others.end());
  others.resize(std::min(first, others.size()));
  random.shuffle(others);
  VolumeStar star;
  star.start(set[i]);
  for (const VolumeNode& n : others) star.add(n);
  while (!star.wrap(reach)) {
    Set later;
    std::size_t added = 0;
    std::vector<char> may_matter;
    for (const VolumeNode& n : left) {
      may_matter.push_back(star.may_matter(n.x));
      quick_assert(!may_matter.back() || star.may_matter_in({n.x, n.x}));
      quick_assert(!may_matter.back() || gap(n) <= star.search_reach() * (1 + 1e-8));
    }
    for (std::size_t k = 0; k < left.size(); ++k) {
      if (may_matter[k] != 0) {
        star.add(left[k]);
        ++added;
      } else {
        later.push_back(left[k]);
      }
    }
    if (added == 0) break;
    left = later;
  }
  star.finish();
  return star;
}

// Returns the ids of the tetrahedra, in the order of the star.
std::vector<Ids> tetrahedra(const VolumeStar& star) {
  std::vector<Ids> all;
  for (const VolumeStar::Corners& triangle : star.triangles()) {
    Set corners{star.centre()};
    for (const std::int32_t k : triangle)
      corners.push_back(star.candidates()[static_cast<std::size_t>(
          star.neighbours()[static_cast<std::size_t>(k)])]);
    quick_assert(pnpbs::orientation(corners[0].x, corners[1].x, corners[2].x, corners[3].x) > 0);
    all.push_back({corners[0].id, corners[1].id, corners[2].id, corners[3].id});
  }
  return all;
}

std::vector<std::int64_t> neighbours(const VolumeStar& star) {
  std::vector<std::int64_t> ids;
  for (const std::int32_t k : star.neighbours())
    ids.push_back(star.candidates()[static_cast<std::size_t>(k)].id);
  return ids;
}

// Expects each tetrahedron in the stars of all its corners, for any number of first candidates.
void expect_all_elements(const std::string& what, const Set& set, std::uint64_t seed) {
  Random random(seed);
  const std::set<Ids> expected = all_elements(set);
  for (const std::size_t first : {std::size_t{3}, std::size_t{12}, set.size()}) {
    std::map<Ids, int> found;
    for (std::size_t i = 0; i < set.size(); ++i) {
      const VolumeStar star = star_in(set, i, first, random);
      const std::vector<Ids> star_tetrahedra = tetrahedra(star);
      for (Ids t : star_tetrahedra) {
        std::sort(t.begin(), t.end());
        ++found[t];
      }
      const VolumeStar again = star_in(set, i, first + 4, random);
      quick_assert_msg(
          tetrahedra(again) == star_tetrahedra && neighbours(again) == neighbours(star),
          "%s: another order, another star", what.c_str());
    }
    quick_assert_msg(found.size() == expected.size(), "%s: %zu tetrahedra instead of %zu",
                     what.c_str(), found.size(), expected.size());
    for (const auto& [t, count] : found)
      quick_assert_msg(count == 4 && expected.count(t) == 1, "%s: a tetrahedron is in %d stars",
                       what.c_str(), count);
  }
}

Set with_ids(const std::vector<P>& points, double d, std::uint64_t seed) {
  std::vector<std::int64_t> ids;
  for (std::size_t k = 0; k < points.size(); ++k)
    ids.push_back(1'000'000'000'000 + 7 * static_cast<std::int64_t>(k));
  Random(seed).shuffle(ids);
  Set set;
  for (std::size_t k = 0; k < points.size(); ++k) set.push_back({points[k], d, ids[k]});
  return set;
}

// Returns the lattice points with two per unit length for which keep(i, j, k) holds.
template <class Keep>
std::vector<P> lattice(int nx, int ny, int nz, const Keep& keep) {
  std::vector<P> points;
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j)
      for (int k = 0; k < nz; ++k)
        if (keep(i, j, k)) points.push_back({0.5 * i, 0.5 * j, 0.5 * k});
  return points;
}

std::vector<P> turned(std::vector<P> points) {
  for (P& x : points)
    x = {0.36 * x[0] + 0.48 * x[1] - 0.8 * x[2], -0.8 * x[0] + 0.6 * x[1],
         0.48 * x[0] + 0.64 * x[1] + 0.6 * x[2]};
  return points;
}

}  // namespace

START_TEST(random_nodes) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    Random random(seed);
    std::vector<P> points;
    for (int k = 0; k < 34; ++k) points.push_back(random.point<3>({{0, 0, 0}, {1, 1, 1}}));
    for (const double d : {0.08, 0.2, 0.5, kEverywhere}) {
      Set set = with_ids(points, d, seed);
      if (d < 1)
        for (VolumeNode& n : set) n.d *= random.between(0.5, 1.5);
      expect_all_elements("random nodes", set, seed);
    }
  }
}
END_TEST

// Many nodes lie on each sphere, in each plane and on each line.
START_TEST(lattices) {
  const auto cubic = [](int, int, int) { return true; };
  const auto face_centred = [](int i, int j, int k) { return (i + j + k) % 2 == 0; };
  const auto body_centred = [](int i, int j, int k) { return i % 2 == j % 2 && j % 2 == k % 2; };
  const std::vector<P> cubes = lattice(4, 3, 3, cubic), faces = lattice(5, 4, 3, face_centred),
                       centres = lattice(5, 5, 5, body_centred);
  for (std::uint64_t seed = 0; seed < 3; ++seed)
    for (const double d : {0.45, kEverywhere}) {
      expect_all_elements("cubic", with_ids(cubes, d, seed), seed);
      expect_all_elements("face-centred", with_ids(faces, d, seed), seed);
      expect_all_elements("body-centred", with_ids(centres, d, seed), seed);
    }
  expect_all_elements("turned", with_ids(turned(cubes), kEverywhere, 1), 1);
  expect_all_elements("turned", with_ids(turned(faces), kEverywhere, 2), 2);
}
END_TEST

// Two cells of the A15 structure: spheres have additional nodes only at the border.
START_TEST(a15) {
  std::vector<P> points;
  for (int i = 0; i < 2; ++i) {
    const double x = i;
    for (const P& at : {P{0, 0, 0}, P{.5, .5, .5}, P{.25, 0, .5}, P{.75, 0, .5}, P{.5, .25, 0},
                        P{.5, .75, 0}, P{0, .5, .25}, P{0, .5, .75}})
      points.push_back({x + at[0], at[1], at[2]});
  }
  for (int j = 0; j < 2; ++j)
    for (int k = 0; k < 2; ++k) points.push_back({2, 1.0 * j, 1.0 * k});
  expect_all_elements("A15", with_ids(points, 0.5, 5), 5);
  expect_all_elements("A15", with_ids(points, kEverywhere, 5), 5);
}
END_TEST

START_TEST(hardly_any_tetrahedra) {
  std::vector<P> flat = lattice(4, 4, 1, [](int, int, int) { return true; });
  expect_all_elements("flat", with_ids(flat, 1, 1), 1);
  flat.push_back({1, 1, 1});
  expect_all_elements("pyramid", with_ids(flat, 1, 2), 2);
  std::vector<P> line = lattice(7, 1, 1, [](int, int, int) { return true; });
  for (const P& x : {P{0, 1, 0}, P{0, 0, 1}}) {
    expect_all_elements("line", with_ids(line, kEverywhere, 3), 3);
    line.push_back(x);
  }
  expect_all_elements("fan", with_ids(line, kEverywhere, 4), 4);
  for (const std::size_t few : {1U, 2U, 3U, 4U})
    expect_all_elements(
        "few",
        with_ids({line.end() - static_cast<std::ptrdiff_t>(few), line.end()}, kEverywhere, 5), 5);
}
END_TEST

// Two sheets at distances below and above the possible width of elements.
START_TEST(sheets) {
  for (const double gap : {0.1, 1.0, 1.9, 2.1, 3.9, 4.1, 6.0}) {
    std::vector<P> points = lattice(4, 4, 2, [](int, int, int) { return true; });
    for (P& x : points) {
      x[0] *= 2;
      x[1] *= 2;
      x[2] *= 2 * gap;
    }
    expect_all_elements("sheets", with_ids(points, 1, 6), 6);
    expect_all_elements("turned sheets", with_ids(turned(points), 1, 7), 7);
  }
}
END_TEST

// Two cones that meet in a node: around it, the elements form two components.
START_TEST(two_components) {
  Random random(8);
  std::vector<P> points{{0, 0, 0}};
  for (const double up : {1.0, -1.0})
    for (int ring = 1; ring <= 2; ++ring)
      for (int k = 0; k < 5; ++k) {
        const double angle = 1.25 * k + ring, across = 0.15 * ring;
        points.push_back({across * std::cos(angle) + random.between(-0.01, 0.01),
                          across * std::sin(angle) + random.between(-0.01, 0.01),
                          up * (0.8 * ring + random.between(-0.02, 0.02))});
      }
  const Set set = with_ids(points, 1, 9);
  expect_all_elements("two cones", set, 9);
  const VolumeStar star = star_in(set, 0, 5, random);
  int above = 0, below = 0;
  for (const std::int32_t k : star.neighbours())
    ++(star.candidates()[static_cast<std::size_t>(k)].x[2] > 0 ? above : below);
  quick_assert(above >= 3 && below >= 3 && !star.closed());
  for (const VolumeStar::Corners& t : star.triangles()) {
    int up = 0;
    for (const std::int32_t place : t) {
      const auto k = static_cast<std::size_t>(star.neighbours()[static_cast<std::size_t>(place)]);
      up += star.candidates()[k].x[2] > 0 ? 1 : 0;
    }
    quick_assert(up == 0 || up == 3);
  }
}
END_TEST

// The star of a lattice node is proven complete without further search if the known region reaches
// the diameter of its spheres.
START_TEST(proof) {
  std::vector<P> points =
      lattice(7, 7, 7, [](int i, int j, int k) { return i % 2 == j % 2 && j % 2 == k % 2; });
  const Set set = with_ids(points, 1, 10);
  const double diameter = std::sqrt(5.0) / 2;
  for (const double reach : {diameter * 0.999, diameter * 1.001}) {
    for (const VolumeNode& centre : set) {
      if (centre.x != P{1.5, 1.5, 1.5}) continue;
      VolumeStar star;
      star.start(centre);
      for (const VolumeNode& n : set)
        if (n.id != centre.id && pnpbs::distance<3>(n.x, centre.x) < reach) star.add(n);
      quick_assert(star.wrap(reach) == (reach > diameter));
      star.finish();
      quick_assert(star.closed() && star.triangles().size() == 24);
      quick_assert(star.neighbours().size() == 14);
    }
  }
}
END_TEST

// Elements known from other stars lead to the same star. If they surround the node, nothing else is
// needed.
START_TEST(known_elements) {
  Random random(12);
  std::vector<P> points;
  for (int k = 0; k < 60; ++k) points.push_back(random.point<3>({{0, 0, 0}, {1, 1, 1}}));
  int closed = 0;
  for (const double d : {0.25, kEverywhere}) {
    const Set set = with_ids(points, d, 13);
    for (std::size_t i = 0; i < set.size(); ++i) {
      const VolumeStar star = star_in(set, i, set.size(), random);
      // Indices into the neighbours.
      std::vector<VolumeStar::Corners> elements = star.triangles();
      random.shuffle(elements);
      const auto candidate = [&](std::int32_t place) {
        return star.neighbours()[static_cast<std::size_t>(place)];
      };
      for (const std::size_t known : {std::size_t{1}, elements.size() / 2, elements.size()}) {
        VolumeStar again;
        again.start(set[i]);
        for (const VolumeNode& n : star.candidates()) again.add(n);
        for (std::size_t k = 0; k < std::min(known, elements.size()); ++k) {
          const auto [a, b, c] = elements[k];
          again.add_known({candidate(a), candidate(b), candidate(c)}, true);
        }
        again.wrap(kEverywhere);
        again.finish();
        quick_assert(tetrahedra(again) == tetrahedra(star) && again.closed() == star.closed());
        quick_assert(neighbours(again) == neighbours(star));
      }
      VolumeStar alone, one_less;
      for (VolumeStar* const one : {&alone, &one_less}) {
        one->start(set[i]);
        for (const std::int32_t k : star.neighbours())
          one->add(star.candidates()[static_cast<std::size_t>(k)]);
      }
      for (const VolumeStar::Corners& corners : elements) alone.add_known(corners, true);
      for (std::size_t k = 1; k < elements.size(); ++k) one_less.add_known(elements[k], true);
      quick_assert(alone.all_known() == star.closed() && !one_less.all_known());
      if (!star.closed()) continue;
      ++closed;
      alone.finish();
      quick_assert(tetrahedra(alone) == tetrahedra(star) && alone.closed());
      VolumeStar some_outside;  // one element outside the domain
      some_outside.start(set[i]);
      for (const std::int32_t k : star.neighbours())
        some_outside.add(star.candidates()[static_cast<std::size_t>(k)]);
      for (const VolumeStar::Corners& corners : elements)
        some_outside.add_known(corners, corners != elements[0]);
      quick_assert(some_outside.all_known());
      some_outside.finish();
      quick_assert(some_outside.triangles().size() + 1 == elements.size() &&
                   !some_outside.closed());
    }
  }
  quick_assert(closed > 20);
}
END_TEST

// The rule is symmetric, and correct for tetrahedra that are flat up to rounding.
START_TEST(rule) {
  const auto element = [](const Set& t) {
    return pnpbs::is_element(pnpbs::ordered_by_id({t[0], t[1], t[2], t[3]}));
  };
  Random random(11);
  int elements = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    Set t;
    for (std::int64_t id = 0; id < 4; ++id)
      t.push_back({random.point<3>({{0, 0, 0}, {1, 1, 1}}), random.between(0.2, 0.6), id});
    const bool expected = keeps_the_rule(t);
    random.shuffle(t);
    quick_assert(element(t) == expected);
    elements += expected ? 1 : 0;
  }
  quick_assert(elements > 500 && elements < 3500);
  // Corners on a circle of radius 1, slightly off its plane. The centre of the sphere does not
  // move.
  for (const double lift : {1e-9, 1e-13, 1e-15}) {
    const Set sliver{{{1, 0, lift}, 0.6, 4},
                     {{0, 1, -lift}, 0.6, 2},
                     {{-1, 0, lift}, 0.6, 3},
                     {{0, -1, -lift}, 0.6, 1}};
    quick_assert(element(sliver));
    Set inside = sliver;
    inside[3].x = {0, -0.9, -lift};
    quick_assert(!element(inside));
  }
}
END_TEST

TEST_SUITE(test_volume_star) {
  return run_suite("volume_star", {random_nodes, lattices, a15, hardly_any_tetrahedra, sheets,
                                   two_components, proof, known_elements, rule});
}
