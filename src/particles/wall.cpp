// SPDX-License-Identifier: BSD-3-Clause
#include "particles/wall.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "base/execution.hpp"
#include "base/index.hpp"
#include "base/point_text.hpp"

namespace pnpbs {

namespace {

constexpr double kRounding = 1e-9, kTolerance = 1e-3;  // [depth]

// Throws for the particle with the smallest id that is not inside. Collective.
template <int Dim>
void require_inside(const Communicator& comm, const KnownParticles<Dim>& particles,
                    std::span<const double> depths) {
  const auto outside = std::ranges::find_if(depths, [](double depth) { return !(depth > 0); });
  const bool any = outside != depths.end();
  const std::size_t i = static_cast<std::size_t>(outside - depths.begin());
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const double id = any ? static_cast<double>(particles.ids[i]) : kNone;
  const double first = -comm.allreduce_max(-id);
  collective_try(comm, [&] {
    if (!any || id > first) return;
    throw Error(ErrorKind::domain, "argument body: the node " + std::to_string(particles.ids[i]) +
                                       " at " + point_text(particles.x[i]) +
                                       " lies on its wall or outside: place nodes in the "
                                       "body that pnpbs_domain_add_offset adds for it");
  });
}

}  // namespace

template <int Dim>
Wall<Dim>::Wall(const Communicator& comm, const SignedDistance<Dim>& body,
                const KnownParticles<Dim>& particles, std::span<const char> outermost)
    : body_(body) {
  collective_try(comm, [&] {
    least_depths_.resize(index(particles.owned));
    for_each("pnpbs::particles::depths", particles.owned,
             [&](std::int64_t i) { least_depths_[index(i)] = -body(particles.x[index(i)]); });
  });
  require_inside(comm, particles, least_depths_);
  // Smallest depth of the outermost particles. [d]
  double shallowest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outermost.size(); ++i)
    if (outermost[i] != 0) shallowest = std::min(shallowest, least_depths_[i] / particles.d[i]);
  shallowest = -comm.allreduce_max(-shallowest);
  for (std::size_t i = 0; i < outermost.size(); ++i)
    if (outermost[i] == 0)
      least_depths_[i] = std::min(least_depths_[i], shallowest * particles.d[i]);
}

template <int Dim>
Point<Dim> Wall<Dim>::kept_off_wall(std::int64_t i, const Point<Dim>& from, Point<Dim> to) const {
  const double least = least_depths_[index(i)];
  const double depth = -body_(to);
  if (depth >= least * (1 - kRounding)) return to;
  if (depth <= 0) return from;
  const Point<Dim> foot = body_.foot(to);
  for (std::size_t k = 0; k < Dim; ++k) to[k] += (least / depth - 1) * (to[k] - foot[k]);
  return -body_(to) >= least * (1 - kTolerance) ? to : from;
}

template class Wall<2>;
template class Wall<3>;

}  // namespace pnpbs
