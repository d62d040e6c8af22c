! SPDX-License-Identifier: BSD-3-Clause
!> A surface for the tests of domains in space.
module tetrahedra
  use, intrinsic :: iso_c_binding
  implicit none
  !> The vertices and faces of a tetrahedron with a volume of 1/6.
  real(c_double), parameter :: vertices(3, 4) = reshape([0d0, 0d0, 0d0, 1d0, 0d0, 0d0, &
                                                         0d0, 1d0, 0d0, 0d0, 0d0, 1d0], [3, 4])
  integer(c_int64_t), parameter :: faces(3, 4) = reshape(int( &
    [1, 3, 2, 1, 2, 4, 1, 4, 3, 2, 3, 4], c_int64_t), [3, 4])
end module tetrahedra
