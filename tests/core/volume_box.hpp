// SPDX-License-Identifier: BSD-3-Clause
// A box with a body-centred cubic lattice whose outer layers do not move: the relaxation of
// displaced nodes in space, without a domain.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/lattice.hpp"
#include "base/mixed_hash.hpp"
#include "bubbles.hpp"
#include "dynamics/pair_laws.hpp"
#include "dynamics/schemes.hpp"

namespace volume_box {

inline constexpr double kCell = pnpbs::Lattice<3>::kCell;

// A crystal with this number of cubic cells along each side, and d = 1. All nodes lie inside its
// box.
struct Crystal {
  int cells;

  Box<3> box() const {
    const double side = cells * kCell, room = 0.5;
    return {{-room, -room, -room}, {side + room, side + room, side + room}};
  }
  // The range of the force must not reach missing nodes beyond the outermost layer.
  bool moves(const Point<3>& x) const { return is_inner<3>(box(), x, 0.5 + 1.25); }
};

// Returns corners and centres of the cells. The node with id n is always at the same point.
inline std::vector<Bubble<3>> sites(const Crystal& crystal) {
  std::vector<Bubble<3>> all;
  for (int half : {0, 1})
    for (int i = 0; i <= crystal.cells - half; ++i)
      for (int j = 0; j <= crystal.cells - half; ++j)
        for (int k = 0; k <= crystal.cells - half; ++k) {
          const double shift = 0.5 * half;
          const Point<3> x{kCell * (i + shift), kCell * (j + shift), kCell * (k + shift)};
          all.push_back({x, 1, static_cast<std::int64_t>(all.size()), crystal.moves(x)});
        }
  return all;
}

// Returns a point of the unit ball that depends on the id alone.
inline Point<3> shift_of(std::int64_t id) {
  Point<3> shift;
  std::uint64_t bits = static_cast<std::uint64_t>(id);
  do {
    for (double& along : shift) {
      bits = pnpbs::mixed(bits);
      along = 2 * static_cast<double>(bits >> 11) * 0x1p-53 - 1;
    }
  } while (pnpbs::distance<3>(shift, {}) > 1);
  return shift;
}

// Displaces every bubble that moves by up to `max` d.
inline void shake(std::vector<Bubble<3>>& bubbles, double max) {
  for (Bubble<3>& b : bubbles) {
    if (!b.moves) continue;
    const Point<3> shift = shift_of(b.id);
    for (std::size_t k = 0; k < 3; ++k) b.x[k] += max * b.d * shift[k];
  }
}

// Buckets, lists and time steps with the default law and scheme for space.
class Relaxation {
 public:
  explicit Relaxation(const Crystal& crystal) {
    bubbles_.box = crystal.box();
    bubbles_.grow_tree([](const Point<3>&) { return 1.0; }, 3);
  }

  void set(const std::vector<Bubble<3>>& bubbles) {
    bubbles_.set(bubbles);
    valid_ = false;
  }
  Bubbles<3>& bubbles() { return bubbles_; }
  const Bubbles<3>& bubbles() const { return bubbles_; }
  int rebuilds() const { return rebuilds_; }

  void step() {
    if (needs_rebuild()) rebuild();
    pnpbs::damped_step<3>(bubbles_.nodes, bubbles_.lists, law_, motion_, next_);
    std::swap(bubbles_.nodes.x, next_);
  }
  void steps(int n) {
    for (int k = 0; k < n; ++k) step();
  }

  // Lists contain all pairs within the range of the force until two nodes have approached each
  // other by half the skin each.
  bool needs_rebuild() const {
    return !valid_ || max_displacement() > 0.5 * (kRadius - law_.range);
  }
  void rebuild() {
    bubbles_.list(kRadius);
    const pnpbs::Nodes<3>& nodes = bubbles_.nodes;
    pnpbs::reserve_field<3>(next_, "next", nodes.capacity());
    pnpbs::reserve_field<3>(listed_, "listed", nodes.capacity());
    bubbles_.pad(next_);
    pnpbs::for_each("listed", nodes.count, [&](std::int64_t i) {
      for (int k = 0; k < 3; ++k) listed_[k](i) = nodes.x[k](i);
    });
    valid_ = true;
    ++rebuilds_;
  }

 private:
  static constexpr double kRadius = 1.6;

  // Returns the largest displacement since the lists were built, in d of the node.
  double max_displacement() const {
    const pnpbs::Nodes<3>& nodes = bubbles_.nodes;
    return pnpbs::max_of("max_displacement", nodes.count, 0, [&](std::int64_t i) {
      return pnpbs::distance<3>(nodes.position(i), pnpbs::point_at<3>(listed_, i)) / nodes.d(i);
    });
  }

  Bubbles<3> bubbles_;
  pnpbs::Field<3> next_, listed_;
  pnpbs::DefaultLaw<3> law_;
  pnpbs::Motion motion_ = kMotionInSpace;
  bool valid_ = false;
  int rebuilds_ = 0;
};

// Distance of the moving bubbles from their sites, in d.
struct Deviation {
  double mean = 0, max = 0;
};

inline Deviation deviation_from_sites(const std::vector<Bubble<3>>& bubbles,
                                      const Crystal& crystal) {
  const std::vector<Bubble<3>> perfect = sites(crystal);
  Deviation deviation;
  double moving = 0;
  for (const Bubble<3>& b : bubbles) {
    if (!b.moves) continue;
    const double way = pnpbs::distance<3>(b.x, perfect[static_cast<std::size_t>(b.id)].x) / b.d;
    deviation.mean += way;
    deviation.max = std::max(deviation.max, way);
    ++moving;
  }
  deviation.mean /= moving;
  return deviation;
}

}  // namespace volume_box
