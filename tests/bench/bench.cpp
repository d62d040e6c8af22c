// SPDX-License-Identifier: BSD-3-Clause
// pnpbs-bench: places nodes in our cases and judges them. Usage:
//   pnpbs-bench [--data DIR] [--scale S] [--set key=value]... [--repeat N] [CASE...]
// S multiplies every spacing (0.3162 makes ten times the nodes). Prints one line per case:
// quality of the triangles where the domain is wider than 3 d, then of all; speed is the median. So
// is the time that the process itself was given ("user"), which other work on the machine disturbs
// less.
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "evaluate.hpp"
#include "pnpbs/pnpbs.h"

namespace {

using pnpbs_bench::Measures;
using pnpbs_bench::NodeSet;
using pnpbs_bench::Verdict;

struct Case {
  const char* name;
  const char* poly;  // NULL: the unit square
  double constant;   // d = scale * (constant + slope * distance from (x0, y0))
  double slope;
  double x0, y0;
};

// d = h0 (1 + 9 r / 0.7071) in the square, h0 = 0.00068; the lakes as in the examples.
const Case kCases[] = {
    {"graded-square", nullptr, 0.00068, 9 * 0.00068 / 0.7071, 0.5, 0.5},
    {"graded-victoria", "lake_victoria.poly", 0.35, 0.006, 0, 0},
    {"graded-lakes", "great_lakes_islands.poly", 0.3, 0.006, 0, 0},
    {"uniform-square", nullptr, 0.0034, 0, 0, 0},
    {"uniform-victoria", "lake_victoria.poly", 0.8947, 0, 0, 0},
    {"uniform-lakes", "great_lakes_islands.poly", 1.5, 0, 0, 0},
};

struct SpacingOf {
  const Case* of;
  double scale;
};

std::int32_t spacing(std::int64_t n, std::int32_t, const double* x, double* d, void* user) {
  const SpacingOf& s = *static_cast<const SpacingOf*>(user);
  for (std::int64_t i = 0; i < n; ++i)
    d[i] = s.scale * (s.of->constant +
                      s.of->slope * std::hypot(x[2 * i] - s.of->x0, x[2 * i + 1] - s.of->y0));
  return 0;
}

pnpbs_context context = nullptr;

void require_ok(pnpbs_status status, const char* what) {
  if (status >= 0) return;
  std::fprintf(stderr, "%s: %s\n", what, pnpbs_last_error(context));
  std::exit(1);
}

struct Result {
  std::vector<double> seconds, user_seconds;
  double steps = 0, bytes_before = 0, bytes = 0;
  std::string phases, hash, stop_reason;
  NodeSet nodes;
};

double statistic(pnpbs_placement p, const char* key) {
  double value = 0;
  require_ok(pnpbs_placement_get_double(p, key, &value), key);
  return value;
}

double user_seconds() {
  rusage used;
  getrusage(RUSAGE_SELF, &used);
  return static_cast<double>(used.ru_utime.tv_sec) +
         1e-6 * static_cast<double>(used.ru_utime.tv_usec);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void take_nodes(pnpbs_placement p, NodeSet& set) {
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
}

void run_once(const Case& c, const std::string& data, double scale,
              const std::vector<std::pair<std::string, std::string>>& options, Result& result) {
  pnpbs_domain domain;
  pnpbs_placement p;
  require_ok(pnpbs_domain_create(context, 2, &domain), "domain");
  if (c.poly) {
    require_ok(pnpbs_domain_read_poly(domain, (data + "/" + c.poly).c_str()), "poly");
  } else {
    const double square[] = {0, 0, 1, 0, 1, 1, 0, 1};
    require_ok(pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, square, nullptr, 0),
               "square");
  }
  require_ok(pnpbs_placement_create(context, domain, &p), "placement");
  for (const auto& [key, value] : options)
    require_ok(pnpbs_placement_set(p, key.c_str(), value.c_str()), key.c_str());
  SpacingOf user{&c, scale};
  if (c.slope == 0)
    require_ok(pnpbs_placement_set_spacing_constant(p, scale * c.constant), "spacing");
  else
    require_ok(pnpbs_placement_set_spacing_callback(p, spacing, &user), "spacing");
  std::int64_t bytes = 0, steps = 0, rebuilds = 0, inserted = 0, deleted = 0;
  pnpbs_placement_get_int64(p, "memory.peak_bytes", &bytes);
  result.bytes_before = static_cast<double>(bytes);
  const double user_before = user_seconds();
  require_ok(pnpbs_placement_run(p), "run");
  result.user_seconds.push_back(user_seconds() - user_before);
  pnpbs_placement_get_int64(p, "memory.peak_bytes", &bytes);
  pnpbs_placement_get_int64(p, "steps", &steps);
  pnpbs_placement_get_int64(p, "rebuilds", &rebuilds);
  pnpbs_placement_get_int64(p, "inserted", &inserted);
  pnpbs_placement_get_int64(p, "deleted", &deleted);
  result.bytes = static_cast<double>(bytes);
  result.steps = static_cast<double>(steps);
  result.seconds.push_back(statistic(p, "seconds.total"));
  result.phases = "rebuilds " + std::to_string(rebuilds) + " +" + std::to_string(inserted) + " -" +
                  std::to_string(deleted);
  for (const char* phase : {"boundary", "tree", "fill", "spacing", "lists", "motion", "population",
                            "stars", "sweeps"}) {
    char text[64];
    std::snprintf(text, sizeof text, " %s %.3f", phase,
                  statistic(p, (std::string("seconds.") + phase).c_str()));
    result.phases += text;
  }
  const char* text = nullptr;
  pnpbs_placement_get_string(p, "hash", &text);
  result.hash = text;
  pnpbs_placement_get_string(p, "stop_reason", &text);
  result.stop_reason = text;
  take_nodes(p, result.nodes);
  pnpbs_placement_destroy(&p);
  pnpbs_domain_destroy(&domain);
}

void print(const char* label, const Measures& m) {
  std::printf(
      "  %s %8ld triangles: mean %.4f  1%% %.4f  least %.4f  >.80 %.3f%%  >.90 %.3f%%  "
      "angle %.1f  edge/d %.4f +- %.4f\n",
      label, static_cast<long>(m.triangles), m.quality_mean, m.quality_one_percent, m.quality_least,
      100 * m.share_above_80, 100 * m.share_above_90, m.angle_least, m.edge_mean, m.edge_deviation);
}

}  // namespace

int main(int argc, char** argv) {
  std::string data = "examples/data";
  double scale = 1;
  int repeat = 1;
  bool judge = true;
  std::vector<std::pair<std::string, std::string>> options;
  std::vector<std::string> names;
  for (int a = 1; a < argc; ++a) {
    const std::string arg = argv[a];
    if (arg == "--data" && a + 1 < argc) {
      data = argv[++a];
    } else if (arg == "--scale" && a + 1 < argc) {
      scale = std::atof(argv[++a]);
    } else if (arg == "--repeat" && a + 1 < argc) {
      repeat = std::atoi(argv[++a]);
    } else if (arg == "--no-judge") {
      judge = false;
    } else if (arg == "--set" && a + 1 < argc) {
      const std::string pair = argv[++a];
      const std::size_t equals = pair.find('=');
      options.emplace_back(pair.substr(0, equals), pair.substr(equals + 1));
    } else {
      names.push_back(arg);
    }
  }
  require_ok(pnpbs_context_create_serial(&context), "context");
  for (const Case& c : kCases) {
    if (!names.empty() && std::find(names.begin(), names.end(), c.name) == names.end()) continue;
    Result result;
    for (int r = 0; r < repeat; ++r) run_once(c, data, scale, options, result);
    const double seconds = median(result.seconds);
    const double n = static_cast<double>(result.nodes.x.size());
    std::printf(
        "%s: %.0f nodes, %.3f s, %.0f nodes/s, user %.3f s, %.0f steps, %s, %.0f bytes/node, hash "
        "%s\n"
        "  %s\n",
        c.name, n, seconds, n / seconds, median(result.user_seconds), result.steps,
        result.stop_reason.c_str(), (result.bytes - result.bytes_before) / n, result.hash.c_str(),
        result.phases.c_str());
    if (!judge) continue;
    const Verdict verdict = pnpbs_bench::evaluate(result.nodes);
    print("wide", verdict.wide);
    print("all ", verdict.all);
    if (verdict.missing_edges > 0)
      std::printf("  %ld boundary edges are missing\n", static_cast<long>(verdict.missing_edges));
    std::fflush(stdout);
  }
  pnpbs_context_destroy(&context);
  return 0;
}
