! SPDX-License-Identifier: BSD-3-Clause
!> Tests particles of one process, in the plane and in space: their volumes sum up to that of the
!> body, no pair is too close, files contain all of them, and invalid arguments are rejected.
!> tests/parallel tests particles over ranks.
program test_particles
  use, intrinsic :: iso_c_binding
  use pnpbs
  use expectations
  implicit none
  type(pnpbs_context) :: context
  integer(c_int) :: stat
  character(len=300) :: errmsg

  call context%create_serial
  call about_a_square
  call about_a_cube
  call about_wrong_arguments
  call context%destroy
  call finish

contains

  subroutine about_a_square
    type(pnpbs_domain) :: body
    type(pnpbs_placement) :: placement
    call square_inset(body, placement)
    call look_at(placement, body, 2)
    call placement%destroy
    call body%destroy
  end subroutine

  subroutine about_a_cube
    type(pnpbs_domain) :: body, inset
    type(pnpbs_placement) :: placement
    real(c_double) :: deep
    deep = -huge(deep)
    call body%create(context, 3)
    call body%add_box([0d0, 0d0, 0d0], [1d0, 1d0, 1d0], 5)
    call inset%create(context, 3)
    call inset%add_offset(body, deep, -0.092d0, resolution=0.1d0, tag=7)
    call placement%create(context, inset)
    call placement%set('steps', 40)
    call placement%set_spacing_constant(0.2294d0)
    call placement%run
    call inset%destroy
    call look_at(placement, body, 3)
    call placement%destroy
    call body%destroy
  end subroutine

  !> Creates a placement for particles in the unit square, each with an area of about 0.01.
  subroutine square_inset(body, placement)
    type(pnpbs_domain), intent(inout) :: body
    type(pnpbs_placement), intent(inout) :: placement
    type(pnpbs_domain) :: inset
    type(pnpbs_placement) :: unused
    real(c_double) :: deep
    deep = -huge(deep)
    call square(context, body, unused, 0.1d0)
    call unused%destroy
    call inset%create(context)
    call inset%add_offset(body, deep, -0.042d0, resolution=0.05d0, tag=7)
    call placement%create(context, inset)
    call placement%set_spacing_constant(0.1076d0)
    call placement%run
    call inset%destroy
  end subroutine

  !> Checks particles in a body with the measure 1.
  subroutine look_at(placement, body, dim)
    type(pnpbs_placement), intent(inout) :: placement
    type(pnpbs_domain), intent(in) :: body
    integer, intent(in) :: dim
    type(pnpbs_particles) :: particles, same
    integer(c_int64_t) :: nodes, count, all_of_them, left_out, moved
    integer(c_int32_t) :: columns
    real(c_double) :: closest
    real(c_double), allocatable :: x(:,:), volumes(:), spacing(:)
    integer(c_int64_t), allocatable :: ids(:)
    integer(c_int32_t), allocatable :: tags(:)
    call placement%count(nodes)
    call particles%create(placement, body)
    call particles%sizes(columns, count, all_of_them)
    call particles%figures(left_out, moved, closest)
    call expect(columns == dim .and. count == all_of_them, 'sizes of particles')
    call expect(count + left_out == nodes .and. moved >= 0 .and. moved <= count, 'their figures')
    allocate (x(dim, count), volumes(count), spacing(count), ids(count), tags(count))
    call same%from_handle(particles%handle())
    call same%get(x, volumes, spacing, ids, tags)
    call expect(abs(sum(volumes) - 1) < 1d-12 .and. all(volumes > 0), 'they fill the body')
    call expect(closest > 0.6d0, 'they are not too close')
    call expect(abs(closest - closest_of(x, spacing)) < 1d-12, 'how close they are')
    call expect(all(x > 0 .and. x < 1), 'they are in the body')
    call expect(all(ids(2:) > ids(:count - 1)), 'they are in the order of ids')
    call expect(any(tags == 7) .and. any(tags == 0) .and. all(tags == 7 .or. tags == 0), 'tags')
    volumes = 0
    call particles%get(volumes=volumes)
    call expect(abs(sum(volumes) - 1) < 1d-12, 'volumes alone')
    call about_files(particles, x, volumes, ids)
    call particles%destroy
    call expect(particles%handle() == 0, 'destroyed')
    call particles%sizes(count=count, stat=stat)
    call expect(stat == PNPBS_ERROR_HANDLE, 'no particles any more')
  end subroutine

  !> Returns the smallest distance of pairs over the mean spacing of the two, by all pairs. Returns
  !> infinity if no pair is closer than this mean.
  function closest_of(x, spacing) result(closest)
    real(c_double), intent(in) :: x(:,:), spacing(:)
    real(c_double) :: closest, distance
    integer :: i, j
    closest = huge(closest)
    do i = 1, size(spacing)
      do j = 1, i - 1
        distance = sqrt(sum((x(:, i) - x(:, j))**2))
        closest = min(closest, distance / ((spacing(i) + spacing(j)) / 2))
      end do
    end do
  end function

  subroutine about_files(particles, x, volumes, ids)
    type(pnpbs_particles), intent(in) :: particles
    real(c_double), intent(in) :: x(:,:), volumes(:)
    integer(c_int64_t), intent(in) :: ids(:)
    character(len=30), parameter :: paths(2) = ['particles.csv', 'particles.txt']
    character(len=4), parameter :: formats(2) = ['    ', 'csv ']
    call particles%write('particles.csv')
    call expect(lines_of('particles.csv') == size(ids) + 1, 'a line for each particle')
    call particles%add_output_field('mass', 2 * volumes)
    call particles%add_output_field('velocity', x)
    call particles%write_files(paths, formats)
    call look_at_table('particles.csv', x, volumes, ids)
    call look_at_table('particles.txt', x, volumes, ids)
    call particles%add_output_field('mass', volumes, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'mass')
    call particles%add_output_field('few', volumes(2:), stat, errmsg)
    call expect(stat < 0, 'too few values')
    call particles%write_files(paths, formats(:1), stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_CAPACITY, errmsg, 'formats')
    call particles%write('particles.ele', stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'ele')
    call particles%write('/nowhere/particles.csv', stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_FILE, errmsg, '/nowhere')
  end subroutine

  function lines_of(path) result(lines)
    character(len=*), intent(in) :: path
    integer :: lines, unit, status
    unit = 20
    open (unit, file=path, status='old', action='read')
    lines = -1
    status = 0
    do while (status == 0)
      read (unit, *, iostat=status)
      lines = lines + 1
    end do
    close (unit)
  end function

  !> Checks a table with the fields of about_files: masses and velocities.
  subroutine look_at_table(path, x, volumes, ids)
    character(len=*), intent(in) :: path
    real(c_double), intent(in) :: x(:,:), volumes(:)
    integer(c_int64_t), intent(in) :: ids(:)
    character(len=200) :: head
    real(c_double) :: at(3), d, volume, mass, velocity(3)
    integer(c_int64_t) :: id, tag
    integer :: dim, k, unit
    dim = size(x, 1)
    unit = 20
    open (unit, file=path, status='old', action='read')
    read (unit, '(a)') head
    call expect(index(head, ',volume,mass,velocity:0,velocity:1') > 0, 'columns: ' // trim(head))
    do k = 1, size(ids)
      read (unit, *) id, at(:dim), tag, d, volume, mass, velocity(:dim)
      call expect(id == ids(k) .and. all(at(:dim) == x(:, k)), 'a particle in a file')
      call expect(volume == volumes(k) .and. mass == 2 * volumes(k), 'its mass in a file')
      call expect(all(velocity(:dim) == x(:, k)), 'its velocity in a file')
    end do
    close (unit)
  end subroutine

  subroutine about_wrong_arguments
    type(pnpbs_domain) :: body, wide, box
    type(pnpbs_placement) :: placement, empty
    type(pnpbs_particles) :: particles
    real(c_double) :: few(3), x(3, 300)
    call square(context, body, empty, 0.1d0)
    call particles%create(empty, body, stat)
    call expect(stat == PNPBS_ERROR_STATE .and. particles%handle() == 0, 'no particles yet')
    call particles%get(volumes=few, stat=stat)
    call expect(stat == PNPBS_ERROR_HANDLE, 'no particles')
    call empty%run
    call particles%create(empty, body, stat)
    call expect(stat == PNPBS_ERROR_DOMAIN .and. particles%handle() == 0, 'nodes on the boundary')
    call body%destroy
    call square_inset(body, placement)
    call wide%create(context)
    call wide%add_polyline(PNPBS_BOUNDARY, .true., &
                           reshape([-1d0, -1d0, 2d0, -1d0, 2d0, 2d0, -1d0, 2d0], [2, 4]))
    call particles%create(placement, wide, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_DOMAIN, errmsg, 'fill')
    call expect(particles%handle() == 0, 'a body that they do not fill')
    call box%create(context, 3)
    call box%add_box([0d0, 0d0, 0d0], [1d0, 1d0, 1d0])
    call particles%create(placement, box, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'body')
    call box%destroy
    call particles%create(placement, box, stat, errmsg)
    call expect(stat < 0, 'a dead body')
    call particles%create(placement, body)
    call particles%get(volumes=few, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_CAPACITY, errmsg, '3')
    call particles%get(x, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'argument x')
    call particles%destroy
    call placement%destroy
    call empty%destroy
    call wide%destroy
    call body%destroy
  end subroutine
end program
