! SPDX-License-Identifier: BSD-3-Clause
!> Helpers of the tests of the Fortran modules: expectations, which are counted, and a placement.
module expectations
  use, intrinsic :: iso_c_binding
  use, intrinsic :: iso_fortran_env, only: error_unit
  use pnpbs
  implicit none
  private
  public :: expect, expect_failure, finish, square

  integer :: failures = 0, checks = 0

contains

  subroutine expect(condition, what)
    logical, intent(in) :: condition
    character(len=*), intent(in) :: what
    checks = checks + 1
    if (condition) return
    failures = failures + 1
    write (error_unit, '(4a)') 'FAILED: ', what, '; last error: ', pnpbs_last_error()
  end subroutine

  !> Expects an error with this status, whose message contains this text.
  subroutine expect_failure(stat, wanted, errmsg, text)
    integer(c_int), intent(in) :: stat, wanted
    character(len=*), intent(in) :: errmsg, text
    character(len=20) :: number
    write (number, '(i0)') stat
    call expect(stat == wanted, 'status ' // trim(number) // ' where "' // text // '" is wrong')
    call expect(index(errmsg, text) > 0, 'no "' // text // '" in "' // trim(errmsg) // '"')
  end subroutine

  !> Ends the program, with exit status 1 if an expectation failed.
  subroutine finish()
    write (*, '(i0, a, i0, a)') checks, ' checks, ', failures, ' failed'
    if (failures > 0 .or. checks == 0) stop 1
  end subroutine

  !> Creates a placement in the unit square with spacing d. It is not initialised.
  subroutine square(context, domain, placement, d)
    type(pnpbs_context), intent(in) :: context
    type(pnpbs_domain), intent(inout) :: domain
    type(pnpbs_placement), intent(inout) :: placement
    real(c_double), intent(in) :: d
    real(c_double), parameter :: corners(2, 4) = reshape([0d0, 0d0, 1d0, 0d0, 1d0, 1d0, 0d0, 1d0], &
                                                         [2, 4])
    call domain%create(context)
    call domain%add_polyline(PNPBS_BOUNDARY, .true., corners)
    call placement%create(context, domain)
    call placement%set_spacing_constant(d)
  end subroutine
end module expectations
