! SPDX-License-Identifier: BSD-3-Clause
!> Curve and level-set callbacks for the tests of domains.
module curves
  use, intrinsic :: iso_c_binding
  implicit none
contains
  !> Returns points of an ellipse with the semi-axes that `user` points to. Fails without `user`.
  function ellipse(n, dim, t, coordinates, user) bind(C)
    integer(c_int64_t), value :: n
    integer(c_int32_t), value :: dim
    real(c_double), intent(in) :: t(n)
    real(c_double), intent(out) :: coordinates(dim, n)
    type(c_ptr), value :: user
    integer(c_int32_t) :: ellipse
    real(c_double), pointer :: axes(:)
    ellipse = 4
    coordinates = 0
    if (.not. c_associated(user)) return
    call c_f_pointer(user, axes, [2])
    coordinates(1, :) = axes(1) * cos(t)
    coordinates(2, :) = axes(2) * sin(t)
    ellipse = 0
  end function

  !> Returns a function that is negative in a ball with the radius that `user` points to. Fails
  !> without `user`.
  function ball_level_set(n, dim, coordinates, values, user) bind(C)
    integer(c_int64_t), value :: n
    integer(c_int32_t), value :: dim
    real(c_double), intent(in) :: coordinates(dim, n)
    real(c_double), intent(out) :: values(n)
    type(c_ptr), value :: user
    integer(c_int32_t) :: ball_level_set
    real(c_double), pointer :: radius
    ball_level_set = 5
    values = 0
    if (.not. c_associated(user)) return
    call c_f_pointer(user, radius)
    values = sum(coordinates**2, dim=1) - radius**2
    ball_level_set = 0
  end function
end module curves
