! SPDX-License-Identifier: BSD-3-Clause
!> Tests callbacks with and without user data: spacings and monitors, and the values that they
!> return.
program test_callbacks
  use, intrinsic :: iso_c_binding
  use pnpbs
  use expectations
  use watchers
  implicit none
  type(pnpbs_context) :: context
  type(pnpbs_domain) :: domain
  type(pnpbs_placement) :: placement, other
  type(cone), target :: asked, watcher
  character(len=:), allocatable :: hash, hash_again
  integer(c_int) :: stat
  character(len=300) :: errmsg

  call context%create_serial
  call square(context, domain, placement, 0.1d0)
  call placement%set('steps', 45)

  ! A callback without user data has the same nodes as the constant that it returns.
  call placement%set_spacing_callback(constant_spacing)
  call placement%run
  call placement%get('hash', hash)
  call other%create(context, domain)
  call other%set('steps', 45)
  call other%set_spacing_constant(0.1d0)
  call other%run
  call other%get('hash', hash_again)
  call expect(hash == hash_again, 'a constant from a callback')
  call placement%set_spacing_callback(constant_spacing, c_loc(asked))
  call placement%run(stat, errmsg)
  call expect_failure(stat, PNPBS_ERROR_CALLBACK, errmsg, '8')

  ! A callback with user data.
  call placement%set_spacing_callback(cone_spacing, c_loc(asked))
  call placement%run
  call expect(asked%calls > 0, 'the spacing was asked')
  call check_spacings
  asked%answer = 1234
  call other%set_spacing_callback(cone_spacing, c_loc(asked))
  call other%run(stat, errmsg)
  call expect_failure(stat, PNPBS_ERROR_CALLBACK, errmsg, '1234')
  asked%answer = 0
  asked%finest = -1
  call other%run(stat, errmsg)
  call expect_failure(stat, PNPBS_ERROR_SPACING, errmsg, 'nodes')

  ! The monitor is called, makes queries, stops a run, and is removed.
  watcher%placement = placement%handle()
  call placement%set_spacing_constant(0.1d0)
  call placement%set_monitor(watch, c_loc(watcher))
  call placement%run(stat)
  call expect(stat == PNPBS_OK .or. stat == PNPBS_NOT_CONVERGED, 'a run that is watched')
  call expect(watcher%calls > 0, 'the monitor was told')
  call expect(watcher%inner_count == PNPBS_OK, 'a query from inside')
  call expect(watcher%inner_step == PNPBS_ERROR_STATE, 'more than a query from inside')
  watcher%answer = 1
  call placement%run(stat)
  call expect(stat == PNPBS_STOPPED, 'stopped by the monitor')
  call placement%run
  watcher%calls = 0
  call placement%set_monitor()
  call placement%run(stat)
  call expect(stat /= PNPBS_STOPPED .and. watcher%calls == 0, 'no monitor any more')

  call other%destroy
  call placement%destroy
  call domain%destroy
  call context%destroy
  deallocate (hash, hash_again)  ! variables of the main program would count as leaks
  call finish

contains

  subroutine check_spacings
    real(c_double), allocatable :: xy(:,:), d(:), wanted(:)
    integer(c_int64_t) :: n
    call placement%count(n)
    allocate (xy(2, n), d(n), wanted(n))
    call placement%get_nodes(xy, spacing=d)
    wanted = 0.02d0 + 0.1d0 * sqrt((xy(1, :) - 0.3d0)**2 + (xy(2, :) - 0.4d0)**2)
    call expect(all(abs(d - wanted) < 0.2d0 * wanted), 'd at the nodes')
    call expect(minval(d) < 0.03d0 .and. maxval(d) > 0.08d0, 'd from fine to coarse')
  end subroutine
end program test_callbacks
