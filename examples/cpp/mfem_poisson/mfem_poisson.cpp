// SPDX-License-Identifier: BSD-3-Clause
//
// Solves -Laplace u = f with a known solution by linear finite elements in MFEM, on meshes that are
// distributed from the start. A second solve uses nodes whose spacing is adapted to f. The domains
// are a square with a hole and a box with a cavity, or the domain of a file.
//
//   mfem_poisson [FILE.poly|FILE.stl SPACING]
#include <mpi.h>
#include <pnpbs/pnpbs_mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <mfem.hpp>
#include <string>
#include <utility>
#include <vector>

#include "pnpbs_mfem.h"

using pnpbs_mfem::check;

enum { OUTSIDE = 1, HOLE = 2, BODY = 3 };

// The known solution u = 1 / (1 + r^2), where r is the distance from `centre` over `length`.
struct Peak {
  int dim;
  double centre[3], length;

  double square_of_r(const double* x) const {
    double sum = 0;
    for (int k = 0; k < dim; ++k) sum += (x[k] - centre[k]) * (x[k] - centre[k]);
    return sum / (length * length);
  }

  double value(const double* x) const { return 1 / (1 + square_of_r(x)); }

  // Returns f = -Laplace u.
  double load(const double* x) const {
    const double r2 = square_of_r(x), one = 1 + r2;
    return (2 * dim / (one * one) - 8 * r2 / (one * one * one)) / (length * length);
  }
};

// Solves the problem and returns the error in the L2 norm. u is known on the whole boundary. The
// conductivity is 1 in the elements with this attribute and 0 elsewhere. Collective.
double solve(mfem::ParMesh& mesh, const Peak& peak, int attribute) {
  mfem::FunctionCoefficient exact([&](const mfem::Vector& x) { return peak.value(x.GetData()); });
  mfem::FunctionCoefficient load([&](const mfem::Vector& x) { return peak.load(x.GetData()); });
  mfem::Vector conductivities(mesh.attributes.Max());
  conductivities = 0.;
  conductivities(attribute - 1) = 1;
  mfem::PWConstCoefficient conductivity(conductivities);

  const mfem::H1_FECollection linear(1, mesh.Dimension());
  mfem::ParFiniteElementSpace space(&mesh, &linear);
  mfem::Array<int> everywhere(mesh.bdr_attributes.Max()), fixed;
  everywhere = 1;
  space.GetEssentialTrueDofs(everywhere, fixed);
  mfem::ParGridFunction u(&space);
  u = 0.;
  u.ProjectBdrCoefficient(exact, everywhere);

  mfem::ParBilinearForm stiffness(&space);
  stiffness.AddDomainIntegrator(new mfem::DiffusionIntegrator(conductivity));
  stiffness.Assemble();
  mfem::ParLinearForm right(&space);
  right.AddDomainIntegrator(new mfem::DomainLFIntegrator(load, 2, 3));
  right.Assemble();
  mfem::HypreParMatrix matrix;
  mfem::Vector x, b;
  stiffness.FormLinearSystem(fixed, u, right, matrix, x, b);

  mfem::HypreSmoother jacobi(matrix, mfem::HypreSmoother::Jacobi);
  mfem::CGSolver solver(mesh.GetComm());
  solver.SetRelTol(1e-12);
  solver.SetMaxIter(10000);
  solver.SetOperator(matrix);
  solver.SetPreconditioner(jacobi);
  solver.Mult(b, x);
  stiffness.RecoverFEMSolution(x, right, u);
  return u.ComputeL2Error(exact);
}

// Reduces the spacing where f is large, by a factor of up to three, because the error of linear
// elements is about |f| d^2. f is evaluated at the vertices of the mesh and sent to the nodes of
// the placement. Collective.
void adapt(pnpbs_placement placement, const mfem::ParMesh& mesh, const pnpbs_mfem::NodeMap& nodes,
           const Peak& peak) {
  std::vector<double> at_vertices(mesh.GetNV());
  for (int v = 0; v < mesh.GetNV(); ++v) at_vertices[v] = std::abs(peak.load(mesh.GetVertex(v)));
  int64_t n = 0;
  check(pnpbs_placement_count(placement, &n));
  std::vector<double> loads(n), d(n);
  nodes.to_nodes(at_vertices.data(), loads.data());
  double largest = 0;
  for (const double load : loads) largest = std::max(largest, load);
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, mesh.GetComm());
  check(pnpbs_placement_get_nodes(placement, n, nullptr, nullptr, nullptr, d.data()));
  for (int64_t i = 0; i < n; ++i) d[i] /= std::max(1., 3 * std::sqrt(loads[i] / largest));
  check(pnpbs_placement_set_spacing_at_nodes(placement, n, d.data()));
}

// Places nodes and solves twice, with the constant spacing d and with an adapted one. Returns both
// errors. Collective.
std::pair<double, double> run(pnpbs_context context, pnpbs_domain domain, const Peak& peak,
                              double d, int attribute) {
  double errors[2];
  pnpbs_placement placement;
  check(pnpbs_placement_create(context, domain, &placement));
  check(pnpbs_placement_set_spacing_constant(placement, d));
  for (int k = 0; k < 2; ++k) {
    check(pnpbs_placement_run(placement));
    pnpbs_mesh mesh;
    int64_t count = 0;
    check(pnpbs_mesh_create(placement, 1, &mesh));
    check(pnpbs_mesh_numbering(mesh, nullptr, &count, nullptr, nullptr));
    const auto made = pnpbs_mfem::make_mesh(mesh, MPI_COMM_WORLD);
    check(pnpbs_mesh_destroy(&mesh));
    errors[k] = solve(*made.mesh, peak, attribute);
    if (mfem::Mpi::Root())
      std::cout << peak.dim << " dimensions, " << (k == 0 ? "constant spacing" : "adapted") << ": "
                << count << " nodes, error " << errors[k] << std::endl;
    if (k == 0) adapt(placement, *made.mesh, made.nodes, peak);
  }
  check(pnpbs_placement_destroy(&placement));
  return {errors[0], errors[1]};
}

void square_and_box(pnpbs_context context) {
  const double square[] = {0, 0, 1, 0, 1, 1, 0, 1}, low[] = {0, 0, 0}, high[] = {1, 1, 1},
               centre[] = {0.3, 0.35, 0.5}, within[] = {0.7, 0.6, 0.5};
  pnpbs_domain plane, space;
  check(pnpbs_domain_create(context, 2, &plane));
  check(pnpbs_domain_add_polyline(plane, PNPBS_BOUNDARY, 1, 4, square, nullptr, OUTSIDE));
  check(pnpbs_domain_add_arc(plane, PNPBS_BOUNDARY, centre, 0.2, 0, 2 * std::acos(-1.), HOLE));
  check(pnpbs_domain_add_region(plane, within, BODY));
  const auto in_plane = run(context, plane, {2, {0.7, 0.6, 0}, 0.1}, 0.03, BODY);
  check(pnpbs_domain_destroy(&plane));

  check(pnpbs_domain_create(context, 3, &space));
  check(pnpbs_domain_add_box(space, low, high, OUTSIDE));
  check(pnpbs_domain_add_ball(space, centre, 0.2, HOLE));
  check(pnpbs_domain_add_region(space, within, BODY));
  const auto in_space = run(context, space, {3, {0.7, 0.6, 0.5}, 0.2}, 0.1, BODY);
  check(pnpbs_domain_destroy(&space));
  if (mfem::Mpi::Root())
    std::cout << "error in the plane: " << in_plane.second << ", expected at most "
              << in_plane.first << "\nerror in space: " << in_space.second << ", expected at most "
              << in_space.first << std::endl;
}

// Solves in the domain of a file. The peak of u lies in the middle of the bounding box and has the
// length of ten spacings. The elements have no tags, so their attribute is 1.
void domain_of_file(pnpbs_context context, const char* path, double d) {
  const int dim = std::string(path).find(".poly") != std::string::npos ? 2 : 3;
  double low[3], high[3];
  pnpbs_domain domain;
  check(pnpbs_domain_create(context, dim, &domain));
  if (dim == 2)
    check(pnpbs_domain_read_poly(domain, path));
  else
    check(pnpbs_domain_read_surface(domain, PNPBS_BOUNDARY, path, 40));
  check(pnpbs_domain_bounds(domain, low, high));
  Peak peak{dim, {0, 0, 0}, 10 * d};
  for (int k = 0; k < dim; ++k) peak.centre[k] = (low[k] + high[k]) / 2;
  run(context, domain, peak, d, 1);
  check(pnpbs_domain_destroy(&domain));
}

int main(int argc, char** argv) {
  mfem::Mpi::Init(argc, argv);
  mfem::Hypre::Init();
  try {
    pnpbs_context context;
    check(pnpbs_context_create_mpi(MPI_COMM_WORLD, &context));
    if (argc < 3)
      square_and_box(context);
    else
      domain_of_file(context, argv[1], std::atof(argv[2]));
    check(pnpbs_context_destroy(&context));
  } catch (const std::exception& error) {
    std::cerr << error.what() << std::endl;
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
  return 0;
}
