! SPDX-License-Identifier: BSD-3-Clause
!> Tests the library, its tables, contexts, options and handles.
program test_library
  use, intrinsic :: iso_c_binding
  use pnpbs
  use expectations
  implicit none
  integer(c_int) :: stat
  character(len=300) :: errmsg

  call about_the_library
  call about_tables
  call about_contexts
  call about_options
  call finish

contains

  subroutine about_the_library
    integer(c_int32_t) :: major, minor, patch
    character(len=20) :: version
    call pnpbs_version(major, minor, patch)
    call expect(major == PNPBS_VERSION_MAJOR .and. minor == PNPBS_VERSION_MINOR .and. &
                patch == PNPBS_VERSION_PATCH, 'the version of the module and of the library')
    write (version, '(i0, ".", i0, ".", i0)') major, minor, patch
    call expect(index(pnpbs_build_info(), 'version: ' // trim(version) // new_line('a')) == 1, &
                'build info')
    call expect(len(pnpbs_mpi_library()) == 0 .or. index(pnpbs_mpi_library(), '.') > 0, &
                'MPI library')
    call expect(pnpbs_status_string(PNPBS_OK) == 'done', 'text of PNPBS_OK')
    call expect(pnpbs_status_string(PNPBS_ERROR_CAPACITY) == 'array too small', 'text of an error')
    call expect(pnpbs_status_string(77) == 'unknown status', 'text of no status')
    call pnpbs_discard_unfinished_files
  end subroutine

  subroutine about_tables
    character(len=:), allocatable :: name, type, default_value, range, help
    logical :: binary, elements, found
    integer(c_int32_t) :: count, i
    integer :: binaries

    call pnpbs_option_count(count, stat)
    call expect(stat == PNPBS_OK .and. count > 5, 'options')
    found = .false.
    do i = 1, count
      call pnpbs_option_info(i, name, type, default_value, range, help)
      call expect(len(name) > 0 .and. len(range) > 0 .and. len(help) > 0, 'option ' // name)
      call expect(type == 'integer' .or. type == 'real' .or. type == 'choice', 'type of ' // name)
      if (name == 'steps') found = type == 'integer'
      ! Each column must have the expected content.
      if (name == 'method') then
        call expect(type == 'choice' .and. default_value == 'default', 'type and default of method')
        call expect(range == 'default | paper' .and. index(help, 'scheme') > 0, &
                    'range and help of method')
      end if
    end do
    call expect(found, 'the option steps')
    call pnpbs_option_info(1, help=help)
    call expect(len(help) > 0, 'one column of the table')
    errmsg = 'as it was'
    call pnpbs_option_info(count, name, stat=stat, errmsg=errmsg)
    call expect(stat == PNPBS_OK .and. errmsg == 'as it was', 'errmsg without an error')
    call pnpbs_option_info(count + 1, name, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'index')
    call pnpbs_option_info(0, name, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'index')

    call pnpbs_statistic_count(count)
    found = .false.
    do i = 1, count
      call pnpbs_statistic_info(i, name, type, help)
      call expect(type == 'integer' .or. type == 'real' .or. type == 'string', 'type of ' // name)
      if (name == 'hash') found = type == 'string' .and. len(help) > 0
    end do
    call expect(found, 'the statistic hash')

    call pnpbs_format_count(count)
    found = .false.
    binaries = 0
    do i = 1, count
      call pnpbs_format_info(i, name, help, binary, elements)
      if (name == 'vtu') found = binary .and. elements .and. len(help) > 0
      if (name == 'msh') call expect(elements .and. .not. binary, 'msh has elements, in text')
      if (binary) binaries = binaries + 1
    end do
    call expect(found, 'the format vtu')
    call expect(binaries < count, 'formats that are text')
  end subroutine

  subroutine about_contexts
    type(pnpbs_context) :: context, same
    type(pnpbs_domain) :: domain
    integer(c_int64_t) :: handle

    call expect(context%handle() == 0, 'no context, no handle')
    call context%destroy(stat)
    call expect(stat == PNPBS_OK, 'destroying nothing')
    call domain%create(context, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_HANDLE, errmsg, 'context')

    call context%create_serial(stat, errmsg)
    call expect(stat == PNPBS_OK, 'a context')
    call expect(context%last_error() == '', 'no error yet')
    handle = context%handle()
    call expect(handle /= 0, 'a handle')
    call same%from_handle(handle)
    call domain%create(same, 4, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, '4')
    call expect(context%last_error() == errmsg, 'the message of the context')
    call domain%create(same)
    call same%destroy
    call expect(same%handle() == 0, 'destroyed')
    call domain%check(stat)
    call expect(stat == PNPBS_ERROR_DOMAIN, 'the domain lives on')
    call domain%destroy
    call context%destroy(stat, errmsg)
    call expect(stat == PNPBS_ERROR_HANDLE, 'the copy of a destroyed context')

    ! MPI is not initialised.
    call context%create_mpi(0, stat=stat, errmsg=errmsg)
    call expect(stat == PNPBS_ERROR_MPI .or. stat == PNPBS_ERROR_UNSUPPORTED, 'no MPI')
    call expect(index(errmsg, 'use context%create_serial') > 0, 'a name as it is in Fortran')
    call context%create_mpi(0.0, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'comm is no integer')
    call context%create_mpi(0_c_int64_t, 'Another MPI 3.0', stat, errmsg)
    call expect(stat == PNPBS_ERROR_MPI .or. stat == PNPBS_ERROR_UNSUPPORTED, 'another MPI')
  end subroutine

  subroutine about_options
    type(pnpbs_context) :: context
    type(pnpbs_domain) :: domain
    type(pnpbs_placement) :: placement
    call context%create_serial
    call context%set('steps', 30)
    call context%set('steps', 31_c_int64_t)
    call context%set('damping', 0.5d0, stat)
    call context%set('method ', 'default ')
    call context%set('stebs', 30, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_KEY, errmsg, 'steps')
    call context%set('steps', 'many', stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'many')
    call context%set('steps', -1, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, '-1')
    call context%set('nothing', 1d0, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_KEY, errmsg, 'nothing')

    call square(context, domain, placement, 0.1d0)
    call placement%set('steps', '40')
    call placement%set('steps', 40)
    call placement%set('steps', 40_c_int64_t)
    call placement%set('steps', 0.5d0, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, '0.5')
    call placement%set('steps', 'x', stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'x')
    call placement%destroy
    call domain%destroy
    call context%destroy
  end subroutine
end program test_library
