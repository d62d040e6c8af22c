// SPDX-License-Identifier: BSD-3-Clause
// The triangles of all surfaces of a domain in space over common vertices. The checks of the domain
// examine and repair them.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/warning.hpp"
#include "geometry/boundary_mesh.hpp"

namespace pnpbs {

// How a surface relates to the domain.
enum class SurfaceRole {
  boundary,  // closed, with normals out of the domain (at a cavity into it)
  inner,     // nodes lie on it, and the domain is on both sides
  by_place,  // boundary or inner, depending on where each triangle lies
  dividing   // boundary at the outside of what the surface encloses, else inner
};

// Adds nodes and triangles to a mesh. Corners of triangles are indices into `nodes`. A node has the
// tag of its first triangle.
void add_surface(BoundaryMesh<3>& mesh, SurfaceRole role, std::span<const Point<3>> nodes,
                 std::span<const std::array<std::int32_t, 3>> triangles,
                 std::span<const std::int32_t> tags);

class LevelSet;

// Default angle between normals at feature edges [degrees]
inline constexpr double kFeatureAngle = 40;

// An edge that is a feature whatever the normals of its triangles are.
struct SurfaceCrease {
  std::array<std::int32_t, 2> vertices;
  std::array<Point<3>, 2> normals;  // unit; left and right of the direction from the first vertex
};

// Tags of triangles with their names, such as those of the solids in a file.
using TagNameList = std::vector<std::pair<std::int32_t, std::string>>;

// A surface as it was added.
struct SurfaceSource {
  std::string name;  // for messages, such as "surface 0" or "ball 1"
  SurfaceRole role = SurfaceRole::boundary;
  std::vector<Point<3>> vertices;
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::int32_t> tags;             // per triangle
  TagNameList tag_names;                      // for messages
  std::shared_ptr<const LevelSet> level_set;  // the level set of this surface, or null
  bool approximates = false;  // true for curved surfaces that were not given as triangles
  bool is_ball = false;       // true for those of ball_surface()
  double feature_angle = kFeatureAngle;  // [degrees]
  std::vector<SurfaceCrease> creases;    // creases of a level set
  std::vector<Warning> warnings;
  // Numbers as the user gave them, for messages. If empty, indices are the numbers.
  std::vector<std::int32_t> vertex_numbers, triangle_numbers;
};

// A triangle of any source.
struct SurfaceTriangle {
  std::array<std::int32_t, 3> vertices;
  std::int32_t tag;
  std::int32_t source;
  std::int32_t number;  // in its source
  bool inner;
  bool by_place = false;  // true if `inner` is still to be determined by place
  bool dividing = false;  // true if `inner` is still to be determined for a dividing surface

  void turn_around() { std::swap(vertices[1], vertices[2]); }
  bool has(std::int32_t vertex) const {
    return vertices[0] == vertex || vertices[1] == vertex || vertices[2] == vertex;
  }
};

// Returns whether two triangles with the same vertices have the same orientation.
inline bool same_turn(const std::array<std::int32_t, 3>& a, const std::array<std::int32_t, 3>& b) {
  const std::size_t k = b[0] == a[0] ? 0 : b[1] == a[0] ? 1 : 2;
  return b[(k + 1) % 3] == a[1];
}

// Triangles of several sources, over common vertices.
struct Triangulation {
  // The first vertex that was given at a position; -1 for intersections of triangles.
  struct GivenVertex {
    std::int32_t source, number;
  };

  std::vector<std::string> sources;    // names of the sources
  std::vector<TagNameList> tag_names;  // per source
  std::vector<Point<3>> vertices;
  std::vector<GivenVertex> given;  // per vertex
  std::vector<SurfaceTriangle> triangles;

  FacetCorners<3> corners(std::int32_t t) const;
  Box<3> box(std::int32_t t) const;

  MessageText vertex_name(std::int32_t v) const;    // such as "vertex 5 of surface 0 (1, 2, 3)"
  std::string triangle_name(std::int32_t t) const;  // such as "triangle 5 of surface 0 'wing'"
  std::string group_name(std::int32_t t) const;     // such as "surface 0 'wing'"
};

// Joins the triangles of all surfaces. Vertices are numbered consecutively and not yet welded.
Triangulation join_surfaces(const std::vector<SurfaceSource>& surfaces);

}  // namespace pnpbs
