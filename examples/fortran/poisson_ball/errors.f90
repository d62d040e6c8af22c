! SPDX-License-Identifier: BSD-3-Clause
!
! Errors of the solution against the known one, by integrals over the tetrahedra.
module errors
  use, intrinsic :: iso_c_binding, only: c_double, c_int64_t
  use body, only: solution, solution_gradient
  use linear_elements, only: hat_gradients
  use nodes_of_rank, only: local_nodes
  implicit none
  private
  public :: measure_errors

  !> Indices of the results of measure_errors:
  !>   l2        L2 norm of u_h - u
  !>   gradient  L2 norm of grad u_h - grad u, the H1 seminorm
  !>   volume    volume of the tetrahedra
  integer, parameter, public :: measures = 3, l2 = 1, gradient = 2, volume = 3

  !> Quadrature rule of 14 points on a tetrahedron, exact to fifth degree (N. Walkington, Quadrature
  !> on simplices of arbitrary dimension, 2000). Eight points lie on the lines from the centroid to
  !> corners and face centroids, six on the lines to edge midpoints. `weight` is relative to the
  !> volume of the tetrahedron.
  real(c_double), parameter :: a1 = 0.310885919263300610d0, w1 = 0.112687925718015851d0
  real(c_double), parameter :: a2 = 0.0927352503108912264d0, w2 = 0.0734930431163619495d0
  real(c_double), parameter :: a3 = 0.0455037041256496495d0, w3 = 0.0425460207770814664d0
  real(c_double), parameter :: b1 = 1 - 3 * a1, b2 = 1 - 3 * a2, b3 = 0.5d0 - a3
  real(c_double), parameter :: weight(14) = [w1, w1, w1, w1, w2, w2, w2, w2, &
                                             w3, w3, w3, w3, w3, w3]
  real(c_double), parameter :: barycentric(4, 14) = reshape( &
    [b1, a1, a1, a1, a1, b1, a1, a1, a1, a1, b1, a1, a1, a1, a1, b1, &
     b2, a2, a2, a2, a2, b2, a2, a2, a2, a2, b2, a2, a2, a2, a2, b2, &
     b3, b3, a3, a3, b3, a3, b3, a3, b3, a3, a3, b3, &
     a3, b3, b3, a3, a3, b3, a3, b3, a3, a3, b3, b3], [4, 14])

contains

  !> Returns the errors of u, which must be up to date at ghosts. Where the surface is concave,
  !> tetrahedra extend a little beyond the body; the known solution is smooth there, too. Each
  !> tetrahedron contributes on the rank that owns its first corner. Collective.
  function measure_errors(nodes, u) result(measured)
    type(local_nodes), intent(in) :: nodes
    real(c_double), intent(in) :: u(:)
    real(c_double) :: measured(measures), parts(measures, nodes%owned)
    integer(c_int64_t) :: t, corner(4)
    parts = 0
    do t = 1, size(nodes%tetrahedra, 2)
      corner = nodes%tetrahedra(:, t)
      if (corner(1) <= nodes%owned) &
        parts(:, corner(1)) = parts(:, corner(1)) + parts_on(nodes%x(:, corner), u(corner))
    end do
    call nodes%placement%sum(parts, measured)
    measured([l2, gradient]) = sqrt(measured([l2, gradient]))
  end function

  !> Returns the integrals of the squared errors over one tetrahedron, and its volume, from
  !> positions and values of u at its corners.
  pure function parts_on(corner, u) result(parts)
    real(c_double), intent(in) :: corner(3, 4), u(4)
    real(c_double) :: parts(measures), hat(3, 4), constant(3), x(3)
    integer :: k
    call hat_gradients(corner, hat, parts(volume))
    constant = matmul(hat, u)
    parts([l2, gradient]) = 0
    do k = 1, size(weight)
      x = matmul(corner, barycentric(:, k))
      parts(l2) = parts(l2) + weight(k) * (dot_product(u, barycentric(:, k)) - solution(x))**2
      parts(gradient) = parts(gradient) + weight(k) * sum((constant - solution_gradient(x))**2)
    end do
    parts([l2, gradient]) = parts(volume) * parts([l2, gradient])
  end function
end module errors
