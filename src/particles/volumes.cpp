// SPDX-License-Identifier: BSD-3-Clause
#include "particles/volumes.hpp"

#include <algorithm>
#include <cmath>

#include "base/exact_sum.hpp"
#include "base/execution.hpp"
#include "base/index.hpp"
#include "base/point_text.hpp"
#include "particles/cell_in_body.hpp"
#include "particles/near_nodes.hpp"

namespace pnpbs {

namespace {

// Largest factor. Beyond it, too much of the body is visible from no particle for meaningful
// volumes.
constexpr double kFarthestFactor = 1.25;
// Distance up to which a cell extends. [d] It covers a corner of 30 degrees half a spacing away
// from its sides.
constexpr double kReach = 2;
// Distance beyond which two particles share no face, unless particles are missing. [mean d]
constexpr double kNeighbours = 2.5;

// Returns the sum over all ranks of the volumes whose flag in `found_again` equals `again`. It is
// exact, so that it does not depend on the partition. Collective.
double sum_of(const Communicator& comm, std::span<const double> volumes,
              std::span<const char> found_again, bool again) {
  ExactSum sum;
  for (std::size_t n = 0; n < volumes.size(); ++n)
    if ((found_again[n] != 0) == again) sum.add(volumes[n]);
  sum.carry();
  std::vector<std::int64_t> entries;
  collective_try(comm, [&] { entries.assign(sum.entries().begin(), sum.entries().end()); });
  comm.allreduce_sum(entries);
  std::ranges::copy(entries, sum.entries().begin());
  return sum.value();
}

void require_near_one(double factor) {
  if (factor <= kFarthestFactor && factor >= 1 / kFarthestFactor) return;
  throw Error(ErrorKind::domain,
              "argument body: the cells of the particles at its wall have " +
                  rounded_text(1 / factor) +
                  " of the volume that remains for them there: the nodes do not fill this body, or "
                  "d is too large for its thin parts");
}

template <int Dim>
class ParticleVolumes {
 public:
  ParticleVolumes(const SignedDistance<Dim>& body, const VoronoiCells& cells,
                  std::span<const Point<Dim>> first, const KnownParticles<Dim>& particles)
      : cells_(cells), first_(first), particles_(particles), cell_(body) {}

  // Returns flags of the particles whose cell differs from that of the node in the elements.
  std::vector<char> find_changed() const {
    const KnownParticles<Dim>& p = particles_;
    std::vector<char> moved(p.x.size()), changed(index(p.owned));
    for (std::size_t i = 0; i < moved.size(); ++i) moved[i] = p.kept[i] == 0 || p.x[i] != first_[i];
    const NearNodes<Dim> near(first_, p.d, moved, kNeighbours);
    for_each("pnpbs::particles::changed", p.owned, [&](std::int64_t i) {
      changed[index(i)] = cells_.at_boundary[index(i)] != 0 || moved[index(i)] != 0;
      near.for_near(i, [&](std::int32_t) { changed[index(i)] = 1; });
    });
    return changed;
  }

  std::vector<double> find(std::span<const char> changed) const {
    const KnownParticles<Dim>& p = particles_;
    std::vector<double> volumes(index(p.owned));
    const NearNodes<Dim> near(p.x, p.d, p.kept, kNeighbours);
    for_each("pnpbs::particles::volumes", p.owned, [&](std::int64_t i) {
      if (p.kept[index(i)] == 0) return;
      volumes[index(i)] = changed[index(i)] != 0 ? volume_of(i, near) : cells_.volumes[index(i)];
    });
    return volumes;
  }

 private:
  double volume_of(std::int64_t i, const NearNodes<Dim>& near) const {
    std::vector<Point<Dim>> neighbours;
    const Point<Dim>& x = particles_.x[index(i)];
    near.for_near(i, [&](std::int32_t j) { neighbours.push_back(particles_.x[index(j)]); });
    std::ranges::sort(neighbours, {}, [&](const Point<Dim>& y) {
      return squared_distance<Dim>(x, y);  // Faster: near ones exclude the others.
    });
    return cell_.volume(x, kReach * particles_.d[index(i)], neighbours);
  }

  const VoronoiCells& cells_;
  std::span<const Point<Dim>> first_;
  const KnownParticles<Dim>& particles_;
  CellInBody<Dim> cell_;
};

}  // namespace

template <int Dim>
std::vector<double> volumes_within(const Communicator& comm, const SignedDistance<Dim>& body,
                                   double measure, const VoronoiCells& cells,
                                   std::span<const Point<Dim>> first,
                                   const KnownParticles<Dim>& particles) {
  std::vector<char> changed;
  std::vector<double> volumes;
  collective_try(comm, [&] {
    const ParticleVolumes<Dim> found(body, cells, first, particles);
    changed = found.find_changed();
    volumes = found.find(changed);
  });
  const double kept = sum_of(comm, volumes, changed, false),
               again = sum_of(comm, volumes, changed, true);
  const double factor = (measure - kept) / again;
  require_near_one(factor);
  for (std::size_t n = 0; n < volumes.size(); ++n)
    if (changed[n] != 0) volumes[n] *= factor;
  return volumes;
}

template std::vector<double> volumes_within<2>(const Communicator&, const SignedDistance<2>&,
                                               double, const VoronoiCells&,
                                               std::span<const Point<2>>, const KnownParticles<2>&);
template std::vector<double> volumes_within<3>(const Communicator&, const SignedDistance<3>&,
                                               double, const VoronoiCells&,
                                               std::span<const Point<3>>, const KnownParticles<3>&);

}  // namespace pnpbs
