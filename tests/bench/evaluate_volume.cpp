// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate_volume.hpp"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

namespace pnpbs_bench {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<std::int64_t, Kernel>;
// The cell info is whether the cell belongs to the body.
using CellBase =
    CGAL::Triangulation_cell_base_with_info_3<bool, Kernel,
                                              CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;
using Structure = CGAL::Triangulation_data_structure_3<VertexBase, CellBase>;
using Triangulation = CGAL::Delaunay_triangulation_3<Kernel, Structure>;
using Cell = Triangulation::Cell_handle;

Triangulation triangulate(const std::vector<Place>& nodes) {
  std::vector<std::pair<Kernel::Point_3, std::int64_t>> points;
  for (const auto& x : nodes)
    points.emplace_back(Kernel::Point_3(x[0], x[1], x[2]), std::ssize(points));
  return Triangulation(points.begin(), points.end());
}

TetrahedronOfNodes sorted_corners(const Cell& cell) {
  TetrahedronOfNodes corners{};
  for (int k = 0; k < 4; ++k) corners[static_cast<std::size_t>(k)] = cell->vertex(k)->info();
  std::sort(corners.begin(), corners.end());
  return corners;
}

int boundary_corners(const Cell& cell, const std::vector<char>& on_boundary) {
  int corners = 0;
  for (int k = 0; k < 4; ++k)
    corners += on_boundary[static_cast<std::size_t>(cell->vertex(k)->info())];
  return corners;
}

bool centroid_inside(const Cell& cell, const Inside& inside) {
  Place middle{};
  for (int k = 0; k < 4; ++k)
    for (int axis = 0; axis < 3; ++axis)
      middle[static_cast<std::size_t>(axis)] += 0.25 * cell->vertex(k)->point()[axis];
  return inside(middle);
}

// Returns whether the volume is below a sixth of that of the regular tetrahedron with the same
// longest edge.
bool flat(const Cell& cell) {
  double longest = 0;
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < a; ++b)
      longest = std::max(
          longest, CGAL::squared_distance(cell->vertex(a)->point(), cell->vertex(b)->point()));
  const double volume = CGAL::volume(cell->vertex(0)->point(), cell->vertex(1)->point(),
                                     cell->vertex(2)->point(), cell->vertex(3)->point());
  return std::fabs(volume) < 0.02 * longest * std::sqrt(longest);
}

bool open(const Cell& cell) {
  for (int k = 0; k < 4; ++k)
    if (!cell->neighbor(k)->info()) return true;
  return false;
}

// Peels flat cells off the boundary. The result does not depend on the order, since an open cell
// stays open.
void peel(const Triangulation& t, const std::vector<char>& on_boundary) {
  std::vector<Cell> in_question;
  for (const Cell cell : t.finite_cell_handles())
    if (cell->info()) in_question.push_back(cell);
  while (!in_question.empty()) {
    const Cell cell = in_question.back();
    in_question.pop_back();
    if (!cell->info() || boundary_corners(cell, on_boundary) < 4 || !open(cell) || !flat(cell))
      continue;
    cell->info() = false;
    for (int k = 0; k < 4; ++k) in_question.push_back(cell->neighbor(k));
  }
}

}  // namespace

std::vector<TetrahedronOfNodes> reference_tetrahedra(const std::vector<Place>& nodes) {
  const Triangulation triangulation = triangulate(nodes);
  std::vector<TetrahedronOfNodes> tetrahedra;
  for (const Cell cell : triangulation.finite_cell_handles())
    tetrahedra.push_back(sorted_corners(cell));
  return tetrahedra;
}

BodyMesh reference_mesh(const std::vector<Place>& nodes, const std::vector<char>& on_boundary,
                        const Inside& inside) {
  const Triangulation t = triangulate(nodes);
  for (const Cell cell : t.all_cell_handles())
    cell->info() = !t.is_infinite(cell) && centroid_inside(cell, inside);
  peel(t, on_boundary);
  BodyMesh mesh;
  for (const Cell cell : t.finite_cell_handles()) {
    if (!cell->info()) continue;
    mesh.tetrahedra.push_back(sorted_corners(cell));
    for (int k = 0; k < 4; ++k) {
      if (cell->neighbor(k)->info()) continue;
      TriangleOfNodes face{cell->vertex((k + 1) % 4)->info(), cell->vertex((k + 2) % 4)->info(),
                           cell->vertex((k + 3) % 4)->info()};
      std::sort(face.begin(), face.end());
      mesh.boundary.push_back(face);
    }
  }
  return mesh;
}

Inside inside_of_file(const std::string& path) {
  using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
  using Primitive = CGAL::AABB_face_graph_triangle_primitive<Surface>;
  using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
  struct Body {
    Surface surface;
    Tree tree;
  };
  namespace processing = CGAL::Polygon_mesh_processing;
  std::vector<Kernel::Point_3> points;
  std::vector<std::vector<std::size_t>> triangles;
  if (!CGAL::IO::read_polygon_soup(path, points, triangles))
    throw std::runtime_error(path + " cannot be read");
  processing::repair_polygon_soup(points, triangles);
  processing::orient_polygon_soup(points, triangles);
  const auto body = std::make_shared<Body>();
  processing::polygon_soup_to_polygon_mesh(points, triangles, body->surface);
  if (!CGAL::is_closed(body->surface)) throw std::runtime_error(path + " is not closed");
  body->tree.insert(faces(body->surface).first, faces(body->surface).second, body->surface);
  body->tree.build();
  const auto side = std::make_shared<CGAL::Side_of_triangle_mesh<Surface, Kernel>>(body->tree);
  return [body, side](const Place& x) {
    return (*side)(Kernel::Point_3(x[0], x[1], x[2])) != CGAL::ON_UNBOUNDED_SIDE;
  };
}

}  // namespace pnpbs_bench
