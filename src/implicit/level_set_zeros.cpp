// SPDX-License-Identifier: BSD-3-Clause
#include "implicit/level_set_zeros.hpp"

#include <algorithm>

#include "base/space_vectors.hpp"

namespace pnpbs {

namespace {

constexpr int kMaxSteps = 60;
constexpr double kEndTolerance = 1e-10;  // of a segment

// What is left of a segment, in parts of its way.
struct Bracket {
  std::size_t segment;
  Point<3> way;
  double a, b, fa, fb;
  int last = 0;  // the end that moved last
};

}  // namespace

// By the rule of false position in the Illinois form, which never leaves the two places between
// which f changes sign.
std::vector<Point<3>> zeros_on(const LevelSet& set, const std::vector<CrossedSegment>& segments) {
  std::vector<Bracket> open;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const CrossedSegment& s = segments[i];
    open.push_back({i, difference(s.end, s.begin), 0, 1, s.f_begin, s.f_end});
  }
  std::vector<Point<3>> zeros(segments.size());
  for (int step = 0; step < kMaxSteps && !open.empty(); ++step) {
    std::vector<double> parts;
    std::vector<Point<3>> x;
    for (const Bracket& s : open) {
      parts.push_back(s.a + (s.b - s.a) * (s.fa / (s.fa - s.fb)));
      x.push_back(shifted(segments[s.segment].begin, parts.back(), s.way));
    }
    const std::vector<double> f = set.values(x);
    std::size_t kept = 0;
    for (std::size_t k = 0; k < open.size(); ++k) {
      Bracket s = open[k];
      const double part = parts[k];
      zeros[s.segment] = x[k];
      if (f[k] == 0 || std::min(part - s.a, s.b - part) <= kEndTolerance) continue;
      const bool low = (f[k] < 0) == (s.fa < 0);
      (low ? s.a : s.b) = part;
      (low ? s.fa : s.fb) = f[k];
      const int moved = low ? 1 : 2;
      if (s.last == moved) (low ? s.fb : s.fa) *= 0.5;
      s.last = moved;
      open[kept++] = s;
    }
    open.resize(kept);
  }
  return zeros;
}

}  // namespace pnpbs
