// SPDX-License-Identifier: BSD-3-Clause
// Ties on a sphere, broken by ids: equivalent to heights raised by powers of a small number,
// independent of the order of the points, and consistent with one triangulation.
#include <check.h>

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <vector>

#include "core/random.hpp"
#include "predicates/space.hpp"
#include "run_suite.hpp"
#include "space_reference.hpp"

using pnpbs::in_sphere_perturbed;
using pnpbs::orientation;
using P = pnpbs::Point<3>;

namespace {

int sign_of(const FivePoints& p, const FiveIds& id) {
  return in_sphere_perturbed(p[0], p[1], p[2], p[3], p[4], id[0], id[1], id[2], id[3], id[4]);
}

FivePoints random_lattice(Random& random, std::int64_t range) {
  FivePoints points;
  for (P& x : points) {
    for (double& coordinate : x) coordinate = static_cast<double>(random.below(range));
  }
  return points;
}

FiveIds random_ids(Random& random) {
  using Limits = std::numeric_limits<std::int64_t>;
  FiveIds ids{Limits::min(), -3, 0, std::int64_t{1} << 40, Limits::max()};
  random.shuffle(ids);
  return ids;
}

bool in_one_plane(const FivePoints& points) {
  const SpaceSigns signs = space_signs(points);
  return std::all_of(signs.rest.begin(), signs.rest.end(), [](int sign) { return sign == 0; });
}

struct Set {
  std::vector<P> points;
  std::vector<std::int64_t> ids;
};

Set grid(int side) {
  Set set;
  for (int i = 0; i < side * side * side; ++i) {
    set.points.push_back({double(i % side), double(i / side % side), double(i / side / side)});
  }
  return set;
}

// Returns the points on the sphere of radius 3.
Set thirty_on_a_sphere() {
  Set set;
  for (const P& x : grid(7).points) {
    const P from_middle{x[0] - 3, x[1] - 3, x[2] - 3};
    if (pnpbs::squared_distance<3>(from_middle, {0, 0, 0}) == 9) set.points.push_back(from_middle);
  }
  return set;
}

void shuffle_ids(Set& set, std::uint64_t seed) {
  Random random(seed);
  set.ids.resize(set.points.size());
  std::iota(set.ids.begin(), set.ids.end(), std::int64_t{7});
  random.shuffle(set.ids);
}

using Corners = std::array<int, 4>;

bool is_delaunay(const Set& set, const Corners& t) {
  const auto& p = set.points;
  const auto& id = set.ids;
  for (int i = 0; i < static_cast<int>(p.size()); ++i) {
    if (std::find(t.begin(), t.end(), i) != t.end()) continue;
    const int side = in_sphere_perturbed(p[t[0]], p[t[1]], p[t[2]], p[t[3]], p[i], id[t[0]],
                                         id[t[1]], id[t[2]], id[t[3]], id[i]);
    quick_assert(side != 0);
    if (side > 0) return false;
  }
  return true;
}

// Returns the tetrahedra of positive orientation whose spheres are empty.
std::vector<Corners> empty_spheres(const Set& set) {
  std::vector<Corners> found;
  const auto& p = set.points;
  const int count = static_cast<int>(p.size());
  for (int i = 0; i < count; ++i) {
    for (int j = i + 1; j < count; ++j) {
      for (int k = j + 1; k < count; ++k) {
        for (int l = k + 1; l < count; ++l) {
          const int turn = orientation(p[i], p[j], p[k], p[l]);
          const Corners corners = turn > 0 ? Corners{i, j, k, l} : Corners{i, j, l, k};
          if (turn != 0 && is_delaunay(set, corners)) found.push_back(corners);
        }
      }
    }
  }
  return found;
}

double six_volumes(const Set& set, const std::vector<Corners>& tetrahedra) {
  double sum = 0;
  for (const Corners& t : tetrahedra) {
    const auto edge = [&](int end, int k) { return set.points[t[end]][k] - set.points[t[0]][k]; };
    sum += edge(1, 0) * (edge(2, 1) * edge(3, 2) - edge(2, 2) * edge(3, 1)) -
           edge(1, 1) * (edge(2, 0) * edge(3, 2) - edge(2, 2) * edge(3, 0)) +
           edge(1, 2) * (edge(2, 0) * edge(3, 1) - edge(2, 1) * edge(3, 0));
  }
  return sum;
}

bool on_the_hull(const Set& set, int a, int b, int c) {
  bool front = false, back = false;
  for (const P& x : set.points) {
    const int side = orientation(set.points[a], set.points[b], set.points[c], x);
    front = front || side > 0;
    back = back || side < 0;
  }
  return !(front && back);
}

// Expects that each face has one tetrahedron on either side, or one if it is on the hull. Then all
// parts of the hull are covered equally often.
void check_faces(const Set& set, const std::vector<Corners>& tetrahedra) {
  std::map<std::array<int, 3>, std::vector<int>> sides;
  for (const Corners& t : tetrahedra) {
    for (const int apex : t) {
      std::array<int, 3> face;
      std::copy_if(t.begin(), t.end(), face.begin(), [&](int corner) { return corner != apex; });
      std::sort(face.begin(), face.end());
      const auto& p = set.points;
      sides[face].push_back(orientation(p[face[0]], p[face[1]], p[face[2]], p[apex]));
    }
  }
  for (const auto& [face, found] : sides) {
    if (on_the_hull(set, face[0], face[1], face[2])) {
      ck_assert_uint_eq(found.size(), 1);
    } else {
      ck_assert_uint_eq(found.size(), 2);
      ck_assert_int_eq(found[0], -found[1]);
    }
  }
}

}  // namespace

START_TEST(ties_are_those_of_raised_heights) {
  Random random(1);
  int ties = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const FivePoints points = random_lattice(random, 2 + random.below(3));
    const FiveIds ids = random_ids(random);
    quick_assert(sign_of(points, ids) == perturbed_sphere_sign(points, ids));
    ties += space_signs(points).sphere == 0;
  }
  ck_assert_int_gt(ties, 5000);
}
END_TEST

START_TEST(perturbation_is_antisymmetric) {
  Random random(2);
  for (int trial = 0; trial < 1000; ++trial) {
    const FivePoints points = random_lattice(random, 2 + random.below(2));
    const FiveIds ids = random_ids(random);
    const int first = sign_of(points, ids);
    quick_assert((first == 0) == in_one_plane(points));
    std::array<int, 5> order{0, 1, 2, 3, 4};
    do {
      FivePoints points_now;
      FiveIds ids_now;
      int inversions = 0;
      for (int i = 0; i < 5; ++i) {
        points_now[i] = points[order[i]];
        ids_now[i] = ids[order[i]];
        for (int j = i + 1; j < 5; ++j) inversions += order[i] > order[j];
      }
      quick_assert(sign_of(points_now, ids_now) == (inversions % 2 == 0 ? first : -first));
    } while (std::next_permutation(order.begin(), order.end()));
  }
}
END_TEST

START_TEST(cube_is_filled_once) {
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    Set set = grid(2);
    shuffle_ids(set, seed);
    const std::vector<Corners> tetrahedra = empty_spheres(set);
    ck_assert_double_eq(six_volumes(set, tetrahedra), 6);
    check_faces(set, tetrahedra);
    // The smallest id is lifted most: its corner is cut off.
    const auto smallest = std::min_element(set.ids.begin(), set.ids.end()) - set.ids.begin();
    ck_assert_int_eq(std::count_if(tetrahedra.begin(), tetrahedra.end(),
                                   [&](const Corners& t) {
                                     return std::find(t.begin(), t.end(), smallest) != t.end();
                                   }),
                     1);
  }
}
END_TEST

START_TEST(ties_make_one_triangulation) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Set set = grid(3);
    shuffle_ids(set, seed);
    std::vector<Corners> tetrahedra = empty_spheres(set);
    ck_assert_double_eq(six_volumes(set, tetrahedra), 6 * 8);
    check_faces(set, tetrahedra);
    set = thirty_on_a_sphere();
    ck_assert_uint_eq(set.points.size(), 30);
    shuffle_ids(set, seed);
    tetrahedra = empty_spheres(set);
    ck_assert_double_eq(six_volumes(set, tetrahedra), 544);
    check_faces(set, tetrahedra);
  }
}
END_TEST

TEST_SUITE(test_space_ties) {
  return run_suite("space ties", {ties_are_those_of_raised_heights, perturbation_is_antisymmetric,
                                  cube_is_filled_once, ties_make_one_triangulation});
}
