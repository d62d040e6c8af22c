// SPDX-License-Identifier: BSD-3-Clause
#include "bench_run.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace pnpbs_bench {

namespace {

struct Result {
  std::vector<double> seconds, user_seconds;
  double nodes = 0, steps = 0, bytes = 0;
  std::string phases, hash, stop_reason;
};

double statistic(pnpbs_placement p, const char* key) {
  double value = 0;
  require_ok(pnpbs_placement_get_double(p, key, &value), key);
  return value;
}

std::int64_t count(pnpbs_placement p, const char* key) {
  std::int64_t value = 0;
  require_ok(pnpbs_placement_get_int64(p, key, &value), key);
  return value;
}

std::string text(pnpbs_placement p, const char* key) {
  const char* value = nullptr;
  require_ok(pnpbs_placement_get_string(p, key, &value), key);
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

std::string phases_of(pnpbs_placement p) {
  std::string phases = "rebuilds " + std::to_string(count(p, "rebuilds")) + " +" +
                       std::to_string(count(p, "inserted")) + " -" +
                       std::to_string(count(p, "deleted"));
  for (const char* phase : {"boundary", "tree", "fill", "spacing", "lists", "motion", "population",
                            "stars", "sweeps"}) {
    char words[64];
    std::snprintf(words, sizeof words, " %s %.3f", phase,
                  statistic(p, (std::string("seconds.") + phase).c_str()));
    phases += words;
  }
  return phases;
}

void run_once(pnpbs_placement p, Result& result) {
  const double bytes_before = static_cast<double>(count(p, "memory.peak_bytes"));
  const double user_before = user_seconds();
  require_ok(pnpbs_placement_run(p), "run");
  result.user_seconds.push_back(user_seconds() - user_before);
  result.seconds.push_back(statistic(p, "seconds.total"));
  result.bytes = static_cast<double>(count(p, "memory.peak_bytes")) - bytes_before;
  result.steps = static_cast<double>(count(p, "steps"));
  result.nodes = static_cast<double>(count(p, "nodes"));
  result.phases = phases_of(p);
  result.hash = text(p, "hash");
  result.stop_reason = text(p, "stop_reason");
}

void print(const std::string& name, const Result& r) {
  const double seconds = median(r.seconds);
  std::printf(
      "%s: %.0f nodes, %.3f s, %.0f nodes/s, user %.3f s, %.0f steps, %s, %.0f bytes/node, hash "
      "%s\n"
      "  %s\n",
      name.c_str(), r.nodes, seconds, r.nodes / seconds, median(r.user_seconds), r.steps,
      r.stop_reason.c_str(), r.bytes / r.nodes, r.hash.c_str(), r.phases.c_str());
}

}  // namespace

bool Arguments::wants(const std::string& name, bool in_study) const {
  if (names.empty()) return !in_study;
  return std::any_of(names.begin(), names.end(), [&](const std::string& wanted) {
    return name == wanted || (wanted.back() == '-' && name.rfind(wanted, 0) == 0);
  });
}

pnpbs_context bench_context() {
  static const pnpbs_context context = [] {
    pnpbs_context made = nullptr;
    if (pnpbs_context_create_serial(&made) < 0) {
      std::fprintf(stderr, "context: %s\n", pnpbs_last_error(nullptr));
      std::exit(1);
    }
    return made;
  }();
  return context;
}

void require_ok(pnpbs_status status, const char* what) {
  if (status >= 0) return;
  std::fprintf(stderr, "%s: %s\n", what, pnpbs_last_error(bench_context()));
  std::exit(1);
}

void run(const Job& job, const Arguments& arguments) {
  Result result;
  for (int repetition = 1; repetition <= arguments.repeat; ++repetition) {
    pnpbs_domain domain;
    pnpbs_placement p;
    require_ok(pnpbs_domain_create(bench_context(), job.dimension, &domain), "domain");
    job.fill_domain(domain);
    require_ok(pnpbs_placement_create(bench_context(), domain, &p), "placement");
    for (const auto& [key, value] : arguments.options)
      require_ok(pnpbs_placement_set(p, key.c_str(), value.c_str()), key.c_str());
    job.set_spacing(p);
    run_once(p, result);
    if (repetition == arguments.repeat) {
      print(job.name, result);
      if (arguments.judge) job.judge(domain, p);
      std::fflush(stdout);
    }
    pnpbs_placement_destroy(&p);
    pnpbs_domain_destroy(&domain);
  }
}

}  // namespace pnpbs_bench
