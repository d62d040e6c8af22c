// SPDX-License-Identifier: BSD-3-Clause
#include "bench_volumes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cases_volume.hpp"
#include "volume_measures.hpp"

namespace pnpbs_bench {

namespace {

struct SpaceNodes {
  std::vector<Place> x;
  std::vector<double> d;
  std::vector<char> on_boundary;
  std::vector<TriangleOfNodes> boundary;  // as returned by the library
};

SpaceNodes nodes_of(pnpbs_placement p) {
  SpaceNodes set;
  std::int64_t n = 0, triangles = 0;
  pnpbs_placement_count(p, &n);
  set.x.resize(static_cast<std::size_t>(n));
  set.d.resize(static_cast<std::size_t>(n));
  std::vector<std::int32_t> tags(static_cast<std::size_t>(n));
  require_ok(pnpbs_placement_get_nodes(p, n, set.x[0].data(), nullptr, tags.data(), set.d.data()),
             "nodes");
  for (const std::int32_t tag : tags) set.on_boundary.push_back(tag != 0);
  require_ok(pnpbs_placement_get_boundary_triangles(p, 0, &triangles, nullptr, nullptr),
             "triangles");
  set.boundary.resize(static_cast<std::size_t>(triangles));
  require_ok(pnpbs_placement_get_boundary_triangles(p, triangles, &triangles,
                                                    set.boundary[0].data(), nullptr),
             "triangles");
  for (TriangleOfNodes& t : set.boundary) std::sort(t.begin(), t.end());
  return set;
}

void print(const char* label, const TetrahedronMeasures& m) {
  std::printf(
      "  %s %8ld tetrahedra: mean %.4f  1%% %.4f  least %.4f  angle %.1f (%.4g %.4g %.4g)  below "
      "20 "
      "degrees %ld  below 10 %ld\n",
      label, static_cast<long>(m.tetrahedra), m.quality_mean, m.quality_one_percent, m.quality_min,
      m.angle_min, m.angle_min_at[0], m.angle_min_at[1], m.angle_min_at[2],
      static_cast<long>(m.below_20), static_cast<long>(m.below_10));
}

void print(const VolumeVerdict& v, double covered, std::int64_t other_faces) {
  print("all     ", v.all);
  print("inside  ", v.inside);
  print("boundary", v.at_boundary);
  std::printf(
      "  edge/d %.4f +- %.4f  inside %.4f +- %.4f  at the boundary %.4f +- %.4f  on it "
      "%.4f +- %.4f\n  by octaves of d:",
      v.edges.mean, v.edges.deviation, v.inner_edges.mean, v.inner_edges.deviation,
      v.edges_at_boundary.mean, v.edges_at_boundary.deviation, v.boundary_edges.mean,
      v.boundary_edges.deviation);
  for (const EdgeBand& band : v.octaves)
    std::printf(" %.4f +- %.4f%s", band.mean, band.deviation, band.edges < 100 ? "?" : "");
  std::printf("  worst places %.4f (%.4g %.4g %.4g), %.4f (%.4g %.4g %.4g)\n", v.min_place,
              v.min_at[0], v.min_at[1], v.min_at[2], v.max_place, v.max_at[0], v.max_at[1],
              v.max_at[2]);
  std::printf("  %ld boundary triangles: mean %.4f  angle mean %.1f least %.1f  covered %.6f\n",
              static_cast<long>(v.surface.triangles), v.surface.quality_mean, v.surface.angle_mean,
              v.surface.angle_min, covered);
  if (other_faces > 0)
    std::printf("  %ld boundary triangles are none in the reference\n",
                static_cast<long>(other_faces));
}

void judge(const VolumeCase& c, const std::string& data, pnpbs_domain domain, pnpbs_placement p) {
  const SpaceNodes nodes = nodes_of(p);
  BodyMesh mesh = reference_mesh(nodes.x, nodes.on_boundary, c.inside(data));
  double volume = 0;
  require_ok(pnpbs_domain_measure(domain, &volume), "volume");
  std::sort(mesh.boundary.begin(), mesh.boundary.end());
  const auto other =
      std::count_if(nodes.boundary.begin(), nodes.boundary.end(), [&](const TriangleOfNodes& t) {
        return !std::binary_search(mesh.boundary.begin(), mesh.boundary.end(), t);
      });
  const VolumeVerdict verdict = evaluate(nodes.x, nodes.d, nodes.on_boundary, mesh);
  print(verdict, verdict.volume / volume, other);
}

}  // namespace

void bench_volumes(const Arguments& arguments) {
  for (const VolumeCase& c : volume_cases()) {
    if (!arguments.wants(c.name, false)) continue;
    volume_spacing d = c.scaled(arguments.scale * std::cbrt(70000 / arguments.nodes));
    Job job;
    job.name = c.name;
    job.dimension = 3;
    job.fill_domain = [&](pnpbs_domain domain) {
      require_ok(c.body(domain, arguments.data.c_str()), c.name.c_str());
    };
    job.set_spacing = [&](pnpbs_placement p) {
      require_ok(c.constant() ? pnpbs_placement_set_spacing_constant(p, d.constant)
                              : pnpbs_placement_set_spacing_callback(p, volume_spacing_at, &d),
                 "spacing");
    };
    job.judge = [&](pnpbs_domain domain, pnpbs_placement p) {
      judge(c, arguments.data, domain, p);
    };
    run(job, arguments);
  }
}

}  // namespace pnpbs_bench
