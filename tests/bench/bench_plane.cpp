// SPDX-License-Identifier: BSD-3-Clause
#include "bench_plane.hpp"

#include <cstdio>

#include "cases.hpp"
#include "evaluate.hpp"

namespace pnpbs_bench {

namespace {

struct SpacingOf {
  const Case* of;
  double scale;
};

std::int32_t spacing(std::int64_t n, std::int32_t, const double* x, double* d, void* user) {
  const SpacingOf& s = *static_cast<const SpacingOf*>(user);
  for (std::int64_t i = 0; i < n; ++i) d[i] = s.scale * s.of->d(x[2 * i], x[2 * i + 1]);
  return 0;
}

void fill(pnpbs_domain domain, const Case& c, const std::string& data) {
  if (!c.poly.empty()) {
    require_ok(pnpbs_domain_read_poly(domain, (data + "/" + c.poly).c_str()), "poly");
    return;
  }
  for (const Loop& loop : c.loops)
    require_ok(
        pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, static_cast<std::int64_t>(loop.size()),
                                  loop[0].data(), nullptr, 0),
        c.name.c_str());
}

NodeSet nodes_of(pnpbs_placement p) {
  NodeSet set;
  std::int64_t n = 0, edges = 0;
  pnpbs_placement_count(p, &n);
  std::vector<double> xy(2 * static_cast<std::size_t>(n));
  set.x.resize(static_cast<std::size_t>(n));
  set.d.resize(static_cast<std::size_t>(n));
  require_ok(pnpbs_placement_get_nodes(p, n, xy.data(), nullptr, nullptr, set.d.data()), "nodes");
  for (std::size_t i = 0; i < set.x.size(); ++i) set.x[i] = {xy[2 * i], xy[2 * i + 1]};
  require_ok(pnpbs_placement_get_boundary_edges(p, 0, &edges, nullptr, nullptr), "edges");
  set.edges.resize(static_cast<std::size_t>(edges));
  require_ok(pnpbs_placement_get_boundary_edges(p, edges, &edges, set.edges[0].data(), nullptr),
             "edges");
  return set;
}

void print(const char* label, const Measures& m) {
  std::printf(
      "  %s %8ld triangles: mean %.4f  1%% %.4f  least %.4f  >.80 %.3f%%  >.90 %.3f%%  "
      "angle %.1f  edge/d %.4f +- %.4f\n",
      label, static_cast<long>(m.triangles), m.quality_mean, m.quality_one_percent, m.quality_min,
      100 * m.share_above_80, 100 * m.share_above_90, m.angle_min, m.edge_mean, m.edge_deviation);
}

void print(const Verdict& verdict, double nodes) {
  print("wide", verdict.wide);
  print("all ", verdict.all);
  std::printf("  nodes / wanted %.4f  edge/d by bands of d:", nodes / verdict.nodes_wanted);
  for (const EdgeBand& band : verdict.edges.bands)
    std::printf(" %.4f%s", band.mean, band.edges < 100 ? "?" : "");
  const EdgeBand& at_boundary = verdict.edges.at_boundary;
  std::printf("\n  at the boundary %.4f +- %.4f  worst places %.4f (%.4g %.4g), %.4f (%.4g %.4g)\n",
              at_boundary.mean, at_boundary.deviation, verdict.edges.min_place,
              verdict.edges.min_at[0], verdict.edges.min_at[1], verdict.edges.max_place,
              verdict.edges.max_at[0], verdict.edges.max_at[1]);
  if (verdict.missing_edges > 0)
    std::printf("  %ld boundary edges are missing\n", static_cast<long>(verdict.missing_edges));
}

}  // namespace

void bench_plane(const Arguments& arguments) {
  for (const Case& c : all_cases()) {
    if (!arguments.wants(c.name, c.in_study)) continue;
    SpacingOf user{&c, arguments.scale};
    Job job;
    job.name = c.name;
    job.fill_domain = [&](pnpbs_domain domain) { fill(domain, c, arguments.data); };
    job.set_spacing = [&](pnpbs_placement p) {
      require_ok(c.constant ? pnpbs_placement_set_spacing_constant(p, arguments.scale * c.d(0, 0))
                            : pnpbs_placement_set_spacing_callback(p, spacing, &user),
                 "spacing");
    };
    job.judge = [](pnpbs_domain, pnpbs_placement p) {
      const NodeSet nodes = nodes_of(p);
      print(evaluate(nodes), static_cast<double>(nodes.x.size()));
    };
    run(job, arguments);
  }
}

}  // namespace pnpbs_bench
