// SPDX-License-Identifier: BSD-3-Clause
// The plane sweep against a search over all pairs, and faces against Euler's formula.
#include <algorithm>
#include <random>
#include <vector>

#include "geometry/plane/faces.hpp"
#include "geometry/plane/plane_sweep.hpp"
#include "predicates/plane.hpp"
#include "run_suite.hpp"

using pnpbs::orientation;
using pnpbs::VertexPair;
using P = pnpbs::Point<2>;

namespace {

struct Net {
  std::vector<P> vertices;
  std::vector<VertexPair> edges;
};

bool on_segment(const P& p, const P& a, const P& b) {
  if (orientation(a, b, p) != 0) return false;
  return std::min(a[0], b[0]) <= p[0] && p[0] <= std::max(a[0], b[0]) &&
         std::min(a[1], b[1]) <= p[1] && p[1] <= std::max(a[1], b[1]);
}

bool is_end(std::int32_t vertex, const VertexPair& edge) {
  return vertex == edge[0] || vertex == edge[1];
}

bool lies_inside(const Net& net, std::int32_t vertex, const VertexPair& edge) {
  return !is_end(vertex, edge) &&
         on_segment(net.vertices[vertex], net.vertices[edge[0]], net.vertices[edge[1]]);
}

// Returns whether two edges meet other than in a common end.
bool meet(const Net& net, const VertexPair& a, const VertexPair& b) {
  if (is_end(a[0], b) && is_end(a[1], b)) return true;
  const auto& p = net.vertices;
  return pnpbs::cross_properly(p[a[0]], p[a[1]], p[b[0]], p[b[1]]) || lies_inside(net, a[0], b) ||
         lies_inside(net, a[1], b) || lies_inside(net, b[0], a) || lies_inside(net, b[1], a);
}

bool any_conflict(const Net& net) {
  for (std::size_t e = 0; e < net.edges.size(); ++e) {
    for (std::size_t v = 0; v < net.vertices.size(); ++v) {
      if (lies_inside(net, static_cast<std::int32_t>(v), net.edges[e])) return true;
    }
    for (std::size_t f = 0; f < e; ++f) {
      if (meet(net, net.edges[e], net.edges[f])) return true;
    }
  }
  return false;
}

Net random_net(std::mt19937& random, int vertices, int edges, int range) {
  Net net;
  std::uniform_int_distribution<int> place(0, range);
  while (static_cast<int>(net.vertices.size()) < vertices) {
    const P p{double(place(random)), double(place(random))};
    if (std::find(net.vertices.begin(), net.vertices.end(), p) == net.vertices.end()) {
      net.vertices.push_back(p);
    }
  }
  std::uniform_int_distribution<int> any(0, vertices - 1);
  while (static_cast<int>(net.edges.size()) < edges) {
    const int a = any(random), b = any(random);
    if (a != b) net.edges.push_back({a, b});
  }
  return net;
}

// Removes edges that conflict with earlier ones.
Net without_conflicts(const Net& all) {
  Net net{all.vertices, {}};
  for (const VertexPair& edge : all.edges) {
    net.edges.push_back(edge);
    if (any_conflict(net)) net.edges.pop_back();
  }
  return net;
}

int components(const Net& net) {
  std::vector<int> part(net.vertices.size());
  for (std::size_t v = 0; v < part.size(); ++v) part[v] = static_cast<int>(v);
  for (std::size_t round = 0; round < part.size(); ++round) {
    for (const auto& [a, b] : net.edges) part[a] = part[b] = std::min(part[a], part[b]);
  }
  std::sort(part.begin(), part.end());
  return static_cast<int>(std::unique(part.begin(), part.end()) - part.begin());
}

}  // namespace

START_TEST(conflicts_equal_all_pairs) {
  std::mt19937 random(5);
  int with = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const Net net = random_net(random, 8, 3, 6);
    const bool expected = any_conflict(net);
    ck_assert_int_eq(!pnpbs::sweep_plane(net.vertices, net.edges).conflicts.empty(), expected);
    with += expected;
  }
  ck_assert_int_gt(with, 2000);
  ck_assert_int_lt(with, 18000);
}
END_TEST

START_TEST(conflicts_are_real) {
  std::mt19937 random(6);
  for (int trial = 0; trial < 2000; ++trial) {
    const Net net = random_net(random, 20, 20, 9);
    for (const auto& conflict : pnpbs::sweep_plane(net.vertices, net.edges).conflicts) {
      const VertexPair& edge = net.edges[conflict.edge];
      if (conflict.other >= 0) {
        ck_assert(meet(net, edge, net.edges[conflict.other]));
      } else {
        ck_assert(lies_inside(net, conflict.vertex, edge));
      }
    }
  }
}
END_TEST

START_TEST(faces_obey_euler) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 500; ++trial) {
    const Net net = without_conflicts(random_net(random, 24, 60, 8));
    const auto sweep = pnpbs::sweep_plane(net.vertices, net.edges);
    ck_assert(sweep.conflicts.empty());
    const auto faces = pnpbs::find_faces(net.vertices, net.edges, sweep);
    const int v = static_cast<int>(net.vertices.size()), e = static_cast<int>(net.edges.size());
    ck_assert_int_eq(faces.count, e - v + components(net) + 1);
  }
}
END_TEST

START_TEST(left_edge_equals_all_pairs) {
  std::mt19937 random(8);
  int compared = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const Net net = without_conflicts(random_net(random, 16, 30, 100));
    const auto sweep = pnpbs::sweep_plane(net.vertices, net.edges);
    for (std::size_t v = 0; v < net.vertices.size(); ++v) {
      const P& p = net.vertices[v];
      double nearest = -1;
      std::int32_t expected = -1;
      for (std::size_t e = 0; e < net.edges.size(); ++e) {
        P low = net.vertices[net.edges[e][0]], high = net.vertices[net.edges[e][1]];
        if (pnpbs::is_lower(high, low)) std::swap(low, high);
        if (!(low[1] < p[1] && p[1] < high[1])) continue;
        const double x = low[0] + (high[0] - low[0]) * (p[1] - low[1]) / (high[1] - low[1]);
        if (x < p[0] - 1e-9 && x > nearest) {
          nearest = x;
          expected = static_cast<std::int32_t>(e);
        }
      }
      // The reference ignores edges with an end level with p, so such points are skipped.
      bool level = false;
      for (const auto& [a, b] : net.edges) {
        if (is_end(static_cast<std::int32_t>(v), {a, b})) continue;
        level = level || net.vertices[a][1] == p[1] || net.vertices[b][1] == p[1];
      }
      if (level) continue;
      ck_assert_int_eq(sweep.left_edge[v], expected);
      compared += expected >= 0;
    }
  }
  ck_assert_int_gt(compared, 1000);
}
END_TEST

START_TEST(same_place_is_told) {
  const std::vector<P> vertices{{0, 0}, {1, 0}, {1, 0}, {0, 1}};
  const auto sweep = pnpbs::sweep_plane(vertices, {{0, 3}});
  ck_assert_uint_eq(sweep.coincident.size(), 1);
  ck_assert_int_eq(sweep.coincident[0][0], 1);
  ck_assert_int_eq(sweep.coincident[0][1], 2);
}
END_TEST

TEST_SUITE(test_plane_sweep) {
  return run_suite("plane_sweep", {conflicts_equal_all_pairs, conflicts_are_real, faces_obey_euler,
                                   left_edge_equals_all_pairs, same_place_is_told});
}
