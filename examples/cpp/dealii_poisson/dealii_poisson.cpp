// SPDX-License-Identifier: BSD-3-Clause
//
// Solves -Laplace u = f with a known solution by linear finite elements in deal.II, on meshes that
// are distributed from the start. A second solve uses nodes whose spacing is adapted to f. The
// domains are a square with a hole and a box with a cavity, or the domain of a file.
//
//   dealii_poisson [FILE.poly|FILE.stl SPACING]
#include <deal.II/base/conditional_ostream.h>
#include <deal.II/base/function.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/la_parallel_vector.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/sparsity_tools.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/vector.h>
#include <deal.II/numerics/vector_tools.h>
#include <pnpbs/pnpbs_mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "pnpbs_dealii.h"

using namespace dealii;
using pnpbs_dealii::check;
template <int dim>
using Mesh = parallel::fullydistributed::Triangulation<dim>;
using Field = LinearAlgebra::distributed::Vector<double>;

enum { OUTSIDE = 1, HOLE = 2 };

// The known solution u = 1 / (1 + r^2), where r is the distance from `centre` over `length`.
template <int dim>
struct Peak : Function<dim> {
  Point<dim> centre;
  double length;

  Peak(const Point<dim>& centre, double length) : centre(centre), length(length) {}

  double value(const Point<dim>& x, const unsigned int = 0) const override {
    return 1 / (1 + x.distance_square(centre) / (length * length));
  }

  // Returns f = -Laplace u.
  double load(const Point<dim>& x) const {
    const double r2 = x.distance_square(centre) / (length * length), one = 1 + r2;
    return (2 * dim / (one * one) - 8 * r2 / (one * one * one)) / (length * length);
  }
};

// Linear elements on a mesh, with their degrees of freedom and quadrature.
template <int dim>
struct Elements {
  const FE_SimplexP<dim> element{1};
  const MappingFE<dim> mapping{element};
  const QGaussSimplex<dim> quadrature{3};
  DoFHandler<dim> dofs;
  IndexSet relevant;
  const MPI_Comm comm = MPI_COMM_WORLD;

  explicit Elements(const Mesh<dim>& mesh) : dofs(mesh) {
    dofs.distribute_dofs(element);
    DoFTools::extract_locally_relevant_dofs(dofs, relevant);
  }
};

// Returns constraints that set u to the known solution on the whole boundary. The faces where the
// ghost cells end are no boundary.
template <int dim>
AffineConstraints<double> boundary_values(const Elements<dim>& fem, const Peak<dim>& peak) {
  AffineConstraints<double> constraints(fem.relevant);
  std::map<types::boundary_id, const Function<dim>*> functions;
  for (const auto id : fem.dofs.get_triangulation().get_boundary_ids())
    if (id != pnpbs_dealii::end_of_ghosts) functions[id] = &peak;
  VectorTools::interpolate_boundary_values(fem.mapping, fem.dofs, functions, constraints);
  constraints.close();
  return constraints;
}

// Assembles matrix and right-hand side from the cells that this rank owns. Collective.
template <int dim>
void assemble(const Elements<dim>& fem, const Peak<dim>& peak,
              const AffineConstraints<double>& constraints, TrilinosWrappers::SparseMatrix& matrix,
              Field& right) {
  FEValues<dim> values(
      fem.mapping, fem.element, fem.quadrature,
      update_values | update_gradients | update_quadrature_points | update_JxW_values);
  const unsigned int n = fem.element.n_dofs_per_cell();
  FullMatrix<double> stiffness(n, n);
  Vector<double> load(n);
  std::vector<types::global_dof_index> indices(n);
  for (const auto& cell : fem.dofs.active_cell_iterators()) {
    if (!cell->is_locally_owned()) continue;
    values.reinit(cell);
    stiffness = 0;
    load = 0;
    for (const unsigned int q : values.quadrature_point_indices()) {
      const double f = peak.load(values.quadrature_point(q));
      for (unsigned int i = 0; i < n; ++i) {
        load(i) += f * values.shape_value(i, q) * values.JxW(q);
        for (unsigned int j = 0; j < n; ++j)
          stiffness(i, j) += values.shape_grad(i, q) * values.shape_grad(j, q) * values.JxW(q);
      }
    }
    cell->get_dof_indices(indices);
    constraints.distribute_local_to_global(stiffness, load, indices, matrix, right);
  }
  matrix.compress(VectorOperation::add);
  right.compress(VectorOperation::add);
}

// Solves the problem and returns the error in the L2 norm. Collective.
template <int dim>
double solve(const Mesh<dim>& mesh, const Peak<dim>& peak) {
  const Elements<dim> fem(mesh);
  const IndexSet& owned = fem.dofs.locally_owned_dofs();
  const AffineConstraints<double> constraints = boundary_values(fem, peak);
  DynamicSparsityPattern pattern(fem.relevant);
  DoFTools::make_sparsity_pattern(fem.dofs, pattern, constraints, false);
  SparsityTools::distribute_sparsity_pattern(pattern, owned, fem.comm, fem.relevant);
  TrilinosWrappers::SparseMatrix matrix;
  matrix.reinit(owned, owned, pattern, fem.comm);
  Field right(owned, fem.relevant, fem.comm), u(owned, fem.relevant, fem.comm);
  assemble(fem, peak, constraints, matrix, right);

  TrilinosWrappers::PreconditionSSOR preconditioner;
  preconditioner.initialize(matrix);
  SolverControl control(10000, 1e-12 * right.l2_norm());
  SolverCG<Field>(control).solve(matrix, u, right, preconditioner);
  constraints.distribute(u);
  u.update_ghost_values();

  Vector<double> errors(mesh.n_active_cells());
  VectorTools::integrate_difference(fem.mapping, fem.dofs, u, peak, errors, fem.quadrature,
                                    VectorTools::L2_norm);
  return VectorTools::compute_global_error(mesh, errors, VectorTools::L2_norm);
}

// Reduces the spacing where f is large, by a factor of up to three, because the error of linear
// elements is about |f| d^2. f is evaluated at the vertices of the triangulation and sent to the
// nodes of the placement. Collective.
template <int dim>
void adapt(pnpbs_placement placement, const Mesh<dim>& mesh, const pnpbs_dealii::NodeMap& nodes,
           const Peak<dim>& peak) {
  Field load(nodes.partitioner);
  for (const auto& cell : mesh.active_cell_iterators())
    if (!cell->is_artificial())
      for (const unsigned int v : cell->vertex_indices())
        load(nodes.number_at_vertex[cell->vertex_index(v)]) = std::abs(peak.load(cell->vertex(v)));
  load.compress(VectorOperation::max);
  const double largest = load.linfty_norm();
  std::vector<double> d(nodes.partitioner->locally_owned_size());
  check(pnpbs_placement_get_nodes(placement, d.size(), nullptr, nullptr, nullptr, d.data()));
  for (std::size_t i = 0; i < d.size(); ++i)
    d[i] /= std::max(1., 3 * std::sqrt(load.local_element(i) / largest));
  check(pnpbs_placement_set_spacing_at_nodes(placement, d.size(), d.data()));
}

// Places nodes and solves twice, with the constant spacing d and with an adapted one. Returns both
// errors. Collective.
template <int dim>
std::pair<double, double> run(pnpbs_context context, pnpbs_domain domain, const Peak<dim>& peak,
                              double d) {
  ConditionalOStream out(std::cout, Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0);
  double errors[2];
  pnpbs_placement placement;
  check(pnpbs_placement_create(context, domain, &placement));
  check(pnpbs_placement_set_spacing_constant(placement, d));
  for (int k = 0; k < 2; ++k) {
    check(pnpbs_placement_run(placement));
    pnpbs_mesh mesh;
    check(pnpbs_mesh_create(placement, 1, &mesh));
    Mesh<dim> triangulation(MPI_COMM_WORLD);
    const auto nodes = pnpbs_dealii::make_triangulation(mesh, triangulation);
    check(pnpbs_mesh_destroy(&mesh));
    errors[k] = solve(triangulation, peak);
    out << dim << " dimensions, " << (k == 0 ? "constant spacing" : "adapted") << ": "
        << nodes.partitioner->size() << " nodes, error " << errors[k] << std::endl;
    if (k == 0) adapt(placement, triangulation, nodes, peak);
  }
  check(pnpbs_placement_destroy(&placement));
  return {errors[0], errors[1]};
}

void square_and_box(pnpbs_context context) {
  ConditionalOStream out(std::cout, Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0);
  const double square[] = {0, 0, 1, 0, 1, 1, 0, 1}, low[] = {0, 0, 0}, high[] = {1, 1, 1},
               centre[] = {0.3, 0.35, 0.5};
  pnpbs_domain plane, space;
  check(pnpbs_domain_create(context, 2, &plane));
  check(pnpbs_domain_add_polyline(plane, PNPBS_BOUNDARY, 1, 4, square, nullptr, OUTSIDE));
  check(pnpbs_domain_add_arc(plane, PNPBS_BOUNDARY, centre, 0.2, 0, 2 * numbers::PI, HOLE));
  const auto in_plane = run(context, plane, Peak<2>({0.7, 0.6}, 0.1), 0.03);
  check(pnpbs_domain_destroy(&plane));

  check(pnpbs_domain_create(context, 3, &space));
  check(pnpbs_domain_add_box(space, low, high, OUTSIDE));
  check(pnpbs_domain_add_ball(space, centre, 0.2, HOLE));
  const auto in_space = run(context, space, Peak<3>({0.7, 0.6, 0.5}, 0.2), 0.1);
  check(pnpbs_domain_destroy(&space));
  out << "error in the plane: " << in_plane.second << ", expected at most " << in_plane.first
      << "\nerror in space: " << in_space.second << ", expected at most " << in_space.first
      << std::endl;
}

// Solves in the domain of a file. The peak of u lies in the middle of the bounding box and has the
// length of ten spacings.
template <int dim>
void domain_of_file(pnpbs_context context, const char* path, double d) {
  double low[3], high[3];
  pnpbs_domain domain;
  check(pnpbs_domain_create(context, dim, &domain));
  if (dim == 2)
    check(pnpbs_domain_read_poly(domain, path));
  else
    check(pnpbs_domain_read_surface(domain, PNPBS_BOUNDARY, path, 40));
  check(pnpbs_domain_bounds(domain, low, high));
  Point<dim> centre;
  for (int k = 0; k < dim; ++k) centre[k] = (low[k] + high[k]) / 2;
  run(context, domain, Peak<dim>(centre, 10 * d), d);
  check(pnpbs_domain_destroy(&domain));
}

int main(int argc, char** argv) {
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  try {
    pnpbs_context context;
    check(pnpbs_context_create_mpi(MPI_COMM_WORLD, &context));
    if (argc < 3)
      square_and_box(context);
    else if (std::string(argv[1]).find(".poly") != std::string::npos)
      domain_of_file<2>(context, argv[1], std::atof(argv[2]));
    else
      domain_of_file<3>(context, argv[1], std::atof(argv[2]));
    check(pnpbs_context_destroy(&context));
  } catch (const std::exception& error) {
    std::cerr << error.what() << std::endl;
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
  return 0;
}
