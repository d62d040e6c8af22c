! SPDX-License-Identifier: BSD-3-Clause
!
! Two codes of one MPI job, each with nodes from PNPBS on its own half of the ranks, at the same
! time. Then all ranks repeat both on MPI_COMM_WORLD: the nodes are the same, to the last bit.
program two_communicators
  use, intrinsic :: iso_c_binding, only: c_double, c_int64_t
  use mpi
  use pnpbs
  implicit none
  real(c_double), parameter :: corners(2, 3) = reshape([0d0, 0d0, 2d0, 0d0, 0d0, 1d0], [2, 3])
  real(c_double), parameter :: d(2) = [0.05d0, 0.03d0]  ! of the two codes
  real(c_double), dimension(2, 2) :: apart, found, together  ! number of nodes, sum of x y
  integer :: rank, ranks, code, half, error

  call MPI_Init(error)
  call MPI_Comm_rank(MPI_COMM_WORLD, rank, error)
  call MPI_Comm_size(MPI_COMM_WORLD, ranks, error)
  code = merge(1, 2, 2 * rank < ranks)
  call MPI_Comm_split(MPI_COMM_WORLD, code, rank, half, error)
  apart = 0
  call place(half, d(code), apart(:, code))
  if (ranks == 1) call place(half, d(2), apart(:, 2))
  call MPI_Allreduce(apart, found, 4, MPI_DOUBLE_PRECISION, MPI_MAX, MPI_COMM_WORLD, error)
  do code = 1, 2
    call place(MPI_COMM_WORLD, d(code), together(:, code))
    if (rank == 0) print '(a, i0, 2(a, i0))', 'nodes of code ', code, ': ', nint(found(1, code)), &
      ', expected ', nint(together(1, code))
  end do
  found = abs(found - together)
  if (rank == 0) print '(a, es8.1, a)', 'difference of the sums: ', maxval(found), ', expected 0'
  call MPI_Finalize(error)

contains
  !> Places nodes on the ranks of a communicator. Collective over them.
  subroutine place(comm, spacing, figures)
    integer, intent(in) :: comm
    real(c_double), intent(in) :: spacing
    real(c_double), intent(out) :: figures(2)
    type(pnpbs_context) :: context
    type(pnpbs_domain) :: domain
    type(pnpbs_placement) :: placement
    integer(c_int64_t) :: nodes
    real(c_double), allocatable :: xy(:, :)
    call context%create_mpi(comm)
    call domain%create(context)
    call domain%add_polyline(PNPBS_BOUNDARY, .true., corners)
    call placement%create(context, domain)
    call placement%set_spacing_constant(spacing)
    call placement%run
    call placement%count(nodes)
    allocate (xy(2, nodes))
    call placement%get_nodes(xy)
    call placement%sum(0 * xy(1, :) + 1, figures(1))
    call placement%sum(xy(1, :) * xy(2, :), figures(2))  ! rounded once, whatever the ranks
    call placement%destroy
    call domain%destroy
    call context%destroy
  end subroutine
end program two_communicators
