// SPDX-License-Identifier: BSD-3-Clause
#include "implicit/level_set_lattice.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_set>

#include "base/error.hpp"
#include "base/point_text.hpp"

namespace pnpbs {

namespace {

constexpr int kFirstCells = 32;  // cells of the coarsest lattice along the longest direction
constexpr std::size_t kMaxCells = std::size_t{1} << 27;
// A cell may contain f = 0 if |f| at its centre is at most this times the largest difference to a
// corner. 1 is enough for linear functions and for distances.
constexpr double kMargin = 1.5;

// Shift of the lattice in each direction [cell], so that its planes do not coincide with surfaces
// at round coordinates. Cells at the ends of the box are shorter.
constexpr Point<3> kShift{0.38196601125, 0.27639320225, 0.44721359550};

bool negative(double f) { return f < 0; }

}  // namespace

LevelSetLattice::LevelSetLattice(const LevelSet& set) : set_(set) {
  for (std::size_t k = 0; k < 3; ++k)
    cells_[k] = 1 + static_cast<std::int32_t>(
                        std::ceil((set.box().high[k] - set.box().low[k]) / set.resolution()));
  for (Depth at = coarsest();; at = next(at)) {
    judge(at);
    flood(at);
    if (at.depth > 0) continue;
    for (std::size_t c = 0; c < at.cells.size(); ++c)
      if (at.crossed[c] != 0) crossed_.push_back(place(at.cells[c]));
    break;
  }
  if (crossed_.empty())
    throw Error(ErrorKind::domain,
                set_.name() + ": f is negative at none of the " + std::to_string(asked_) +
                    " points at which it was evaluated: the body must lie in the "
                    "box, and be thicker than the resolution");
}

LatticeIndex LevelSetLattice::place(std::uint64_t key) {
  constexpr std::uint64_t kMask = (std::uint64_t{1} << 21) - 1;
  return {static_cast<std::int32_t>(key & kMask), static_cast<std::int32_t>(key >> 21 & kMask),
          static_cast<std::int32_t>(key >> 42)};
}

Point<3> LevelSetLattice::position(const LatticeIndex& place) const {
  Point<3> x;
  for (std::size_t k = 0; k < 3; ++k) {
    const double steps = std::max(1, cells_[k] - 1);
    const double part = std::clamp((place[k] - kShift[k]) / steps, 0.0, 1.0);
    x[k] = (1 - part) * set_.box().low[k] + part * set_.box().high[k];
  }
  return x;
}

bool LevelSetLattice::is_flat(std::size_t axis) const {
  return set_.box().low[axis] == set_.box().high[axis];
}

LatticeIndex LevelSetLattice::corner(const LatticeIndex& cell, int depth, int which) const {
  LatticeIndex at;
  for (std::size_t k = 0; k < 3; ++k)
    at[k] = std::min(cells_[k], (cell[k] + (which >> k & 1)) << depth);
  return at;
}

LatticeIndex LevelSetLattice::centre(const LatticeIndex& cell, int depth) const {
  const LatticeIndex low = corner(cell, depth, 0), high = corner(cell, depth, 7);
  LatticeIndex at;
  for (std::size_t k = 0; k < 3; ++k) at[k] = (low[k] + high[k]) / 2;
  return at;
}

// ------------------------------------------------------------------ refinement -----------------

LevelSetLattice::Depth LevelSetLattice::coarsest() const {
  Depth first{0, {}, {}, {}};
  const std::int32_t longest = *std::max_element(cells_.begin(), cells_.end());
  while ((longest - 1) >> first.depth >= kFirstCells) ++first.depth;
  LatticeIndex cell;
  for (cell[2] = 0; cell[2] << first.depth < cells_[2]; ++cell[2])
    for (cell[1] = 0; cell[1] << first.depth < cells_[1]; ++cell[1])
      for (cell[0] = 0; cell[0] << first.depth < cells_[0]; ++cell[0])
        first.cells.push_back(key(cell));
  return first;
}

LevelSetLattice::Depth LevelSetLattice::next(const Depth& coarser) const {
  Depth finer{coarser.depth - 1, {}, {}, {}};
  for (std::size_t c = 0; c < coarser.cells.size(); ++c) {
    if (coarser.crossed[c] == 0 && coarser.near[c] == 0) continue;
    const LatticeIndex parent = place(coarser.cells[c]);
    for (int child = 0; child < 8; ++child) {
      LatticeIndex cell;
      bool in_box = true;
      for (std::size_t k = 0; k < 3; ++k) {
        cell[k] = 2 * parent[k] + (child >> k & 1);
        in_box = in_box && cell[k] << finer.depth < cells_[k];
      }
      if (in_box) finer.cells.push_back(key(cell));
    }
  }
  return finer;
}

// Evaluates the new cells.
void LevelSetLattice::judge(Depth& at) {
  const std::size_t begin = at.crossed.size();
  if (begin == 0) samples_.clear();
  sample(at.depth, std::span(at.cells).subspan(begin));
  for (std::size_t c = begin; c < at.cells.size(); ++c) {
    const LatticeIndex cell = place(at.cells[c]);
    const double middle =
        at.depth > 0 ? value(centre(cell, at.depth)) : value(corner(cell, at.depth, 0));
    bool crossed = false;
    double difference = 0;
    for (int which = 0; which < 8; ++which) {
      const double f = value(corner(cell, at.depth, which));
      crossed = crossed || negative(f) != negative(middle);
      difference = std::max(difference, std::fabs(f - middle));
    }
    at.crossed.push_back(crossed);
    at.near.push_back(std::fabs(middle) <= kMargin * difference);
  }
}

// Follows the surface: adds the neighbour across every face with different signs.
void LevelSetLattice::flood(Depth& at) {
  std::unordered_set<std::uint64_t> there(at.cells.begin(), at.cells.end());
  for (std::size_t begin = 0; begin < at.cells.size();) {
    const std::size_t end = at.cells.size();
    for (std::size_t c = begin; c < end; ++c) {
      if (at.crossed[c] == 0) continue;
      const LatticeIndex cell = place(at.cells[c]);
      for (std::size_t face = 0; face < 6; ++face) {
        const std::size_t axis = face / 2;
        const bool high = face % 2 == 1;
        if (is_flat(axis) || !face_crossed(cell, at.depth, axis, high)) continue;
        LatticeIndex beyond = cell;
        beyond[axis] += high ? 1 : -1;
        if (there.insert(key(beyond)).second) at.cells.push_back(key(beyond));
      }
    }
    if (at.cells.size() > kMaxCells)
      throw Error(ErrorKind::domain, set_.name() + ": the surface crosses more than 2^27 cells: " +
                                         "the resolution must be more than " +
                                         number_text(set_.resolution()));
    judge(at);
    begin = end;
  }
}

// A face on the border is never crossed, since f is nowhere negative there.
bool LevelSetLattice::face_crossed(const LatticeIndex& cell, int depth, std::size_t axis,
                                   bool high) const {
  int below = 0;
  for (int which = 0; which < 8; ++which)
    if ((which >> axis & 1) == (high ? 1 : 0))
      below += negative(value(corner(cell, depth, which))) ? 1 : 0;
  return below > 0 && below < 4;
}

// ------------------------------------------------------------------ evaluation of f -----------

void LevelSetLattice::sample(int depth, std::span<const std::uint64_t> cells) {
  std::vector<std::uint64_t> wanted;
  const auto want = [&](const LatticeIndex& at) {
    if (samples_.try_emplace(key(at), 0.0).second) wanted.push_back(key(at));
  };
  for (const std::uint64_t cell : cells) {
    for (int which = 0; which < 8; ++which) want(corner(place(cell), depth, which));
    if (depth > 0) want(centre(place(cell), depth));
  }
  std::vector<Point<3>> x;
  for (const std::uint64_t each : wanted) x.push_back(position(place(each)));
  const std::vector<double> f = set_.values(x);
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    samples_[wanted[i]] = f[i];
    if (negative(f[i])) reject_border(place(wanted[i]));
  }
  asked_ += wanted.size();
}

void LevelSetLattice::reject_border(const LatticeIndex& at) const {
  for (std::size_t k = 0; k < 3; ++k)
    if (!is_flat(k) && (at[k] == 0 || at[k] == cells_[k]))
      throw Error(ErrorKind::domain,
                  set_.name() + ": f is negative at " + point_text(position(at)) +
                      ", on the border of the box: the body must lie in the box, so give a larger "
                      "one, or cut the body off by max(f, g) with g < 0 where it is to end");
}

}  // namespace pnpbs
