! SPDX-License-Identifier: BSD-3-Clause
!> Conversions between the modules pnpbs and pnpbs_geo and the C interface. Arrays become addresses,
!> C strings become Fortran strings, and a status becomes stat and errmsg, or stops the program.
module pnpbs_calls
  use, intrinsic :: iso_c_binding
  use, intrinsic :: iso_fortran_env, only: error_unit
  use pnpbs_c
  implicit none
  private
  public :: arguments, texts, conclude, text_of, c_text, count_from_one, integer_of, pointer_of

  !> The number of elements that is assumed for an absent array.
  integer(c_int64_t), parameter :: unlimited = huge(0_c_int64_t)

  !> The arguments of one call, and the first error in them. On several ranks the call must be made
  !> even after an error, because the other ranks block otherwise. It is then made with a capacity
  !> of -1, which the library rejects on all ranks.
  type :: arguments
    private
    integer(c_int) :: status = PNPBS_OK
    character(len=200) :: message = ' '
  contains
    procedure :: refuse
    procedure :: require
    procedure :: is_wrong
    procedure :: capacity
    procedure :: found
    ! place_<type>(name, array, [rows,] address, room): returns the address of the first element of
    ! an array, or NULL if the array is absent, and the number of its elements or columns.
    procedure :: place_int8
    procedure :: place_int32
    procedure :: place_int64
    procedure :: place_int32_columns
    procedure :: place_int64_columns
    procedure :: place_real
    procedure :: place_real_columns
    procedure :: place_real_pairs
    procedure :: place_formats
    procedure :: check_rows
    procedure :: check_rank
    procedure, private :: check_neighbours_in_memory
  end type

  !> Texts for C, without trailing blanks, with their addresses. A variable of this type must be a
  !> target.
  type :: texts
    type(c_ptr), allocatable :: addresses(:)
    character(kind=c_char), allocatable, private :: characters(:)
  contains
    procedure :: put
  end type

  ! The target of addresses of empty arrays: not NULL, but without elements.
  integer(c_int64_t), target, save :: nothing = 0

  !> Converts indices and offsets of C, from 0, to those of Fortran, from 1.
  interface count_from_one
    module procedure count_from_one_int32
    module procedure count_from_one_int64
  end interface

  interface
    function c_strlen(text) bind(C, name="strlen")
      import
      implicit none
      type(c_ptr), value :: text
      integer(c_size_t) :: c_strlen
    end function
  end interface

contains

  ! ------------------------------------------------------------ status ------------------------

  !> Concludes every call of a procedure. With stat the program continues: stat is set to the
  !> status, and errmsg, if present, to the message of an error; without an error it does not
  !> change. Without stat, an error stops the program, and the message begins with the name of the
  !> procedure. The message of an error is the last one of libpnpbs, or `said`, the last one of
  !> another library.
  subroutine conclude(procedure_name, status, stat, errmsg, given, said)
    character(len=*), intent(in) :: procedure_name
    integer(c_int), intent(in) :: status
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    class(arguments), intent(in), optional :: given
    character(len=*), intent(in), optional :: said
    character(len=:), allocatable :: message
    integer(c_int) :: found

    found = status
    message = ''
    if (status < 0 .and. present(said)) then
      message = said
    else if (status < 0) then
      message = in_fortran(text_of(c_last_error(c_null_ptr)))
    end if
    if (present(given)) then
      if (given%is_wrong()) then
        found = given%status
        message = trim(given%message)
      end if
    end if
    if (present(errmsg) .and. found < 0) errmsg = message
    if (present(stat)) then
      call tell(procedure_name, found, stat)
    else if (found < 0) then
      call give_up(procedure_name // ': ' // text_of(c_status_string(found)) // ': ' // message)
    end if
  end subroutine

  ! Sets stat, an integer of four or eight bytes, because code may be compiled with eight-byte
  ! default integers.
  subroutine tell(procedure_name, status, stat)
    character(len=*), intent(in) :: procedure_name
    integer(c_int), intent(in) :: status
    class(*), intent(out) :: stat
    select type (stat)
    type is (integer(c_int32_t))
      stat = int(status, c_int32_t)
    type is (integer(c_int64_t))
      stat = int(status, c_int64_t)
    class default
      call give_up(procedure_name // ': argument stat must be an integer of four or eight bytes')
    end select
  end subroutine

  ! Stops the program with exit status 1. The statement "stop <text>" has exit status 0.
  subroutine give_up(message)
    character(len=*), intent(in) :: message
    write (error_unit, '(2a)') 'pnpbs: ', message
    stop 1
  end subroutine

  ! ------------------------------------------------------------ texts -------------------------

  !> Copies a C string of the library.
  function text_of(c) result(text)
    type(c_ptr), intent(in) :: c
    character(len=:), allocatable :: text
    character(kind=c_char), pointer :: characters(:)
    integer :: i, length

    length = 0
    if (c_associated(c)) length = int(c_strlen(c))
    allocate (character(len=length) :: text)
    if (length == 0) return
    call c_f_pointer(c, characters, [length])
    do i = 1, length
      text(i:i) = characters(i)
    end do
  end function

  !> Replaces the names of C functions in a message by their Fortran names.
  recursive function in_fortran(message) result(text)
    character(len=*), intent(in) :: message
    character(len=:), allocatable :: text
    character(len=*), parameter :: objects(7) = &
      ['context  ', 'domain   ', 'placement', 'transfer ', 'mesh     ', 'voronoi  ', 'particles']
    character(len=:), allocatable :: prefix
    integer :: i, at
    text = message
    do i = 1, size(objects)
      prefix = 'pnpbs_' // trim(objects(i)) // '_'
      at = index(text, prefix)
      if (at == 0) cycle
      text = text(:at - 1) // trim(objects(i)) // '%' // in_fortran(text(at + len(prefix):))
    end do
  end function

  !> Returns a null-terminated text for C, without trailing blanks.
  function c_text(text) result(c)
    character(len=*), intent(in) :: text
    character(kind=c_char, len=len_trim(text) + 1) :: c
    c = trim(text) // c_null_char
  end function

  subroutine put(self, given)
    class(texts), intent(inout), target :: self
    character(len=*), intent(in) :: given(:)
    integer :: begin, i, k
    allocate (self%addresses(size(given)), self%characters(sum(len_trim(given)) + size(given)))
    self%characters = c_null_char
    begin = 1
    do k = 1, size(given)
      self%addresses(k) = c_loc(self%characters(begin))
      do i = 1, len_trim(given(k))
        self%characters(begin + i - 1) = given(k)(i:i)
      end do
      begin = begin + len_trim(given(k)) + 1
    end do
  end subroutine

  ! ------------------------------------------------------------ handles -----------------------

  function integer_of(pointer) result(handle)
    type(c_ptr), intent(in) :: pointer
    integer(c_int64_t) :: handle
    handle = int(transfer(pointer, 0_c_intptr_t), c_int64_t)
  end function

  function pointer_of(handle) result(pointer)
    integer(c_int64_t), intent(in) :: handle
    type(c_ptr) :: pointer
    pointer = transfer(int(handle, c_intptr_t), c_null_ptr)
  end function

  ! ------------------------------------------------------------ arguments ---------------------

  !> Records an error, unless there is one already.
  subroutine refuse(self, status, message)
    class(arguments), intent(inout) :: self
    integer(c_int), intent(in) :: status
    character(len=*), intent(in) :: message
    if (self%is_wrong()) return
    self%status = status
    self%message = message
  end subroutine

  !> Rejects an array with fewer elements than required.
  subroutine require(self, name, room, needed)
    class(arguments), intent(inout) :: self
    character(len=*), intent(in) :: name
    integer(c_int64_t), intent(in) :: room, needed
    character(len=100) :: places
    if (room >= needed) return
    write (places, '(a, i0, a, i0, a)') ' has room for ', room, '; ', needed, ' are needed'
    call self%refuse(PNPBS_ERROR_CAPACITY, 'argument ' // name // trim(places))
  end subroutine

  function is_wrong(self)
    class(arguments), intent(in) :: self
    logical :: is_wrong
    is_wrong = self%status /= PNPBS_OK
  end function

  !> Returns the error as a status.
  function found(self)
    class(arguments), intent(in) :: self
    integer(c_int) :: found
    found = self%status
  end function

  !> Returns the capacity for the library, which is -1 after an error.
  function capacity(self, room)
    class(arguments), intent(in) :: self
    integer(c_int64_t), intent(in) :: room
    integer(c_int64_t) :: capacity
    capacity = room
    if (self%is_wrong()) capacity = -1
  end function

  subroutine place_int8(self, name, array, address, room)
    class(arguments), intent(inout) :: self
    character(len=*), intent(in) :: name
    integer(c_int8_t), intent(in), optional, target :: array(:)
    type(c_ptr), intent(out) :: address
    integer(c_int64_t), intent(out) :: room
    call absent(address, room)
    if (.not. present(array)) return
    call empty(address, room)
    if (size(array) == 0) return
    address = c_loc(array(1))
    room = size(array, kind=c_int64_t)
    if (room > 1) call self%check_neighbours_in_memory(name, address, c_loc(array(2)), 1)
  end subroutine

  subroutine place_int32(self, name, array, address, room)
    class(arguments), intent(inout) :: self
    character(len=*), intent(in) :: name
    integer(c_int32_t), intent(in), optional, target :: array(:)
    type(c_ptr), intent(out) :: address
    integer(c_int64_t), intent(out) :: room
    call absent(address, room)
    if (.not. present(array)) return
    call empty(address, room)
    if (size(array) == 0) return
    address = c_loc(array(1))
    room = size(array, kind=c_int64_t)
    if (room > 1) call self%check_neighbours_in_memory(name, address, c_loc(array(2)), 4)
  end subroutine

  subroutine place_int64(self, name, array, address, room)
    class(arguments), intent(inout) :: self
    character(len=*), intent(in) :: name
    integer(c_int64_t), intent(in), optional, target :: array(:)
    type(c_ptr), intent(out) :: address
    integer(c_int64_t), intent(out) :: room
    call absent(address, room)
    if (.not. present(array)) return
    call empty(address, room)
    if (size(array) == 0) return
    address = c_loc(array(1))
    room = size(array, kind=c_int64_t)
    if (room > 1) call self%check_neighbours_in_memory(name, address, c_loc(array(2)), 8)
  end subroutine

  subroutine place_real(self, name, array, address, room)
    class(arguments), intent(inout) :: self
    character(len=*), intent(in) :: name
    real(c_double), intent(in), optional, target :: array(:)
    type(c_ptr), intent(out) :: address
    integer(c_int64_t), intent(out) :: room
    call absent(address, room)
    if (.not. present(array)) return
    call empty(address, room)
    if (size(array) == 0) return
    address = c_loc(array(1))
    room = size(array, kind=c_int64_t)
    if (room > 1) call self%check_neighbours_in_memory(name, address, c_loc(array(2)), 8)
  end subroutine

  subroutine place_int32_columns(self, name, array, rows, address, room)
    class(arguments), intent(inout) :: self
    character(len=*), intent(in) :: name
    integer(c_int32_t), intent(in), optional, target :: array(:,:)
    integer, intent(in) :: rows
    type(c_ptr), intent(out) :: address
    integer(c_int64_t), intent(out) :: room
    call absent(address, room)
    if (.not. present(array)) return
    call empty(address, room)
    call self%check_rows(name, size(array, 1), rows)
    if (size(array) == 0 .or. self%is_wrong()) return
    address = c_loc(array(1, 1))
    room = size(array, 2, kind=c_int64_t)
    call self%check_neighbours_in_memory(name, address, c_loc(array(2, 1)), 4)
    if (room > 1) &
      call self%check_neighbours_in_memory(name, address, c_loc(array(1, 2)), 4 * rows)
  end subroutine

  subroutine place_int64_columns(self, name, array, rows, address, room)
    class(arguments), intent(inout) :: self
    character(len=*), intent(in) :: name
    integer(c_int64_t), intent(in), optional, target :: array(:,:)
    integer, intent(in) :: rows
    type(c_ptr), intent(out) :: address
    integer(c_int64_t), intent(out) :: room
    call absent(address, room)
    if (.not. present(array)) return
    call empty(address, room)
    call self%check_rows(name, size(array, 1), rows)
    if (size(array) == 0 .or. self%is_wrong()) return
    address = c_loc(array(1, 1))
    room = size(array, 2, kind=c_int64_t)
    call self%check_neighbours_in_memory(name, address, c_loc(array(2, 1)), 8)
    if (room > 1) &
      call self%check_neighbours_in_memory(name, address, c_loc(array(1, 2)), 8 * rows)
  end subroutine

  subroutine place_real_columns(self, name, array, rows, address, room)
    class(arguments), intent(inout) :: self
    character(len=*), intent(in) :: name
    real(c_double), intent(in), optional, target :: array(:,:)
    integer, intent(in) :: rows
    type(c_ptr), intent(out) :: address
    integer(c_int64_t), intent(out) :: room
    call absent(address, room)
    if (.not. present(array)) return
    call empty(address, room)
    call self%check_rows(name, size(array, 1), rows)
    if (size(array) == 0 .or. self%is_wrong()) return
    address = c_loc(array(1, 1))
    room = size(array, 2, kind=c_int64_t)
    call self%check_neighbours_in_memory(name, address, c_loc(array(2, 1)), 8)
    if (room > 1) &
      call self%check_neighbours_in_memory(name, address, c_loc(array(1, 2)), 8 * rows)
  end subroutine

  ! Places pairs of points, (rows, 2, room).
  subroutine place_real_pairs(self, name, array, rows, address, room)
    class(arguments), intent(inout) :: self
    character(len=*), intent(in) :: name
    real(c_double), intent(in), optional, target :: array(:,:,:)
    integer, intent(in) :: rows
    type(c_ptr), intent(out) :: address
    integer(c_int64_t), intent(out) :: room
    call absent(address, room)
    if (.not. present(array)) return
    call empty(address, room)
    call self%check_rows(name, size(array, 1), rows)
    call self%check_rows(name, size(array, 2), 2)
    if (size(array) == 0 .or. self%is_wrong()) return
    address = c_loc(array(1, 1, 1))
    room = size(array, 3, kind=c_int64_t)
    call self%check_neighbours_in_memory(name, address, c_loc(array(2, 1, 1)), 8)
    call self%check_neighbours_in_memory(name, address, c_loc(array(1, 2, 1)), 8 * rows)
    if (room > 1) &
      call self%check_neighbours_in_memory(name, address, c_loc(array(1, 1, 2)), 16 * rows)
  end subroutine

  !> Places the optional formats of n files; a blank format becomes NULL.
  subroutine place_formats(self, formats, n, c_formats, address)
    class(arguments), intent(inout) :: self
    character(len=*), intent(in), optional :: formats(:)
    integer(c_int64_t), intent(in) :: n
    type(texts), intent(inout), target :: c_formats
    type(c_ptr), intent(out) :: address
    integer :: k
    address = c_null_ptr
    if (.not. present(formats)) return
    call self%require('formats', size(formats, kind=c_int64_t), n)
    if (size(formats) == 0) return
    call c_formats%put(formats)
    do k = 1, size(formats)
      if (formats(k) == ' ') c_formats%addresses(k) = c_null_ptr
    end do
    address = c_loc(c_formats%addresses(1))
  end subroutine

  subroutine absent(address, room)
    type(c_ptr), intent(out) :: address
    integer(c_int64_t), intent(out) :: room
    address = c_null_ptr
    room = unlimited
  end subroutine

  subroutine empty(address, room)
    type(c_ptr), intent(out) :: address
    integer(c_int64_t), intent(out) :: room
    address = c_loc(nothing)
    room = 0
  end subroutine

  !> Rejects an array whose first extent is wrong.
  subroutine check_rows(self, name, rows, needed)
    class(arguments), intent(inout) :: self
    character(len=*), intent(in) :: name
    integer, intent(in) :: rows, needed
    character(len=80) :: numbers
    if (rows == needed) return
    write (numbers, '(a, i0, a, i0, a)') ' has an extent of ', rows, '; ', needed, ' was expected'
    call self%refuse(PNPBS_ERROR_ARGUMENT, 'argument ' // name // trim(numbers))
  end subroutine

  !> Rejects an array whose rank differs from the dimension.
  subroutine check_rank(self, name, rank_of_array, dim)
    class(arguments), intent(inout) :: self
    character(len=*), intent(in) :: name
    integer, intent(in) :: rank_of_array, dim
    character(len=80) :: numbers
    if (rank_of_array == dim) return
    write (numbers, '(a, i0, a, i0, a)') ' has rank ', rank_of_array, '; ', dim, ' was expected'
    call self%refuse(PNPBS_ERROR_ARGUMENT, 'argument ' // name // trim(numbers))
  end subroutine

  ! Rejects an array with gaps in memory, because C needs contiguous arrays.
  subroutine check_neighbours_in_memory(self, name, first, second, bytes)
    class(arguments), intent(inout) :: self
    character(len=*), intent(in) :: name
    type(c_ptr), intent(in) :: first, second
    integer, intent(in) :: bytes
    if (transfer(second, 0_c_intptr_t) - transfer(first, 0_c_intptr_t) == bytes) return
    call self%refuse(PNPBS_ERROR_ARGUMENT, 'argument ' // name // ' has gaps in memory: ' // &
      'give a whole array, or a section x(i:j) or x(:,i:j) of one')
  end subroutine

  subroutine count_from_one_int32(indices)
    integer(c_int32_t), intent(inout) :: indices(:)
    integer(c_int64_t) :: i
    do i = 1, size(indices, kind=c_int64_t)
      indices(i) = indices(i) + 1
    end do
  end subroutine

  subroutine count_from_one_int64(indices)
    integer(c_int64_t), intent(inout) :: indices(:)
    integer(c_int64_t) :: i
    do i = 1, size(indices, kind=c_int64_t)
      indices(i) = indices(i) + 1
    end do
  end subroutine
end module pnpbs_calls
