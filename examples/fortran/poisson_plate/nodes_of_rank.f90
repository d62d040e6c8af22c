! SPDX-License-Identifier: BSD-3-Clause
!
! The part of the placement on one rank: owned nodes, ghosts, the stars of the owned nodes, and the
! triangles that belong to the rank.
module nodes_of_rank
  use, intrinsic :: iso_c_binding, only: c_double, c_int8_t, c_int32_t, c_int64_t
  use pnpbs, only: pnpbs_placement
  use ghost_exchange, only: exchange_pattern, take_exchange_pattern
  implicit none
  private
  public :: local_nodes, take_nodes, triangle_area

  !> The nodes of a rank. Arrays of nodes hold the owned nodes first, then the ghosts.
  type :: local_nodes
    integer(c_int64_t) :: owned, ghosts
    real(c_double), allocatable :: xy(:,:)
    integer(c_int32_t), allocatable :: tags(:)
    !> The star of node i is neighbours(offsets(i) : offsets(i+1)-1), counter-clockwise. If
    !> closed(e) is 1, node i, neighbours(e) and the next neighbour around form a triangle.
    integer(c_int64_t), allocatable :: offsets(:), neighbours(:)
    integer(c_int8_t), allocatable :: closed(:)
    integer(c_int64_t), allocatable :: triangles(:,:)
    type(exchange_pattern) :: exchange
  contains
    procedure :: next_around
    procedure :: previous_around
  end type

contains

  !> Copies nodes, ghosts, stars, triangles and the exchange pattern from the placement. Collective.
  subroutine take_nodes(placement, comm, nodes)
    type(pnpbs_placement), intent(in) :: placement
    integer, intent(in) :: comm
    type(local_nodes), intent(out) :: nodes
    integer(c_int64_t) :: entries, triangles, all
    call placement%count(nodes%owned)
    call placement%ghost_count(nodes%ghosts)
    call placement%star_size(entries)
    call placement%triangle_count(triangles)
    all = nodes%owned + nodes%ghosts
    allocate (nodes%xy(2, all), nodes%tags(all), nodes%triangles(3, triangles))
    allocate (nodes%offsets(nodes%owned + 1), nodes%neighbours(entries), nodes%closed(entries))
    call placement%get_nodes(nodes%xy, tags=nodes%tags)
    call placement%get_ghosts(nodes%xy(:, nodes%owned + 1:), tags=nodes%tags(nodes%owned + 1:))
    call placement%get_stars(nodes%offsets, nodes%neighbours, nodes%closed)
    call placement%get_triangles(nodes%triangles)
    call take_exchange_pattern(placement, comm, nodes%exchange)
  end subroutine

  !> Returns the entry of the star of node i that follows entry e, cyclically.
  pure function next_around(self, i, e) result(next)
    class(local_nodes), intent(in) :: self
    integer(c_int64_t), intent(in) :: i, e
    integer(c_int64_t) :: next
    next = e + 1
    if (next == self%offsets(i + 1)) next = self%offsets(i)
  end function

  !> Returns the entry of the star of node i that precedes entry e, cyclically.
  pure function previous_around(self, i, e) result(previous)
    class(local_nodes), intent(in) :: self
    integer(c_int64_t), intent(in) :: i, e
    integer(c_int64_t) :: previous
    previous = e - 1
    if (e == self%offsets(i)) previous = self%offsets(i + 1) - 1
  end function

  !> Returns the area of the triangle a, b, c, which is positive if it is counter-clockwise.
  pure function triangle_area(a, b, c) result(area)
    real(c_double), intent(in) :: a(2), b(2), c(2)
    real(c_double) :: area
    area = ((b(1) - a(1)) * (c(2) - a(2)) - (b(2) - a(2)) * (c(1) - a(1))) / 2
  end function
end module nodes_of_rank
