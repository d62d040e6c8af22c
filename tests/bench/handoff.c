/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Measures the cost of passing a placement on: seconds of the run, of a distributed mesh and of the
 * Voronoi cells on the slowest rank, and the imbalance of the mesh.
 * usage: handoff DIM SPACING [layers of ghost elements, default 1]  for the unit square or cube */
#include <mpi.h>
#include <pnpbs/pnpbs_mpi.h>
#include <stdio.h>
#include <stdlib.h>

static pnpbs_context context;
static int rank, size;

static void check(pnpbs_status status, const char* what) {
  if (status >= 0) return;
  fprintf(stderr, "%s: %s\n", what, pnpbs_last_error(context));
  MPI_Abort(MPI_COMM_WORLD, 1);
}

static pnpbs_placement placement_in_unit(int32_t dim, double spacing) {
  const double square[] = {0, 0, 1, 0, 1, 1, 0, 1}, low[] = {0, 0, 0}, high[] = {1, 1, 1};
  pnpbs_domain domain;
  pnpbs_placement placement;
  check(pnpbs_domain_create(context, dim, &domain), "domain");
  check(dim == 2 ? pnpbs_domain_add_polyline(domain, PNPBS_BOUNDARY, 1, 4, square, NULL, 1)
                 : pnpbs_domain_add_box(domain, low, high, 1),
        "boundary");
  check(pnpbs_placement_create(context, domain, &placement), "placement");
  pnpbs_domain_destroy(&domain);
  check(pnpbs_placement_set_spacing_constant(placement, spacing), "spacing");
  return placement;
}

static double largest(double mine) {
  double most;
  MPI_Allreduce(&mine, &most, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  return most;
}

static double seconds_of_mesh(pnpbs_placement placement, int32_t layers, pnpbs_mesh* mesh) {
  const double begin = MPI_Wtime();
  check(pnpbs_mesh_create(placement, layers, mesh), "mesh");
  return largest(MPI_Wtime() - begin);
}

static double seconds_of_cells(pnpbs_placement placement) {
  const double begin = MPI_Wtime();
  pnpbs_voronoi voronoi;
  check(pnpbs_voronoi_create(placement, &voronoi), "Voronoi cells");
  check(pnpbs_voronoi_destroy(&voronoi), "Voronoi cells");
  return largest(MPI_Wtime() - begin);
}

int main(int argc, char** argv) {
  int64_t nodes, elements, all_nodes, all_elements;
  double run, made, cells;
  pnpbs_placement placement;
  pnpbs_mesh mesh;
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  if (argc < 3) {
    if (rank == 0) fprintf(stderr, "usage: %s DIM SPACING [layers]\n", argv[0]);
    MPI_Abort(MPI_COMM_WORLD, 2);
  }
  check(pnpbs_context_create_mpi(MPI_COMM_WORLD, &context), "context");
  placement = placement_in_unit(atoi(argv[1]), atof(argv[2]));
  run = MPI_Wtime();
  check(pnpbs_placement_run(placement), "run");
  run = largest(MPI_Wtime() - run);
  made = seconds_of_mesh(placement, argc > 3 ? atoi(argv[3]) : 1, &mesh);
  cells = seconds_of_cells(placement);
  check(pnpbs_mesh_sizes(mesh, NULL, NULL, NULL, &nodes, NULL, &elements, NULL), "sizes");
  check(pnpbs_mesh_numbering(mesh, NULL, &all_nodes, NULL, &all_elements), "numbering");
  nodes = (int64_t)largest((double)nodes), elements = (int64_t)largest((double)elements);
  if (rank == 0)
    printf(
        "ranks %d nodes %lld elements %lld run %.3f mesh %.3f (%.1f %%) cells %.3f (%.1f %%) "
        "fullest %.3f nodes %.3f elements of a share\n",
        size, (long long)all_nodes, (long long)all_elements, run, made, 100 * made / run, cells,
        100 * cells / run, (double)nodes * size / (double)all_nodes,
        (double)elements * size / (double)all_elements);
  pnpbs_mesh_destroy(&mesh);
  pnpbs_placement_destroy(&placement);
  pnpbs_context_destroy(&context);
  MPI_Finalize();
  return 0;
}
