! SPDX-License-Identifier: BSD-3-Clause
!
! Solves Poisson's equation on a plate with holes by linear finite elements, which are assembled
! from the stars of the nodes, over the ranks of an MPI communicator, at four spacings, each half of
! the previous one. The solution is known, so the program computes orders of convergence; README.md
! explains the expected values.
! usage: poisson_plate [FOLDER]   If a folder is given, every rank writes its piece of the finest
!                                 solution into it; the folder must exist.
program poisson_plate
  use, intrinsic :: iso_c_binding, only: c_double, c_int64_t, c_loc
  use mpi
  use pnpbs
  use conjugate_gradients, only: solve
  use errors, only: measure_errors, norms, l2, gradient, nodal, recovered
  use irregular_nodes, only: irregular_share
  use nodes_of_rank, only: local_nodes, take_nodes
  use pieces, only: write_piece
  use plate, only: create_plate, holes, plate_spacing, spacing_parameters, solution
  use star_rows, only: assemble, equations
  implicit none
  integer, parameter :: levels = 4, total_nodes = 1, total_boundary = 2, total_triangles = 3
  real(c_double), parameter :: coarsest = 0.06d0
  type(pnpbs_context) :: context
  type(pnpbs_domain) :: domain
  type(pnpbs_placement) :: placement
  type(local_nodes) :: nodes
  type(equations) :: rows
  type(spacing_parameters), target :: parameters
  real(c_double), allocatable :: u(:)
  real(c_double) :: error_at(norms, levels), irregular
  integer(c_int64_t) :: totals(3)
  integer :: comm, rank, level, error
  character(len=200) :: folder

  call MPI_Init(error)
  comm = MPI_COMM_WORLD
  call MPI_Comm_rank(comm, rank, error)
  call get_command_argument(1, folder)
  call context%create_mpi(comm)
  call create_plate(context, domain)

  if (rank == 0) print '(a8, a8, a10, 4(a9, a7))', 'h', 'nodes', 'irregular', 'L2', 'order', &
    'H1', 'order', 'nodal', 'order', 'recov.', 'order'
  do level = 1, levels
    parameters%h = coarsest / 2**(level - 1)
    call placement%create(context, domain)
    call placement%set_spacing_callback(plate_spacing, c_loc(parameters))
    call placement%run

    call take_nodes(placement, comm, nodes)
    call assemble(nodes, rows)
    call boundary_values(u)
    call solve(nodes, rows, 1d-10, u)

    error_at(:, level) = measure_errors(nodes, u)
    irregular = irregular_share(nodes)
    call count_over_ranks(totals)
    if (rank == 0) call print_errors
    if (level == levels .and. folder /= '') call write_piece(trim(folder), rank, nodes, u)
    call placement%destroy
  end do
  if (rank == 0) call print_checks

  call domain%destroy
  call context%destroy
  call MPI_Finalize(error)

contains

  !> Sets u to the known solution at the boundary and to 0 elsewhere.
  subroutine boundary_values(u)
    real(c_double), allocatable, intent(out) :: u(:)
    integer(c_int64_t) :: i
    allocate (u(nodes%owned + nodes%ghosts))
    u = 0
    do i = 1, nodes%owned
      if (nodes%tags(i) /= 0) u(i) = solution(nodes%xy(:, i))
    end do
  end subroutine

  !> Counts nodes, boundary nodes and triangles over all ranks. Collective.
  subroutine count_over_ranks(totals)
    integer(c_int64_t), intent(out) :: totals(3)
    integer(c_int64_t) :: mine(3)
    mine(total_nodes) = nodes%owned
    mine(total_boundary) = count(nodes%tags(:nodes%owned) /= 0)
    mine(total_triangles) = size(nodes%triangles, 2)
    call MPI_Allreduce(mine, totals, 3, MPI_INTEGER8, MPI_SUM, comm, error)
  end subroutine

  !> Prints one line of the table: each error, and its order relative to the previous spacing.
  subroutine print_errors
    integer :: k
    write (*, '(f8.5, i8, f8.1, " %")', advance='no') parameters%h, totals(total_nodes), &
      100 * irregular
    do k = 1, norms
      if (level == 1) write (*, '(es9.2, a)', advance='no') error_at(k, level), '       '
      if (level > 1) write (*, '(es9.2, f7.2)', advance='no') error_at(k, level), &
        order(k, level - 1, level)
    end do
    print '()'
  end subroutine

  !> Returns the power of the spacing by which error k falls from level `coarse` to level `fine`.
  function order(k, coarse, fine)
    integer, intent(in) :: k, coarse, fine
    real(c_double) :: order
    order = log(error_at(k, coarse) / error_at(k, fine)) / (log(2d0) * (fine - coarse))
  end function

  !> Prints results with their expected values: the number of triangles by Euler's formula, and the
  !> orders of convergence by theory. Theory predicts 1 + s for the last two orders if the irregular
  !> share of the area falls as the power 2 s of the spacing (README.md).
  subroutine print_checks
    print '(a, i0, a, i0)', 'triangles: ', totals(total_triangles), ', expected ', &
      2 * totals(total_nodes) - totals(total_boundary) - 2 + 2 * holes
    print '(a, f5.3, a)', 'order of the L2 error: ', order(l2, 1, levels), ', expected about 2'
    print '(a, f5.3, a)', 'order of the H1 error: ', order(gradient, 1, levels), &
      ', expected about 1'
    print '(a, f5.3, a)', 'order of the H1 error at the nodes: ', order(nodal, 1, levels), &
      ', expected at least 1.2'
    print '(a, f5.3, a)', 'order of the recovered gradient: ', order(recovered, 1, levels), &
      ', expected at least 1.4'
    print '(a, f4.1, a)', 'H1 error over that at the nodes: ', &
      error_at(gradient, levels) / error_at(nodal, levels), ', expected at least 25'
    print '(a, f4.1, a)', 'H1 error over that of the recovered gradient: ', &
      error_at(gradient, levels) / error_at(recovered, levels), ', expected at least 25'
  end subroutine
end program poisson_plate
