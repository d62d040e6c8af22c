! SPDX-License-Identifier: BSD-3-Clause
!
! What one rank has of the placement: its own nodes, then its ghosts; its share of the tetrahedra.
module nodes_of_rank
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t
  use pnpbs, only: pnpbs_placement
  use ghost_exchange, only: exchange_pattern, take_exchange_pattern
  implicit none
  private
  public :: local_nodes, take_nodes

  type :: local_nodes
    integer(c_int64_t) :: owned, ghosts
    real(c_double), allocatable :: x(:,:)
    integer(c_int32_t), allocatable :: tags(:)
    !> Each is one rank's; its corners may be ghosts.
    integer(c_int64_t), allocatable :: tetrahedra(:,:)
    type(exchange_pattern) :: exchange
  end type

contains

  !> Copies all of it out of the placement. Collective.
  subroutine take_nodes(placement, comm, nodes)
    type(pnpbs_placement), intent(in) :: placement
    integer, intent(in) :: comm
    type(local_nodes), intent(out) :: nodes
    integer(c_int64_t) :: tetrahedra
    call placement%count(nodes%owned)
    call placement%ghost_count(nodes%ghosts)
    call placement%tetrahedron_count(tetrahedra)
    allocate (nodes%x(3, nodes%owned + nodes%ghosts), nodes%tags(nodes%owned))
    allocate (nodes%tetrahedra(4, tetrahedra))
    call placement%get_nodes(nodes%x, tags=nodes%tags)
    call placement%get_ghosts(nodes%x(:, nodes%owned + 1:))
    call placement%get_tetrahedra(nodes%tetrahedra)
    call take_exchange_pattern(placement, comm, nodes%exchange)
  end subroutine
end module nodes_of_rank
