// SPDX-License-Identifier: BSD-3-Clause
// Tests that a failed call changes nothing. The spacing callback of one rank returns an error in
// some of its calls, or the monitor or a file fails. All results of queries on any rank must remain
// the same. The same call, repeated, must then succeed with the result that it has without the
// error. The program runs on groups of ranks.
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "placement_view.hpp"
#include "rank_program.h"

namespace {

using Call = std::function<pnpbs_status(pnpbs_placement)>;

// Parameters of a spacing, and the number of the call in which the callback of the last rank fails.
struct Spacing {
  double d = 0.05, centre = 0.3;
  long calls = 0, fails_at = -1;
};

std::int32_t spacing_at(std::int64_t n, std::int32_t dim, const double* x, double* d, void* user) {
  auto* const s = static_cast<Spacing*>(user);
  ++s->calls;
  if (s->fails_at >= 0 && s->calls >= s->fails_at && rank == size - 1) return 1;
  for (std::int64_t i = 0; i < n; ++i)
    d[i] = s->d * (1 + std::hypot(x[dim * i] - s->centre, x[dim * i + 1] - 0.5));
  return 0;
}

struct Shape {
  const char* name;
  std::int32_t dim;
  double d;
  std::function<void(pnpbs_domain)> add;
};

const std::vector<Shape>& shapes() {
  static const std::vector<Shape> all = {{"square", 2, 0.06,
                                          [](pnpbs_domain domain) {
                                            const double corners[] = {0, 0, 1, 0, 1, 1, 0, 1};
                                            pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4,
                                                                      corners, nullptr, 0);
                                          }},
                                         {"box", 3, 0.2,
                                          [](pnpbs_domain domain) {
                                            const double low[] = {0, 0, 0}, high[] = {1, 1, 0.7};
                                            pnpbs_domain_add_box(domain, low, high, 1);
                                          }},
                                         {"surface", 3, 0.2,
                                          [](pnpbs_domain domain) {
                                            const double centre[] = {0.5, 0.5, 0.5};
                                            pnpbs_domain_set_filled(domain, 0);
                                            pnpbs_domain_add_ball(domain, centre, 0.5, 1);
                                          }},
                                         {"sphere", 0, 0.1, {}}};
  return all;
}

pnpbs_placement placement_of(const Shape& shape, Spacing& spacing) {
  const double outside[] = {0, 0, -1};
  pnpbs_domain domain;
  pnpbs_placement placement;
  expect((shape.dim == 0 ? pnpbs_domain_create_sphere(context, 1, outside, &domain)
                         : pnpbs_domain_create(context, shape.dim, &domain)) == PNPBS_OK,
         "domain");
  if (shape.add) shape.add(domain);
  expect(pnpbs_placement_create(context, domain, &placement) == PNPBS_OK, "placement");
  pnpbs_domain_destroy(&domain);
  pnpbs_placement_set_int64(placement, "steps", 30);
  pnpbs_placement_set_int64(placement, "coarsest_steps", 20);
  spacing = {shape.d};
  pnpbs_placement_set_spacing_callback(placement, spacing_at, &spacing);
  return placement;
}

void set_another_spacing(pnpbs_placement placement, Spacing& spacing) {
  spacing.centre = 0.8;
  spacing.d *= 0.8;
  pnpbs_placement_set_spacing_callback(placement, spacing_at, &spacing);
}

// A call that fails, and the calls before it.
struct Case {
  const char* name;
  std::function<void(pnpbs_placement, Spacing&)> prepare;
  Call call;
};

const std::vector<Case>& cases() {
  const auto nothing = [](pnpbs_placement, Spacing&) {};
  const auto run_before = [](pnpbs_placement p, Spacing&) { pnpbs_placement_run(p); };
  const auto steps_before = [](pnpbs_placement p, Spacing&) { pnpbs_placement_step(p, 13); };
  const auto another_spacing = [](pnpbs_placement p, Spacing& spacing) {
    pnpbs_placement_run(p);
    set_another_spacing(p, spacing);
  };
  const auto step = [](pnpbs_placement p) { return pnpbs_placement_step(p, 17); };
  const auto adjust = [](pnpbs_placement p) {
    return pnpbs_placement_adjust_population(p, nullptr, nullptr);
  };
  static const std::vector<Case> all = {
      {"first run", nothing, pnpbs_placement_run},
      {"run again", run_before, pnpbs_placement_run},
      {"run on", steps_before, pnpbs_placement_run},
      {"step on", steps_before, step},
      {"run for another spacing", another_spacing, pnpbs_placement_run},
      {"step for another spacing", another_spacing, step},
      {"initialise again", run_before, pnpbs_placement_initialise},
      {"adjust for another spacing", another_spacing, adjust},
      {"rebalance for another spacing", another_spacing, pnpbs_placement_rebalance}};
  return all;
}

std::string about(const Shape& shape, const Case& c, long call) {
  return std::string(shape.name) + ", " + c.name + ", fails at call " + std::to_string(call);
}

// The largest number of callback calls over the ranks, and the result of the call without a
// failure.
struct Undisturbed {
  long calls;
  pnpbs_status status;
  char hash[32];
};

Undisturbed undisturbed(const Shape& shape, const Case& c) {
  Spacing spacing;
  const pnpbs_placement placement = placement_of(shape, spacing);
  c.prepare(placement, spacing);
  spacing.calls = 0;
  Undisturbed result{};
  result.status = c.call(placement);
  expect(result.status >= 0, (about(shape, c, 0) + ": an error without a failure").c_str());
  hash_of_nodes(placement, result.hash);
  result.calls = spacing.calls;
  MPI_Bcast(&result.calls, 1, MPI_LONG, size - 1, group);
  pnpbs_placement p = placement;
  pnpbs_placement_destroy(&p);
  return result;
}

void check_failure(const Shape& shape, const Case& c, const Undisturbed& right, long at) {
  const std::string name = about(shape, c, at);
  Spacing spacing;
  pnpbs_placement placement = placement_of(shape, spacing);
  c.prepare(placement, spacing);
  const PlacementView before = view_before_call(placement);
  spacing.calls = 0;
  spacing.fails_at = at;
  const pnpbs_status failed = c.call(placement);
  spacing.fails_at = -1;
  expect(failed == PNPBS_ERROR_CALLBACK, (name + ": another status").c_str());
  const PlacementView after = view_after_call(placement);
  expect(before == after, (name + ": changed " + before.difference(after)).c_str());
  char hash[32];
  expect(c.call(placement) == right.status, (name + ": another status when repeated").c_str());
  hash_of_nodes(placement, hash);
  expect(std::string(hash) == right.hash, (name + ": other nodes when repeated").c_str());
  pnpbs_placement_destroy(&placement);
}

void check(const Shape& shape, const Case& c) {
  const Undisturbed right = undisturbed(shape, c);
  std::vector<long> at{1, right.calls / 3, right.calls - 1, right.calls};
  std::erase_if(at, [&](long call) { return call < 1 || call > right.calls; });
  std::sort(at.begin(), at.end());
  at.erase(std::unique(at.begin(), at.end()), at.end());
  for (const long call : at) check_failure(shape, c, right, call);
}

// Checks a checkpoint that is read with another spacing, which only the callback of the last rank
// reveals, late in the call.
void check_reading() {
  const Shape& shape = shapes()[0];
  Spacing spacing;
  pnpbs_placement placement = placement_of(shape, spacing);
  char path[100];
  int first = rank;
  MPI_Bcast(&first, 1, MPI_INT, 0, group);
  snprintf(path, sizeof path, "transactions_%d_%d.vtkhdf", size, first);
  pnpbs_placement_step(placement, 11);
  expect(pnpbs_placement_write_checkpoint(placement, path) == PNPBS_OK, "checkpoint");
  pnpbs_placement_run(placement);
  const PlacementView before = view_before_call(placement);
  spacing.calls = 0;
  spacing.fails_at = 3;
  expect(pnpbs_placement_read_checkpoint(placement, path) == PNPBS_ERROR_CALLBACK, "read");
  spacing.fails_at = -1;
  const PlacementView after = view_after_call(placement);
  expect(before == after, ("reading changed " + before.difference(after)).c_str());
  pnpbs_placement_destroy(&placement);
  MPI_Barrier(group);
  if (rank == 0) std::remove(path);
}

// A spacing with a spot that is narrower than the distance of the samples.
std::int32_t spot_at(std::int64_t n, std::int32_t dim, const double* x, double* d, void* user) {
  auto* const s = static_cast<Spacing*>(user);
  ++s->calls;
  if (s->fails_at >= 0 && s->calls >= s->fails_at && rank == size - 1) return 1;
  for (std::int64_t i = 0; i < n; ++i)
    d[i] = std::hypot(x[dim * i] - 0.4137, x[dim * i + 1] - 0.5519) < 0.002 ? 0.0005 : 0.1;
  return 0;
}

// Checks that no rank keeps a hint if the callback of the last rank fails at the point.
void check_hints() {
  std::string hashes[2];
  for (const bool fails : {false, true}) {
    Spacing spacing;
    pnpbs_placement placement = placement_of(shapes()[0], spacing);
    pnpbs_placement_set_spacing_callback(placement, spot_at, &spacing);
    const double hint[] = {0.4137, 0.5519};
    spacing.fails_at = fails ? 1 : -1;
    if (fails)
      expect(pnpbs_placement_add_spacing_hints(placement, 1, hint) == PNPBS_ERROR_CALLBACK, "hint");
    spacing.fails_at = -1;
    expect(pnpbs_placement_run(placement) >= 0, "run after a hint that failed");
    char hash[32];
    hash_of_nodes(placement, hash);
    hashes[fails ? 1 : 0] = hash;
    pnpbs_placement_destroy(&placement);
  }
  expect(hashes[0] == hashes[1], "a hint that failed changed the nodes");
}

void checks() {
  check_hints();
  for (const Shape& shape : shapes())
    for (const Case& c : cases()) check(shape, c);
  check_reading();
}

}  // namespace

int main(int argc, char** argv) { return run_in_groups(argc, argv, checks); }
