! SPDX-License-Identifier: BSD-3-Clause
!> Tests placements of one process: nodes and lists against the C interface, spacings, files, and
!> invalid arguments.
program test_placement
  use, intrinsic :: iso_c_binding
  use pnpbs
  use expectations
  use twins
  implicit none
  type(pnpbs_context) :: context
  integer(c_int) :: stat
  character(len=300) :: errmsg

  call context%create_serial
  call about_a_square
  call about_steps
  call about_spacings
  call about_values_at_points
  call about_given_nodes
  call about_wrong_arguments
  call about_files
  call context%destroy
  call pnpbs_finalize(stat)
  call expect(stat == PNPBS_OK, 'finalize')
  call finish

contains

  ! Checks the placement of examples/c/smallest: 80 nodes on the boundary, and Euler's formula.
  subroutine about_a_square
    type(pnpbs_domain) :: domain
    type(pnpbs_placement) :: placement, same
    integer(c_int64_t) :: nodes, all_nodes, triangles, inserted, deleted
    integer(c_int32_t), allocatable :: tags(:)
    integer(c_int32_t) :: warnings, code, points
    real(c_double) :: point(3)
    real(c_double) :: imbalance
    character(len=:), allocatable :: hash, hash_again, text
    call square(context, domain, placement, 0.05d0)
    call placement%run(stat)
    call expect(stat == PNPBS_OK .or. stat == PNPBS_NOT_CONVERGED, 'run')
    call placement%count(nodes)
    call expect(abs(nodes - 503) < 20, 'about 503 nodes')
    allocate (tags(nodes))
    call placement%get_nodes(tags=tags)
    call expect(count(tags /= 0) == 80, '80 nodes on the boundary')
    call placement%triangle_count(triangles)
    call expect(triangles == 2 * nodes - 80 - 2, 'triangles by Euler''s formula')
    call compare_with_c(placement)

    call placement%get('nodes', all_nodes)
    call expect(all_nodes == nodes, 'the statistic nodes')
    call placement%get('imbalance', imbalance)
    call expect(imbalance == 1, 'the statistic imbalance')
    call placement%get('hash', hash)
    call expect(len(hash) > 8, 'hash')
    call placement%get('hash', nodes, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_KEY, errmsg, 'hash')
    call placement%get('nodos', imbalance, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_KEY, errmsg, 'nodes')
    call placement%get('nodes', text, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_KEY, errmsg, 'nodes')

    call about_elements(placement)
    call placement%warning_count(warnings)
    call expect(warnings == 0, 'no warnings')
    call placement%get_warning(1, text, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'index')
    call placement%get_warning_data(1, code, all_nodes, imbalance, point, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'index')
    call expect(code == PNPBS_WARNING_UNKNOWN .and. all(point /= point), 'no such warning')
    call context%last_error_data(code, points)
    call expect(code == PNPBS_REASON_OTHER .and. points == 0, 'data of an error')
    call context%last_error_point(1, point)
    call expect(all(point /= point), 'no point')
    call placement%rebalance
    call placement%check(stat)
    call expect(stat == PNPBS_OK, 'the results are right')
    call same%from_handle(placement%handle())
    call same%get('hash', hash_again)
    call expect(hash == hash_again, 'rebalancing moves no node')
    call placement%adjust_population(inserted, deleted)
    call expect(inserted >= 0 .and. deleted >= 0, 'population')
    call placement%adjust_population
    call placement%destroy
    call same%count(nodes, stat)
    call expect(stat == PNPBS_ERROR_HANDLE .and. nodes == 0, 'a dead placement')
    call domain%destroy
  end subroutine

  ! Checks quality, edge length over d, and the estimate of a run.
  subroutine about_elements(placement)
    type(pnpbs_placement), intent(in) :: placement
    integer(c_int64_t) :: bands, edges(8), too_few(0), nodes, all_nodes, bytes
    real(c_double) :: quality, mean, d_from(8), d_to(8), means(8), deviation(8), seconds
    call placement%get('quality.mean', quality)
    call expect(quality > 0.97 .and. quality < 1, 'mean quality')
    call placement%get('edge.mean', mean)
    call expect(abs(mean - 1) < 0.05, 'edges over d')
    call placement%edge_band_count(bands)
    call expect(bands == 1, 'one band where d is constant')
    call placement%get_edge_bands(d_from, d_to, edges, means, deviation)
    call expect(d_from(1) == 0.05d0 .and. d_to(1) == 0.05d0, 'the band')
    call expect(edges(1) > 1000 .and. abs(means(1) - 1) < 0.05, 'edges of the band')
    call expect(deviation(1) > 0 .and. deviation(1) < 0.1, 'their deviation')
    call placement%get_edge_bands(edges=too_few, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_CAPACITY, errmsg, 'capacity')
    call placement%cell_band_count(bands)
    call expect(bands == 1, 'one band of cells')
    call placement%get_cell_bands('area_ratio', d_from, d_to, edges, means, deviation)
    call expect(d_from(1) == 0.05d0 .and. d_to(1) == 0.05d0, 'the band of cells')
    call placement%get('cell.mean_area_ratio', mean)
    call expect(edges(1) > 1000 .and. means(1) == mean, 'edges between cells')
    call placement%get('cell.min_area_ratio', mean)
    call expect(deviation(1) == mean .and. mean > 0.5 .and. mean < means(1), 'the least ratio')
    call placement%get_cell_bands('area_rati', stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_KEY, errmsg, 'area_ratio')
    call placement%get('nodes', nodes)
    call placement%estimate(all_nodes, bytes, seconds)
    call expect(abs(all_nodes - nodes) < 0.05d0 * nodes, 'expected nodes')
    call expect(bytes > 260 * all_nodes .and. seconds > 0, 'expected memory and time')
    call placement%estimate(stat=stat)
    call expect(stat == PNPBS_OK, 'nothing asked')
  end subroutine

  subroutine about_steps
    type(pnpbs_domain) :: domain
    type(pnpbs_placement) :: placement
    integer(c_int64_t) :: nodes, more, inserted, deleted, offsets(3), neighbours(1)
    call square(context, domain, placement, 0.1d0)
    call placement%count(nodes)
    call expect(nodes == 0, 'no nodes yet')
    call placement%get_adjacency(offsets, neighbours, stat)
    call expect(stat == PNPBS_ERROR_STATE, 'no lists yet')
    call placement%initialise
    call placement%count(nodes)
    call expect(nodes > 100, 'initial nodes')
    call placement%step(3, stat)
    call expect(stat == PNPBS_NOT_CONVERGED, 'three steps')
    call placement%step(2_c_int64_t, stat)
    call placement%step(-1, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, '-1')
    call compare_with_c(placement)
    ! One inner node is far too few, so many must be inserted.
    call placement%set_nodes(reshape([0.5d0, 0.5d0], [2, 1]))
    call placement%initialise
    call placement%count(nodes)
    call placement%adjust_population(inserted, deleted)
    call placement%count(more)
    call expect(inserted > deleted .and. more == nodes + inserted - deleted, 'a sparse population')
    call placement%destroy
    call domain%destroy
  end subroutine

  subroutine about_spacings
    type(pnpbs_domain) :: domain
    type(pnpbs_placement) :: placement
    integer(c_int64_t) :: coarse, fine
    real(c_double), allocatable :: d(:)
    call square(context, domain, placement, 0.1d0)
    call placement%set('steps', 60)
    call placement%set_spacing_constant(-1d0, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_SPACING, errmsg, '-1')
    call placement%set_spacing_at_nodes([1d0], stat)
    call expect(stat == PNPBS_ERROR_STATE, 'values at no nodes')
    call placement%run
    call placement%count(coarse)
    allocate (d(coarse))
    d = 0.05d0
    call placement%set_spacing_at_nodes(d)
    call placement%run
    call placement%count(fine)
    call expect(fine > 3 * coarse, 'finer by values at nodes')
    call placement%set_spacing_at_nodes(d, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'nodes')
    ! x varies fastest: d is fine on the left and coarse on the right.
    call placement%set_spacing_grid([0d0, 0d0], [1d0, 1d0], reshape([0.05d0, 0.2d0], [2, 1]))
    call placement%run
    call expect(left_of_middle(placement) > 0.7, 'finer on the left')
    call placement%set_spacing_grid([0d0], [1d0, 1d0], reshape([0.05d0], [1, 1]), stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'origin')
    call placement%set_spacing_grid([0d0, 0d0], [1d0, 0d0], reshape([0.05d0], [1, 1]), stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'step[1]')
    call placement%destroy
    call domain%destroy
  end subroutine

  function left_of_middle(placement) result(share)
    type(pnpbs_placement), intent(in) :: placement
    real(c_double), allocatable :: xy(:,:)
    integer(c_int64_t) :: nodes
    real(c_double) :: share
    call placement%count(nodes)
    allocate (xy(2, nodes))
    call placement%get_nodes(xy)
    share = real(count(xy(1, :) < 0.5d0), c_double) / real(nodes, c_double)
  end function

  !> Checks a linear spacing from two triangles, from their corners as points, and from a file.
  subroutine about_values_at_points
    type(pnpbs_domain) :: domain
    type(pnpbs_placement) :: placement
    real(c_double) :: x(2, 4), d(4)
    integer(c_int64_t) :: corners(3, 2)
    integer, parameter :: unit = 31
    integer :: kind
    x = reshape([-1d0, -1d0, 2d0, -1d0, 2d0, 2d0, -1d0, 2d0], [2, 4])
    d = 0.05d0 + 0.02d0 * (x(1, :) + 1)
    corners = reshape([1, 2, 3, 4, 3, 1], [3, 2])
    open (unit=unit, file='points.csv', action='write')
    write (unit, '(a)') 'x,y,d,other'
    write (unit, '(3(es24.16, ","), i0)') (x(:, kind), d(kind), 7, kind=1, 4)
    close (unit)
    call square(context, domain, placement, 0.1d0)
    call placement%set('steps', 20)
    do kind = 1, 3
      if (kind == 1) call placement%set_spacing_mesh(x, d, corners)
      if (kind == 2) call placement%set_spacing_points(x, d)
      if (kind == 3) call placement%set_spacing_file('points.csv', 'd')
      call placement%run
      call expect(has_linear_spacing(placement), 'values at given points')
    end do
    corners(2, 2) = 5
    call placement%set_spacing_mesh(x, d, corners, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, '4 nodes')
    call placement%set_spacing_mesh(x, d(:3), corners, stat, errmsg)
    call expect(stat < 0, 'values of other points')
    call placement%set_spacing_mesh(x, d, corners(:2, :), stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'corners')
    call placement%set_spacing_points(x(:1, :), d, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'coordinates')
    call placement%set_spacing_points(x, -d, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_SPACING, errmsg, '= -0.05')
    call placement%set_spacing_file('points.csv', stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_FILE, errmsg, "'d', 'other'")
    call placement%destroy
    call domain%destroy
  end subroutine

  function has_linear_spacing(placement) result(has)
    type(pnpbs_placement), intent(in) :: placement
    real(c_double), allocatable :: xy(:,:), d(:)
    integer(c_int64_t) :: nodes
    logical :: has
    call placement%count(nodes)
    allocate (xy(2, nodes), d(nodes))
    call placement%get_nodes(xy, spacing=d)
    has = all(abs(d - 0.07d0 - 0.02d0 * xy(1, :)) < 1d-9)
  end function

  subroutine about_given_nodes
    type(pnpbs_domain) :: domain
    type(pnpbs_placement) :: placement
    real(c_double) :: xy(2, 3)
    integer(c_int64_t) :: ids(3), found(3)
    integer(c_int64_t) :: nodes
    integer(c_int64_t), allocatable :: all_ids(:)
    integer(c_int32_t), allocatable :: tags(:)
    integer :: i
    xy = reshape([0.3d0, 0.3d0, 0.7d0, 0.4d0, 0.5d0, 0.7d0], [2, 3])
    ids = [1000001, 1000005, 1000003]
    call square(context, domain, placement, 0.4d0)
    call placement%set_nodes(xy, ids)
    call placement%initialise
    call placement%count(nodes)
    allocate (all_ids(nodes), tags(nodes))
    call placement%get_nodes(ids=all_ids, tags=tags)
    found = [(count(all_ids == ids(i) .and. tags == 0), i = 1, 3)]
    call expect(all(found == 1), 'ids that were given')
    call placement%set_nodes(xy)
    call placement%set_nodes(xy, ids(:2), stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_CAPACITY, errmsg, 'ids has room for 2; 3')
    call placement%set_nodes(reshape(xy, [3, 2]), stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'coordinates')
    call placement%destroy
    call domain%destroy
  end subroutine

  subroutine about_wrong_arguments
    type(pnpbs_domain) :: domain
    type(pnpbs_placement) :: placement
    integer(c_int64_t) :: nodes, entries, triangles
    real(c_double), allocatable :: three(:,:)
    integer(c_int64_t), allocatable :: ids(:), offsets(:), neighbours(:), corners(:,:)
    integer(c_int8_t), allocatable :: triangle(:)
    integer(c_int32_t) :: ranks(1)
    call square(context, domain, placement, 0.2d0)
    call placement%run
    call placement%count(nodes)
    allocate (three(3, nodes), ids(2 * nodes), offsets(nodes + 1))
    call placement%get_nodes(three, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'coordinates has an extent of 3; 2')
    call placement%get_nodes(three(1:2, :), stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'coordinates has gaps in memory')
    call placement%get_nodes(ids=ids(::2), stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'ids has gaps in memory')
    call placement%get_nodes(ids=ids(2 * nodes:1:-1), stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'ids has gaps in memory')
    call placement%get_nodes(ids=ids(3:2 + nodes), stat=stat)
    call expect(stat == PNPBS_OK, 'a section without gaps')
    call placement%get_nodes(ids=ids(:nodes - 1), stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_CAPACITY, errmsg, 'are needed')
    call placement%get_nodes(stat=stat)
    call expect(stat == PNPBS_OK, 'asking for nothing')

    call placement%adjacency_size(entries)
    allocate (neighbours(entries))
    call placement%get_adjacency(offsets(:nodes), neighbours, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_CAPACITY, errmsg, 'offsets has room for')
    call placement%get_adjacency(offsets, neighbours(:entries - 1), stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_CAPACITY, errmsg, 'are needed')
    call placement%star_size(entries)
    allocate (triangle(entries))
    call placement%get_stars(offsets(:1), neighbours, triangle, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_CAPACITY, errmsg, 'offsets has room for 1')
    call placement%get_stars(offsets, neighbours, triangle(:5), stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_CAPACITY, errmsg, 'are needed')
    call placement%triangle_count(triangles)
    allocate (corners(3, triangles))
    call placement%get_triangles(corners(:, :0), stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_CAPACITY, errmsg, 'are needed')
    call placement%get_triangles(corners(1:2, :), stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'triangles has an extent of 2')
    call placement%get_boundary_edges(corners(:2, :), stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'edges has gaps')
    call placement%get_exchange(ranks, offsets(:0), ids, offsets, neighbours, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_CAPACITY, errmsg, 'send_offsets has room for 0; 1')
    call placement%destroy
    call domain%destroy
  end subroutine

  subroutine about_files
    type(pnpbs_domain) :: domain
    type(pnpbs_placement) :: placement
    integer(c_int64_t) :: nodes
    character(len=24) :: paths(3)
    logical :: there
    call square(context, domain, placement, 0.2d0)
    call placement%write('fortran_none.csv', stat=stat)
    call expect(stat == PNPBS_ERROR_STATE, 'nothing to write yet')
    call placement%run
    call placement%count(nodes)
    call placement%write('fortran_square.csv')
    call expect(lines_of('fortran_square.csv') == nodes + 1, 'a line for every node')
    paths = ['fortran_a.csv           ', 'fortran_b.node          ', 'fortran_c.txt           ']
    call placement%write_files(paths, ['    ', 'node', 'csv '], [.false., .true., .false.])
    call expect(lines_of('fortran_a.csv') == nodes + 1, 'format of the extension')
    call expect(lines_of('fortran_c.txt') == nodes + 1, 'format by name')
    inquire (file='fortran_b.ele', exist=there)
    call expect(there, 'elements where they were asked for')
    call placement%write_files(paths(:2))
    call placement%write('fortran_square.xyz', .true., stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'xyz')
    call placement%write('no/such/folder/a.csv', stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_FILE, errmsg, 'no/such/folder')
    call placement%write_files(paths, ['csv'], stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_CAPACITY, errmsg, 'formats has room for 1; 3')
    call about_output_fields(placement, nodes)
    call about_checkpoints(placement)
    call placement%destroy
    call domain%destroy
  end subroutine

  subroutine about_output_fields(placement, nodes)
    type(pnpbs_placement), intent(in) :: placement
    integer(c_int64_t), intent(in) :: nodes
    real(c_double) :: x(2, nodes)
    integer(c_int64_t) :: plain
    call placement%get_nodes(x)
    call placement%write('fortran_a.msh')
    plain = lines_of('fortran_a.msh')
    call placement%add_output_field('flow', x)
    call placement%add_output_field('u ', x(1, :))
    call placement%write('fortran_a.msh')
    call expect(lines_of('fortran_a.msh') == plain + 2 * (nodes + 10), 'fields in the file')
    call placement%add_output_field('u', x(1, :), stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, '"u"')
    call placement%clear_output_fields
    call placement%write('fortran_a.msh')
    call expect(lines_of('fortran_a.msh') == plain, 'fields are forgotten')
  end subroutine

  subroutine about_checkpoints(placement)
    type(pnpbs_placement), intent(in) :: placement
    type(pnpbs_domain) :: domain
    type(pnpbs_placement) :: again
    character(len=:), allocatable :: before, after
    if (index(pnpbs_build_info(), 'HDF5: none') > 0) then
      call placement%write_checkpoint('fortran_a.vtkhdf', stat)
      call expect(stat == PNPBS_ERROR_UNSUPPORTED, 'no checkpoints without HDF5')
      return
    end if
    call placement%write_checkpoint('fortran_a.vtkhdf  ')
    call square(context, domain, again, 0.2d0)
    call again%read_checkpoint('fortran_a.vtkhdf')
    call placement%get('hash', before)
    call again%get('hash', after)
    call expect(before == after, 'the nodes that were saved')
    call again%read_checkpoint('fortran_b.node', stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_FILE, errmsg, 'fortran_b.node')
    call again%destroy
    call domain%destroy
  end subroutine

  function lines_of(path) result(n)
    character(len=*), intent(in) :: path
    integer(c_int64_t) :: n
    integer :: status
    n = 0
    open (18, file=path, status='old', action='read')
    do
      read (18, *, iostat=status)
      if (status /= 0) exit
      n = n + 1
    end do
    close (18)
  end function
end program test_placement
