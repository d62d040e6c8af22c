! SPDX-License-Identifier: BSD-3-Clause
!
! The problem: -Laplace u = f in a body with u given on its surface. The body is a ball of radius 1
! or the body of a file. u is a wave whose length is about the size of the body.
module body
  use, intrinsic :: iso_c_binding, only: c_double
  use pnpbs, only: pnpbs_context, pnpbs_domain, PNPBS_BOUNDARY
  implicit none
  private
  public :: create_body, solution, solution_gradient, source

  !> Half of the longest side of the body's bounding box: 1 for the ball.
  real(c_double), protected, public :: body_size = 1

contains

  !> Creates the domain and sets body_size. `path` is that of a .stl, .off, .obj or .ply file, or
  !> empty for the ball. Local.
  subroutine create_body(context, path, domain)
    type(pnpbs_context), intent(in) :: context
    character(len=*), intent(in) :: path
    type(pnpbs_domain), intent(inout) :: domain
    real(c_double) :: low(3), high(3)
    call domain%create(context, 3)
    if (path == '') then
      call domain%add_ball([0d0, 0d0, 0d0], 1d0)
    else
      call domain%read_surface(PNPBS_BOUNDARY, path)
    end if
    call domain%bounds(low, high)
    body_size = maxval(high - low) / 2
  end subroutine

  !> Returns u = sin(2 x + y) exp(z), with lengths in units of body_size.
  pure function solution(x) result(u)
    real(c_double), intent(in) :: x(3)
    real(c_double) :: u
    u = sin((2 * x(1) + x(2)) / body_size) * exp(x(3) / body_size)
  end function

  pure function solution_gradient(x) result(gradient)
    real(c_double), intent(in) :: x(3)
    real(c_double) :: gradient(3), slope
    slope = cos((2 * x(1) + x(2)) / body_size) * exp(x(3) / body_size)
    gradient = [2 * slope, slope, solution(x)] / body_size
  end function

  !> Returns f = -Laplace u.
  pure function source(x) result(f)
    real(c_double), intent(in) :: x(3)
    real(c_double) :: f
    f = 4 * solution(x) / body_size**2
  end function
end module body
