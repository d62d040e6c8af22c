! SPDX-License-Identifier: BSD-3-Clause
!
! The share of the plate where the triangulation differs from a hexagonal lattice. The errors of the
! gradient on neighbouring triangles do not cancel there.
module irregular_nodes
  use, intrinsic :: iso_c_binding, only: c_double, c_int64_t
  use mpi
  use ghost_exchange, only: fill_ghosts
  use nodes_of_rank, only: local_nodes, triangle_area
  implicit none
  private
  public :: irregular_share

contains

  !> Returns the share of the area in triangles with an inner node that does not have six
  !> neighbours. Collective.
  function irregular_share(nodes) result(share)
    type(local_nodes), intent(in) :: nodes
    real(c_double) :: share, mine(2), areas(2), excess(size(nodes%tags)), area
    integer(c_int64_t) :: i, t, corner(3)
    integer :: error
    excess = 0
    do i = 1, nodes%owned
      if (nodes%tags(i) /= 0) cycle
      excess(i) = real(nodes%offsets(i + 1) - nodes%offsets(i) - 6, c_double)
    end do
    call fill_ghosts(nodes%exchange, excess)
    mine = 0
    do t = 1, size(nodes%triangles, 2)
      corner = nodes%triangles(:, t)
      area = triangle_area(nodes%xy(:, corner(1)), nodes%xy(:, corner(2)), nodes%xy(:, corner(3)))
      mine(1) = mine(1) + area
      if (any(abs(excess(corner)) > 0.5d0)) mine(2) = mine(2) + area
    end do
    call MPI_Allreduce(mine, areas, 2, MPI_DOUBLE_PRECISION, MPI_SUM, nodes%exchange%comm, error)
    share = areas(2) / areas(1)
  end function
end module irregular_nodes
