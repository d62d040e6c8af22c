// SPDX-License-Identifier: BSD-3-Clause
#include "surfaces/surface_checks.hpp"

#include <algorithm>
#include <iterator>
#include <set>
#include <string>
#include <utility>

#include "base/error.hpp"
#include "base/point_text.hpp"
#include "base/union_find.hpp"
#include "geometry/volume/triangle_contacts.hpp"

namespace pnpbs {
namespace {

// Returns a text such as "from vertex 1 of surface 0 (0, 0, 0) to vertex 2 of surface 0 (1, 0, 0)".
MessageText edge_name(const Triangulation& surface, const std::array<std::int32_t, 2>& ends) {
  return "from " + surface.vertex_name(ends[0]) + " to " + surface.vertex_name(ends[1]);
}

std::string others_text(std::int64_t count, const char* what) {
  if (count <= 1) return "";
  return "; there are " + std::to_string(count) + " such " + what;
}

// The number of faulty edges, and the one at the triangle of lowest index.
struct FaultyEdges {
  std::int64_t count = 0;
  std::size_t first = 0;
};

template <class Faulty>
FaultyEdges find_faulty(const SurfaceEdges& edges, const Faulty& faulty) {
  FaultyEdges found;
  for (std::size_t e = 0; e < edges.count(); ++e) {
    const auto sides = edges.boundary_sides(e);
    if (!faulty(sides.size())) continue;
    if (found.count++ == 0 || sides[0].corner() < edges.boundary_sides(found.first)[0].corner())
      found.first = e;
  }
  return found;
}

}  // namespace

void require_closed_boundary(const Triangulation& surface, const SurfaceEdges& edges) {
  const FaultyEdges open = find_faulty(edges, [](std::size_t sides) { return sides == 1; });
  if (open.count > 0)
    throw BrokenSurface("the boundary is not closed: no other triangle joins " +
                        surface.triangle_name(edges.boundary_sides(open.first)[0].triangle) +
                        " at its edge " + edge_name(surface, edges.ends(open.first)) +
                        others_text(open.count, "edges"));
  const FaultyEdges many = find_faulty(edges, [](std::size_t sides) { return sides > 2; });
  if (many.count == 0) return;
  const auto sides = edges.boundary_sides(many.first);
  throw BrokenSurface(std::to_string(sides.size()) + " boundary triangles meet in the edge " +
                      edge_name(surface, edges.ends(many.first)) + ", such as " +
                      surface.triangle_name(sides[0].triangle) + " and " +
                      surface.triangle_name(sides.back().triangle) +
                      others_text(many.count, "edges") +
                      ": two bodies that touch there must be joined or moved apart");
}

void warn_of_touching_vertices(const Triangulation& surface, const SurfaceEdges& edges,
                               std::vector<Warning>& warnings) {
  UnionFind<std::int64_t> fans(3 * surface.triangles.size());  // per corner of a triangle
  const auto corner_at = [&](std::int32_t t, std::int32_t vertex) {
    const auto& vertices = surface.triangles[t].vertices;
    return 3 * std::int64_t{t} +
           (std::find(vertices.begin(), vertices.end(), vertex) - vertices.begin());
  };
  for (std::size_t e = 0; e < edges.count(); ++e) {
    const auto sides = edges.boundary_sides(e);
    for (std::size_t s = 1; s < sides.size(); ++s)
      for (const std::int32_t end : edges.ends(e))
        fans.join(corner_at(sides[0].triangle, end), corner_at(sides[s].triangle, end));
  }
  std::vector<std::int64_t> fan(surface.vertices.size(), -1);
  std::vector<char> touching(surface.vertices.size(), 0);
  std::int64_t count = 0;
  MessageText first;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if (surface.triangles[t].inner) continue;
    for (const std::int32_t v : surface.triangles[t].vertices) {
      const std::int64_t root = fans.root(corner_at(static_cast<std::int32_t>(t), v));
      if (fan[v] < 0) fan[v] = root;
      if (fan[v] == root || touching[v]) continue;
      touching[v] = 1;
      if (count++ == 0)
        first = surface.vertex_name(v) + ", as " +
                surface.triangle_name(static_cast<std::int32_t>(fan[v] / 3)) + " and " +
                surface.triangle_name(static_cast<std::int32_t>(t)) + " do";
    }
  }
  if (count == 0) return;
  warnings.emplace_back(WarningCode::surfaces_touch,
                        "boundary surfaces touch in " + first + others_text(count, "vertices"),
                        count);
}

BoxTree<3> tree_of(const Triangulation& surface) {
  std::vector<Box<3>> boxes(surface.triangles.size());
  for (std::size_t t = 0; t < boxes.size(); ++t)
    boxes[t] = surface.box(static_cast<std::int32_t>(t));
  return BoxTree<3>(std::move(boxes));
}

namespace {

using Pair = std::pair<std::int32_t, std::int32_t>;

MessageText text_of(const Triangulation& surface, const Pair& pair) {
  const auto [t, other] = pair;
  const Contact contact = contact_of(surface.corners(t), surface.corners(other));
  const char* const how = contact.kind == Contact::Kind::cross   ? " cross at "
                          : contact.kind == Contact::Kind::touch ? " touch at "
                                                                 : " lie on each other at ";
  return surface.triangle_name(t) + " and " + surface.triangle_name(other) + how +
         point_text(contact.place);
}

}  // namespace

void reject_crossings(const Triangulation& surface, const BoxTree<3>& tree, bool filled) {
  constexpr std::size_t kListed = 5;
  const auto count = static_cast<std::int32_t>(surface.triangles.size());
  std::int64_t pairs = 0;
  bool broken = false;  // whether two boundary triangles cross
  std::set<Pair> first;
  for (std::int32_t t = 0; t < count; ++t) {
    const FacetCorners<3> corners = surface.corners(t);
    tree.for_meeting(surface.box(t), [&](std::int32_t other) {
      if (other <= t) return;
      if (!triangles_meet(corners, surface.triangles[t].vertices, surface.corners(other),
                          surface.triangles[other].vertices))
        return;
      ++pairs;
      broken |= !surface.triangles[t].inner && !surface.triangles[other].inner;
      first.emplace(t, other);
      if (first.size() > kListed) first.erase(std::prev(first.end()));
    });
  }
  if (pairs == 0) return;
  MessageText message;
  for (const Pair& pair : first) message += (message.empty() ? "" : "\n") + text_of(surface, pair);
  const std::int64_t others = pairs - std::ssize(first);
  if (others > 0) message += "\nand " + std::to_string(others) + " more such pairs";
  if (broken) throw BrokenSurface(message);
  // A repair leaves inner surfaces as they are, and surfaces alone are not split.
  reject_domain(message +
                (filled ? "\nInner surfaces may meet other triangles only in common edges and "
                          "vertices: pnpbs_domain_set_fragment (in the command --fragment) divides "
                          "the triangles along the line in which they meet"
                        : "\nSurfaces alone may meet only in common edges and vertices: divide the "
                          "triangles along the line in which they meet"));
}

}  // namespace pnpbs
