// SPDX-License-Identifier: BSD-3-Clause
#include "quality/volume/node_move.hpp"

#include <algorithm>
#include <limits>

#include "predicates/space.hpp"

namespace pnpbs {

namespace {

// The faces opposite to the corners, oriented so that the corner is on their positive side.
constexpr std::size_t kFaces[4][3] = {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}};

StarChanges::Corners face_of(const TetrahedronNodes& t, std::size_t corner) {
  return {t[kFaces[corner][0]], t[kFaces[corner][1]], t[kFaces[corner][2]]};
}

}  // namespace

NodeMove::NodeMove(const Nodes<3>& nodes, const StarChanges& stars, std::int32_t node)
    : nodes_(nodes), stars_(stars), change_{node, nodes.position(node), {}, {}} {
  constexpr double kFarthest = 2;  // [d] no edge between nodes at rest is longer
  const auto add = [&](std::int64_t j) { near_.push_back(static_cast<std::int32_t>(j)); };
  stars.for_neighbours(node, add);
  ring_ = near_;
  for (const std::int32_t j : ring_) {
    stars.count_if_unknown(j);
    stars.for_neighbours(j, add);
  }
  std::sort(near_.begin(), near_.end());
  near_.erase(std::unique(near_.begin(), near_.end()), near_.end());
  std::erase_if(near_, [&](std::int32_t j) {
    return j == node || distance<3>(nodes.position(j), change_.x) > kFarthest * nodes.d(node);
  });
}

// Computes the tetrahedra that node i forms with the candidates. Returns whether they close around
// the node.
bool NodeMove::wrap_star(VolumeStar& star, std::int32_t i, std::span<const std::int32_t> candidates,
                         std::vector<TetrahedronNodes>& tetrahedra) const {
  star.start(node_at(i));
  for (const std::int32_t j : candidates) star.add(node_at(j));
  star.wrap(std::numeric_limits<double>::infinity());  // the candidates are all that matter
  star.finish();
  const auto node = [&](std::int32_t place) {
    const std::int32_t k = star.neighbours()[static_cast<std::size_t>(place)];
    return candidates[static_cast<std::size_t>(k)];
  };
  for (const VolumeStar::Corners& triangle : star.triangles())
    tetrahedra.push_back({i, node(triangle[0]), node(triangle[1]), node(triangle[2])});
  return star.closed();
}

bool NodeMove::go_to(const Point<3>& x) {
  static thread_local VolumeStar star;
  change_.x = x;
  change_.gone.clear();
  change_.made.clear();
  return wrap_star(star, change_.node, near_, change_.made);
}

// Returns the apex of the tetrahedron on the other side of a face, or -1 if none exists.
std::int32_t NodeMove::beyond(const TetrahedronNodes& t, std::size_t corner) const {
  const Corners face = face_of(t, corner);
  std::int32_t apex = -1;
  stars_.count_if_unknown(face[0]);
  stars_.for_simplices(face[0], [&](const Corners& other) {
    for (std::size_t k = 0; k < 3; ++k)
      if (other[k] == face[2] && other[(k + 1) % 3] == face[1]) apex = other[(k + 2) % 3];
  });
  return apex;
}

// Returns whether the moved node lies in the circumsphere of t.
bool NodeMove::in_sphere_now(const TetrahedronNodes& t) const {
  const VolumeNode p = node_at(change_.node);
  std::array<VolumeNode, 4> c;
  for (std::size_t k = 0; k < 4; ++k) c[k] = node_at(t[k]);
  return in_sphere_perturbed(c[0].x, c[1].x, c[2].x, c[3].x, p.x, c[0].id, c[1].id, c[2].id,
                             c[3].id, p.id) > 0;
}

bool NodeMove::is_gone(const TetrahedronNodes& t) const {
  return contains(gone_by_id_, stars_.by_id(t));
}

void NodeMove::find_gone() {
  gone_by_id_.clear();
  const auto add = [&](const TetrahedronNodes& t) {
    change_.gone.push_back(t);
    gone_by_id_.push_back(stars_.by_id(t));
  };
  stars_.for_simplices(change_.node, [&](const Corners& corners) {
    add({change_.node, corners[0], corners[1], corners[2]});
  });
  // The other three faces of a tetrahedron of the star lead to tetrahedra of the same star.
  const std::size_t star = change_.gone.size();
  for (std::size_t next = 0; next < change_.gone.size(); ++next)
    for (std::size_t corner = 0; corner < (next < star ? 1 : 4); ++corner) {
      const TetrahedronNodes t = change_.gone[next];
      const std::int32_t apex = beyond(t, corner);
      if (apex < 0) continue;
      const Corners face = face_of(t, corner);
      const TetrahedronNodes behind{face[0], face[2], face[1], apex};
      if (!is_gone(behind) && in_sphere_now(behind)) add(behind);
    }
}

// Adds an open face, or closes it if its reverse is open: then a tetrahedron lies on either side,
// or a removed one and a new one lie on the same side.
void NodeMove::add_face(const Corners& corners) {
  const Corners face = StarChanges::least_first(corners), back{face[0], face[2], face[1]};
  const auto found = find_same(open_, back);
  if (found == open_.end()) {
    open_.push_back(face);
  } else {
    *found = open_.back();
    open_.pop_back();
  }
}

// Adds the faces of a tetrahedron: outside of a new one neighbours are missing, inside of a removed
// one.
void NodeMove::add_faces(const TetrahedronNodes& t, bool made) {
  for (std::size_t corner = 0; corner < 4; ++corner) {
    const Corners face = face_of(t, corner);
    add_face(made ? Corners{face[0], face[2], face[1]} : face);
  }
}

bool NodeMove::complete() {
  find_gone();
  open_.clear();
  for (const TetrahedronNodes& t : change_.gone) add_faces(t, false);
  for (const TetrahedronNodes& t : change_.made) add_faces(t, true);
  constexpr int kMaxFilled = 100;  // usually a few suffice
  for (int filled = 0; !open_.empty(); ++filled)
    if (filled == kMaxFilled || !fill(open_.back())) return false;
  return true;
}

// Adds the missing tetrahedron at a face. All its corners are old neighbours of the node. Returns
// false if none exists.
bool NodeMove::fill(const Corners& corners) {
  static thread_local VolumeStar star;
  std::vector<std::int32_t> candidates = ring_;
  if (std::erase(candidates, corners[0]) == 0) return false;
  candidates.push_back(change_.node);
  std::vector<TetrahedronNodes> around;
  wrap_star(star, corners[0], candidates, around);
  for (const TetrahedronNodes& t : around)
    for (std::size_t k = 1; k < 4; ++k) {
      const std::size_t next = k % 3 + 1;
      if (t[k] != corners[1] || t[next] != corners[2]) continue;
      if (std::find(t.begin(), t.end(), change_.node) != t.end()) return false;
      change_.made.push_back(t);
      add_faces(t, true);
      return true;
    }
  return false;
}

}  // namespace pnpbs
