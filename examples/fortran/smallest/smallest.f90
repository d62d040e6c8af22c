! SPDX-License-Identifier: BSD-3-Clause
!
! The smallest program: places nodes in the unit square with the constant spacing 0.05.
! examples/c/smallest is the same program in C and explains the expected results.
program smallest
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t
  use pnpbs
  implicit none
  real(c_double), parameter :: corners(2, 4) = reshape([0d0, 0d0, 1d0, 0d0, 1d0, 1d0, 0d0, 1d0], &
                                                       [2, 4])
  type(pnpbs_context) :: context
  type(pnpbs_domain) :: domain
  type(pnpbs_placement) :: placement
  integer(c_int64_t) :: nodes, triangles, boundary
  integer(c_int32_t), allocatable :: tags(:)

  ! Without the argument stat, an error stops the program with its message.
  call context%create_serial
  call domain%create(context)
  call domain%add_polyline(PNPBS_BOUNDARY, .true., corners)
  call placement%create(context, domain)
  call placement%set_spacing_constant(0.05d0)
  call placement%run

  ! Results are copied into arrays of the caller, so their number is queried first.
  call placement%count(nodes)
  allocate (tags(nodes))
  call placement%get_nodes(tags=tags)
  boundary = count(tags /= 0)
  call placement%triangle_count(triangles)

  print '(a, i0, a)', 'nodes: ', nodes, ', expected about 503'
  print '(a, i0, a)', 'on the boundary: ', boundary, ', expected 80'
  print '(a, i0, a, i0)', 'triangles: ', triangles, ', expected ', 2 * nodes - boundary - 2

  call placement%destroy
  call domain%destroy
  call context%destroy
end program smallest
