// SPDX-License-Identifier: BSD-3-Clause
#include "particles/thinning.hpp"

#include <algorithm>
#include <tuple>
#include <vector>

#include "base/error.hpp"
#include "base/index.hpp"
#include "particles/near_nodes.hpp"

namespace pnpbs {

namespace {

enum class Fate : char { open, kept, left_out };

// A contest in rounds. In each round, the particles decide whose fate follows from earlier
// decisions.
template <int Dim>
class Contest {
 public:
  Contest(const Communicator& comm, double least, const KnownParticles<Dim>& particles)
      : comm_(comm), particles_(particles) {
    collective_try(comm, [&] {
      const NearNodes<Dim> near(particles.x, particles.d, particles.kept, least);
      close_ = near_rows(near, particles.owned, particles.ids);
      fates_.assign(particles.x.size(), Fate::open);
      before_ = fates_;
      rivals_.assign(particles.x.size(), 0);
      for (std::size_t i = 0; i < fates_.size(); ++i)
        if (particles.kept[i] == 0) fates_[i] = Fate::left_out;
      for (std::int64_t i = 0; i < particles.owned; ++i)
        rivals_[index(i)] = static_cast<std::int32_t>(close_.row(i).size());
    });
    fill_ghosts(comm, *particles.pattern, rivals_);
  }

  std::vector<Fate> run() {
    for (std::uint64_t open = 1; open > 0;) {
      std::ranges::copy(fates_, before_.begin());
      open = 0;
      for (std::int64_t i = 0; i < particles_.owned; ++i) {
        if (before_[index(i)] != Fate::open) continue;
        fates_[index(i)] = fate_of(i);
        open += fates_[index(i)] == Fate::open;
      }
      open = comm_.allreduce_sum(open);
      fill_ghosts(comm_, *particles_.pattern, fates_);
    }
    return std::move(fates_);
  }

 private:
  Fate fate_of(std::int64_t i) const {
    bool first = true;
    for (const std::int32_t j : close_.row(i)) {
      const Fate other = before_[index(j)];
      if (other == Fate::kept) return Fate::left_out;
      if (other == Fate::open && precedence(j) < precedence(i)) first = false;
    }
    return first ? Fate::kept : Fate::open;
  }
  std::tuple<std::int32_t, std::int64_t> precedence(std::int64_t i) const {
    return {rivals_[index(i)], particles_.ids[index(i)]};
  }

  const Communicator& comm_;
  const KnownParticles<Dim>& particles_;
  ChunkedRows<std::int32_t> close_;
  std::vector<Fate> fates_, before_;
  std::vector<std::int32_t> rivals_;
};

}  // namespace

template <int Dim>
void remove_close_particles(const Communicator& comm, double least,
                            KnownParticles<Dim>& particles) {
  const std::vector<Fate> fates = Contest<Dim>(comm, least, particles).run();
  for (std::size_t i = 0; i < fates.size(); ++i) particles.kept[i] = fates[i] == Fate::kept;
}

template void remove_close_particles(const Communicator&, double, KnownParticles<2>&);
template void remove_close_particles(const Communicator&, double, KnownParticles<3>&);

}  // namespace pnpbs
