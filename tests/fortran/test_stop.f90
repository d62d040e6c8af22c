! SPDX-License-Identifier: BSD-3-Clause
!> Causes an error in a call without stat, which stops the program. stop.sh checks how it ends.
program test_stop
  use, intrinsic :: iso_c_binding
  use pnpbs
  implicit none
  type(pnpbs_context) :: context
  type(pnpbs_domain) :: domain
  character(len=100) :: errmsg
  character(len=10) :: way
  real :: no_integer
  call get_command_argument(1, way)
  call context%create_serial
  select case (way)
  case ('library')
    call context%set('stebs', 3, errmsg=errmsg)
  case ('module')
    call domain%create(context)
    call domain%add_hole([1d0])
  case ('stat')
    call domain%create(context, stat=no_integer)
  case ('outcome')
    call run_out_of_steps
    stop 3
  end select
  stop 4

contains

  ! A status above zero is not an error, so the program continues.
  subroutine run_out_of_steps
    type(pnpbs_placement) :: placement
    call domain%create(context)
    call domain%add_arc(PNPBS_BOUNDARY, [0d0, 0d0], 1d0, 0d0, 8 * atan(1d0))
    call placement%create(context, domain)
    call placement%set_spacing_constant(0.3d0)
    call placement%step(1)
  end subroutine
end program test_stop
