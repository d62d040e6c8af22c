! SPDX-License-Identifier: BSD-3-Clause
!> Tests shapes that GDAL reads, by the module pnpbs_geo.
program test_shapes
  use, intrinsic :: iso_c_binding
  use pnpbs
  use pnpbs_geo
  use expectations
  implicit none
  character(len=*), parameter :: path = 'fortran_shapes.geojson'
  real(c_double), parameter :: corners(2, 4) = reshape([18d0, 54d0, 20d0, 54d0, 20d0, 55d0, 18d0, &
                                                        55d0], [2, 4])
  type(pnpbs_context) :: context
  integer(c_int) :: stat
  character(len=300) :: errmsg

  call write_lines(path, [character(len=110) :: &
    '{"type": "FeatureCollection", "features": [', &
    '{"type": "Feature", "properties": {"name": "shore"}, "geometry": {"type": "Polygon",', &
    '"coordinates": [[[18, 54], [20, 54], [20, 55], [18, 55], [18, 54]]]}},', &
    '{"type": "Feature", "properties": {"name": "buoy"}, "geometry": {"type": "Point",', &
    '"coordinates": [19, 54.5]}}]}'])
  call context%create_serial
  call about_a_coast
  call about_grids
  call about_errors
  call context%destroy
  call finish

contains

  subroutine write_lines(name, lines)
    character(len=*), intent(in) :: name, lines(:)
    integer :: unit, i
    unit = 17
    open (unit, file=name, status='replace', action='write')
    write (unit, '(a)') (trim(lines(i)), i = 1, size(lines))
    close (unit)
  end subroutine

  subroutine about_a_coast
    type(pnpbs_geo_shapes) :: shapes
    type(pnpbs_domain) :: domain
    type(pnpbs_placement) :: placement
    real(c_double), allocatable :: x(:,:)
    real(c_double) :: least, greatest, xy(2, 4)
    integer(c_int64_t) :: nodes, vertices, boundary, inner, points
    integer(c_int32_t) :: names, notes, dim, tag
    integer :: k
    character(len=:), allocatable :: name, unit, proj, wkt, prj
    call shapes%read(path, projection='EPSG:2180', unit='km', tag_field='name')
    call shapes%counts(vertices, boundary, inner, points)
    call expect(all([vertices, boundary, inner, points] == [5, 1, 0, 1]), 'what was read')
    call shapes%projection(name, unit, proj, wkt, prj)
    call expect(name == 'ETRF2000-PL / CS92 in kilometre', 'name of the projection')
    call expect(unit == 'kilometre', 'unit of the projection')
    call expect(index(proj, '+proj=tmerc') == 1 .and. index(wkt, 'PROJCRS') == 1 &
                .and. index(prj, 'PROJCS') == 1, 'forms of the projection')
    call shapes%scale(least, greatest)
    call expect(least > 0.999d0 .and. greatest < 1 .and. least < greatest, 'scale')
    call shapes%note_count(notes)
    call expect(notes == 0, 'no notes')

    call domain%create(context)
    call shapes%add_to_domain(context, domain, 45d0)
    call domain%tag_name_count(names)
    call domain%get_tag_name(1, dim, tag, name)
    call expect(names == 2 .and. dim == 1 .and. name == 'shore', 'names of tags')
    call placement%create(context, domain)
    call placement%set('steps', 20)
    call placement%set_spacing_constant(10d0)
    call placement%run
    call placement%count(nodes)
    allocate (x(2, nodes))
    call placement%get_nodes(x)
    xy = corners
    call shapes%from_degrees(xy)
    do k = 1, 4
      call expect(minval((x(1, :) - xy(1, k))**2 + (x(2, :) - xy(2, k))**2) < 1d-18, &
                  'a corner is a node')
    end do
    ! Sides are straight in the projection, so the northern one bends to 55.004 degrees.
    call shapes%to_degrees(x)
    call expect(all(x(1, :) > 17.999d0 .and. x(1, :) < 20.001d0 .and. x(2, :) > 53.98d0 &
                    .and. x(2, :) < 55.01d0), 'longitudes and latitudes')
    call shapes%write_prj('fortran_shapes.vtu')
    call expect(text_in('fortran_shapes.prj') == prj, '.prj file')
    call expect(shapes%explain('at (500, 700)') == 'at (500, 700)', 'text that is no message')
    call placement%destroy
    call domain%destroy
    call shapes%destroy
    call shapes%read(path, region_field='name')
    call domain%create(context)
    call shapes%add_to_domain(context, domain)
    call domain%tag_name_count(names)
    call domain%get_tag_name(1, dim, tag, name)
    call expect(names == 1 .and. dim == 2 .and. tag == 1 .and. name == 'shore', 'name of a region')
    call domain%destroy
    call shapes%destroy
    call shapes%counts(vertices, stat=stat)
    call expect(stat == PNPBS_ERROR_HANDLE, 'destroyed shapes')
    call expect(shapes%explain('as it is (1, 2)') == 'as it is (1, 2)', 'message without shapes')
    call expect(index(pnpbs_geo_build_info(), 'GDAL: ') == 1, 'versions')
  end subroutine

  ! Checks a grid with the values 3 longitude + latitude. The file beside it says that it is in
  ! degrees.
  subroutine about_grids
    character(len=*), parameter :: name = 'fortran_depth.asc'
    type(pnpbs_geo_shapes) :: shapes
    type(pnpbs_geo_grid) :: grid
    character(len=:), allocatable :: wkt
    real(c_double) :: xy(2, 4), found(4), low(2), high(2)
    logical :: inside(4)
    call write_lines(name, [character(len=110) :: 'ncols 3', 'nrows 2', 'xllcenter 17', &
                            'yllcenter 53', 'cellsize 2', '106 112 118', '104 110 116'])
    call write_lines('fortran_depth.prj', [character(len=110) :: &
      'GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],', &
      'PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]]'])
    call shapes%read(path)
    call shapes%projection(wkt=wkt)
    xy = corners
    call shapes%from_degrees(xy)
    call grid%read(name, minval(xy, 2), maxval(xy, 2), projection=wkt)
    call grid%values(xy, found, inside)
    call expect(all(abs(found - [108, 114, 115, 109]) < 1d-4), 'values on a grid')
    call expect(all(inside), 'all points are in the grid')
    call grid%slopes(xy, found)
    call expect(all(found > 1d-5 .and. found < 1d-4), 'slopes of a grid, 2 and 3 per degree')
    call grid%slopes(xy, found(:3), stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'slopes has an extent of 3')
    call pnpbs_geo_depth_spacing([4000d0, 1d0], found(:2), metres=1000d0)
    call expect(all(abs(found(:2) - sqrt(9.81d0 * [4000d0, 10d0]) * 44.712d0 / 30) < 1d-9), 'd by depth')
    call pnpbs_geo_depth_spacing([200d0], found(:1), 1000d0, slopes=[50d0], slope=20d0)
    call expect(abs(found(1) - 0.4d0 * acos(-1d0)) < 1d-12, 'd by slopes of the depth')
    call pnpbs_geo_depth_spacing([200d0], found(:1), 1000d0, slope=20d0, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'slopes has an extent of 0')
    call grid%extent(low, high)
    call expect(all(low < minval(xy, 2)) .and. all(high > maxval(xy, 2)), 'extent of a grid')
    call grid%values(xy, found(:3), stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'values has an extent of 3')
    call grid%destroy
    call grid%extent(low, high, stat)
    call expect(stat == PNPBS_ERROR_HANDLE, 'a destroyed grid')
    call grid%read(name, [50d0, 10d0], [51d0, 11d0], stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_SPACING, errmsg, 'outside of the domain')
    call shapes%destroy
  end subroutine

  function text_in(name) result(text)
    character(len=*), intent(in) :: name
    character(len=2000) :: text
    integer :: unit
    unit = 18
    open (unit, file=name, status='old', action='read')
    read (unit, '(a)') text
    close (unit, status='delete')
  end function

  subroutine about_errors
    type(pnpbs_geo_shapes) :: shapes
    type(pnpbs_domain) :: domain
    character(len=:), allocatable :: note
    real(c_double) :: x(3, 2)
    call shapes%read(path, layer='sea', stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_FILE, errmsg, 'no layer ''sea''')
    call expect(index(pnpbs_geo_last_error(), 'no layer ''sea''') > 0, 'the last error')
    call shapes%read(path, projection='EPSG:1', stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'EPSG:1')
    call shapes%read(path, unit='mile', stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'm or km')
    call shapes%read(path)
    call domain%create(context)
    call shapes%add_to_domain(context, domain, 200d0, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'corner_angle')
    x = 0
    call shapes%to_degrees(x, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'coordinates has an extent of 3')
    call shapes%get_note(1, note, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'index')
    call domain%destroy
    call shapes%destroy
  end subroutine
end program
