! SPDX-License-Identifier: BSD-3-Clause
!
! The linear finite element equations, assembled from the stars of the nodes. The row of a node
! depends only on the triangles around it, so a rank assembles complete rows of its owned nodes
! without messages and without a mesh.
module star_rows
  use, intrinsic :: iso_c_binding, only: c_double, c_int64_t
  use nodes_of_rank, only: local_nodes, triangle_area
  use plate, only: source
  implicit none
  private
  public :: equations, assemble, multiply

  !> The equations of the owned nodes. Row i has the entry diagonal(i) for node i, and beside(e) for
  !> neighbours(e) of its star.
  type :: equations
    real(c_double), allocatable :: diagonal(:), beside(:), load(:)
  end type

contains

  !> Assembles the equations of the owned nodes. Local.
  subroutine assemble(nodes, rows)
    type(local_nodes), intent(in) :: nodes
    type(equations), intent(out) :: rows
    integer(c_int64_t) :: i, e, next
    allocate (rows%diagonal(nodes%owned), rows%load(nodes%owned))
    allocate (rows%beside(size(nodes%neighbours)))
    rows%diagonal = 0
    rows%beside = 0
    rows%load = 0
    do i = 1, nodes%owned
      do e = nodes%offsets(i), nodes%offsets(i + 1) - 1
        if (nodes%closed(e) == 0) cycle
        next = nodes%next_around(i, e)
        call add_triangle(nodes%xy(:, i), nodes%xy(:, nodes%neighbours(e)), &
                          nodes%xy(:, nodes%neighbours(next)), rows%diagonal(i), &
                          rows%beside(e), rows%beside(next), rows%load(i))
      end do
    end do
  end subroutine

  !> Adds the contribution of the triangle a, b, c to the row of its corner a. The hat function of a
  !> corner has the gradient (opposite edge, turned by a right angle) / (2 area). The load is the
  !> integral of f times the hat function of a. It is computed with the midpoints of the edges, a
  !> rule that is exact to second degree; the hat function is 1/2 at two of them and 0 at the third.
  pure subroutine add_triangle(a, b, c, at_a, at_b, at_c, load)
    real(c_double), intent(in) :: a(2), b(2), c(2)
    real(c_double), intent(inout) :: at_a, at_b, at_c, load
    real(c_double) :: area
    area = triangle_area(a, b, c)
    at_a = at_a + dot_product(c - b, c - b) / (4 * area)
    at_b = at_b + dot_product(c - b, a - c) / (4 * area)
    at_c = at_c + dot_product(c - b, b - a) / (4 * area)
    load = load + area / 6 * (source((a + b) / 2) + source((a + c) / 2))
  end subroutine

  !> Multiplies the matrix by `values` at inner nodes. The product is 0 at boundary nodes, whose
  !> values are given. `values` must be up to date at ghosts. Local.
  subroutine multiply(nodes, rows, values, product)
    type(local_nodes), intent(in) :: nodes
    type(equations), intent(in) :: rows
    real(c_double), intent(in) :: values(:)
    real(c_double), intent(out) :: product(:)
    integer(c_int64_t) :: i, first, last
    do i = 1, nodes%owned
      product(i) = 0
      if (nodes%tags(i) /= 0) cycle
      first = nodes%offsets(i)
      last = nodes%offsets(i + 1) - 1
      product(i) = rows%diagonal(i) * values(i) &
                   + sum(rows%beside(first:last) * values(nodes%neighbours(first:last)))
    end do
  end subroutine
end module star_rows
