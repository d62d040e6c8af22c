// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay/volume/volume_star.hpp"

#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

#include "predicates/space.hpp"

namespace pnpbs {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNoSlope = -std::numeric_limits<double>::max();

std::uint64_t bit_in_word(std::int32_t k, std::size_t first) {
  const std::size_t at = static_cast<std::size_t>(k) - first;
  return at < kWord ? std::uint64_t{1} << at : 0;
}

}  // namespace

void VolumeStar::start(const VolumeNode& centre) {
  centre_ = centre;
  candidates_.clear();
  relative_.clear();
  known_.clear();
}

void VolumeStar::add(const VolumeNode& candidate) {
  candidates_.push_back(candidate);
  relative_.push_back(difference(candidate.x, centre_.x));
}

void VolumeStar::add_known(const Corners& corners, bool taken) {
  known_.push_back({corners, taken});
}

bool VolumeStar::wrap(double reach) {
  facets_.clear();
  open_.clear();
  unproven_.clear();
  shields_.clear();
  search_reach_ = 0;
  if (count() >= 3) {
    invert();
    clear_edges();
    if (known_.empty())
      start_walk(nearest());
    else
      start_at_known();
    walk(reach);
  }
  nothing_found_ = known_.empty() && facets_.empty();
  if (reach >= max_reach()) return true;
  if (nothing_found_ || !open_.empty()) search_reach_ = max_reach();
  return search_reach_ == 0;
}

void VolumeStar::invert() {
  const std::size_t n = candidates_.size(), padded = (n + kGroup - 1) / kGroup * kGroup;
  for (std::vector<double>& along : y_)
    if (along.size() < padded) along.resize(2 * padded);
  if (slopes_.size() < padded) slopes_.resize(2 * padded);
  double least = kInfinity;
  for (std::size_t k = 0; k < n; ++k) {
    slopes_[k] = dot(relative_[k], relative_[k]);
    least = std::min(least, slopes_[k]);
  }
  unit_ = std::sqrt(least);
  for (std::size_t k = 0; k < n; ++k) {
    const double scale = unit_ / slopes_[k];
    for (std::size_t along = 0; along < 3; ++along) y_[along][k] = scale * relative_[k][along];
  }
  for (std::size_t k = n; k < padded; ++k)
    for (std::size_t along = 0; along < 3; ++along) y_[along][k] = 0;
}

void VolumeStar::clear_edges() {
  const std::size_t n = candidates_.size();
  done_.assign(n * ((n + kWord - 1) / kWord), 0);
  waiting_.clear();
}

std::int32_t VolumeStar::nearest() const {
  const auto first = slopes_.begin();
  return static_cast<std::int32_t>(
      std::min_element(first, first + static_cast<std::ptrdiff_t>(count())) - first);
}

bool VolumeStar::is_done(const Edge& edge) const {
  const std::size_t words = (candidates_.size() + kWord - 1) / kWord, to = index(edge.to);
  return (done_[index(edge.from) * words + to / kWord] >> (to % kWord) & 1) != 0;
}

void VolumeStar::set_done(const Edge& edge) {
  const std::size_t words = (candidates_.size() + kWord - 1) / kWord, to = index(edge.to);
  done_[index(edge.from) * words + to / kWord] |= std::uint64_t{1} << (to % kWord);
}

// ------------------------------------------------------------------ where the walk begins ------

void VolumeStar::set_known_done() {
  for (const Known& known : known_)
    for (std::size_t k = 0; k < 3; ++k) set_done({known.corners[k], known.corners[(k + 1) % 3]});
}

void VolumeStar::start_at_known() {
  set_known_done();
  for (const Known& known : known_)
    for (std::size_t k = 0; k < 3; ++k) {
      const Edge back{known.corners[(k + 1) % 3], known.corners[k]};
      if (!is_done(back)) waiting_.push_back(back);
    }
}

// The elements surround the centre if each edge has one on either side. Their number then follows
// from Euler's formula, so that the edges are rarely checked in vain.
bool VolumeStar::all_known() {
  facets_.clear();
  open_.clear();
  if (candidates_.size() < 4 || known_.size() != 2 * candidates_.size() - 4) return false;
  clear_edges();
  start_at_known();
  return waiting_.empty();
}

// The nearest node is a neighbour of the centre. The smallest of all circles through the centre,
// this and another node is the equator of an empty sphere: a node inside it, which is farther away
// than the nearest one, would give a smaller circle. Inversion maps the circles to lines and the
// smallest circle to the farthest line. Therefore its other node forms a face with the nearest one,
// unless there are ties.
void VolumeStar::start_walk(std::int32_t first) {
  const std::size_t n = candidates_.size();
  const Point<3> a = inverse(first);
  const double *x = y_[0].data(), *y = y_[1].data(), *z = y_[2].data();
  line_gaps_.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    const Point<3> b{x[k], y[k], z[k]}, along = difference(b, a), area = cross(a, b);
    const double length2 = dot(along, along);
    line_gaps_[k] = length2 > 0 ? dot(area, area) / length2 : -1;
  }
  line_gaps_[index(first)] = -1;
  const auto farthest = std::max_element(line_gaps_.begin(), line_gaps_.end());
  const auto second = static_cast<std::int32_t>(farthest - line_gaps_.begin());
  const Point<3> b = inverse(second), along = difference(b, a);
  const double length2 = dot(along, along), t = -dot(a, along) / length2;
  const Point<3> foot{a[0] + t * along[0], a[1] + t * along[1], a[2] + t * along[2]};
  // The offset is reduced by the rounding error, which enlarges the sphere. This is valid if the
  // ends of the line are apart.
  constexpr double kApart = 0.1;
  if (*farthest > kApart * kApart && length2 > kApart * kApart &&
      all_surely_below({foot, *farthest - 4 * kRounding}, {first, second, second})) {
    waiting_.push_back({first, second});
    waiting_.push_back({second, first});
  } else {
    start_walk_exactly(first);
  }
}

// Handles ties: finds some facet that has the nearest node as a corner.
void VolumeStar::start_walk_exactly(std::int32_t first) {
  std::vector<std::int32_t> order(candidates_.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [this](std::int32_t k, std::int32_t l) {
    return line_gaps_[index(k)] > line_gaps_[index(l)];
  });
  Facet facet;
  for (const std::int32_t second : order) {
    if (second == first) continue;
    if (!find_facet_exactly({first, second}, facet)) continue;
    bool lowest = true;
    for (std::int32_t k = 0; k < count() && lowest; ++k)
      lowest = std::count(facet.corners.begin(), facet.corners.end(), k) > 0 || !beyond(facet, k);
    if (!lowest) continue;
    waiting_.push_back({first, second});
    return;
  }
}

// ------------------------------------------------------------------ the walk -------------------

void VolumeStar::walk(double reach) {
  Facet facet;
  while (!waiting_.empty()) {
    const Edge edge = waiting_.back();
    waiting_.pop_back();
    if (is_done(edge)) continue;
    if (find_facet(edge, facet)) {
      add_facet(facet, reach);
    } else {
      set_done(edge);
      add_open(face_of(edge));
    }
  }
}

// Adds an open face. Of all faces in one plane across an axis, one is sufficient.
void VolumeStar::add_open(const Face& face) {
  shields_.push_back(face);
  const auto k = static_cast<std::size_t>(face.common);
  if (face.common < 0 || std::none_of(open_.begin(), open_.end(), [&](const Face& other) {
        return other.common == face.common && other.normal[k] * face.normal[k] > 0;
      }))
    open_.push_back(face);
}

void VolumeStar::add_facet(const Facet& facet, double reach) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Edge edge{facet.corners[k], facet.corners[(k + 1) % 3]}, back{edge.to, edge.from};
    set_done(edge);
    if (!is_done(back)) waiting_.push_back(back);
  }
  facets_.push_back(facet);
  // Rounding the offset down makes the sphere larger.
  Plane& plane = facets_.back().plane;
  plane.offset -= kRounding;
  constexpr double kMargin = 1 - 1e-9;
  const double proven = kMargin * reach * plane.offset;
  const double square = unit_ * unit_ * dot(plane.normal, plane.normal);
  if (proven > 0 && proven * proven >= square) return;
  unproven_.push_back(plane);
  if (plane.offset <= 0)  // Flat, or nearly so.
    for (std::size_t k = 0; k < 3; ++k)
      shields_.push_back(face_of({facet.corners[k], facet.corners[(k + 1) % 3]}));
  const double diameter =
      plane.offset > 0 ? std::sqrt(square) / (kMargin * plane.offset) : kInfinity;
  search_reach_ = std::max(search_reach_, std::min(diameter, max_reach()));
}

VolumeStar::Face VolumeStar::face_of(const Edge& edge) const {
  Face face{edge, cross(inverse(edge.from), inverse(edge.to)), -1};
  const Point<3>&a = relative_[index(edge.from)], &b = relative_[index(edge.to)];
  for (std::size_t k = 0; k < 3; ++k)
    if (a[k] == 0 && b[k] == 0 && std::fabs(face.normal[k]) > kRounding)
      face.common = static_cast<int>(k);
  return face;
}

VolumeStar::Facet VolumeStar::facet_of(const Edge& edge, std::int32_t corner) const {
  const Point<3> a = inverse(edge.from);
  const Point<3> normal = cross(difference(inverse(edge.to), a), difference(inverse(corner), a));
  return {{edge.from, edge.to, corner}, {normal, dot(normal, a)}};
}

bool VolumeStar::all_surely_below(const Plane& plane, const Corners& facet) const {
  const double *x = y_[0].data(), *y = y_[1].data(), *z = y_[2].data();
  const double limit = plane.offset - kRounding;
  const double nx = plane.normal[0], ny = plane.normal[1], nz = plane.normal[2];
  for (std::size_t first = 0; first < candidates_.size(); first += kWord) {
    std::uint64_t bits = bits_where(first, candidates_.size(), [=](std::size_t k) {
      return nx * x[k] + ny * y[k] + nz * z[k] > limit;
    });
    for (const std::int32_t corner : facet) bits &= ~bit_in_word(corner, first);
    if (bits != 0) return false;
  }
  return true;
}

// Finds the facet with this edge. Returns false if none exists, so that face (centre, from, to)
// is open. Seen along the edge, the third corner is the steepest candidate on the right side of the
// face. If all others are certainly below the facet, exact arithmetic is not necessary.
bool VolumeStar::find_facet(const Edge& edge, Facet& facet) {
  const Point<3> a = inverse(edge.from), b = inverse(edge.to), along = difference(b, a);
  const Point<3> normal = cross(a, b), up = cross(along, normal);
  const double height = dot(up, a);
  const double *x = y_[0].data(), *y = y_[1].data(), *z = y_[2].data();
  double* const slopes = slopes_.data();
  const std::size_t n = candidates_.size(), padded = (n + kGroup - 1) & ~(kGroup - 1);
  const double nx = normal[0], ny = normal[1], nz = normal[2];
  const double ux = up[0], uy = up[1], uz = up[2];
  double steepest = kNoSlope;
#pragma omp simd reduction(max : steepest)
  for (std::size_t k = 0; k < padded; ++k) {
    const double out = nx * x[k] + ny * y[k] + nz * z[k];
    const double rise = ux * x[k] + uy * y[k] + uz * z[k] - height;
    const double slope = out > kRounding ? rise / out : kNoSlope;
    slopes[k] = slope;
    steepest = slope > steepest ? slope : steepest;
  }
  if (steepest > kNoSlope) {
    std::size_t first = 0;
    std::uint64_t bits = 0;
    for (; bits == 0; first += kWord)
      bits = bits_where(first, n, [=](std::size_t k) { return slopes[k] == steepest; });
    const std::size_t corner = first - kWord + static_cast<std::size_t>(std::countr_zero(bits));
    facet = facet_of(edge, static_cast<std::int32_t>(corner));
    if (all_surely_below(facet.plane, facet.corners)) return true;
  }
  return find_facet_exactly(edge, facet);
}

// Returns whether three points relative to the centre have a 0 in the same coordinate. They are
// then in one plane with it, which is frequent on flat surfaces.
bool VolumeStar::share_a_coordinate(const Point<3>& a, const Point<3>& b, const Point<3>& c) {
  for (std::size_t k = 0; k < 3; ++k)
    if (a[k] == 0 && b[k] == 0 && c[k] == 0) return true;
  return false;
}

// Returns on which side of face (centre, a, b) the candidate c lies. `normal` is that of the face
// after inversion.
int VolumeStar::side(const Point<3>& normal, std::int32_t a, std::int32_t b, std::int32_t c) const {
  const double out = dot(normal, inverse(c));
  if (out > kRounding) return 1;
  if (out < -kRounding) return -1;
  const Point<3>&xa = relative_[index(a)], &xb = relative_[index(b)], &xc = relative_[index(c)];
  if (share_a_coordinate(xa, xb, xc)) return 0;
  return orientation(centre_.x, candidates_[index(a)].x, candidates_[index(b)].x,
                     candidates_[index(c)].x);
}

bool VolumeStar::surely_below(const Plane& plane, std::int32_t k) const {
  return dot(plane.normal, inverse(k)) - plane.offset < -kRounding;
}

// Returns whether candidate k is inside the sphere of the facet.
bool VolumeStar::beyond(const Facet& facet, std::int32_t k) const {
  if (surely_below(facet.plane, k)) return false;
  if (dot(facet.plane.normal, inverse(k)) - facet.plane.offset > kRounding) return true;
  const VolumeNode &a = candidates_[index(facet.corners[0])],
                   &b = candidates_[index(facet.corners[1])],
                   &c = candidates_[index(facet.corners[2])], &p = candidates_[index(k)];
  return in_sphere_perturbed(centre_.x, a.x, b.x, c.x, p.x, centre_.id, a.id, b.id, c.id, p.id) > 0;
}

bool VolumeStar::find_facet_exactly(const Edge& edge, Facet& facet) const {
  const Point<3> normal = cross(inverse(edge.from), inverse(edge.to));
  bool found = false;
  for (std::int32_t k = 0; k < count(); ++k) {
    if (k == edge.from || k == edge.to) continue;
    if (found && surely_below(facet.plane, k)) continue;
    if (side(normal, edge.from, edge.to, k) <= 0) continue;
    if (found && !beyond(facet, k)) continue;
    facet = facet_of(edge, k);
    found = true;
  }
  return found;
}

// The search for nodes that are not candidates yet and can change the star. They are in the spheres
// of tetrahedra that are not proven and behind open faces.

namespace {

constexpr double kBeyond = 1 + 1e-9;  // Distances are rounded.

}  // namespace

// Returns whether y lies in the plane of a shield face, between its two neighbours and closer to
// the origin than the line through them after inversion. A sphere of an element that contains
// neither neighbour cannot reach such a point.
bool VolumeStar::is_shielded(const Point<3>& y) const {
  constexpr double kThin = 1e-3, kSlack = 1e-9, kMargin = 1e-6;
  if (unit_ < 0.01 * max_reach()) return false;
  return std::any_of(shields_.begin(), shields_.end(), [&](const Face& face) {
    const Point<3>& normal = face.normal;
    const double square = dot(normal, normal);
    if (square < kThin * kThin || std::fabs(dot(normal, y)) > kRounding) return false;
    const double of_a = dot(cross(y, inverse(face.edge.to)), normal) / square;
    const double of_b = dot(cross(inverse(face.edge.from), y), normal) / square;
    return of_a > -kSlack && of_b > -kSlack && of_a + of_b < 1 - kMargin;
  });
}

// Returns whether x, whose inverse is y, is on the open side of the face. The decision is exact.
bool VolumeStar::in_front(const Face& face, const Point<3>& x, const Point<3>& y) const {
  if (face.common >= 0) {
    const auto k = static_cast<std::size_t>(face.common);
    return face.normal[k] * (x[k] - centre_.x[k]) > 0;
  }
  const double out = dot(face.normal, y);
  if (std::fabs(out) > kRounding) return out > 0;
  return orientation(centre_.x, candidates_[index(face.edge.from)].x,
                     candidates_[index(face.edge.to)].x, x) > 0;
}

bool VolumeStar::may_matter(const Point<3>& x) const {
  const Point<3> away = difference(x, centre_.x);
  const double square = dot(away, away), farthest = search_reach_ * kBeyond;
  if (square == 0 || square > farthest * farthest) return false;
  if (nothing_found_) return true;
  const double scale = unit_ / square;
  const Point<3> y{scale * away[0], scale * away[1], scale * away[2]};
  const bool beyond =
      std::any_of(unproven_.begin(), unproven_.end(),
                  [&](const Plane& plane) { return dot(plane.normal, y) > plane.offset; }) ||
      std::any_of(open_.begin(), open_.end(),
                  [&](const Face& face) { return in_front(face, x, y); });
  return beyond && !is_shielded(y);
}

std::uint64_t VolumeStar::may_matter_bits(const std::array<const double*, 3>& x,
                                          std::size_t n) const {
  const double *x0 = x[0], *x1 = x[1], *x2 = x[2];
  const double c0 = centre_.x[0], c1 = centre_.x[1], c2 = centre_.x[2];
  const double farthest = search_reach_ * kBeyond, unit = unit_;
  const std::uint64_t near = bits_where(n, [=](std::size_t k) {
    const double dx = x0[k] - c0, dy = x1[k] - c1, dz = x2[k] - c2;
    return dx * dx + dy * dy + dz * dz <= farthest * farthest;
  });
  if (nothing_found_ || near == 0) return near;
  std::uint64_t beyond = 0;
  const auto add_beyond = [&](const Point<3>& normal, double offset) {
    const double nx = normal[0], ny = normal[1], nz = normal[2];
    beyond |= bits_where(n, [=](std::size_t k) {
      const double dx = x0[k] - c0, dy = x1[k] - c1, dz = x2[k] - c2;
      return (nx * dx + ny * dy + nz * dz) * unit > offset * (dx * dx + dy * dy + dz * dz);
    });
  };
  for (const Plane& plane : unproven_) add_beyond(plane.normal, plane.offset - kRounding);
  for (const Face& face : open_) {
    if (face.common < 0) {
      add_beyond(face.normal, -2 * kRounding);
      continue;
    }
    const auto k = static_cast<std::size_t>(face.common);
    const double* const along = x[k];
    const double c = centre_.x[k], sign = std::copysign(1.0, face.normal[k]);
    beyond |= bits_where(n, [=](std::size_t j) { return sign * (along[j] - c) > 0; });
  }
  return near & beyond;
}

bool VolumeStar::may_matter_in(const Box<3>& box) const {
  const Point<3> low = difference(box.low, centre_.x), high = difference(box.high, centre_.x);
  double nearest = 0, farthest = 0;  // Squared distances.
  for (std::size_t k = 0; k < 3; ++k) {
    const double gap = std::max({low[k], -high[k], 0.0});
    nearest += gap * gap;
    farthest += std::max(low[k] * low[k], high[k] * high[k]);
  }
  if (nearest > search_reach_ * search_reach_ * kBeyond) return false;
  if (nothing_found_) return true;
  // Returns whether normal * x > offset * |x|^2 for any x in the box, in the units of these two.
  const double slack = 1e-9 * farthest / unit_;
  const auto reaches = [&](const Point<3>& normal, double offset) {
    const double bend = std::max(offset, 0.0) / unit_;
    double sum = slack;
    for (std::size_t k = 0; k < 3; ++k) {
      constexpr double kInfinity = std::numeric_limits<double>::infinity();
      const double peak = bend > 0 ? 0.5 * normal[k] / bend : std::copysign(kInfinity, normal[k]);
      const double x = std::clamp(peak, low[k], high[k]);
      sum += normal[k] * x - bend * x * x;
    }
    return sum > 0;
  };
  return std::any_of(unproven_.begin(), unproven_.end(),
                     [&](const Plane& plane) { return reaches(plane.normal, plane.offset); }) ||
         std::any_of(open_.begin(), open_.end(),
                     [&](const Face& face) { return reaches(face.normal, 0); });
}

// Selection of the facets that are elements, and the order of the results.

namespace {

// Sorts by key(value). Keys must be distinct. For few values, the number of smaller keys is counted
// for each, for all at the same time: this has no branches that can be mispredicted.
template <class Value, class Key>
void sort_by(std::vector<Value>& values, const Key& key) {
  const std::size_t n = values.size(), padded = (n + kGroup - 1) & ~(kGroup - 1);
  if (n > kWord) {
    std::sort(values.begin(), values.end(),
              [&](const Value& a, const Value& b) { return key(a) < key(b); });
    return;
  }
  std::array<std::int64_t, kWord> keys{}, less{};
  std::array<Value, kWord> unsorted;
  for (std::size_t k = 0; k < n; ++k) {
    unsorted[k] = values[k];
    keys[k] = key(values[k]);
  }
  for (std::size_t k = 0; k < n; ++k) {
    const std::int64_t own = keys[k];
#pragma omp simd
    for (std::size_t l = 0; l < padded; ++l) less[l] += own < keys[l];
  }
  for (std::size_t k = 0; k < n; ++k) values[static_cast<std::size_t>(less[k])] = unsorted[k];
}

}  // namespace

bool VolumeStar::is_element(const Facet& facet) const {
  const auto& [a, b, c] = facet.corners;
  const VolumeNode &p = candidates_[index(a)], &q = candidates_[index(b)],
                   &r = candidates_[index(c)];
  // A tetrahedron that is not flat and far from the limit does not require a common order of the
  // corners.
  constexpr double kSurelyNotFlat = 1e-4, kMargin = 1e-3;
  const Plane& plane = facet.plane;
  if (plane.offset > kSurelyNotFlat) {
    const double limit = 2 * kMaxRadius * std::min({centre_.d, p.d, q.d, r.d}) * plane.offset;
    const double diameter = unit_ * std::sqrt(dot(plane.normal, plane.normal));
    if (diameter < (1 - kMargin) * limit) return true;
    if (diameter > (1 + kMargin) * limit) return false;
  }
  return pnpbs::is_element(ordered_by_id({centre_, p, q, r}));
}

void VolumeStar::find_neighbours() {
  used_.assign((candidates_.size() + kWord - 1) / kWord, 0);
  for (const Corners& triangle : triangles_)
    for (const std::int32_t k : triangle)
      used_[index(k) / kWord] |= std::uint64_t{1} << (index(k) % kWord);
  neighbours_.clear();
  for (std::size_t w = 0; w < used_.size(); ++w)
    for (std::uint64_t left = used_[w]; left != 0; left &= left - 1)
      neighbours_.push_back(static_cast<std::int32_t>(w * kWord) + std::countr_zero(left));
  sort_by(neighbours_, [this](std::int32_t k) { return candidates_[index(k)].id; });
}

// Sorts each triangle as one number. Of its three rotations, the smallest number begins with the
// smallest index.
void VolumeStar::number_corners() {
  find_neighbours();
  place_.resize(candidates_.size());
  for (std::size_t n = 0; n < neighbours_.size(); ++n)
    place_[index(neighbours_[n])] = static_cast<std::int32_t>(n);
  constexpr int kBits = 21;
  const auto pack = [](std::int64_t a, std::int64_t b, std::int64_t c) {
    return a << 2 * kBits | b << kBits | c;
  };
  packed_.clear();
  for (const Corners& triangle : triangles_) {
    const std::int32_t a = place_[index(triangle[0])], b = place_[index(triangle[1])],
                       c = place_[index(triangle[2])];
    packed_.push_back(std::min({pack(a, b, c), pack(b, c, a), pack(c, a, b)}));
  }
  sort_by(packed_, [](std::int64_t packed) { return packed; });
  const auto place = [](std::int64_t packed, int from_last) {
    constexpr std::int64_t kMask = (std::int64_t{1} << kBits) - 1;
    return static_cast<std::int32_t>(packed >> from_last * kBits & kMask);
  };
  for (std::size_t t = 0; t < packed_.size(); ++t)
    triangles_[t] = {place(packed_[t], 2), place(packed_[t], 1), place(packed_[t], 0)};
}

}  // namespace pnpbs
