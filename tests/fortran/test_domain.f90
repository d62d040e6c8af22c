! SPDX-License-Identifier: BSD-3-Clause
!> Tests domains: every kind of curve, known areas, and invalid arguments.
program test_domain
  use, intrinsic :: iso_c_binding
  use pnpbs
  use expectations
  use twins
  use curves
  use watchers
  implicit none
  real(c_double), parameter :: pi = 3.14159265358979323846d0
  real(c_double), parameter :: corners(2, 4) = reshape([0d0, 0d0, 2d0, 0d0, 2d0, 1d0, 0d0, 1d0], &
                                                       [2, 4])
  type(pnpbs_context) :: context
  integer(c_int) :: stat
  character(len=300) :: errmsg

  call context%create_serial
  call about_polylines
  call about_arcs_and_curves
  call about_open_curves
  call about_graphs_with_tags
  call about_graphs
  call about_graphs_finer_than_d
  call about_offsets
  call about_files
  call about_wrong_arguments
  call context%destroy
  call finish

contains

  function area(domain)
    type(pnpbs_domain), intent(in) :: domain
    real(c_double) :: area
    call domain%measure(area)
  end function

  subroutine about_polylines
    type(pnpbs_domain) :: domain
    real(c_double) :: low(2), high(2)
    real(c_double), allocatable :: segments(:,:,:)
    real(c_double) :: wide(3, 4)
    integer(c_int32_t), allocatable :: tags(:)
    integer(c_int64_t) :: count
    call domain%create(context)
    ! A section with gaps is copied to a contiguous array before the call.
    wide = 9
    wide(1:2, :) = corners
    call domain%add_polyline(PNPBS_BOUNDARY, .true., wide(1:2, :), [3, 4, 5, 6], 0d0)
    call domain%add_polyline(PNPBS_INNER, .false., &
                             reshape([0.5d0, 0.5d0, 1.5d0, 0.5d0], [2, 2]), [7])
    call domain%check
    call expect(area(domain) == 2, 'area of a rectangle')
    call domain%bounds(low, high)
    call expect(all(low == 0) .and. all(high == [2d0, 1d0]), 'bounds')
    call domain%segment_count(count)
    call expect(count == 5, 'five segments')
    allocate (segments(2, 2, count), tags(count))
    call domain%get_segments(segments, tags)
    call expect(twin_segments(domain%handle(), count, segments, tags) == 0, 'segments as in C')
    call expect(any(tags == 7) .and. any(tags == 3), 'tags')
    call domain%get_segments(segments(:, :, :4), stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_CAPACITY, errmsg, '5')
    call domain%get_segments(tags=tags(:0), stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_CAPACITY, errmsg, '5')
    call domain%destroy
  end subroutine

  subroutine about_arcs_and_curves
    type(pnpbs_domain) :: domain
    real(c_double), target :: axes(2)
    call domain%create(context, 2)
    call domain%add_arc(PNPBS_BOUNDARY, [1d0, 2d0], 3d0, 0d0, 2 * pi, 4)
    call domain%add_arc(PNPBS_BOUNDARY, [1d0, 2d0], 1d0, 0d0, 2 * pi)
    call expect(abs(area(domain) - 8 * pi) < 0.05, 'area of a ring')
    call domain%destroy
    axes = [2d0, 0.5d0]
    call domain%create(context)
    call domain%add_curve(PNPBS_BOUNDARY, ellipse, 0d0, 2 * pi, user=c_loc(axes(1)))
    call expect(abs(area(domain) - pi) < 0.01, 'area of an ellipse')
    call domain%destroy
    call domain%create(context)
    call domain%add_curve(PNPBS_BOUNDARY, ellipse, 0d0, 2 * pi, 5, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_CALLBACK, errmsg, '4')
    call domain%destroy
  end subroutine

  !> Returns the index of the first segment with a tag.
  function first_with(tag, tags)
    integer, intent(in) :: tag
    integer(c_int32_t), intent(in) :: tags(:)
    integer :: first_with
    do first_with = 1, size(tags)
      if (tags(first_with) == tag) exit
    end do
  end function

  !> Checks where open curves begin, as the order of their segments is not determined by their
  !> shape.
  subroutine about_open_curves
    type(pnpbs_domain) :: domain
    real(c_double), target :: axes(2)
    real(c_double), allocatable :: segments(:,:,:)
    integer(c_int32_t), allocatable :: tags(:)
    integer(c_int64_t) :: count
    integer :: i
    call domain%create(context)
    call domain%add_polyline(PNPBS_BOUNDARY, .true., corners, [1, 1, 1, 1])
    call domain%add_arc(PNPBS_INNER, [1d0, 0.25d0], 0.5d0, 0.25d0 * pi, 0.75d0 * pi, 2)
    axes = [1.5d0, 0.75d0]
    call domain%add_curve(PNPBS_INNER, ellipse, 0.1d0, 0.7d0, 3, user=c_loc(axes(1)))
    call domain%segment_count(count)
    allocate (segments(2, 2, count), tags(count))
    call domain%get_segments(segments, tags)
    i = first_with(2, tags)
    call expect(maxval(abs(segments(:, 1, i) - [1 + sqrt(0.125d0), 0.25d0 + sqrt(0.125d0)])) &
                < 1d-12, 'where the arc begins')
    i = first_with(3, tags)
    call expect(maxval(abs(segments(:, 1, i) - axes * [cos(0.1d0), sin(0.1d0)])) < 1d-12, &
                'where the curve begins')
    call domain%destroy
  end subroutine

  subroutine about_graphs
    type(pnpbs_domain) :: domain
    real(c_double) :: xy(2, 8)
    integer(c_int64_t) :: ends(2, 8)
    integer :: i
    xy(:, 1:4) = corners
    xy(:, 5:8) = 0.25d0 * corners + 0.25d0
    do i = 1, 8
      ends(:, i) = [i, i + 1]
    end do
    ends(2, 4) = 1
    ends(2, 8) = 5
    call domain%create(context)
    call domain%add_pslg(xy, ends)
    call expect(area(domain) == 2, 'area without its hole')
    call domain%destroy
    call domain%create(context)
    call domain%add_pslg(xy, ends, [1, 2, 3, 4, 5, 6, 7, 8], [(2, i = 1, 8)], &
                         reshape([0.4d0, 0.4d0], [2, 1]))
    call expect(abs(area(domain) - 1.875d0) < 1d-14, 'area with its hole')
    call domain%add_fixed_nodes(reshape([1.5d0, 0.75d0], [2, 1]), [9])
    call domain%add_fixed_nodes(reshape([1.2d0, 0.75d0], [2, 1]))
    call domain%check
    call domain%destroy
    ! The last vertex has the index 8, as Fortran counts from 1.
    ends(2, 8) = 9
    call domain%create(context)
    call domain%add_pslg(xy, ends, stat=stat, errmsg=errmsg)
    call expect(stat == PNPBS_ERROR_ARGUMENT .or. stat == PNPBS_ERROR_DOMAIN, 'a ninth vertex')
    call domain%add_polyline(PNPBS_BOUNDARY, .true., corners)
    call domain%add_polyline(PNPBS_BOUNDARY, .true., xy(:, 5:8))
    call domain%destroy
    call domain%create(context)
    call domain%add_polyline(PNPBS_BOUNDARY, .true., corners)
    call domain%add_polyline(PNPBS_INNER, .true., xy(:, 5:8))
    call expect(area(domain) == 2, 'an inner loop')
    call domain%add_hole([0.4d0, 0.4d0])
    call expect(abs(area(domain) - 1.875d0) < 1d-14, 'a hole in the inner loop')
    call domain%destroy
  end subroutine

  !> Checks a graph with more vertices than segments, and with tags of each that the other does not
  !> have.
  subroutine about_graphs_with_tags
    type(pnpbs_domain) :: domain
    type(pnpbs_placement) :: placement
    real(c_double), allocatable :: segments(:,:,:)
    integer(c_int32_t), allocatable :: tags(:), node_tags(:)
    integer(c_int64_t) :: count, nodes
    integer :: i
    call domain%create(context)
    call domain%add_pslg(reshape([corners, [1d0, 0.5d0]], [2, 5]), &
                         reshape([1_c_int64_t, 2_c_int64_t, 2_c_int64_t, 3_c_int64_t, &
                                  3_c_int64_t, 4_c_int64_t, 4_c_int64_t, 1_c_int64_t], [2, 4]), &
                         [11, 12, 13, 14, 15], [21, 22, 23, 24])
    call domain%segment_count(count)
    allocate (segments(2, 2, count), tags(count))
    call domain%get_segments(segments, tags)
    call expect(all(tags >= 21 .and. tags <= 24), 'tags of segments')
    call placement%create(context, domain)
    call placement%set_spacing_constant(0.1d0)
    call placement%initialise
    call placement%count(nodes)
    allocate (node_tags(nodes))
    call placement%get_nodes(tags=node_tags)
    do i = 11, 15
      call expect(any(node_tags == i), 'tags of vertices')
    end do
    call placement%destroy
    call domain%destroy
  end subroutine

  subroutine about_graphs_finer_than_d
    type(pnpbs_domain) :: domain
    real(c_double) :: xy(2, 44)
    real(c_double), target :: radius
    type(cone), target :: even
    integer(c_int64_t) :: ends(2, 44), vertices, curves
    integer :: i
    ! The graph has a square of 40 segments, and a small square of four segments within it.
    do i = 1, 10
      xy(:, i) = [0.1d0 * (i - 1), 0d0]
      xy(:, i + 10) = [1d0, 0.1d0 * (i - 1)]
      xy(:, i + 20) = [1 - 0.1d0 * (i - 1), 1d0]
      xy(:, i + 30) = [0d0, 1 - 0.1d0 * (i - 1)]
    end do
    xy(:, 41:44) = reshape([0.5d0, 0.5d0, 0.6d0, 0.5d0, 0.6d0, 0.6d0, 0.5d0, 0.6d0], [2, 4])
    do i = 1, 44
      ends(:, i) = [i, i + 1]
    end do
    ends(2, 40) = 1
    ends(2, 44) = 41
    call domain%create(context)
    call domain%add_pslg(xy, ends, hole_points=reshape([0.55d0, 0.55d0], [2, 1]))
    call domain%set_corner_angle(30d0)
    call expect(abs(area(domain) - 0.99d0) < 1d-14, 'with its hole')
    call domain%set_corner_angle(200d0, stat=stat, errmsg=errmsg)
    call expect(stat == PNPBS_ERROR_ARGUMENT .and. index(errmsg, 'corner_angle') > 0, 'an angle of 200')
    radius = 0.5d0
    call domain%tag_outline(ball_level_set, 5, c_loc(radius), vertices)
    call expect(vertices == 10, 'segments within half a side of the corner')
    call domain%tag_outline(ball_level_set, 0, c_loc(radius), stat=stat, errmsg=errmsg)
    call expect(stat == PNPBS_ERROR_ARGUMENT .and. index(errmsg, 'tag') > 0, 'tag 0')
    call domain%set_snap(1d-3)
    call domain%set_snap(-1d0, stat=stat, errmsg=errmsg)
    call expect(stat == PNPBS_ERROR_ARGUMENT .and. index(errmsg, 'length') > 0, 'a negative length')
    even%finest = 0.3d0
    even%growth = 0
    call domain%simplify_by_file('nowhere.csv', 0.25d0, 2d0, stat=stat, errmsg=errmsg)
    call expect(stat == PNPBS_ERROR_FILE .and. index(errmsg, 'nowhere.csv') > 0, 'no such file')
    call domain%simplify(cone_spacing, -1d0, 2d0, c_loc(even), stat=stat, errmsg=errmsg)
    call expect(stat == PNPBS_ERROR_ARGUMENT .and. index(errmsg, 'tolerance') > 0, 'below zero')
    call domain%simplify(cone_spacing, 1d-9, 2d0, c_loc(even), vertices, curves)
    call expect(vertices > 20 .and. curves == 1, 'straight sides, and the small hole')
    call expect(abs(area(domain) - 1) < 1d-14, 'without its hole')
    call domain%destroy
  end subroutine

  subroutine about_offsets
    use, intrinsic :: ieee_arithmetic, only: ieee_negative_inf, ieee_value
    type(pnpbs_domain) :: square, inset, box
    type(cone), target :: even, graded
    real(c_double), parameter :: left = 0.042d0 / 0.979d0, right = 0.958d0 / 1.021d0
    real(c_double) :: deep
    integer(c_int32_t), allocatable :: tags(:)
    integer(c_int64_t) :: coarse, fine
    deep = -huge(deep)
    call square%create(context)
    call square%add_polyline(PNPBS_BOUNDARY, .true., &
                             reshape([0d0, 0d0, 1d0, 0d0, 1d0, 1d0, 0d0, 1d0], [2, 4]))
    even%finest = 0.1d0
    even%growth = 0
    call inset%create(context)
    call inset%add_offset(square, deep, -0.42d0, sideways_spacing, tag=7, user=c_loc(even))
    call expect(abs(area(inset) - (1 - 2 * 0.042d0)**2) < 1d-9, 'area of an inset')
    call inset%segment_count(coarse)
    allocate (tags(coarse))
    call inset%get_segments(tags=tags)
    call expect(all(tags == 7), 'tags of an inset')
    call inset%destroy
    call inset%create(context)
    call inset%add_offset(square, ieee_value(deep, ieee_negative_inf), -0.042d0)
    call expect(abs(area(inset) - (1 - 2 * 0.042d0)**2) < 1d-9, 'area of an inset by lengths')
    call inset%destroy
    ! The inset lies between four straight lines.
    graded%finest = 0.1d0
    graded%growth = 0.05d0
    call inset%create(context)
    call inset%add_offset(square, deep, -0.42d0, sideways_spacing, user=c_loc(graded))
    call expect(abs(area(inset) - 0.916d0 * (right - left) + 0.021d0 * (right**2 - left**2)) &
                < 1d-9, 'area of a graded inset')
    call inset%destroy
    ! A finer resolution has more points on the arcs around the outer corners.
    call inset%create(context)
    call inset%add_offset(square, 0d0, 0.042d0, resolution=0.05d0)
    call inset%segment_count(coarse)
    call inset%destroy
    call inset%create(context)
    call inset%add_offset(square, 0d0, 0.042d0, resolution=0.01d0)
    call inset%segment_count(fine)
    call expect(fine > 2 * coarse, 'a finer resolution')
    call inset%destroy

    call inset%create(context)
    call inset%add_offset(square, deep, -0.042d0, tag=0, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'tag')
    call inset%add_offset(square, deep, -0.6d0, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_DOMAIN, errmsg, 'from -infinity to -0.6')
    even%answer = 6
    call inset%add_offset(square, deep, -0.42d0, sideways_spacing, user=c_loc(even), stat=stat, &
                          errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_CALLBACK, errmsg, '6')
    call box%create(context, 3)
    call box%add_offset(square, deep, -0.042d0, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'body has two dimensions')
    call box%destroy
    call square%destroy
    call inset%add_offset(square, deep, -0.042d0, stat=stat, errmsg=errmsg)
    call expect(stat < 0, 'a dead body')
    call inset%destroy
  end subroutine

  subroutine about_files
    type(pnpbs_domain) :: domain
    character(len=*), parameter :: nl = new_line('a')
    character(len=*), parameter :: triangle = '3 2 0 0' // nl // '1 0 0' // nl // '2 1 0' // nl // &
      '3 0 1' // nl // '3 0' // nl // '1 1 2' // nl // '2 2 3' // nl // '3 3 1' // nl // '0' // nl
    call domain%create(context)
    call domain%parse_poly(triangle, 'a triangle')
    call expect(area(domain) == 0.5d0, 'area of a triangle')
    call domain%destroy
    open (17, file='fortran_triangle.poly', status='replace')
    write (17, '(a)') triangle
    close (17)
    call domain%create(context)
    call domain%read_poly('fortran_triangle.poly   ')
    call expect(area(domain) == 0.5d0, 'area of a triangle from a file')
    call domain%destroy
    call domain%create(context)
    call domain%read_poly('no/such/file.poly', stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_FILE, errmsg, 'no/such/file.poly')
    call domain%parse_poly('nonsense', 'My text', stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_FILE, errmsg, 'My text')
    call domain%destroy
  end subroutine

  subroutine about_wrong_arguments
    type(pnpbs_domain) :: domain
    real(c_double) :: three(3, 4), low(2), short(1)
    three = 0
    call domain%create(context)
    call domain%check(stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_DOMAIN, errmsg, ' ')
    call domain%add_polyline(PNPBS_BOUNDARY, .true., three, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'coordinates has an extent of 3; 2')
    call domain%add_polyline(PNPBS_BOUNDARY, .true., corners, [1, 2, 3], stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_CAPACITY, errmsg, 'tags has room for 3; 4')
    call domain%add_polyline(17, .true., corners, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, '17')
    call domain%add_polyline(PNPBS_BOUNDARY, .true., corners, corner_angle=999d0, stat=stat, &
                             errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, '999')
    call domain%add_arc(PNPBS_BOUNDARY, [1d0], 1d0, 0d0, 1d0, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'centre')
    call domain%add_arc(PNPBS_BOUNDARY, [1d0, 1d0], -1d0, 0d0, 1d0, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'radius')
    call domain%add_hole([1d0], stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'point')
    call domain%add_fixed_nodes(corners, [1], stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_CAPACITY, errmsg, 'tags')
    call domain%bounds(low, short, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'high')
    call domain%destroy
    call domain%measure(low(1), stat)
    call expect(stat == PNPBS_ERROR_HANDLE, 'a dead domain')
  end subroutine
end program test_domain
