! SPDX-License-Identifier: BSD-3-Clause
!
! One rank's part of the placement: its own nodes, then its ghosts, and the tetrahedra that touch
! its own nodes, whichever rank they belong to.
module nodes_of_rank
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t
  use pnpbs, only: pnpbs_placement
  implicit none
  private
  public :: local_nodes, take_nodes

  type :: local_nodes
    type(pnpbs_placement) :: placement
    integer(c_int64_t) :: owned, ghosts
    real(c_double), allocatable :: x(:,:)
    integer(c_int32_t), allocatable :: tags(:)
    !> The order is the same on all ranks and for any number of ranks.
    integer(c_int64_t), allocatable :: tetrahedra(:,:)
  end type

contains

  !> Copies this part from the placement. Collective.
  subroutine take_nodes(placement, nodes)
    type(pnpbs_placement), intent(in) :: placement
    type(local_nodes), intent(out) :: nodes
    integer(c_int64_t) :: tetrahedra
    nodes%placement = placement
    call placement%count(nodes%owned)
    call placement%ghost_count(nodes%ghosts)
    call placement%incident_element_count(tetrahedra)
    allocate (nodes%x(3, nodes%owned + nodes%ghosts), nodes%tags(nodes%owned))
    allocate (nodes%tetrahedra(4, tetrahedra))
    call placement%get_nodes(nodes%x, tags=nodes%tags)
    call placement%get_ghosts(nodes%x(:, nodes%owned + 1:))
    call placement%get_incident_elements(nodes%tetrahedra)
  end subroutine
end module nodes_of_rank
