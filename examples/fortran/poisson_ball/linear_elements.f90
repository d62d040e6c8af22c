! SPDX-License-Identifier: BSD-3-Clause
!
! The linear finite element equations. A rank stores the rows of its owned nodes and has all
! tetrahedra that contribute to them. Sums at ghosts are incomplete and are discarded.
module linear_elements
  use, intrinsic :: iso_c_binding, only: c_double, c_int64_t
  use body, only: source
  use nodes_of_rank, only: local_nodes
  implicit none
  private
  public :: equations, assemble, multiply, hat_gradients

  !> Corner numbers at the ends of the six edges of a tetrahedron.
  integer, parameter :: edge(2, 6) = reshape([1, 2, 1, 3, 1, 4, 2, 3, 2, 4, 3, 4], [2, 6])

  !> The equations of the owned nodes. stiffness(e, t) is the integral over tetrahedron t of the
  !> scalar product of the gradients of the hat functions at the ends of edge e. Rows sum to zero,
  !> so these entries determine the diagonal, too.
  type :: equations
    real(c_double), allocatable :: stiffness(:,:), diagonal(:), load(:)
  end type

contains

  !> Assembles the equations of the owned nodes. Local.
  subroutine assemble(nodes, rows)
    type(local_nodes), intent(in) :: nodes
    type(equations), intent(out) :: rows
    real(c_double) :: hat(3, 4), volume
    integer(c_int64_t) :: t, ends(2)
    integer :: e
    allocate (rows%stiffness(6, size(nodes%tetrahedra, 2)))
    allocate (rows%diagonal(size(nodes%x, 2)), rows%load(size(nodes%x, 2)))
    rows%diagonal = 0
    rows%load = 0
    do t = 1, size(nodes%tetrahedra, 2)
      call hat_gradients(nodes%x(:, nodes%tetrahedra(:, t)), hat, volume)
      do e = 1, 6
        rows%stiffness(e, t) = -volume * dot_product(hat(:, edge(1, e)), hat(:, edge(2, e)))
        ends = nodes%tetrahedra(edge(:, e), t)
        rows%diagonal(ends) = rows%diagonal(ends) + rows%stiffness(e, t)
      end do
      call add_load(nodes, nodes%tetrahedra(:, t), volume, rows%load)
    end do
    rows%diagonal = rows%diagonal(:nodes%owned)
    rows%load = rows%load(:nodes%owned)
    ! Where a body is thinner than the spacing, a node of its surface may have no tetrahedron.
    where (rows%diagonal == 0) rows%diagonal = 1
  end subroutine

  !> Adds the integrals of f times each hat function over one tetrahedron, with f linear on it.
  subroutine add_load(nodes, corner, volume, load)
    type(local_nodes), intent(in) :: nodes
    integer(c_int64_t), intent(in) :: corner(4)
    real(c_double), intent(in) :: volume
    real(c_double), intent(inout) :: load(:)
    real(c_double) :: f(4)
    integer :: k
    f = [(source(nodes%x(:, corner(k))), k = 1, 4)]
    load(corner) = load(corner) + volume / 20 * (f + sum(f))
  end subroutine

  !> Multiplies the matrix by `values` at inner nodes. The product is 0 at boundary nodes, whose
  !> values are given. `values` must be up to date at ghosts. Local.
  subroutine multiply(nodes, rows, values, product)
    type(local_nodes), intent(in) :: nodes
    type(equations), intent(in) :: rows
    real(c_double), intent(in) :: values(:)
    real(c_double), intent(out) :: product(:)
    real(c_double) :: sums(size(values)), flow
    integer(c_int64_t) :: t, a, b
    integer :: e
    sums = 0
    do t = 1, size(nodes%tetrahedra, 2)
      do e = 1, 6
        a = nodes%tetrahedra(edge(1, e), t)
        b = nodes%tetrahedra(edge(2, e), t)
        flow = rows%stiffness(e, t) * (values(a) - values(b))
        sums(a) = sums(a) + flow
        sums(b) = sums(b) - flow
      end do
    end do
    product = merge(sums(:nodes%owned), 0d0, nodes%tags == 0)
  end subroutine

  !> Computes the gradients of the four hat functions, each 1 at one corner and 0 at the others, and
  !> the volume of the tetrahedron.
  pure subroutine hat_gradients(corner, hat, volume)
    real(c_double), intent(in) :: corner(3, 4)
    real(c_double), intent(out) :: hat(3, 4), volume
    real(c_double) :: side(3, 3)
    integer :: k
    do k = 1, 3
      side(:, k) = corner(:, k + 1) - corner(:, 1)
    end do
    do k = 1, 3
      hat(:, k + 1) = cross(side(:, mod(k, 3) + 1), side(:, mod(k + 1, 3) + 1))
    end do
    volume = dot_product(side(:, 1), hat(:, 2)) / 6
    hat(:, 2:) = hat(:, 2:) / (6 * volume)
    hat(:, 1) = -sum(hat(:, 2:), dim=2)
  end subroutine

  pure function cross(a, b)
    real(c_double), intent(in) :: a(3), b(3)
    real(c_double) :: cross(3)
    cross = cshift(a, 1) * cshift(b, 2) - cshift(a, 2) * cshift(b, 1)
  end function
end module linear_elements
