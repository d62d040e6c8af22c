! SPDX-License-Identifier: BSD-3-Clause
!> Tests Voronoi cells of one process, in the plane and in space: their volumes fill the domain,
!> each cell is closed, faces are found by the offsets, and invalid arguments are rejected.
!> tests/parallel tests cells over ranks.
program test_voronoi
  use, intrinsic :: iso_c_binding
  use pnpbs
  use expectations
  implicit none
  type(pnpbs_context) :: context
  integer(c_int) :: stat
  character(len=300) :: errmsg

  call context%create_serial
  call about_the_plane
  call about_a_box
  call about_wrong_arguments
  call context%destroy
  call finish

contains

  subroutine about_the_plane
    type(pnpbs_domain) :: domain
    type(pnpbs_placement) :: placement
    call square(context, domain, placement, 0.15d0)
    call placement%run
    call look_at(placement, 2)
    call placement%destroy
    call domain%destroy
  end subroutine

  subroutine about_a_box
    type(pnpbs_domain) :: domain
    type(pnpbs_placement) :: placement
    call domain%create(context, 3)
    call domain%add_box([0d0, 0d0, 0d0], [1d0, 1d0, 1d0], 5)
    call placement%create(context, domain)
    call placement%set('steps', 20)
    call placement%set_spacing_constant(0.3d0)
    call placement%run
    call look_at(placement, 3)
    call placement%destroy
    call domain%destroy
  end subroutine

  !> Checks the cells of a domain with the measure 1.
  subroutine look_at(placement, dim)
    type(pnpbs_placement), intent(inout) :: placement
    integer, intent(in) :: dim
    type(pnpbs_voronoi) :: voronoi, same
    real(c_double), allocatable :: volumes(:), boundary(:,:), areas(:), distances(:), normals(:,:)
    real(c_double), allocatable :: x(:,:)
    integer(c_int64_t), allocatable :: ids(:), offsets(:), neighbours(:), numbers(:)
    integer(c_int64_t) :: nodes, count, faces, i, f, back
    integer(c_int32_t) :: columns
    call placement%count(nodes)
    call voronoi%create(placement)
    call voronoi%sizes(columns, count, faces)
    call expect(columns == dim .and. count == nodes .and. faces > nodes, 'sizes of cells')
    allocate (x(dim, nodes), ids(nodes), volumes(nodes), boundary(dim, nodes), offsets(nodes + 1))
    allocate (neighbours(faces), numbers(faces), areas(faces), distances(faces), normals(dim, faces))
    call placement%get_nodes(x, ids)
    call same%from_handle(voronoi%handle())
    call same%get_cells(volumes, boundary)
    call voronoi%get_faces(offsets, neighbours, numbers, areas, distances, normals)
    call voronoi%get_faces(offsets)
    call expect(abs(sum(volumes) - 1) < 1d-12, 'volumes of cells add up')
    call expect(offsets(1) == 1 .and. offsets(nodes + 1) == faces + 1, 'offsets of faces')
    do i = 1, nodes
      associate (a => offsets(i), b => offsets(i + 1) - 1)
        call expect(all(abs(boundary(:, i) + matmul(normals(:, a:b), areas(a:b))) < 1d-13), &
                    'a cell is closed')
      end associate
      do f = offsets(i), offsets(i + 1) - 1
        associate (there => x(:, place_of(neighbours(f), ids)))
          call expect(all(abs(x(:, i) + distances(f) * normals(:, f) - there) < 1d-14), &
                      'the way to a neighbour')
        end associate
        call expect(numbers(f) + 1 == place_of(neighbours(f), ids), 'the number of a neighbour')
        associate (a => offsets(place_of(neighbours(f), ids)), &
                   b => offsets(place_of(neighbours(f), ids) + 1) - 1)
          back = a - 1 + place_of(ids(i), neighbours(a:b))
          call expect(back >= a .and. areas(max(back, a)) == areas(f), 'a face of both cells')
        end associate
      end do
    end do
    call voronoi%destroy
    call expect(voronoi%handle() == 0, 'destroyed')
  end subroutine

  !> Returns the index of an id, from 1, or 0 if it is not found.
  function place_of(id, ids) result(place)
    integer(c_int64_t), intent(in) :: id, ids(:)
    integer(c_int64_t) :: place
    do place = size(ids, kind=c_int64_t), 1, -1
      if (ids(place) == id) return
    end do
  end function

  subroutine about_wrong_arguments
    type(pnpbs_domain) :: domain
    type(pnpbs_placement) :: placement
    type(pnpbs_voronoi) :: voronoi
    real(c_double) :: few(3), boundary(3, 200)
    real(c_double), allocatable :: none(:,:)
    integer(c_int64_t) :: offsets(200)
    call square(context, domain, placement, 0.3d0)
    call voronoi%create(placement, stat=stat)
    call expect(stat == PNPBS_ERROR_STATE .and. voronoi%handle() == 0, 'no cells without nodes')
    call voronoi%get_cells(few, stat=stat)
    call expect(stat == PNPBS_ERROR_HANDLE, 'no cells')
    call placement%run
    call voronoi%create(placement)
    call voronoi%get_cells(few, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_CAPACITY, errmsg, '3')
    call voronoi%get_cells(boundary=boundary, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'boundary')
    call voronoi%get_faces(offsets(:3), stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_CAPACITY, errmsg, 'offsets')
    call voronoi%get_faces(offsets, areas=few, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_CAPACITY, errmsg, 'faces')
    allocate (none(3, 0))
    call voronoi%get_faces(offsets, normals=none, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'normals')
    call voronoi%destroy
    call placement%destroy
    call domain%destroy
  end subroutine
end program
