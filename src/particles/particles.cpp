// SPDX-License-Identifier: BSD-3-Clause
#include "particles/particles.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "base/index.hpp"
#include "level/lists_and_stars.hpp"
#include "particles/near_nodes.hpp"
#include "particles/separation.hpp"
#include "particles/thinning.hpp"
#include "particles/volumes.hpp"
#include "particles/wall.hpp"
#include "voronoi/voronoi_cells.hpp"

namespace pnpbs {

namespace {

// Distance below which one of a pair is left out at once, as pushing cannot separate it enough.
// [mean d]
constexpr double kTooClose = 0.5;
// Distance that pushing aims at. [mean d]
template <int Dim>
constexpr double kPushed = Dim == 2 ? 0.9 : 0.85;

// Distance up to which particles must be known. [d] Particles are examined within 2.5 of the mean
// of their d and may approach by two pushes. The mean d of a pair can be half as large again as d.
constexpr double kKnown = 1.5 * (2.5 + 2 * kFarthestPush);

template <int Dim>
KnownParticles<Dim> known_particles(Results<Dim>& results) {
  KnownParticles<Dim> known;
  results.prepare_lists();
  make_known_around(*results.shown(), kKnown);
  known.pattern = results.exchange_pattern();
  collective_try(results.communicator(), [&] {
    const NodeColumns nodes = results.nodes();
    known.owned = results.count();
    for (std::int64_t place = 0; place < nodes.count; ++place) {
      const std::int64_t i = results.node_at(place);
      Point<Dim>& x = known.x.emplace_back();
      for (std::size_t k = 0; k < Dim; ++k) x[k] = nodes.x[k](i);
      known.d.push_back(nodes.d(i));
      known.ids.push_back(nodes.id(i));
    }
    known.kept.assign(known.x.size(), 1);
  });
  return known;
}

// Returns the smallest distance of a pair over the mean of their d. Collective.
template <int Dim>
double closest_pair(const Communicator& comm, const KnownParticles<Dim>& particles) {
  double closest = std::numeric_limits<double>::infinity();
  collective_try(comm, [&] {
    const NearNodes<Dim> near(particles.x, particles.d, particles.kept, 1);
    for (std::int64_t i = 0; i < particles.owned; ++i) {
      const std::size_t n = index(i);
      if (particles.kept[n] == 0) continue;
      near.for_near(i, [&](std::int32_t other) {
        const std::size_t j = index(other);
        closest = std::min(closest, distance<Dim>(particles.x[n], particles.x[j]) /
                                        (0.5 * (particles.d[n] + particles.d[j])));
      });
    }
  });
  return -comm.allreduce_max(-closest);
}

template <int Dim>
std::unique_ptr<Particles> collected(NodalResults& results, const KnownParticles<Dim>& known,
                                     std::span<const Point<Dim>> first,
                                     std::span<const double> volumes) {
  auto particles = std::make_unique<Particles>();
  particles->dimension = Dim;
  const NodeColumns nodes = results.nodes();
  for (std::int64_t place = 0; place < known.owned; ++place) {
    const std::size_t n = index(place);
    if (known.kept[n] == 0) continue;
    particles->x.insert(particles->x.end(), known.x[n].begin(), known.x[n].end());
    particles->ids.push_back(known.ids[n]);
    particles->tags.push_back(static_cast<std::int32_t>(nodes.tag(results.node_at(place))));
    particles->spacing.push_back(known.d[n]);
    particles->volumes.push_back(volumes[n]);
    particles->moved += known.x[n] != first[n];
  }
  return particles;
}

}  // namespace

template <int Dim>
std::unique_ptr<Particles> make_particles(Results<Dim>& results, const Domain<Dim>& body) {
  const Communicator& comm = results.communicator();
  const std::unique_ptr<VoronoiCells> cells = make_voronoi_cells(results);
  KnownParticles<Dim> known = known_particles<Dim>(results);
  std::vector<Point<Dim>> first;
  std::optional<SignedDistance<Dim>> within;
  collective_try(comm, [&] {
    first = known.x;
    within.emplace(body);
  });
  const Wall<Dim> wall(comm, *within, known, cells->at_boundary);

  remove_close_particles(comm, kTooClose, known);
  push_apart(comm, kPushed<Dim>, wall, known);
  remove_close_particles(comm, kClosestPair<Dim>, known);

  const std::vector<double> volumes =
      volumes_within<Dim>(comm, *within, measure_of(body), *cells, first, known);
  std::unique_ptr<Particles> particles;
  collective_try(comm, [&] { particles = collected<Dim>(results, known, first, volumes); });
  particles->all = static_cast<std::int64_t>(
      comm.allreduce_sum(static_cast<std::uint64_t>(particles->ids.size())));
  particles->left_out = results.global_count() - particles->all;
  particles->moved =
      static_cast<std::int64_t>(comm.allreduce_sum(static_cast<std::uint64_t>(particles->moved)));
  particles->closest = closest_pair(comm, known);
  return particles;
}

template std::unique_ptr<Particles> make_particles<2>(Results<2>&, const PlaneDomain&);
template std::unique_ptr<Particles> make_particles<3>(Results<3>&, const VolumeDomain&);

}  // namespace pnpbs
