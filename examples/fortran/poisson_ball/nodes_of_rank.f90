! SPDX-License-Identifier: BSD-3-Clause
!
! The part of the placement on one rank: owned nodes, ghosts, and all tetrahedra at owned nodes,
! also those that belong to other ranks.
module nodes_of_rank
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t
  use pnpbs, only: pnpbs_placement
  implicit none
  private
  public :: local_nodes, take_nodes

  !> The nodes of a rank. `x` holds the positions of owned nodes first, then those of ghosts. `tags`
  !> are those of owned nodes only.
  type :: local_nodes
    type(pnpbs_placement) :: placement
    integer(c_int64_t) :: owned, ghosts
    real(c_double), allocatable :: x(:,:)
    integer(c_int32_t), allocatable :: tags(:)
    !> (4, :) local indices. The order does not depend on the number of ranks.
    integer(c_int64_t), allocatable :: tetrahedra(:,:)
  end type

contains

  !> Copies nodes, ghosts and tetrahedra from the placement. Collective.
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
