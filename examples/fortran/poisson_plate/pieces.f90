! SPDX-License-Identifier: BSD-3-Clause
!
! Output of one file per rank in VTK's legacy text format: owned nodes and ghosts, the triangles of
! the rank, and values at the nodes.
module pieces
  use, intrinsic :: iso_c_binding, only: c_double, c_int64_t
  use nodes_of_rank, only: local_nodes
  use plate, only: solution
  implicit none
  private
  public :: write_piece

  integer, parameter :: unit = 20

contains

  !> Writes <folder>/poisson_plate_<rank>.vtk. Local.
  subroutine write_piece(folder, rank, nodes, u)
    character(len=*), intent(in) :: folder
    integer, intent(in) :: rank
    type(local_nodes), intent(in) :: nodes
    real(c_double), intent(in) :: u(:)
    real(c_double) :: difference(size(u))
    integer(c_int64_t) :: i
    character(len=3) :: digits
    do i = 1, size(u)
      difference(i) = u(i) - solution(nodes%xy(:, i))
    end do
    write (digits, '(i3.3)') rank
    open (unit, file=folder // '/poisson_plate_' // digits // '.vtk', action='write', &
          status='replace')
    call write_triangles(nodes)
    write (unit, '(a, i0)') 'POINT_DATA ', size(u)
    call write_values('solution', u)
    call write_values('error', difference)
    close (unit)
  end subroutine

  subroutine write_triangles(nodes)
    type(local_nodes), intent(in) :: nodes
    integer :: n, t
    n = size(nodes%triangles, 2)
    write (unit, '(a)') '# vtk DataFile Version 3.0', 'poisson_plate', 'ASCII', &
      'DATASET UNSTRUCTURED_GRID'
    write (unit, '(a, i0, a)') 'POINTS ', size(nodes%xy, 2), ' double'
    write (unit, '(2es25.16e3, a)') (nodes%xy(:, t), ' 0', t = 1, size(nodes%xy, 2))
    write (unit, '(a, i0, 1x, i0)') 'CELLS ', n, 4 * n
    write (unit, '("3 ", i0, 1x, i0, 1x, i0)') nodes%triangles - 1
    write (unit, '(a, i0)') 'CELL_TYPES ', n
    write (unit, '(a)') ('5', t = 1, n)
  end subroutine

  subroutine write_values(name, values)
    character(len=*), intent(in) :: name
    real(c_double), intent(in) :: values(:)
    write (unit, '(a)') 'SCALARS ' // name // ' double 1', 'LOOKUP_TABLE default'
    write (unit, '(es25.16e3)') values
  end subroutine
end module pieces
