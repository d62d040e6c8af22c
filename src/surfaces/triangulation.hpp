// SPDX-License-Identifier: BSD-3-Clause
// The triangles of all surfaces as given, over common vertices: what the checks of a volume's
// domain look at and mend.
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

enum class SurfaceRole {
  boundary,  // closed, their normals pointing out of the domain: of a cavity, into it
  inner,     // nodes follow it, but the domain is on both sides
  by_place,  // as given: whichever of the two each triangle is where it lies
  dividing   // boundary where it bounds what its surface encloses, inner within that
};

// Adds nodes and triangles, whose corners are indices into the nodes given. A node has the tag of
// the first of its triangles.
void add_surface(BoundaryMesh<3>& mesh, SurfaceRole role, std::span<const Point<3>> nodes,
                 std::span<const std::array<std::int32_t, 3>> triangles,
                 std::span<const std::int32_t> tags);

class LevelSet;

inline constexpr double kFeatureAngle = 40;  // degrees

// A feature edge that is known as such, whatever its triangles' normals are.
struct SurfaceCrease {
  std::array<std::int32_t, 2> vertices;
  std::array<Point<3>, 2> normals;  // unit, left and right of the way from the first to the second
};

// One surface as it was added.
struct SurfaceSource {
  std::string name;  // for messages: "surface 0", "ball 1"
  SurfaceRole role = SurfaceRole::boundary;
  std::vector<Point<3>> vertices;
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::int32_t> tags;             // of the triangles
  std::shared_ptr<const LevelSet> level_set;  // whose surface it is; null of others
  bool approximates = false;                  // a curved surface that was given without triangles
  double feature_angle = kFeatureAngle;       // degrees
  std::vector<SurfaceCrease> creases;         // of a level set
  std::vector<Warning> warnings;
};

struct SurfaceTriangle {
  std::array<std::int32_t, 3> vertices;
  std::int32_t tag;
  std::int32_t source;
  std::int32_t number;  // in its source
  bool inner;
  bool by_place = false;  // whether it is inner is still to be found
  bool dividing = false;  // likewise

  void turn_around() { std::swap(vertices[1], vertices[2]); }
  bool has(std::int32_t vertex) const {
    return vertices[0] == vertex || vertices[1] == vertex || vertices[2] == vertex;
  }
};

struct Triangulation {
  struct GivenVertex {
    std::int32_t source, number;
  };

  std::vector<std::string> sources;  // their names
  std::vector<Point<3>> vertices;
  std::vector<GivenVertex> given;  // the first that was given where the vertex is
  std::vector<SurfaceTriangle> triangles;

  FacetCorners<3> corners(std::int32_t t) const;
  Box<3> box(std::int32_t t) const;

  MessageText vertex_name(std::int32_t v) const;    // "vertex 5 of surface 0 (1, 2, 3)"
  std::string triangle_name(std::int32_t t) const;  // "triangle 5 of surface 0"
};

// The triangles of all surfaces, with their vertices one after the other.
Triangulation join_surfaces(const std::vector<SurfaceSource>& surfaces);

}  // namespace pnpbs
