! SPDX-License-Identifier: BSD-3-Clause
!> Tests a caller whose default integers have eight bytes (-fdefault-integer-8).
program test_eight_bytes
  use, intrinsic :: iso_c_binding
  use pnpbs
  implicit none
  type(pnpbs_context) :: context
  type(pnpbs_domain) :: domain
  type(pnpbs_placement) :: placement
  integer :: stat, nodes
  character(len=200) :: errmsg
  if (kind(stat) /= c_int64_t) stop 2
  stat = -1
  call context%create_serial(stat, errmsg)
  if (stat /= PNPBS_OK) stop 3
  call domain%create(context)
  call domain%add_arc(PNPBS_BOUNDARY, [0d0, 0d0], 1d0, 0d0, 8 * atan(1d0), stat=stat)
  call placement%create(context, domain, stat)
  call placement%set('steps', 20)
  call placement%set_spacing_constant(0.2d0)
  call placement%step(5, stat)
  if (stat /= PNPBS_NOT_CONVERGED) stop 5
  call placement%count(nodes)
  if (nodes < 50) stop 6
  call placement%set('stebs', 20, stat, errmsg)
  if (stat /= PNPBS_ERROR_KEY .or. index(errmsg, 'steps') == 0) stop 7
  call context%create_mpi(0, stat=stat)
  if (stat >= 0) stop 8
end program test_eight_bytes
