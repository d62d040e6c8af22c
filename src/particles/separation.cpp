// SPDX-License-Identifier: BSD-3-Clause
#include "particles/separation.hpp"

#include <cmath>
#include <span>
#include <vector>

#include "base/execution.hpp"
#include "base/index.hpp"
#include "comm/ghost_update.hpp"
#include "particles/near_nodes.hpp"

namespace pnpbs {

namespace {

// Number of rounds.
constexpr int kRounds = 40;
// Fraction of the missing distance that is corrected per round. It is less than 1 because a
// particle can be pushed from several sides.
constexpr double kPart = 0.6;
constexpr double kAboveRounding = 1 + 1e-12;

template <int Dim>
class Separation {
 public:
  Separation(const Communicator& comm, double least, const Wall<Dim>& wall,
             KnownParticles<Dim>& particles)
      : comm_(comm), least_(least), wall_(wall), particles_(particles) {
    collective_try(comm, [&] {
      const NearNodes<Dim> near(particles.x, particles.d, particles.kept,
                                least + 2 * kFarthestPush);
      near_ = near_rows(near, particles.owned, particles.ids);
      first_ = particles.x;
      next_ = particles.x;
    });
  }

  void run() {
    for (int round = 0; round < kRounds; ++round) {
      collective_try(comm_, [&] {
        for_each("pnpbs::particles::push", particles_.owned,
                 [&](std::int64_t i) { next_[index(i)] = pushed(i); });
        particles_.x.swap(next_);
        ghosts_.pack(comm_, particles_.pattern, Dim, coordinates());
      });
      ghosts_.start();
      ghosts_.wait();
      ghosts_.unpack(coordinates());
    }
  }

 private:
  Point<Dim> pushed(std::int64_t i) const {
    const Point<Dim>& x = particles_.x[index(i)];
    if (particles_.kept[index(i)] == 0) return x;
    Point<Dim> push{};
    bool any = false;
    for (const std::int32_t j : near_.row(i)) {
      const Point<Dim>& other = particles_.x[index(j)];
      const double apart = distance<Dim>(x, other);
      const double wanted = least_ * 0.5 * (particles_.d[index(i)] + particles_.d[index(j)]);
      if (apart >= wanted) continue;
      any = true;
      for (std::size_t k = 0; k < Dim; ++k)
        push[k] += kPart * 0.5 * (wanted - apart) / apart * (x[k] - other[k]);
    }
    if (!any) return x;
    for (std::size_t k = 0; k < Dim; ++k) push[k] += x[k];
    const Point<Dim> next = wall_.kept_off_wall(i, x, push);
    const bool too_far = distance<Dim>(first_[index(i)], next) >
                         kAboveRounding * kFarthestPush * particles_.d[index(i)];
    return too_far ? x : next;
  }

  double* coordinates() { return particles_.x.empty() ? nullptr : particles_.x[0].data(); }

  const Communicator& comm_;
  double least_;
  const Wall<Dim>& wall_;
  KnownParticles<Dim>& particles_;
  ChunkedRows<std::int32_t> near_;
  std::vector<Point<Dim>> first_, next_;
  GhostUpdate ghosts_;
};

}  // namespace

template <int Dim>
void push_apart(const Communicator& comm, double least, const Wall<Dim>& wall,
                KnownParticles<Dim>& particles) {
  Separation<Dim>(comm, least, wall, particles).run();
}

template void push_apart(const Communicator&, double, const Wall<2>&, KnownParticles<2>&);
template void push_apart(const Communicator&, double, const Wall<3>&, KnownParticles<3>&);

}  // namespace pnpbs
