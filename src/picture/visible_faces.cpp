// SPDX-License-Identifier: BSD-3-Clause
#include "picture/visible_faces.hpp"

#include <algorithm>

namespace pnpbs::picture {
namespace {

using Corners = std::array<std::int64_t, 3>;
using Marks = std::vector<bool>;  // of nodes

bool is_kept(const TetrahedronCorners& x, const CutPlane& plane) {
  double sum = 0;
  for (const Point<3>& corner : x) sum += plane.height(corner);
  return sum <= 0;
}

// Ascending, so that a face is the same from both sides.
Corners face_of(const std::array<std::int64_t, 4>& tetrahedron, std::size_t opposite) {
  Corners face{tetrahedron[(opposite + 1) % 4], tetrahedron[(opposite + 2) % 4],
               tetrahedron[(opposite + 3) % 4]};
  std::ranges::sort(face);
  return face;
}

bool all_marked(const Marks& marks, const Corners& face) {
  return std::ranges::all_of(
      face, [&](std::int64_t node) { return marks[static_cast<std::size_t>(node)]; });
}

void mark(Marks& marks, const auto& corners) {
  for (const std::int64_t node : corners) marks[static_cast<std::size_t>(node)] = true;
}

// Sorting all faces would take far more time and memory than the few that can be seen: their
// corners are on the boundary, or in a tetrahedron that is taken away.
class Shell {
 public:
  Shell(const Body& body, const CutPlane& plane)
      : body_(body), kept_(body.tetrahedra.size()), outside_(body.size()), inside_(body.size()) {
    for (std::size_t t = 0; t < kept_.size(); ++t) {
      kept_[t] = is_kept(body.corners(t), plane);
      mark(kept_[t] ? inside_ : outside_, body.tetrahedra[t]);
    }
    Marks beside = outside_;
    for (const Corners& triangle : body.boundary) mark(beside, triangle);
    for (std::size_t t = 0; t < kept_.size(); ++t)
      if (kept_[t]) for_faces(t, beside, [&](const Corners& face) { faces_.push_back({face, t}); });
    std::ranges::sort(faces_, {}, &Face::corners);
  }

  std::vector<VisibleFace> visible() const {
    std::vector<VisibleFace> found;
    for (Corners triangle : body_.boundary) {
      std::ranges::sort(triangle);
      add_if_kept(triangle, false, found);
    }
    for (std::size_t t = 0; t < kept_.size(); ++t)
      if (!kept_[t])
        for_faces(t, inside_, [&](const Corners& face) { add_if_kept(face, true, found); });
    return found;
  }

 private:
  struct Face {
    Corners corners;
    std::size_t tetrahedron;
  };

  template <class Work>
  void for_faces(std::size_t t, const Marks& marks, const Work& work) const {
    for (std::size_t opposite = 0; opposite < 4; ++opposite) {
      const Corners face = face_of(body_.tetrahedra[t], opposite);
      if (all_marked(marks, face)) work(face);
    }
  }

  void add_if_kept(const Corners& face, bool cut, std::vector<VisibleFace>& found) const {
    const auto place = std::ranges::lower_bound(faces_, face, {}, &Face::corners);
    if (place != faces_.end() && place->corners == face)
      found.push_back({face, place->tetrahedron, cut});
  }

  const Body& body_;
  Marks kept_;              // of tetrahedra
  Marks outside_, inside_;  // nodes of tetrahedra that are taken away, and of those that are kept
  std::vector<Face> faces_;
};

}  // namespace

std::vector<VisibleFace> visible_faces(const Body& body, const CutPlane& plane) {
  if (body.surfaces_alone()) {
    std::vector<VisibleFace> all;
    for (const Corners& triangle : body.boundary) all.push_back({triangle, 0, false});
    return all;
  }
  return Shell(body, plane).visible();
}

}  // namespace pnpbs::picture
