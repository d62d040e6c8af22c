// SPDX-License-Identifier: BSD-3-Clause
//
// A random body as data: surfaces, solids of a level set, or curves in the plane, in units of the
// spacing, and the frame that rotates, scales and shifts it.
#pragma once

#include <pnpbs/pnpbs.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "random.hpp"

namespace hunt {

using Point = std::array<double, 3>;

Point operator+(const Point& a, const Point& b);
Point operator-(const Point& a, const Point& b);
Point operator*(double factor, const Point& a);
double dot(const Point& a, const Point& b);
Point cross(const Point& a, const Point& b);
double length(const Point& a);
Point unit(const Point& a);

/** A coordinate frame: x becomes scale * (rotation x) + offset. */
struct Frame {
  std::array<Point, 3> rotation{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  // its rows
  double scale = 1;
  Point offset{0, 0, 0};

  Point to_world(const Point& x) const;
  Point to_body(const Point& x) const;
};

struct Mesh {
  std::vector<Point> points;
  std::vector<std::array<std::int64_t, 3>> triangles;
  std::vector<std::int32_t> tags;  // empty: all 1
  std::int32_t role = PNPBS_BOUNDARY;
};

/** A capsule (or ball) or a box of a level set, rounded or not, added or subtracted. */
struct Solid {
  bool is_box = false, taken_away = false;
  Point a{}, b{};  // ends of a capsule, or corners of a box
  double radius = 0;
};

struct Curve {
  std::vector<std::array<double, 2>> points;
  bool closed = true;
  std::int32_t role = PNPBS_BOUNDARY;
  double corner_angle = 0;
};

struct Body {
  int dim = 3;
  std::string name;
  bool filled = true;
  std::vector<Mesh> meshes;
  std::vector<Solid> solids;
  double resolution = 0.5;
  std::vector<Curve> curves;
  std::vector<Point> fixed;
  std::string file;
  // Primitives of the library, aligned with the coordinate axes.
  std::vector<std::array<Point, 2>> boxes;
  std::vector<std::array<Point, 2>> cylinders;
  std::vector<double> radii;  // of the cylinders
  Frame frame;
  Point low{}, high{};  // bounding box in its own coordinates
};

/** Adds the body to a domain. The body must outlive the placements in it. */
pnpbs_status add(const Body& body, pnpbs_domain domain);

/** Returns a level-set function in the body's own coordinates, negative inside the solids. */
double level_of(const Body& body, const Point& x);

/** Estimates the number of nodes at spacing 1 from area and volume. */
double nodes_of(double area, double volume);
double area_of(const Mesh& mesh);
double volume_of(const Mesh& mesh);
/** Scales the mesh so that it has about this number of nodes at spacing 1. */
void scale_to(Mesh& mesh, double nodes);
/** Cuts every triangle in four, `times` times. */
void refine(Mesh& mesh, int times);

// The following functions return random bodies of one kind with about `nodes` nodes at spacing 1.
Body random_tube(Random& random, double nodes);
Body random_profile(Random& random, double nodes);
Body random_scan(Random& random, double nodes);
Body random_level_set(Random& random, double nodes);
Body random_blocks(Random& random, double nodes);
Body random_plane_body(Random& random, double nodes);
Body random_file(Random& random, const std::vector<std::string>& files);

/** Returns the body that a file describes. Throws std::runtime_error if the file cannot be read. */
Body file_body(const std::string& path);

/** Returns a body of a random kind in a random frame. */
Body random_body(Random& random, int dim, double nodes, const std::vector<std::string>& files);

/** Returns a closed curve in the plane for profiles and channels: L, T, H, U, combs, plates. */
std::vector<std::array<double, 2>> random_outline(Random& random, double wall, std::string& name);

}  // namespace hunt
