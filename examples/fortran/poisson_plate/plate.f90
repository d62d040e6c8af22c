! SPDX-License-Identifier: BSD-3-Clause
!
! The problem: -Laplace u = f on a plate with five round holes, with u given on every boundary. Also
! the spacing of the nodes, which is smaller at the holes. The shorter side of the plate has the
! length 1.
module plate
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t, c_ptr, c_f_pointer
  use pnpbs, only: pnpbs_context, pnpbs_domain, PNPBS_BOUNDARY
  implicit none
  private
  public :: spacing_parameters, plate_spacing, create_plate, solution, solution_gradient, source

  integer, parameter, public :: holes = 5

  real(c_double), parameter :: pi = 3.14159265358979323846d0
  real(c_double), parameter :: corners(2, 4) = reshape([0d0, 0d0, 2d0, 0d0, 2d0, 1d0, 0d0, 1d0], &
                                                       [2, 4])
  real(c_double), parameter :: centre(2, holes) = reshape( &
    [0.35d0, 0.30d0, 0.40d0, 0.72d0, 0.95d0, 0.60d0, 1.45d0, 0.30d0, 1.65d0, 0.72d0], [2, holes])
  real(c_double), parameter :: radius(holes) = [0.15d0, 0.10d0, 0.20d0, 0.12d0, 0.08d0]
  !> Coefficients of the logarithms in u, one per hole.
  real(c_double), parameter :: strength(holes) = [0.3d0, -0.2d0, 0.4d0, -0.3d0, 0.2d0]
  !> The spacing at a hole is that far away over 1 + refinement.
  real(c_double), parameter :: refinement = 2

  !> The parameters of the spacing, which the callback receives through `user`: h, the spacing far
  !> from the holes.
  type, bind(C) :: spacing_parameters
    real(c_double) :: h
  end type

contains

  !> Evaluates d(x) = h g(x) with a smooth g that is 1 far from the holes and about a third at their
  !> rims. g does not depend on h, so sets of nodes for different h differ in their scale only.
  function plate_spacing(n, dim, xyz, d, user) bind(C)
    integer(c_int64_t), value :: n
    integer(c_int32_t), value :: dim
    real(c_double), intent(in) :: xyz(dim, n)
    real(c_double), intent(out) :: d(n)
    type(c_ptr), value :: user
    integer(c_int32_t) :: plate_spacing
    type(spacing_parameters), pointer :: parameters
    integer(c_int64_t) :: i
    call c_f_pointer(user, parameters)
    do i = 1, n
      d(i) = parameters%h / (1 + refinement * sum((radius / distances(xyz(1:2, i)))**2))
    end do
    plate_spacing = 0
  end function

  !> Creates the domain: a rectangle with the tag 1 and holes with the tags 2, 3, ... Local.
  subroutine create_plate(context, domain)
    type(pnpbs_context), intent(in) :: context
    type(pnpbs_domain), intent(inout) :: domain
    integer :: k
    call domain%create(context)
    call domain%add_polyline(PNPBS_BOUNDARY, .true., corners)
    do k = 1, holes
      call domain%add_arc(PNPBS_BOUNDARY, centre(:, k), radius(k), 0d0, 2 * pi, k + 1)
    end do
  end subroutine

  !> Returns u = sin(pi x) sin(pi y) + sum of strength(k) log |x - centre(k)|.
  pure function solution(x) result(u)
    real(c_double), intent(in) :: x(2)
    real(c_double) :: u
    u = sin(pi * x(1)) * sin(pi * x(2)) + sum(strength * log(distances(x)))
  end function

  pure function solution_gradient(x) result(gradient)
    real(c_double), intent(in) :: x(2)
    real(c_double) :: gradient(2), slope(holes)
    slope = strength / distances(x)**2
    gradient(1) = pi * cos(pi * x(1)) * sin(pi * x(2)) + sum(slope * (x(1) - centre(1, :)))
    gradient(2) = pi * sin(pi * x(1)) * cos(pi * x(2)) + sum(slope * (x(2) - centre(2, :)))
  end function

  !> Returns f = -Laplace u. The logarithms are harmonic and do not contribute.
  pure function source(x) result(f)
    real(c_double), intent(in) :: x(2)
    real(c_double) :: f
    f = 2 * pi**2 * sin(pi * x(1)) * sin(pi * x(2))
  end function

  !> Returns the distances of the point x from the centres of the holes.
  pure function distances(x) result(r)
    real(c_double), intent(in) :: x(2)
    real(c_double) :: r(holes)
    r = sqrt((x(1) - centre(1, :))**2 + (x(2) - centre(2, :))**2)
  end function
end module plate
