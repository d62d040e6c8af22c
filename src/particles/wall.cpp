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

// Of the outermost ones that tell how deep others must be.
constexpr double kRadius = 1.6;
constexpr double kRounding = 1e-9, kTolerance = 1e-3;  // of the depth

template <int Dim>
double depth_of(const SignedDistance<Dim>& body, const KnownParticles<Dim>& particles,
                std::int64_t i) {
  const Point<Dim>& x = particles.x[index(i)];
  const double depth = -body(x);
  if (depth > 0) return depth;
  throw Error(ErrorKind::domain, "argument body: the node " +
                                     std::to_string(particles.ids[index(i)]) + " at " +
                                     point_text(x) +
                                     " lies on its wall or outside: place nodes in what "
                                     "pnpbs_domain_add_offset makes of it");
}

}  // namespace

template <int Dim>
Wall<Dim>::Wall(const Communicator& comm, const SignedDistance<Dim>& body,
                const KnownParticles<Dim>& particles, std::span<const char> outermost)
    : body_(body) {
  std::vector<double> depths(particles.x.size());
  std::vector<char> is_outermost(particles.x.size());
  agreed(comm, [&] {
    for_each("pnpbs::particles::depths", particles.owned,
             [&](std::int64_t i) { depths[index(i)] = depth_of(body, particles, i); });
    std::ranges::copy(outermost, is_outermost.begin());
  });
  fill_ghosts(comm, *particles.pattern, depths);
  fill_ghosts(comm, *particles.pattern, is_outermost);
  agreed(comm, [&] {
    const NearNodes<Dim> near(particles.x, particles.d, is_outermost, kRadius);
    depths_.assign(depths.begin(), depths.begin() + particles.owned);
    for_each("pnpbs::particles::least_depths", particles.owned, [&](std::int64_t i) {
      if (is_outermost[index(i)] != 0) return;
      double least = std::numeric_limits<double>::infinity();  // over d
      near.for_near(i, [&](std::int32_t j) {
        least = std::min(least, depths[index(j)] / particles.d[index(j)]);
      });
      if (std::isinf(least)) least = 0;  // far from the wall
      depths_[index(i)] = std::min(depths[index(i)], least * particles.d[index(i)]);
    });
  });
}

template <int Dim>
Point<Dim> Wall<Dim>::held_off(std::int64_t i, const Point<Dim>& from, Point<Dim> to) const {
  const double least = depths_[index(i)];
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
