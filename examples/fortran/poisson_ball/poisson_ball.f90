! SPDX-License-Identifier: BSD-3-Clause
!
! Solves Poisson's equation in a ball, or in the body of a file, by linear finite elements on
! tetrahedra, over the ranks of an MPI communicator, at three spacings. The solution is known, so
! the program computes orders of convergence; README.md explains the expected values.
! usage: poisson_ball [FILE [H]]   FILE: a closed surface, .stl, .off, .obj or .ply
!                                  H: the coarsest spacing over body_size (body.f90)
program poisson_ball
  use, intrinsic :: iso_c_binding, only: c_double, c_int64_t
  use mpi
  use pnpbs
  use body, only: body_size, create_body, solution
  use conjugate_gradients, only: solve
  use errors, only: measure_errors, measures, l2, gradient, volume
  use linear_elements, only: assemble, equations
  use nodes_of_rank, only: local_nodes, take_nodes
  implicit none
  integer, parameter :: levels = 3
  real(c_double), parameter :: coarser(levels) = [1d0, 1.4d0, 2d0]
  type(pnpbs_context) :: context
  type(pnpbs_domain) :: domain
  type(pnpbs_placement) :: placement
  type(local_nodes) :: nodes
  type(equations) :: rows
  real(c_double), allocatable :: u(:)
  real(c_double) :: measured(measures, levels), coarsest, h, whole
  integer(c_int64_t) :: total
  integer :: rank, level, error
  character(len=200) :: path, number

  call MPI_Init(error)
  call MPI_Comm_rank(MPI_COMM_WORLD, rank, error)
  call get_command_argument(1, path)
  call get_command_argument(2, number)
  coarsest = 0.16d0
  if (number /= '') read (number, *) coarsest
  call context%create_mpi(MPI_COMM_WORLD)
  call create_body(context, trim(path), domain)
  call domain%measure(whole)

  if (rank == 0) print '(a10, a9, a11, a7, a11, a7)', 'h', 'nodes', 'L2', 'order', 'H1', 'order'
  do level = 1, levels
    h = coarsest * body_size / coarser(level)
    call placement%create(context, domain)
    call placement%set_spacing_constant(h)
    call placement%run

    call take_nodes(placement, nodes)
    call assemble(nodes, rows)
    call boundary_values(u)
    call solve(nodes, rows, 1d-10, u)

    measured(:, level) = measure_errors(nodes, u)
    call placement%get('nodes', total)
    if (rank == 0) call print_errors
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
      if (nodes%tags(i) /= 0) u(i) = solution(nodes%x(:, i))
    end do
  end subroutine

  !> Prints one line of the table: the errors, and their orders relative to the previous spacing.
  subroutine print_errors
    if (level == 1) then
      print '(f10.5, i9, es11.3, 7x, es11.3)', h, total, measured([l2, gradient], level)
    else
      print '(f10.5, i9, es11.3, f7.2, es11.3, f7.2)', h, total, measured(l2, level), &
        order(l2, level - 1, level), measured(gradient, level), order(gradient, level - 1, level)
    end if
  end subroutine

  !> Returns the power of the spacing by which error k falls from level `coarse` to level `fine`.
  function order(k, coarse, fine)
    integer, intent(in) :: k, coarse, fine
    real(c_double) :: order
    order = log(measured(k, coarse) / measured(k, fine)) / log(coarser(fine) / coarser(coarse))
  end function

  subroutine print_checks
    print '(a, f5.3, a)', 'volume of the tetrahedra over that of the body: ', &
      measured(volume, levels) / whole, ', expected about 1'
    print '(a, f5.3, a)', 'order of the L2 error: ', order(l2, 1, levels), ', expected at least 1.8'
    print '(a, f5.3, a)', 'order of the H1 error: ', order(gradient, 1, levels), &
      ', expected at least 0.9'
  end subroutine
end program poisson_ball
