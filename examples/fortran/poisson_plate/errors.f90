! SPDX-License-Identifier: BSD-3-Clause
!
! Errors of the solution against the known one in four norms, each an integral over the triangles.
module errors
  use, intrinsic :: iso_c_binding, only: c_double, c_int64_t
  use mpi
  use ghost_exchange, only: fill_ghosts
  use nodes_of_rank, only: local_nodes, triangle_area
  use plate, only: solution, solution_gradient
  implicit none
  private
  public :: measure_errors

  !> Indices of the results of measure_errors:
  !>   l2         L2 norm of u_h - u
  !>   gradient   L2 norm of grad u_h - grad u, the H1 seminorm
  !>   nodal      L2 norm of grad u_h - grad of the interpolant of u
  !>   recovered  L2 norm of the recovered gradient minus grad u
  integer, parameter, public :: norms = 4, l2 = 1, gradient = 2, nodal = 3, recovered = 4

  !> Quadrature rule of six points on a triangle, exact to fourth degree (D. Dunavant, Int. J.
  !> Numer. Meth. Eng. 21, 1985, table II): weights relative to the area, barycentric coordinates.
  real(c_double), parameter :: w1 = 0.223381589678011d0, w2 = 0.109951743655322d0
  real(c_double), parameter :: a1 = 0.108103018168070d0, b1 = 0.445948490915965d0
  real(c_double), parameter :: a2 = 0.816847572980459d0, b2 = 0.091576213509771d0
  real(c_double), parameter :: weight(6) = [w1, w1, w1, w2, w2, w2]
  real(c_double), parameter :: barycentric(3, 6) = reshape( &
    [a1, b1, b1, b1, a1, b1, b1, b1, a1, a2, b2, b2, b2, a2, b2, b2, b2, a2], [3, 6])

contains

  !> Returns the errors of u, which must be up to date at ghosts. The triangles at a hole extend a
  !> little into it; the known solution is smooth there, too. Collective.
  function measure_errors(nodes, u) result(measured)
    type(local_nodes), intent(in) :: nodes
    real(c_double), intent(in) :: u(:)
    real(c_double) :: measured(norms), squares(norms), slopes(2, size(u))
    integer(c_int64_t) :: t, corner(3)
    integer :: error
    call recover_gradient(nodes, u, slopes)
    squares = 0
    do t = 1, size(nodes%triangles, 2)
      corner = nodes%triangles(:, t)
      squares = squares + squares_on(nodes%xy(:, corner), u(corner), slopes(:, corner))
    end do
    call MPI_Allreduce(squares, measured, norms, MPI_DOUBLE_PRECISION, MPI_SUM, &
                       nodes%exchange%comm, error)
    measured = sqrt(measured)
  end function

  !> Returns the integrals of the squared errors over one triangle from positions, values and
  !> recovered gradients at its corners.
  pure function squares_on(xy, u, slopes) result(squares)
    real(c_double), intent(in) :: xy(2, 3), u(3), slopes(2, 3)
    real(c_double) :: squares(norms), area, constant(2), x(2), values(3)
    integer :: k
    area = triangle_area(xy(:, 1), xy(:, 2), xy(:, 3))
    constant = gradient_on(xy, u)
    squares = 0
    do k = 1, size(weight)
      x = matmul(xy, barycentric(:, k))
      squares(l2) = squares(l2) + weight(k) * (dot_product(u, barycentric(:, k)) - solution(x))**2
      squares(gradient) = squares(gradient) + weight(k) * sum((constant - solution_gradient(x))**2)
      squares(recovered) = squares(recovered) + weight(k) &
                           * sum((matmul(slopes, barycentric(:, k)) - solution_gradient(x))**2)
    end do
    do k = 1, 3
      values(k) = u(k) - solution(xy(:, k))
    end do
    squares(nodal) = sum(gradient_on(xy, values)**2)
    squares = area * squares
  end function

  !> Computes the recovered gradient at nodes and ghosts from u at the nodes. At an inner node it is
  !> the mean gradient over the triangles of the star, weighted by their areas. At a boundary node
  !> this mean approximates the gradient at a point inside, so the gradient is extrapolated linearly
  !> instead: from that of each inner neighbour through that at the midpoint of the edge to it,
  !> which is the mean over the two triangles at the edge. Collective.
  subroutine recover_gradient(nodes, u, slopes)
    type(local_nodes), intent(in) :: nodes
    real(c_double), intent(in) :: u(:)
    real(c_double), intent(out) :: slopes(:,:)
    integer(c_int64_t) :: i, e
    do i = 1, nodes%owned
      slopes(:, i) = mean_gradient(nodes, u, i, &
                                   [(e, e = nodes%offsets(i), nodes%offsets(i + 1) - 1)])
    end do
    call fill_ghosts_of_both(nodes, slopes)
    do i = 1, nodes%owned
      if (nodes%tags(i) /= 0) call extend_to_boundary(nodes, u, i, slopes)
    end do
    call fill_ghosts_of_both(nodes, slopes)
  end subroutine

  !> Extrapolates the gradient to the boundary node i if it has inner neighbours. Local.
  subroutine extend_to_boundary(nodes, u, i, slopes)
    type(local_nodes), intent(in) :: nodes
    real(c_double), intent(in) :: u(:)
    integer(c_int64_t), intent(in) :: i
    real(c_double), intent(inout) :: slopes(:,:)
    integer(c_int64_t) :: e
    integer :: inner
    real(c_double) :: total(2)
    inner = 0
    total = 0
    do e = nodes%offsets(i), nodes%offsets(i + 1) - 1
      if (nodes%tags(nodes%neighbours(e)) /= 0) cycle
      inner = inner + 1
      total = total + 2 * mean_gradient(nodes, u, i, [nodes%previous_around(i, e), e]) &
              - slopes(:, nodes%neighbours(e))
    end do
    if (inner > 0) slopes(:, i) = total / inner
  end subroutine

  !> Returns the mean gradient over the triangles at node i that begin with the given entries of its
  !> star, weighted by their areas.
  pure function mean_gradient(nodes, u, i, entries) result(mean)
    type(local_nodes), intent(in) :: nodes
    real(c_double), intent(in) :: u(:)
    integer(c_int64_t), intent(in) :: i, entries(:)
    real(c_double) :: mean(2), area, whole
    integer(c_int64_t) :: corner(3)
    integer :: k
    mean = 0
    whole = 0
    do k = 1, size(entries)
      if (nodes%closed(entries(k)) == 0) cycle
      corner = [i, nodes%neighbours(entries(k)), &
                nodes%neighbours(nodes%next_around(i, entries(k)))]
      area = triangle_area(nodes%xy(:, corner(1)), nodes%xy(:, corner(2)), nodes%xy(:, corner(3)))
      mean = mean + area * gradient_on(nodes%xy(:, corner), u(corner))
      whole = whole + area
    end do
    mean = mean / whole
  end function

  !> Updates both components of the gradient at the ghosts. Collective.
  subroutine fill_ghosts_of_both(nodes, slopes)
    type(local_nodes), intent(in) :: nodes
    real(c_double), intent(inout) :: slopes(:,:)
    real(c_double) :: component(size(slopes, 2))
    integer :: direction
    do direction = 1, 2
      component = slopes(direction, :)
      call fill_ghosts(nodes%exchange, component)
      slopes(direction, :) = component
    end do
  end subroutine

  !> Returns the gradient of the linear function with the values u at the corners xy of a triangle.
  pure function gradient_on(xy, u) result(slope)
    real(c_double), intent(in) :: xy(2, 3), u(3)
    real(c_double) :: slope(2), twice_area
    twice_area = 2 * triangle_area(xy(:, 1), xy(:, 2), xy(:, 3))
    slope(1) = u(1) * (xy(2, 2) - xy(2, 3)) + u(2) * (xy(2, 3) - xy(2, 1)) &
               + u(3) * (xy(2, 1) - xy(2, 2))
    slope(2) = u(1) * (xy(1, 3) - xy(1, 2)) + u(2) * (xy(1, 1) - xy(1, 3)) &
               + u(3) * (xy(1, 2) - xy(1, 1))
    slope = slope / twice_area
  end function
end module errors
