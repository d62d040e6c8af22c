// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/plane/polygon_triangles.hpp"

#include <algorithm>
#include <utility>

#include "predicates/plane.hpp"

namespace pnpbs {

namespace {

// Limits of the work, which correspond to a few seconds. Ear clipping fails at its limit, which
// only polygons with very many reflex corners reach. Flipping stops at its limit.
constexpr std::int64_t kMaxEarTests = 2'000'000'000;  // [tests against the box of an ear]
constexpr std::int64_t kBoxTests = 20;  // Cost of a test against the ear itself. [box tests]
constexpr std::int64_t kMaxFlipTests = 50'000'000;

std::size_t at(std::int32_t index) { return static_cast<std::size_t>(index); }

// A triangle. Across edge k, from corner k to the next, lies the triangle across[k]; -1 if none.
struct Piece {
  std::array<std::int32_t, 3> corner;
  std::array<std::int32_t, 3> across;
};

class EarClipping {
 public:
  explicit EarClipping(const std::vector<Point<2>>& corners);

  // Returns the triangles, or nothing if no ear is found.
  std::vector<Piece> run();

 private:
  int turn_at(std::int32_t i) const;
  bool is_ear(std::int32_t i);
  void classify(std::int32_t i);
  void cut_off(std::int32_t i);
  void link(std::int32_t piece, std::size_t edge, std::int32_t neighbor);

  const std::vector<Point<2>>& x_;
  std::vector<std::int32_t> next_, previous_;  // Neighbours in the remaining polygon.
  std::vector<std::int32_t> behind_;           // Triangle behind the edge to the next corner.
  std::vector<std::int32_t> reflex_;           // Corners that were reflex at some time.
  std::vector<char> may_block_;                // Whether a corner still remains and is reflex.
  std::vector<char> is_no_ear_;                // Cached; can be outdated after other cuts.
  std::vector<Piece> pieces_;
  std::int64_t tests_ = 0;
};

EarClipping::EarClipping(const std::vector<Point<2>>& corners)
    : x_(corners),
      next_(corners.size()),
      previous_(corners.size()),
      behind_(corners.size(), -1),
      may_block_(corners.size(), 0),
      is_no_ear_(corners.size(), 0) {
  const auto count = static_cast<std::int32_t>(corners.size());
  for (std::int32_t i = 0; i < count; ++i) {
    next_[at(i)] = i + 1 < count ? i + 1 : 0;
    previous_[at(i)] = i > 0 ? i - 1 : count - 1;
  }
  for (std::int32_t i = 0; i < count; ++i) classify(i);
}

int EarClipping::turn_at(std::int32_t i) const {
  return orientation(x_[at(previous_[at(i)])], x_[at(i)], x_[at(next_[at(i)])]);
}

void EarClipping::classify(std::int32_t i) {
  const bool blocks = turn_at(i) <= 0;
  if (blocks && !may_block_[at(i)]) reflex_.push_back(i);
  may_block_[at(i)] = blocks;
}

// Returns whether the corner is convex and no other corner lies in or on the triangle that would be
// cut off. Testing reflex corners is enough: if any corner lies there, a reflex one does, too.
bool EarClipping::is_ear(std::int32_t i) {
  if (may_block_[at(i)]) return false;
  const std::int32_t before = previous_[at(i)], after = next_[at(i)];
  const Point<2>&a = x_[at(before)], &b = x_[at(i)], &c = x_[at(after)];
  const Point<2> low{std::min({a[0], b[0], c[0]}), std::min({a[1], b[1], c[1]})};
  const Point<2> high{std::max({a[0], b[0], c[0]}), std::max({a[1], b[1], c[1]})};
  tests_ += static_cast<std::int64_t>(reflex_.size());
  return std::none_of(reflex_.begin(), reflex_.end(), [&](std::int32_t j) {
    if (!may_block_[at(j)] || j == before || j == after) return false;
    const Point<2>& p = x_[at(j)];
    if (p[0] < low[0] || p[0] > high[0] || p[1] < low[1] || p[1] > high[1]) return false;
    tests_ += kBoxTests;
    return orientation(a, b, p) >= 0 && orientation(b, c, p) >= 0 && orientation(c, a, p) >= 0;
  });
}

void EarClipping::link(std::int32_t piece, std::size_t edge, std::int32_t neighbor) {
  pieces_[at(piece)].across[edge] = neighbor;
  // Edge 2 of an ear is the one that remained in the polygon.
  if (neighbor >= 0) pieces_[at(neighbor)].across[2] = piece;
}

void EarClipping::cut_off(std::int32_t i) {
  const std::int32_t before = previous_[at(i)], after = next_[at(i)];
  const auto piece = static_cast<std::int32_t>(pieces_.size());
  pieces_.push_back({{before, i, after}, {-1, -1, -1}});
  link(piece, 0, behind_[at(before)]);
  link(piece, 1, behind_[at(i)]);
  behind_[at(before)] = piece;
  next_[at(before)] = after;
  previous_[at(after)] = before;
  for (const std::int32_t neighbor : {before, after}) {
    classify(neighbor);
    is_no_ear_[at(neighbor)] = 0;
  }
}

// Continues at the second next corner after each cut, so that a round polygon does not become a fan
// of thin triangles.
std::vector<Piece> EarClipping::run() {
  std::size_t left = x_.size();
  std::size_t misses = 0;
  bool second_look = false;
  std::int32_t i = 1;
  while (left > 3) {
    if (++tests_ > kMaxEarTests) return {};
    if (!is_no_ear_[at(i)] && is_ear(i)) {
      cut_off(i);
      --left;
      misses = 0;
      second_look = false;
      i = next_[at(next_[at(i)])];
      continue;
    }
    is_no_ear_[at(i)] = 1;
    i = next_[at(i)];
    if (++misses < left) continue;
    // A corner that blocked an ear may itself be cut off by now, so cached results are reset once.
    if (second_look) return {};
    std::fill(is_no_ear_.begin(), is_no_ear_.end(), 0);
    misses = 0;
    second_look = true;
  }
  if (turn_at(i) <= 0) return {};
  const std::int32_t after = next_[at(i)];
  cut_off(i);
  // The last triangle also has a neighbour across its third edge.
  link(static_cast<std::int32_t>(pieces_.size() - 1), 2, behind_[at(after)]);
  return std::move(pieces_);
}

std::size_t edge_towards(const Piece& piece, std::int32_t neighbor) {
  const auto found = std::find(piece.across.begin(), piece.across.end(), neighbor);
  return static_cast<std::size_t>(found - piece.across.begin());
}

// Flips edge k of a triangle if the corner across it is inside the circumcircle of the triangle.
// Returns whether it did.
bool flip(const std::vector<Point<2>>& x, std::vector<Piece>& pieces, std::int32_t index,
          std::size_t k) {
  Piece& here = pieces[at(index)];
  const std::int32_t other = here.across[k];
  if (other < 0) return false;
  Piece& there = pieces[at(other)];
  const std::size_t j = edge_towards(there, index);
  const std::int32_t a = here.corner[k], b = here.corner[(k + 1) % 3];
  const std::int32_t c = here.corner[(k + 2) % 3], d = there.corner[(j + 2) % 3];
  if (in_circle(x[at(a)], x[at(b)], x[at(c)], x[at(d)]) <= 0) return false;
  const std::int32_t past_bc = here.across[(k + 1) % 3], past_ca = here.across[(k + 2) % 3];
  const std::int32_t past_ad = there.across[(j + 1) % 3], past_db = there.across[(j + 2) % 3];
  here = {{c, a, d}, {past_ca, past_ad, other}};
  there = {{d, b, c}, {past_db, past_bc, index}};
  if (past_ad >= 0) pieces[at(past_ad)].across[edge_towards(pieces[at(past_ad)], other)] = index;
  if (past_bc >= 0) pieces[at(past_bc)].across[edge_towards(pieces[at(past_bc)], index)] = other;
  return true;
}

}  // namespace

std::vector<std::array<std::int32_t, 3>> polygon_triangles(const std::vector<Point<2>>& corners) {
  std::vector<Piece> pieces = EarClipping(corners).run();
  bool again = true;
  for (std::int64_t tests = 0; again && tests < kMaxFlipTests;
       tests += 3 * static_cast<std::int64_t>(pieces.size())) {
    again = false;
    for (std::size_t t = 0; t < pieces.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k)
        again = flip(corners, pieces, static_cast<std::int32_t>(t), k) || again;
  }
  std::vector<std::array<std::int32_t, 3>> triangles;
  triangles.reserve(pieces.size());
  for (const Piece& piece : pieces) triangles.push_back(piece.corner);
  return triangles;
}

}  // namespace pnpbs
