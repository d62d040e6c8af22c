// SPDX-License-Identifier: BSD-3-Clause
#include "quality/volume/star_changes.hpp"

#include <utility>

#include "base/execution.hpp"
#include "quality/volume/small_node_set.hpp"

namespace pnpbs {

namespace {

bool has(const TetrahedronNodes& tetrahedron, std::int32_t i) {
  return std::find(tetrahedron.begin(), tetrahedron.end(), i) != tetrahedron.end();
}

// Returns the other three corners, ordered such that (i, corners) has the orientation of t.
StarChanges::Corners others(const TetrahedronNodes& t, std::int32_t i) {
  if (t[0] == i) return {t[1], t[2], t[3]};
  if (t[1] == i) return {t[0], t[3], t[2]};
  if (t[2] == i) return {t[0], t[1], t[3]};
  return {t[0], t[2], t[1]};
}

// Returns the corners of all tetrahedra of the change, without duplicates.
std::vector<std::int32_t> corners_of(const StarChange& change) {
  std::vector<std::int32_t> corners;
  for (const auto* tetrahedra : {&change.gone, &change.made})
    for (const TetrahedronNodes& t : *tetrahedra) corners.insert(corners.end(), t.begin(), t.end());
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

}  // namespace

StarChanges::Corners StarChanges::least_first(const Corners& c) {
  if (c[0] < c[1] && c[0] < c[2]) return c;
  return c[1] < c[2] ? Corners{c[1], c[2], c[0]} : Corners{c[2], c[0], c[1]};
}

TetrahedronNodes StarChanges::by_id(TetrahedronNodes corners) const {
  std::sort(corners.begin(), corners.end(),
            [this](std::int32_t a, std::int32_t b) { return nodes_.id(a) < nodes_.id(b); });
  return corners;
}

bool StarChanges::ids_less(const TetrahedronNodes& a, const TetrahedronNodes& b) const {
  return std::lexicographical_compare(
      a.begin(), a.end(), b.begin(), b.end(),
      [this](std::int32_t i, std::int32_t j) { return nodes_.id(i) < nodes_.id(j); });
}

StarChanges::Star StarChanges::star_after(std::int32_t i, const StarChange& change) const {
  Star star;
  std::vector<Corners> gone;
  for (const TetrahedronNodes& t : change.gone)
    if (has(t, i)) gone.push_back(least_first(others(t, i)));
  for_simplices(i, [&](const Corners& corners) {
    if (!contains(gone, least_first(corners))) star.simplices.push_back(corners);
  });
  for (const TetrahedronNodes& t : change.made)
    if (has(t, i)) star.simplices.push_back(others(t, i));
  SmallNodeSet neighbours;
  for (const Corners& corners : star.simplices)
    for (const std::int32_t j : corners)
      if (!neighbours.contains(j)) neighbours.add(j);
  star.neighbours.assign(neighbours.all().begin(), neighbours.all().end());
  return star;
}

// Writes a star in the format of VolumeStars. By Euler's formula, n neighbours with 2 n - 4
// triangles close around the node.
void StarChanges::write_in_order(const Star& star, std::vector<std::int32_t>& out) const {
  const std::size_t n = star.neighbours.size();
  out.push_back(VolumeStars::header(n, star.simplices.size() + 4 == 2 * n));
  const auto first = static_cast<std::ptrdiff_t>(out.size());
  out.insert(out.end(), star.neighbours.begin(), star.neighbours.end());
  std::sort(out.begin() + first, out.end(),
            [this](std::int32_t a, std::int32_t b) { return nodes_.id(a) < nodes_.id(b); });
  std::vector<Corners> places;
  places.reserve(star.simplices.size());
  for (const Corners& corners : star.simplices) {
    Corners triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      std::int32_t place = 0;
      while (out[static_cast<std::size_t>(first + place)] != corners[k]) ++place;
      triangle[k] = place;
    }
    places.push_back(least_first(triangle));
  }
  std::sort(places.begin(), places.end());
  for (const Corners& triangle : places) {
    if (n <= static_cast<std::size_t>(VolumeStars::kMaxPlaces))
      out.push_back(VolumeStars::pack(triangle));
    else
      for (const std::int32_t place : triangle)
        out.push_back(out[static_cast<std::size_t>(first + place)]);
  }
}

// The changes treat all new tetrahedra as elements of the domain and ignore the outside. Where a
// surface is rough compared with d, a moved node may violate that, so open stars and changed stars
// are marked as doubtful. An unchanged closed star has the same nodes at the same positions as
// before and remains valid.
void StarChanges::write_to(VolumeStars& stars) const {
  std::vector<char> changed(place_.size());
  for (std::size_t i = 0; i < place_.size(); ++i) changed[i] = place_[i] != kUnchanged;
  stars.replace(changed, [this](std::int64_t i, std::vector<std::int32_t>& out) {
    const std::int32_t place = place_[static_cast<std::size_t>(i)];
    write_in_order(changed_[static_cast<std::size_t>(place)], out);
  });
  for (std::size_t i = 0; i < changed.size(); ++i)
    changed[i] = changed[i] || !stars.closed(static_cast<std::int64_t>(i));
  stars.doubt(changed);
}

void StarChanges::put(std::int32_t i, Star star) {
  std::int32_t& place = place_[static_cast<std::size_t>(i)];
  if (place == kUnchanged) {
    place = static_cast<std::int32_t>(changed_.size());
    changed_.push_back(std::move(star));
  } else {
    changed_[static_cast<std::size_t>(place)] = std::move(star);
  }
}

// The new stars are computed concurrently, because no star depends on more than one change.
std::vector<std::vector<std::int32_t>> StarChanges::accept(std::span<const StarChange> changes) {
  std::vector<std::vector<std::int32_t>> affected(changes.size());
  std::vector<std::vector<Star>> after(changes.size());
  for_each("pnpbs::StarChanges::accept", std::ssize(changes), [&](std::int64_t c) {
    const auto k = static_cast<std::size_t>(c);
    affected[k] = corners_of(changes[k]);
    for (const std::int32_t i : affected[k]) after[k].push_back(star_after(i, changes[k]));
  });
  for (std::size_t k = 0; k < changes.size(); ++k)
    for (std::size_t a = 0; a < affected[k].size(); ++a)
      put(affected[k][a], std::move(after[k][a]));
  return affected;
}

}  // namespace pnpbs
