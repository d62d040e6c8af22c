// SPDX-License-Identifier: BSD-3-Clause
// pnpbs-bench: places nodes in our cases and judges them. Usage:
//   pnpbs-bench [--data DIR] [--scale S] [--set key=value]... [--repeat N] [CASE...]
// S multiplies every spacing (0.3162 makes ten times the nodes). Prints one line per case:
// quality of the triangles where the domain is wider than 3 d, then of all; edge over d by bands of
// d
// ("?": fewer than 100 edges), at the boundary, and where its mean over two rings of neighbours is
// least and largest; speed is the median. So is the time that the process itself was given
// ("user"), which other work on the machine disturbs less.
// A CASE that ends with "-" stands for all that begin so: bands- for the study of the bands of d.
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "cases.hpp"
#include "evaluate.hpp"
#include "pnpbs/pnpbs.h"

namespace {

using pnpbs_bench::Case;
using pnpbs_bench::EdgeBand;
using pnpbs_bench::Measures;
using pnpbs_bench::NodeSet;
using pnpbs_bench::Verdict;

struct SpacingOf {
  const Case* of;
  double scale;
};

std::int32_t spacing(std::int64_t n, std::int32_t, const double* x, double* d, void* user) {
  const SpacingOf& s = *static_cast<const SpacingOf*>(user);
  for (std::int64_t i = 0; i < n; ++i) d[i] = s.scale * s.of->d(x[2 * i], x[2 * i + 1]);
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
  if (!c.poly.empty())
    require_ok(pnpbs_domain_read_poly(domain, (data + "/" + c.poly).c_str()), "poly");
  else
    for (const pnpbs_bench::Loop& loop : c.loops)
      require_ok(pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1,
                                           static_cast<std::int64_t>(loop.size()), loop[0].data(),
                                           nullptr, 0),
                 c.name.c_str());
  require_ok(pnpbs_placement_create(context, domain, &p), "placement");
  for (const auto& [key, value] : options)
    require_ok(pnpbs_placement_set(p, key.c_str(), value.c_str()), key.c_str());
  SpacingOf user{&c, scale};
  if (c.constant)
    require_ok(pnpbs_placement_set_spacing_constant(p, scale * c.d(0, 0)), "spacing");
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
      label, static_cast<long>(m.triangles), m.quality_mean, m.quality_one_percent, m.quality_min,
      100 * m.share_above_80, 100 * m.share_above_90, m.angle_min, m.edge_mean, m.edge_deviation);
}

void print(const Verdict& verdict, double nodes) {
  std::printf("  nodes / wanted %.4f  edge/d by bands of d:", nodes / verdict.nodes_wanted);
  for (const EdgeBand& band : verdict.edges.bands)
    std::printf(" %.4f%s", band.mean, band.edges < 100 ? "?" : "");
  const EdgeBand& at_boundary = verdict.edges.at_boundary;
  std::printf("\n  at the boundary %.4f +- %.4f  worst places %.4f (%.4g %.4g), %.4f (%.4g %.4g)\n",
              at_boundary.mean, at_boundary.deviation, verdict.edges.min_place,
              verdict.edges.min_at[0], verdict.edges.min_at[1], verdict.edges.max_place,
              verdict.edges.max_at[0], verdict.edges.max_at[1]);
}

// A name stands for all cases that begin with it, if it ends with "-".
bool is_wanted(const Case& c, const std::vector<std::string>& names) {
  if (names.empty()) return !c.in_study;
  return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
    return c.name == name || (name.back() == '-' && c.name.rfind(name, 0) == 0);
  });
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
  for (const Case& c : pnpbs_bench::all_cases()) {
    if (!is_wanted(c, names)) continue;
    Result result;
    for (int r = 0; r < repeat; ++r) run_once(c, data, scale, options, result);
    const double seconds = median(result.seconds);
    const double n = static_cast<double>(result.nodes.x.size());
    std::printf(
        "%s: %.0f nodes, %.3f s, %.0f nodes/s, user %.3f s, %.0f steps, %s, %.0f bytes/node, hash "
        "%s\n"
        "  %s\n",
        c.name.c_str(), n, seconds, n / seconds, median(result.user_seconds), result.steps,
        result.stop_reason.c_str(), (result.bytes - result.bytes_before) / n, result.hash.c_str(),
        result.phases.c_str());
    if (!judge) continue;
    const Verdict verdict = pnpbs_bench::evaluate(result.nodes);
    print("wide", verdict.wide);
    print("all ", verdict.all);
    print(verdict, n);
    if (verdict.missing_edges > 0)
      std::printf("  %ld boundary edges are missing\n", static_cast<long>(verdict.missing_edges));
    std::fflush(stdout);
  }
  pnpbs_context_destroy(&context);
  return 0;
}
