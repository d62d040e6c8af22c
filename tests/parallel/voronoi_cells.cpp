// SPDX-License-Identifier: BSD-3-Clause
// Tests Voronoi cells against cells cut by brute force from a square and a cube, and their
// invariants: volumes sum up to that of the elements, the normals of the faces and the boundary of
// a cell sum up to 0, and both sides have the same face. Any number of ranks gives the bits of one.
// The test uses the public interface only. Usage: voronoi_cells
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <numeric>
#include <string>
#include <vector>

extern "C" {
#include "rank_program.h"
}
#include "parallel/brute_cells.hpp"
#include "volume_cases.h"

namespace {

using namespace brute;

// ------------------------------------------------------------------ cases ----------------------

pnpbs_status unit_square(pnpbs_domain domain, const char*) {
  const double square[] = {0, 0, 1, 0, 1, 1, 0, 1};
  return pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, square, nullptr, 0);
}
// Adds a domain with a slit narrower than the spacing, a hole, and an inner curve.
pnpbs_status slotted_plane(pnpbs_domain domain, const char*) {
  const double outline[] = {0, 0, 1, 0, 1, 1, 0.52, 1, 0.5, 0.5, 0.48, 1, 0, 1},
               hole[] = {0.2, 0.2, 0.2, 0.4, 0.4, 0.4, 0.4, 0.2}, curve[] = {0.6, 0.3, 0.9, 0.7};
  pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 7, outline, nullptr, 0);
  pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, hole, nullptr, 0);
  return pnpbs_domain_add_polyline(domain, PNPBS_INNER, 0, 2, curve, nullptr, 0);
}

// Adds a kite with an inner curve along its axis. Two nodes are mirror images at the curve and
// closer to its middle than its ends are, so the face between their cells lies in a side of
// elements.
pnpbs_status kite(pnpbs_domain domain, const char*) {
  const double outline[] = {0, 0, 2, -0.75, 4, 0, 2, 0.75}, curve[] = {0, 0, 4, 0};
  pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, outline, nullptr, 0);
  return pnpbs_domain_add_polyline(domain, PNPBS_INNER, 0, 2, curve, nullptr, 0);
}

// The properties of a case that can be checked: all of them for the unit square or cube, only
// closed cells, or only the measure.
enum class Known { everything, closed_cells, measure };
struct Case {
  const char* name;
  std::int32_t dim, steps;
  volume_body body;
  double d;
  Known known;
};
const Case kCases[] = {{"square", 2, 60, unit_square, 0.03, Known::everything},
                       {"square, as it begins", 2, 0, unit_square, 0.03, Known::everything},
                       {"slit, hole and curve", 2, 60, slotted_plane, 0.05, Known::closed_cells},
                       {"kite", 2, 0, kite, 4, Known::closed_cells},
                       {"cube", 3, 60, volume_unit_box, 0.09, Known::everything},
                       {"cube, as it begins", 3, 0, volume_unit_box, 0.09, Known::everything},
                       {"few nodes", 3, 5, volume_unit_box, 0.5, Known::closed_cells},
                       {"slotted cube", 3, 20, volume_slotted, 0.12, Known::closed_cells},
                       {"closed surface", 3, 20, surface_halves, 0.2, Known::measure},
                       {"open surface", 3, 20, surface_terrain, 0.15, Known::measure}};

pnpbs_placement placed(const Case& it, pnpbs_context in) {
  pnpbs_domain domain;
  pnpbs_placement placement;
  double finest = it.d;
  expect(pnpbs_domain_create(in, it.dim, &domain) == PNPBS_OK, "domain");
  expect(it.body(domain, nullptr) >= 0, "body");
  expect(pnpbs_placement_create(in, domain, &placement) == PNPBS_OK, "placement");
  pnpbs_placement_set_int64(placement, "steps", it.steps);
  if (it.known == Known::measure)  // surfaces around the origin
    pnpbs_placement_set_spacing_constant(placement, it.d);
  else
    pnpbs_placement_set_spacing_callback(placement, growing_spacing, &finest);
  expect(pnpbs_placement_run(placement) >= 0, "run");
  pnpbs_domain_destroy(&domain);
  return placement;
}

// ------------------------------------------------------------------ cells ----------------------

struct Face {
  std::int64_t id, number;
  double area, distance;
  Point normal;
};
struct Cell {
  Point x{}, boundary{};
  double volume = 0;
  std::vector<Face> faces;
};
using Cells = std::map<std::int64_t, Cell>;  // by id

Cells cells_of(pnpbs_placement placement, std::int32_t dim) {
  pnpbs_voronoi voronoi;
  std::int64_t n = 0, m = 0;
  std::int32_t told_dim = 0;
  expect(pnpbs_voronoi_create(placement, &voronoi) == PNPBS_OK, "cells");
  expect(pnpbs_voronoi_sizes(voronoi, &told_dim, &n, &m) == PNPBS_OK && told_dim == dim, "sizes");
  const auto nodes = static_cast<std::size_t>(n), faces = static_cast<std::size_t>(m),
             width = static_cast<std::size_t>(dim);
  std::vector<double> x(nodes * width), volumes(nodes), boundary(nodes * width), areas(faces),
      distances(faces), normals(faces * width);
  std::vector<std::int64_t> ids(nodes), offsets(nodes + 1), to(faces), numbers(faces);
  expect(
      pnpbs_placement_get_nodes(placement, n, x.data(), ids.data(), nullptr, nullptr) == PNPBS_OK,
      "nodes");
  expect(pnpbs_voronoi_get_cells(voronoi, n, volumes.data(), boundary.data()) == PNPBS_OK &&
             pnpbs_voronoi_get_faces(voronoi, n, m, offsets.data(), to.data(), numbers.data(),
                                     areas.data(), distances.data(), normals.data()) == PNPBS_OK,
         "arrays of cells");
  const auto point = [&](const std::vector<double>& from, std::size_t k) {
    Point p{};
    std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(k * width), width, p.begin());
    return p;
  };
  Cells cells;
  for (std::size_t i = 0; i < nodes; ++i) {
    Cell& cell = cells[ids[i]] = {point(x, i), point(boundary, i), volumes[i], {}};
    for (auto f = static_cast<std::size_t>(offsets[i]);
         f < static_cast<std::size_t>(offsets[i + 1]); ++f)
      cell.faces.push_back({to[f], numbers[f], areas[f], distances[f], point(normals, f)});
  }
  expect(pnpbs_voronoi_destroy(&voronoi) == PNPBS_OK && !voronoi, "destroy");
  return cells;
}

// Returns the measure of the elements, from their corners.
double measure_of_elements(pnpbs_placement placement, std::int32_t dim) {
  pnpbs_mesh mesh;
  std::int32_t corners = 0;
  std::int64_t nodes = 0, elements = 0;
  expect(pnpbs_mesh_create(placement, 0, &mesh) == PNPBS_OK, "mesh");
  pnpbs_mesh_sizes(mesh, nullptr, &corners, nullptr, &nodes, &elements, nullptr, nullptr);
  const auto width = static_cast<std::size_t>(dim), k = static_cast<std::size_t>(corners);
  std::vector<double> x(width * static_cast<std::size_t>(nodes));
  std::vector<std::int32_t> rows(k * static_cast<std::size_t>(elements));
  pnpbs_mesh_get_nodes(mesh, nodes, x.data(), nullptr, nullptr, nullptr, nullptr);
  pnpbs_mesh_get_elements(mesh, elements, rows.data(), nullptr, nullptr, nullptr);
  pnpbs_mesh_destroy(&mesh);
  const auto corner = [&](std::size_t e, std::size_t c) {
    Point p{};
    std::copy_n(x.begin() + static_cast<std::ptrdiff_t>(width) * rows[k * e + c], width, p.begin());
    return p;
  };
  double sum = 0;
  for (std::size_t e = 0; e < static_cast<std::size_t>(elements); ++e) {
    const Point a = corner(e, 1) - corner(e, 0), b = corner(e, 2) - corner(e, 0);
    sum +=
        corners == 3 ? length(cross(a, b)) / 2 : dot(cross(a, b), corner(e, 3) - corner(e, 0)) / 6;
  }
  return sum;
}

// ------------------------------------------------------------------ brute force ----------------

// Returns the `count` nodes nearest to one, without itself. These must be more than its cell has
// neighbours.
std::vector<std::int64_t> closest(const Cells& cells, std::int64_t id, std::size_t count) {
  const Point x = cells.at(id).x;
  std::vector<std::pair<double, std::int64_t>> order;
  for (const auto& [other, cell] : cells)
    if (other != id) order.push_back({length(cell.x - x), other});
  std::ranges::sort(order);
  std::vector<std::int64_t> ids;
  for (std::size_t k = 0; k < std::min(count, order.size()); ++k) ids.push_back(order[k].second);
  return ids;
}

struct Worst {
  double volume = 0, area = 0;
};

// Returns the largest deviations of cells and faces, relative to the cells' size.
Worst off_brute_force(const Cells& cells, std::int32_t dim) {
  Worst worst;
  for (const auto& [id, cell] : cells) {
    const std::vector<std::int64_t> ids = closest(cells, id, dim == 2 ? 30 : 80);
    std::vector<Point> others;
    for (const std::int64_t other : ids) others.push_back(cells.at(other).x);
    std::vector<double> areas;
    const double volume = brute_cell(cell.x, others, areas);
    worst.volume = std::max(worst.volume, std::abs(cell.volume - volume) / volume);
    std::map<std::int64_t, double> told;
    for (const Face& face : cell.faces) told[face.id] = face.area;
    const double scale = std::pow(volume, dim == 2 ? 0.5 : 2. / 3);
    for (std::size_t k = 0; k < ids.size(); ++k)
      worst.area = std::max(worst.area, std::abs(told[ids[k]] - areas[k]) / scale);
  }
  if (rank == 0) std::printf("  brute force: %.2g, %.2g\n", worst.volume, worst.area);
  return worst;
}

void check_by_brute_force(const Cells& cells, std::int32_t dim) {
  const Worst worst = off_brute_force(cells, dim);
  expect(worst.volume < 1e-11, "volumes by brute force");
  expect(worst.area < 1e-10, "areas by brute force");
}

// ------------------------------------------------------------------ invariants -----------------

void check_faces(const Cells& cells) {
  for (const auto& [id, cell] : cells) {
    std::int64_t before = -1;
    for (const Face& face : cell.faces) {
      const Cell& other = cells.at(face.id);
      const auto back = std::ranges::find(other.faces, id, &Face::id);
      expect(back != other.faces.end() && back->area == face.area &&
                 back->distance == face.distance && back->normal == -1. * face.normal,
             "the neighbour has the same face");
      expect(before < face.id, "neighbours by id");
      before = face.id;
      expect(std::abs(face.distance - length(other.x - cell.x)) <= 1e-15 &&
                 length(face.distance * face.normal - (other.x - cell.x)) <= 1e-15,
             "distance and normal");
    }
  }
}

void check_closed(const Cells& cells, std::int32_t dim) {
  double worst = 0;
  for (const auto& [id, cell] : cells) {
    Point sum = cell.boundary;
    for (const Face& face : cell.faces) sum = sum + face.area * face.normal;
    worst = std::max(worst, length(sum) / std::pow(cell.volume, dim == 2 ? 0.5 : 2. / 3));
  }
  if (rank == 0) std::printf("  closed: %.2g\n", worst);
  expect(worst < 1e-10, "faces and boundary of a cell add up to 0");
}

void check_numbers(const Cells& own) {
  std::vector<std::int64_t> ids, all(1);
  for (const auto& [id, cell] : own) ids.push_back(id);
  std::vector<int> counts(static_cast<std::size_t>(size)), starts(counts.size());
  const int count = static_cast<int>(ids.size());
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, group);
  std::exclusive_scan(counts.begin(), counts.end(), starts.begin(), 0);
  all.resize(static_cast<std::size_t>(starts.back() + counts.back()));
  MPI_Allgatherv(ids.data(), count, MPI_INT64_T, all.data(), counts.data(), starts.data(),
                 MPI_INT64_T, group);
  for (const auto& [id, cell] : own)
    for (const Face& face : cell.faces)
      expect(all.at(static_cast<std::size_t>(face.number)) == face.id, "number of a neighbour");
}

void check_bits(const Cells& own, const Cells& all) {
  for (const auto& [id, cell] : own) {
    const Cell& same = all.at(id);
    bool equal = cell.volume == same.volume && cell.boundary == same.boundary &&
                 cell.faces.size() == same.faces.size();
    for (std::size_t f = 0; equal && f < cell.faces.size(); ++f)
      equal = cell.faces[f].id == same.faces[f].id && cell.faces[f].area == same.faces[f].area;
    expect(equal, "the bits of one rank");
  }
}

void check_case(const Case& it) {
  const int before = failures;
  pnpbs_context serial;
  expect(pnpbs_context_create_serial(&serial) == PNPBS_OK, "context of one rank");
  pnpbs_placement alone = placed(it, serial);
  const Cells all = cells_of(alone, it.dim);
  double sum = 0;
  for (const auto& [id, cell] : all) sum += cell.volume;
  const double measure = measure_of_elements(alone, it.dim);
  if (rank == 0)
    std::printf("%s: %zu nodes, volume off by %.2g\n", it.name, all.size(), sum / measure - 1);
  expect(std::abs(sum / measure - 1) < 1e-13, "volumes add up to that of the elements");
  check_faces(all);
  if (it.known != Known::measure) check_closed(all, it.dim);
  if (it.known == Known::everything && rank == 0) check_by_brute_force(all, it.dim);
  pnpbs_placement_destroy(&alone);
  pnpbs_context_destroy(&serial);

  pnpbs_placement placement = placed(it, context);
  const Cells own = cells_of(placement, it.dim);
  check_numbers(own);
  check_bits(own, all);
  pnpbs_placement_destroy(&placement);
  if (failures > before) std::printf("rank %d, %s: WRONG\n", rank, it.name);
}

// ------------------------------------------------------------------ errors ---------------------

// Checks that an error on one rank is an error on all.
void check_errors() {
  pnpbs_placement placement;
  pnpbs_domain domain = unit_domain(2);
  pnpbs_voronoi voronoi;
  expect(pnpbs_placement_create(context, domain, &placement) == PNPBS_OK, "placement");
  expect(pnpbs_voronoi_create(placement, &voronoi) == PNPBS_ERROR_STATE && !voronoi,
         "no nodes yet");
  pnpbs_placement_set_spacing_constant(placement, 0.2);
  expect(pnpbs_placement_run(placement) >= 0, "run");
  if (size > 1)
    expect(pnpbs_voronoi_create(placement, rank == 1 ? nullptr : &voronoi) == PNPBS_ERROR_ARGUMENT,
           "no place for the handle");
  expect(pnpbs_voronoi_create(placement, &voronoi) == PNPBS_OK, "cells");
  std::int64_t nodes = 0, faces = 0;
  std::vector<double> room(200);
  pnpbs_voronoi_sizes(voronoi, nullptr, &nodes, &faces);
  if (nodes > 0) {
    expect(
        pnpbs_voronoi_get_cells(voronoi, nodes - 1, room.data(), nullptr) == PNPBS_ERROR_CAPACITY,
        "too small");
    expect(pnpbs_voronoi_get_faces(voronoi, nodes, faces - 1, nullptr, nullptr, nullptr,
                                   room.data(), nullptr, nullptr) == PNPBS_ERROR_CAPACITY,
           "too small for faces");
  }
  pnpbs_voronoi dead = voronoi;
  expect(pnpbs_voronoi_destroy(&voronoi) == PNPBS_OK && !voronoi &&
             pnpbs_voronoi_destroy(&voronoi) == PNPBS_OK,
         "destroy");
  expect(pnpbs_voronoi_sizes(dead, nullptr, nullptr, nullptr) == PNPBS_ERROR_HANDLE,
         "a handle that is not live");
  pnpbs_placement_destroy(&placement);
  pnpbs_domain_destroy(&domain);
}

void check_all() {
  for (const Case& it : kCases) check_case(it);
  check_errors();
}

}  // namespace

int main(int argc, char** argv) { return run_in_groups(argc, argv, check_all); }
