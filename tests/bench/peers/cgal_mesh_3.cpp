// SPDX-License-Identifier: BSD-3-Clause
// pnpbs-cgal-mesh-3: CGAL's Mesh_3 as a command that the comparison of bodies runs like any other
// tool.
//   pnpbs-cgal-mesh-3 IN.off OUT.node OUT.ele EDGE FACET CELL DISTANCE ANGLE
// EDGE is the largest length of feature edges, FACET and CELL are the largest circumradii, DISTANCE
// is the largest distance of triangles from the surface, and ANGLE in degrees makes an edge a
// feature. CGAL optimises with its defaults (perturb, exude). Prints the seconds without files.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_polyhedron_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Polyhedral_mesh_domain_with_features_3.h>
#include <CGAL/make_mesh_3.h>
#include <CGAL/version.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <vector>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Polyhedron = CGAL::Mesh_polyhedron_3<Kernel>::type;
using Domain = CGAL::Polyhedral_mesh_domain_with_features_3<Kernel>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation, Domain::Corner_index,
                                                        Domain::Curve_index>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;

Polyhedron read(const char* path) {
  std::ifstream file(path);
  Polyhedron body;
  if (!(file >> body) || body.empty() || !body.is_closed())
    throw std::runtime_error("not a closed surface of triangles");
  return body;
}

Complex mesh(const Polyhedron& body, char** sizes) {
  namespace given = CGAL::parameters;
  Domain domain(body);
  domain.detect_features(std::atof(sizes[4]));
  const Criteria criteria(
      given::edge_size = std::atof(sizes[0]), given::facet_angle = 25,
      given::facet_size = std::atof(sizes[1]), given::facet_distance = std::atof(sizes[3]),
      given::cell_radius_edge_ratio = 2, given::cell_size = std::atof(sizes[2]));
  return CGAL::make_mesh_3<Complex>(domain, criteria, given::manifold());
}

void write(const Complex& complex, const char* nodes, const char* elements) {
  std::unordered_map<Triangulation::Vertex_handle, std::size_t> number;
  std::vector<Triangulation::Vertex_handle> vertices;
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end(); ++cell)
    for (int k = 0; k < 4; ++k)
      if (number.emplace(cell->vertex(k), vertices.size() + 1).second)
        vertices.push_back(cell->vertex(k));
  std::ofstream node(nodes), element(elements);
  node.precision(17);
  node << vertices.size() << " 3 0 0\n";
  for (const auto& vertex : vertices)
    node << number.at(vertex) << " " << vertex->point().point() << "\n";
  element << complex.number_of_cells_in_complex() << " 4 0\n";
  std::size_t k = 0;
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end();
       ++cell) {
    element << ++k;
    for (int corner = 0; corner < 4; ++corner) element << " " << number.at(cell->vertex(corner));
    element << "\n";
  }
}

}  // namespace

int main(int count, char** words) {
  if (count == 2 && std::string(words[1]) == "--version") {
    std::printf("CGAL %s\n", CGAL_VERSION_STR);
    return 0;
  }
  if (count != 9) {
    std::fprintf(
        stderr,
        "usage: pnpbs-cgal-mesh-3 IN.off OUT.node OUT.ele EDGE FACET CELL DISTANCE ANGLE\n");
    return 2;
  }
  try {
    const Polyhedron body = read(words[1]);
    const auto begin = std::chrono::steady_clock::now();
    const Complex complex = mesh(body, words + 4);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    write(complex, words[2], words[3]);
    std::printf("seconds %.6f\n", seconds.count());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pnpbs-cgal-mesh-3: %s\n", error.what());
    return 1;
  }
  return 0;
}
