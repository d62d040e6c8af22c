! SPDX-License-Identifier: BSD-3-Clause
!
! Conjugate gradients with the diagonal as preconditioner, over the ranks of a communicator. Dot
! products are exact sums, rounded once, and rows have the same bits on any rank. The solution
! therefore has the same bits on any number of ranks.
module conjugate_gradients
  use, intrinsic :: iso_c_binding, only: c_double
  use, intrinsic :: iso_fortran_env, only: error_unit
  use mpi
  use nodes_of_rank, only: local_nodes
  use linear_elements, only: equations, multiply
  implicit none
  private
  public :: solve

  integer, parameter :: most_steps = 10000

contains

  !> Solves the equations. On entry u holds the given values at boundary nodes and an initial guess
  !> at inner nodes. On return it holds the solution at nodes and ghosts, with a residual of at most
  !> `tolerance` times the initial one. Ends the program if the iteration does not converge.
  !> Collective.
  subroutine solve(nodes, rows, tolerance, u)
    type(local_nodes), intent(in) :: nodes
    type(equations), intent(in) :: rows
    real(c_double), intent(in) :: tolerance
    real(c_double), intent(inout) :: u(:)
    real(c_double), dimension(nodes%owned) :: residual, scaled, image
    real(c_double) :: direction(size(u)), before, now, enough, length
    integer :: step

    call nodes%placement%update_ghosts(u)
    call multiply(nodes, rows, u, image)
    where (nodes%tags == 0)
      residual = rows%load - image
    elsewhere
      residual = 0
    end where
    scaled = residual / rows%diagonal
    direction(:nodes%owned) = scaled
    now = dot(residual, scaled)
    enough = tolerance**2 * now
    do step = 1, most_steps
      if (now <= enough) exit
      call nodes%placement%update_ghosts(direction)
      call multiply(nodes, rows, direction, image)
      length = now / dot(direction(:nodes%owned), image)
      u(:nodes%owned) = u(:nodes%owned) + length * direction(:nodes%owned)
      residual = residual - length * image
      scaled = residual / rows%diagonal
      before = now
      now = dot(residual, scaled)
      direction(:nodes%owned) = scaled + now / before * direction(:nodes%owned)
    end do
    if (now > enough) call give_up
    call nodes%placement%update_ghosts(u)

  contains

    function dot(a, b) result(total)
      real(c_double), intent(in) :: a(:), b(:)
      real(c_double) :: total
      call nodes%placement%dot(a, b, total)
    end function

    subroutine give_up
      integer :: error
      write (error_unit, '(a, i0, a)') 'conjugate gradients: not there after ', most_steps, ' steps'
      call MPI_Abort(MPI_COMM_WORLD, 1, error)
    end subroutine
  end subroutine
end module conjugate_gradients
