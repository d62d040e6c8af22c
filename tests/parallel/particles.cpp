// SPDX-License-Identifier: BSD-3-Clause
// Tests particles that fill a body. For any body, no pair is closer than documented, no particle is
// nearer to the wall than the nodes were, most nodes become particles without moving, and the
// others move or are left out only because another node is close. The volumes sum up to that of the
// body, and equal those of cells cut by brute force from a square and a cube. Any number of ranks
// gives the bits of one. The test uses the public interface only. Usage: particles <folder of the
// examples' bodies>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

extern "C" {
#include "rank_program.h"
}
#include "parallel/brute_cells.hpp"
#include "volume_cases.h"

namespace {

using namespace brute;

// ------------------------------------------------------------------ cases ----------------------

const double kDepth = 0.42, kMostMoved = 0.3;
double pushed_apart(std::int32_t dim) { return dim == 2 ? 0.9 : 0.85; }
double closest_pair(std::int32_t dim) { return dim == 2 ? 0.651 : 0.611; }

pnpbs_status unit_square(pnpbs_domain domain, const char*) {
  const double square[] = {0, 0, 1, 0, 1, 1, 0, 1};
  return pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, square, nullptr, 0);
}
// Adds a square with a slit narrower than the spacing, and a narrow bay.
pnpbs_status slotted_plane(pnpbs_domain domain, const char*) {
  const double outline[] = {0, 0, 1, 0, 1, 1, 0.52, 1, 0.5, 0.5, 0.48, 1, 0, 1, 0, 0.6, -1, 0.5};
  return pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 9, outline, nullptr, 0);
}
// Adds strips with two layers of nodes each, which are too close to each other and to those of the
// next strip.
pnpbs_status strips(pnpbs_domain domain, const char*) {
  pnpbs_status status = PNPBS_OK;
  for (int k = 0; k < 8 && status >= 0; ++k) {
    const double low = 0.1 * k, high = low + 0.06, strip[] = {0, low, 2, low, 2, high, 0, high};
    status = pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, strip, nullptr, 0);
  }
  return status;
}
pnpbs_status islands(pnpbs_domain domain, const char* data) {
  return pnpbs_domain_read_poly(domain, (std::string(data) + "/great_lakes_islands.poly").c_str());
}
// Adds a plate in which two layers of nodes are too close to each other.
pnpbs_status thin_plate(pnpbs_domain domain, const char*) {
  const double low[] = {0, 0, 0}, high[] = {1, 1, 0.084};
  return pnpbs_domain_add_box(domain, low, high, 1);
}

struct Case {
  const char* name;
  std::int32_t dim;
  volume_body body;
  double d, growth;  // coefficient of x
  bool is_box;       // the unit square or cube
  bool is_crowded;   // in some regions
};
const Case kCases[] = {{"square", 2, unit_square, 0.05, 0, true, false},
                       {"graded square", 2, unit_square, 0.02, 0.08, true, false},
                       {"slit and bay", 2, slotted_plane, 0.04, 0, false, false},
                       {"strips", 2, strips, 0.05, 0.01, false, true},
                       {"islands", 2, islands, 12, 0, false, true},
                       {"cube", 3, volume_unit_box, 0.1, 0, true, false},
                       {"graded cube", 3, volume_unit_box, 0.07, 0.1, true, false},
                       {"thin plate", 3, thin_plate, 0.06, 0, false, true},
                       {"eros", 3, volume_eros, 0.06, 0.05, false, true}};

const Case* spaced_as = nullptr;
int32_t spacing(int64_t n, int32_t dim, const double* x, double* d, void*) {
  for (int64_t i = 0; i < n; ++i) d[i] = spaced_as->d + spaced_as->growth * std::abs(x[dim * i]);
  return 0;
}

struct Placed {
  pnpbs_domain body = nullptr;
  pnpbs_placement placement = nullptr;
};

Placed placed(const Case& it, pnpbs_context in, const char* data) {
  Placed made;
  pnpbs_domain inset = nullptr;
  spaced_as = &it;
  expect(pnpbs_domain_create(in, it.dim, &made.body) == PNPBS_OK &&
             pnpbs_domain_create(in, it.dim, &inset) == PNPBS_OK && it.body(made.body, data) >= 0,
         "domains");
  expect(pnpbs_domain_add_offset(inset, made.body, -INFINITY, -kDepth, spacing, nullptr, 0, 1) ==
             PNPBS_OK,
         "inset");
  expect(pnpbs_placement_create(in, inset, &made.placement) == PNPBS_OK, "placement");
  pnpbs_placement_set_int64(made.placement, "steps", 60);
  pnpbs_placement_set_int64(made.placement, "conforming_rounds", 0);
  pnpbs_placement_set_spacing_callback(made.placement, spacing, nullptr);
  expect(pnpbs_placement_run(made.placement) >= 0, "run");
  pnpbs_domain_destroy(&inset);
  return made;
}

void destroy(Placed& made) {
  pnpbs_placement_destroy(&made.placement);
  pnpbs_domain_destroy(&made.body);
}

// ------------------------------------------------------------------ results --------------------

struct Node {
  Point x{};
  double d = 0, volume = 0;
  std::int32_t tag = 0;
  bool operator==(const Node&) const = default;
};
using NodesById = std::map<std::int64_t, Node>;

struct Columns {
  std::vector<double> x, d, volumes;
  std::vector<std::int64_t> ids;
  std::vector<std::int32_t> tags;
  explicit Columns(std::int64_t n)
      : x(3 * std::size_t(n)), d(std::size_t(n)), volumes(d), ids(d.size()), tags(d.size()) {}
};

NodesById by_id(const Columns& columns, std::int32_t dim) {
  NodesById nodes;
  const auto width = static_cast<std::size_t>(dim);
  for (std::size_t i = 0; i < columns.ids.size(); ++i) {
    Node& node = nodes[columns.ids[i]];
    std::copy_n(columns.x.begin() + static_cast<std::ptrdiff_t>(width * i), width, node.x.begin());
    node.d = columns.d[i], node.volume = columns.volumes[i], node.tag = columns.tags[i];
  }
  return nodes;
}

NodesById nodes_of(pnpbs_placement placement, std::int32_t dim) {
  std::int64_t n = 0;
  expect(pnpbs_placement_count(placement, &n) == PNPBS_OK, "count");
  Columns columns(n);
  expect(pnpbs_placement_get_nodes(placement, n, columns.x.data(), columns.ids.data(),
                                   columns.tags.data(), columns.d.data()) == PNPBS_OK,
         "nodes");
  return by_id(columns, dim);
}

struct Told {
  NodesById particles;
  std::int64_t all = 0, left_out = 0, moved = 0;
  double closest = 0;
};

Told particles_of(const Placed& made, std::int32_t dim) {
  pnpbs_particles particles;
  Told told;
  std::int64_t n = 0;
  std::int32_t told_dim = 0;
  expect(pnpbs_particles_create(made.placement, made.body, &particles) == PNPBS_OK, "particles");
  expect(pnpbs_particles_sizes(particles, &told_dim, &n, &told.all) == PNPBS_OK && told_dim == dim,
         "sizes");
  expect(pnpbs_particles_figures(particles, &told.left_out, &told.moved, &told.closest) == PNPBS_OK,
         "figures");
  Columns columns(n);
  expect(pnpbs_particles_get(particles, n, columns.x.data(), columns.volumes.data(),
                             columns.d.data(), columns.ids.data(), columns.tags.data()) == PNPBS_OK,
         "arrays");
  if (n > 0)
    expect(pnpbs_particles_get(particles, n - 1, columns.x.data(), nullptr, nullptr, nullptr,
                               nullptr) == PNPBS_ERROR_CAPACITY,
           "too small");
  expect(pnpbs_particles_destroy(&particles) == PNPBS_OK && !particles, "destroy");
  told.particles = by_id(columns, dim);
  return told;
}

// ------------------------------------------------------------------ invariants -----------------

double apart(const Node& a, const Node& b) { return length(a.x - b.x) / ((a.d + b.d) / 2); }

void check_pairs(const Told& told, std::int32_t dim) {
  double closest = INFINITY;
  for (auto a = told.particles.begin(); a != told.particles.end(); ++a)
    for (auto b = std::next(a); b != told.particles.end(); ++b)
      closest = std::min(closest, apart(a->second, b->second));
  if (closest >= 1) closest = INFINITY;
  expect(std::isinf(closest) ? std::isinf(told.closest)
                             : std::abs(told.closest - closest) <= 1e-14 * closest,
         "closest pair");
  expect(told.closest >= closest_pair(dim), "no two are too close");
}

// Checks which nodes became particles, and why the others did not.
void check_nodes(const Told& told, const NodesById& nodes, const Case& it) {
  std::int64_t moved = 0;
  for (const auto& [id, particle] : told.particles) {
    const Node& node = nodes.at(id);
    moved += particle.x != node.x;
    expect(particle.d == node.d && particle.tag == node.tag, "d and tag of the node");
    expect(length(particle.x - node.x) <= kMostMoved * node.d * (1 + 1e-12), "not too far");
  }
  expect(moved == told.moved, "those that have moved");
  expect(std::size_t(told.all) == told.particles.size(), "particles of all ranks");
  expect(std::size_t(told.left_out) == nodes.size() - told.particles.size(), "those left out");
  expect((told.left_out > 0) == it.is_crowded, "some left out where there are too many");
}

// Returns the nodes that are closer to another one than the distance to which pairs are pushed
// apart, and, repeatedly, the moved nodes near one of these.
std::set<std::int64_t> crowd_of(const Told& told, const NodesById& nodes, double pushed) {
  std::set<std::int64_t> crowd, moved;
  for (const auto& [id, node] : nodes) {
    for (const auto& [other, there] : nodes)
      if (other != id && apart(node, there) < pushed) crowd.insert(id);
    const auto particle = told.particles.find(id);
    if (particle != told.particles.end() && particle->second.x != node.x) moved.insert(id);
  }
  std::vector<std::int64_t> next(crowd.begin(), crowd.end());
  while (!next.empty()) {
    const Node& node = nodes.at(next.back());
    next.pop_back();
    for (const std::int64_t id : moved)
      if (apart(node, nodes.at(id)) < pushed + 2 * kMostMoved && crowd.insert(id).second)
        next.push_back(id);
  }
  return crowd;
}

void check_crowds(const Told& told, const NodesById& nodes, std::int32_t dim) {
  const std::set<std::int64_t> crowd = crowd_of(told, nodes, pushed_apart(dim));
  for (const auto& [id, node] : nodes) {
    const auto particle = told.particles.find(id);
    const bool as_it_was = particle != told.particles.end() && particle->second.x == node.x;
    expect(as_it_was || crowd.contains(id), "only crowded ones move or are left out");
  }
}

double depth_in_box(const Point& x, std::int32_t dim) {
  double depth = 1;
  for (std::size_t k = 0; k < std::size_t(dim); ++k) depth = std::min({depth, x[k], 1 - x[k]});
  return depth;
}

void check_depths(const Told& told, const NodesById& nodes, std::int32_t dim) {
  double least = INFINITY, before = INFINITY;  // over d
  for (const auto& [id, node] : nodes)
    before = std::min(before, depth_in_box(node.x, dim) / node.d);
  for (const auto& [id, node] : told.particles)
    least = std::min(least, depth_in_box(node.x, dim) / node.d);
  expect(least >= before * (1 - 2e-3), "as far from the wall as the nodes");
}

void check_volumes(const Told& told, const Placed& made, const Case& it) {
  double sum = 0, measure = 0, worst = 0;
  for (const auto& [id, particle] : told.particles) sum += particle.volume;
  expect(pnpbs_domain_measure(made.body, &measure) == PNPBS_OK, "measure");
  expect(std::abs(sum / measure - 1) < 1e-13, "volumes add up to that of the body");
  if (it.is_box)
    for (const auto& [id, particle] : told.particles) {
      std::vector<Point> others;
      for (const auto& [other, there] : told.particles)
        if (other != id && apart(particle, there) < 3) others.push_back(there.x);
      std::vector<double> areas;
      const double volume = brute_cell(particle.x, others, areas);
      worst = std::max(worst, std::abs(particle.volume - volume) / volume);
    }
  if (rank == 0)
    std::printf(
        "%s: %zu particles, closest %.3f d, %lld left out, %lld moved, volumes off by %.2g"
        ", of all %.2g\n",
        it.name, told.particles.size(), told.closest, (long long)told.left_out,
        (long long)told.moved, worst, sum / measure - 1);
  expect(worst < (it.dim == 2 ? 1e-3 : 1e-2), "volumes by brute force");
}

void check_bits(const Told& own, const Told& all) {
  expect(own.all == all.all && own.left_out == all.left_out && own.moved == all.moved &&
             own.closest == all.closest,
         "the figures of one rank");
  for (const auto& [id, particle] : own.particles)
    expect(all.particles.contains(id) && particle == all.particles.at(id), "the bits of one rank");
}

// Returns the particles of one rank, after all checks.
Told made_alone(const Case& it, const char* data) {
  pnpbs_context serial;
  expect(pnpbs_context_create_serial(&serial) == PNPBS_OK, "context of one rank");
  Placed alone = placed(it, serial, data);
  const Told all = particles_of(alone, it.dim);
  const NodesById nodes = nodes_of(alone.placement, it.dim);
  check_pairs(all, it.dim);
  check_nodes(all, nodes, it);
  check_crowds(all, nodes, it.dim);
  if (it.is_box) check_depths(all, nodes, it.dim);
  check_volumes(all, alone, it);
  destroy(alone);
  pnpbs_context_destroy(&serial);
  return all;
}

// Returns the result of rank 0 on all ranks.
Told of_rank_0(Told told) {
  std::vector<std::pair<std::int64_t, Node>> list(told.particles.begin(), told.particles.end());
  std::int64_t counts[] = {std::int64_t(list.size()), told.all, told.left_out, told.moved};
  MPI_Bcast(counts, 4, MPI_INT64_T, 0, group);
  MPI_Bcast(&told.closest, 1, MPI_DOUBLE, 0, group);
  list.resize(std::size_t(counts[0]));
  MPI_Bcast(list.data(), int(list.size() * sizeof list[0]), MPI_BYTE, 0, group);
  told.particles = NodesById(list.begin(), list.end());
  told.all = counts[1], told.left_out = counts[2], told.moved = counts[3];
  return told;
}

void check_case(const Case& it, const char* data) {
  const int before = failures;
  const Told all = of_rank_0(rank == 0 ? made_alone(it, data) : Told());
  Placed made = placed(it, context, data);
  check_bits(particles_of(made, it.dim), all);
  // It is an error if one rank does not pass the body.
  pnpbs_particles particles;
  if (size > 1)
    expect(pnpbs_particles_create(made.placement, rank == 1 ? nullptr : made.body, &particles) ==
                   PNPBS_ERROR_ARGUMENT &&
               !particles,
           "no body on a rank");
  destroy(made);
  if (failures > before) std::printf("rank %d, %s: WRONG\n", rank, it.name);
}

void check_all() {
  for (const Case& it : kCases) check_case(it, arguments[0]);
}

}  // namespace

int main(int argc, char** argv) { return run_in_groups(argc, argv, check_all); }
