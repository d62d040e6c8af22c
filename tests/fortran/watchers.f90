! SPDX-License-Identifier: BSD-3-Clause
!> Spacing callbacks and monitors for the tests.
module watchers
  use, intrinsic :: iso_c_binding
  use pnpbs
  implicit none

  !> Parameters of a spacing, d = finest + growth |x - centre|. `answer` is the value that the
  !> callback returns.
  type, bind(C) :: cone
    real(c_double) :: finest = 0.02d0, growth = 0.1d0, centre(2) = [0.3d0, 0.4d0]
    integer(c_int32_t) :: answer = 0
    integer(c_int64_t) :: calls = 0, placement = 0
    integer(c_int32_t) :: inner_count = -99, inner_step = -99
  end type

contains

  function cone_spacing(n, dim, xyz, d, user) bind(C)
    integer(c_int64_t), value :: n
    integer(c_int32_t), value :: dim
    real(c_double), intent(in) :: xyz(dim, n)
    real(c_double), intent(out) :: d(n)
    type(c_ptr), value :: user
    integer(c_int32_t) :: cone_spacing
    type(cone), pointer :: c
    integer(c_int64_t) :: i
    call c_f_pointer(user, c)
    do i = 1, n
      d(i) = c%finest + c%growth * sqrt((xyz(1, i) - c%centre(1))**2 + (xyz(2, i) - c%centre(2))**2)
    end do
    c%calls = c%calls + 1
    cone_spacing = c%answer
  end function

  !> Returns d = finest + growth z, in space.
  function height_spacing(n, dim, xyz, d, user) bind(C)
    integer(c_int64_t), value :: n
    integer(c_int32_t), value :: dim
    real(c_double), intent(in) :: xyz(dim, n)
    real(c_double), intent(out) :: d(n)
    type(c_ptr), value :: user
    integer(c_int32_t) :: height_spacing
    type(cone), pointer :: c
    call c_f_pointer(user, c)
    height_spacing = c%answer
    if (dim /= 3) height_spacing = 3
    d = c%finest
    if (dim == 3) d = c%finest + c%growth * xyz(3, :)
    c%calls = c%calls + 1
  end function

  !> Returns d = finest + growth x, in the plane and in space.
  function sideways_spacing(n, dim, xyz, d, user) bind(C)
    integer(c_int64_t), value :: n
    integer(c_int32_t), value :: dim
    real(c_double), intent(in) :: xyz(dim, n)
    real(c_double), intent(out) :: d(n)
    type(c_ptr), value :: user
    integer(c_int32_t) :: sideways_spacing
    type(cone), pointer :: c
    call c_f_pointer(user, c)
    d = c%finest + c%growth * xyz(1, :)
    c%calls = c%calls + 1
    sideways_spacing = c%answer
  end function

  function constant_spacing(n, dim, xyz, d, user) bind(C)
    integer(c_int64_t), value :: n
    integer(c_int32_t), value :: dim
    real(c_double), intent(in) :: xyz(dim, n)
    real(c_double), intent(out) :: d(n)
    type(c_ptr), value :: user
    integer(c_int32_t) :: constant_spacing
    d = 0.1d0
    constant_spacing = 0
    if (c_associated(user) .or. any(xyz < 0)) constant_spacing = 8
  end function

  !> Counts its calls, makes queries, and stops the run if `answer` is not 0.
  function watch(fraction, step, nodes, max_speed, user) bind(C)
    real(c_double), value :: fraction
    integer(c_int64_t), value :: step, nodes
    real(c_double), value :: max_speed
    type(c_ptr), value :: user
    integer(c_int32_t) :: watch
    type(cone), pointer :: c
    type(pnpbs_placement) :: placement
    integer(c_int64_t) :: count
    call c_f_pointer(user, c)
    c%calls = c%calls + 1
    watch = c%answer
    if (fraction < 0 .or. fraction > 1 .or. step < 0 .or. nodes < 0 .or. max_speed < 0) watch = 99
    if (c%placement == 0) return
    call placement%from_handle(c%placement)
    call placement%count(count, c%inner_count)
    call placement%step(1, c%inner_step)
  end function
end module watchers
