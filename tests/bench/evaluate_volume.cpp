// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate_volume.hpp"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <utility>

namespace pnpbs_bench {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<std::int64_t, Kernel>;
using Structure = CGAL::Triangulation_data_structure_3<VertexBase>;
using Triangulation = CGAL::Delaunay_triangulation_3<Kernel, Structure>;

}  // namespace

std::vector<std::array<std::int64_t, 4>> reference_tetrahedra(
    const std::vector<std::array<double, 3>>& nodes) {
  std::vector<std::pair<Kernel::Point_3, std::int64_t>> points;
  for (const auto& x : nodes)
    points.emplace_back(Kernel::Point_3(x[0], x[1], x[2]), std::ssize(points));
  const Triangulation triangulation(points.begin(), points.end());
  std::vector<std::array<std::int64_t, 4>> tetrahedra;
  for (const auto cell : triangulation.finite_cell_handles()) {
    std::array<std::int64_t, 4> corners{};
    for (int k = 0; k < 4; ++k) corners[static_cast<std::size_t>(k)] = cell->vertex(k)->info();
    std::sort(corners.begin(), corners.end());
    tetrahedra.push_back(corners);
  }
  return tetrahedra;
}

}  // namespace pnpbs_bench
