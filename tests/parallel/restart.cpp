// SPDX-License-Identifier: BSD-3-Clause
// Tests runs continued from a checkpoint, for every kind of spacing, in the plane, in space, on
// surfaces and on the sphere, with and without a growth limit and small spots that samples of d
// miss. Three ranks run and write checkpoints at five moments; two ranks and one rank continue from
// each of them. Nodes, status and warnings must be the same as without interruption.
#include <pnpbs/pnpbs_mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "rank_program.h"

namespace {

constexpr int kMoments = 5;
const char* case_name = "";

void require(pnpbs_status status, const char* what) {
  expect(status >= 0, (std::string(case_name) + ": " + what).c_str());
}

// ------------------------------------------------------------------ spacings -------------------

// A spacing. With `spot` it is small around a point near which few samples lie.
struct Spot {
  double d, fine, radius;
  double at[3];
  bool spot;
};

std::int32_t spacing_with_spot(std::int64_t n, std::int32_t dim, const double* x, double* d,
                               void* user) {
  const auto* const s = static_cast<const Spot*>(user);
  for (std::int64_t i = 0; i < n; ++i) {
    double square = 0;
    for (std::int32_t k = 0; k < dim; ++k) square += std::pow(x[dim * i + k] - s->at[k], 2);
    d[i] = s->spot && square < s->radius * s->radius ? s->fine : s->d * (1 + 0.3 * x[dim * i]);
  }
  return 0;
}

using SetSpacing = std::function<void(pnpbs_placement)>;

SetSpacing callback(Spot& spot) {
  return [&spot](pnpbs_placement p) {
    require(pnpbs_placement_set_spacing_callback(p, spacing_with_spot, &spot), "callback");
  };
}

SetSpacing constant(double d) {
  return [d](pnpbs_placement p) {
    require(pnpbs_placement_set_spacing_constant(p, d), "constant spacing");
  };
}

SetSpacing grid(std::int32_t dim, double d) {
  return [=](pnpbs_placement p) {
    const std::int64_t size[] = {3, 3, 3};
    const double origin[] = {-1, -1, -1}, step[] = {1, 1, 1};
    std::vector<double> values(dim == 2 ? 9 : 27);
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = d * (1 + 0.2 * (k % 3));
    require(pnpbs_placement_set_spacing_grid(p, size, origin, step, values.data()), "grid");
  };
}

// Sets d on a mesh of two triangles or five tetrahedra over the square or cube from -1 to 1.
SetSpacing mesh(std::int32_t dim, double d) {
  return [=](pnpbs_placement p) {
    std::vector<double> x, values;
    for (int k = 0; k < (dim == 2 ? 4 : 8); ++k) {
      for (std::int32_t c = 0; c < dim; ++c) x.push_back((k >> c & 1) != 0 ? 1 : -1);
      values.push_back(d * (1 + 0.1 * k));
    }
    const std::vector<std::int64_t> triangles{0, 1, 3, 0, 3, 2};
    const std::vector<std::int64_t> tetrahedra{0, 1, 3, 5, 0, 3, 2, 6, 0, 5,
                                               4, 6, 3, 6, 7, 5, 0, 3, 6, 5};
    const auto& elements = dim == 2 ? triangles : tetrahedra;
    require(pnpbs_placement_set_spacing_mesh(
                p, static_cast<std::int64_t>(values.size()), x.data(), values.data(),
                static_cast<std::int64_t>(elements.size()) / (dim + 1), elements.data()),
            "mesh");
  };
}

SetSpacing points(std::int32_t dim, double d) {
  return [=](pnpbs_placement p) {
    std::vector<double> x, values;
    for (int k = 0; k < 40; ++k) {
      for (std::int32_t c = 0; c < dim; ++c) x.push_back(std::fmod(0.37 * k * (c + 1), 2) - 1);
      values.push_back(d * (0.8 + 0.1 * (k % 4)));
    }
    require(pnpbs_placement_set_spacing_points(p, 40, x.data(), values.data()), "points");
  };
}

SetSpacing shape(double d) {
  return [=](pnpbs_placement p) {
    require(pnpbs_placement_set_spacing_from_shape(p, 20, 3, 0, 0.2, d / 2, 1.5 * d), "shape");
  };
}

// Sets values at the nodes of an initial placement with constant d.
SetSpacing at_nodes(double d) {
  return [=](pnpbs_placement p) {
    constant(d)(p);
    require(pnpbs_placement_initialise(p), "nodes");
    std::int64_t n = 0;
    pnpbs_placement_count(p, &n);
    std::vector<double> values(static_cast<std::size_t>(n) + 1), x(3 * values.size());
    require(pnpbs_placement_get_nodes(p, n, x.data(), nullptr, nullptr, nullptr), "nodes");
    for (std::int64_t i = 0; i < n; ++i)
      values[static_cast<std::size_t>(i)] =
          d * (0.9 + 0.1 * std::fabs(x[static_cast<std::size_t>(i)]));
    require(pnpbs_placement_set_spacing_at_nodes(p, n, values.data()), "values at nodes");
  };
}

// ------------------------------------------------------------------ cases ----------------------

enum class Kind { plane, body, surface, sphere };

struct Case {
  std::string name;
  Kind kind;
  SetSpacing set_spacing;
  const char* growth_limit;  // null: the default
};

pnpbs_placement placement_of(pnpbs_context on, const Case& c) {
  const double corners[] = {-1, -1, 1, -1, 1, 1, -1, 1}, outside[] = {0, 0, 1};
  const double low[] = {-0.8, -0.9, -0.6}, high[] = {0.8, 0.9, 0.6};
  pnpbs_domain domain;
  pnpbs_placement placement;
  require(c.kind == Kind::sphere ? pnpbs_domain_create_sphere(on, 1, outside, &domain)
                                 : pnpbs_domain_create(on, c.kind == Kind::plane ? 2 : 3, &domain),
          "domain");
  if (c.kind == Kind::plane)
    pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, corners, nullptr, 0);
  if (c.kind == Kind::surface) pnpbs_domain_set_filled(domain, 0);
  if (c.kind == Kind::body || c.kind == Kind::surface) pnpbs_domain_add_box(domain, low, high, 1);
  require(pnpbs_placement_create(on, domain, &placement), "placement");
  pnpbs_domain_destroy(&domain);
  pnpbs_placement_set_int64(placement, "steps", 40);
  pnpbs_placement_set_int64(placement, "event_interval", 8);
  if (c.growth_limit) pnpbs_placement_set(placement, "growth_limit", c.growth_limit);
  return placement;
}

struct Result {
  std::string hash;
  pnpbs_status status;
  std::vector<std::string> warnings;

  bool operator==(const Result&) const = default;
};

Result result_of(pnpbs_placement placement, pnpbs_status status) {
  char hash[32];
  hash_of_nodes(placement, hash);
  Result result{hash, status, {}};
  std::int32_t count = 0;
  pnpbs_placement_warning_count(placement, &count);
  for (std::int32_t k = 0; k < count; ++k) {
    const char* text = "";
    pnpbs_placement_get_warning(placement, k, &text);
    result.warnings.emplace_back(text);
  }
  return result;
}

std::string path_of(int moment) { return "restart_" + std::to_string(moment) + ".vtkhdf"; }

// Counts the events and checkpoints of a run. Checkpoints are written at the first events and then
// at later ones, which overwrite the last files.
struct Watch {
  pnpbs_placement placement;
  int events = 0, written = 0;
};

std::int32_t write_checkpoints(double, std::int64_t, std::int64_t, double, void* user) {
  auto* const watch = static_cast<Watch*>(user);
  const int moment = watch->written < 2 ? watch->written : 2 + watch->events++ % 2;
  if (pnpbs_placement_write_checkpoint(watch->placement, path_of(moment).c_str()) == PNPBS_OK)
    watch->written = std::max(watch->written, moment + 1);
  return 0;
}

void expect_same(const Result& result, const Result& right, int moment) {
  const std::string name =
      std::string(case_name) + ", moment " + std::to_string(moment) + " on " + std::to_string(size);
  expect(result.hash == right.hash, (name + ": other nodes").c_str());
  expect(result.status == right.status, (name + ": status " + std::to_string(result.status) +
                                         " instead of " + std::to_string(right.status))
                                            .c_str());
  std::string warnings;
  for (const std::string& warning : result.warnings) warnings += "\n  " + warning;
  expect(result.warnings == right.warnings, (name + ": other warnings:" + warnings).c_str());
}

// Continues from each checkpoint; the last one is that of the finished run.
void continue_from(pnpbs_context on, const Case& c, int moments, const Result& right,
                   const SetSpacing& set_spacing) {
  for (int moment = 0; moment < moments; ++moment) {
    pnpbs_placement placement = placement_of(on, c);
    if (set_spacing) set_spacing(placement);
    const pnpbs_status read = pnpbs_placement_read_checkpoint(placement, path_of(moment).c_str());
    expect(read == PNPBS_OK, (std::string(case_name) + ", read: " + pnpbs_last_error(on)).c_str());
    std::int64_t finished = 0, status = 0;
    pnpbs_placement_get_int64(placement, "finished", &finished);
    pnpbs_placement_get_int64(placement, "status", &status);
    expect((moment == moments - 1) == (finished == 1), "whether the run has finished");
    if (!finished) status = pnpbs_placement_run(placement);
    expect_same(result_of(placement, static_cast<pnpbs_status>(status)), right, moment);
    pnpbs_placement_destroy(&placement);
  }
}

void check(const Case& c, pnpbs_context part, int size_of_part) {
  case_name = c.name.c_str();
  pnpbs_placement placement = placement_of(context, c);
  c.set_spacing(placement);
  Watch watch{placement};
  pnpbs_placement_set_monitor(placement, write_checkpoints, &watch);
  const pnpbs_status status = pnpbs_placement_run(placement);
  pnpbs_placement_set_monitor(placement, nullptr, nullptr);
  require(status, "run");
  expect(watch.written >= 2, (c.name + ": few checkpoints").c_str());
  require(pnpbs_placement_write_checkpoint(placement, path_of(watch.written).c_str()), "write");
  const Result right = result_of(placement, status);
  pnpbs_placement_destroy(&placement);
  const bool saved_whole = c.name.find("values at nodes") != std::string::npos;
  const int all = size;
  size = size_of_part;
  continue_from(part, c, watch.written + 1, right, saved_whole ? SetSpacing() : c.set_spacing);
  size = all;
  MPI_Barrier(MPI_COMM_WORLD);
}

std::vector<Case> cases(Spot& even, Spot& spot) {
  std::vector<Case> all;
  for (const auto& named : {std::pair(Kind::plane, "plane"),
                            {Kind::body, "body"},
                            {Kind::surface, "surface"},
                            {Kind::sphere, "sphere"}}) {
    const Kind kind = named.first;
    const std::string name = named.second;
    const std::int32_t dim = kind == Kind::plane ? 2 : 3;
    const double d = kind == Kind::plane ? 0.15 : kind == Kind::body ? 0.35 : 0.25;
    const auto add = [&](const char* what, SetSpacing set, const char* limit) {
      all.push_back({std::string(name) + ", " + what, kind, std::move(set), limit});
    };
    add("constant", constant(d), nullptr);
    add("callback", callback(even), nullptr);
    add("callback, no limit", callback(even), "0");
    add("callback, limit", callback(even), "0.1");
    if (kind != Kind::sphere) add("grid", grid(dim, d), nullptr);
    if (kind != Kind::sphere) add("mesh", mesh(dim, d), nullptr);
    add("points", points(dim, d), nullptr);
    if (kind == Kind::plane || kind == Kind::body) add("shape", shape(d), nullptr);
    add("values at nodes", at_nodes(d), nullptr);
    if (kind == Kind::body) {
      add("spot", callback(spot), nullptr);
      add("spot, no limit", callback(spot), "0");
      add("spot, limit", callback(spot), "0.2");
    }
  }
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  begin_ranks(&argc, &argv);
  MPI_Comm split;
  MPI_Comm_split(MPI_COMM_WORLD, rank == 0, rank, &split);
  pnpbs_context part;
  expect(pnpbs_context_create_mpi(split, &part) == PNPBS_OK, "context");
  Spot even{0.18, 0, 0, {0, 0, 0}, false};
  Spot spot{0.25, 0.06, 0.07, {0.3287, -0.6423, 0.0041}, true};
  const std::string only = argc > 1 ? argv[1] : "";
  for (const Case& c : cases(even, spot))
    if (c.name.find(only) != std::string::npos) check(c, part, rank == 0 ? 1 : size - 1);
  pnpbs_context_destroy(&part);
  MPI_Comm_free(&split);
  if (rank == 0)
    for (int moment = 0; moment < kMoments; ++moment) std::remove(path_of(moment).c_str());
  return end_ranks();
}
