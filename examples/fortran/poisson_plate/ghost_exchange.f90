! SPDX-License-Identifier: BSD-3-Clause
!
! The halo exchange: every rank sends values at its owned nodes to the ranks that have these nodes
! as ghosts.
module ghost_exchange
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t
  use mpi
  use pnpbs, only: pnpbs_placement
  implicit none
  private
  public :: exchange_pattern, take_exchange_pattern, fill_ghosts

  !> The exchange pattern that placement%get_exchange returns, and the communicator of the solver.
  type :: exchange_pattern
    integer :: comm
    integer(c_int32_t), allocatable :: ranks(:)
    integer(c_int64_t), allocatable :: send_offsets(:), send_nodes(:)
    integer(c_int64_t), allocatable :: receive_offsets(:), receive_nodes(:)
  end type

contains

  !> Copies the exchange pattern from the placement. Collective.
  subroutine take_exchange_pattern(placement, comm, pattern)
    type(pnpbs_placement), intent(in) :: placement
    integer, intent(in) :: comm
    type(exchange_pattern), intent(out) :: pattern
    integer(c_int32_t) :: neighbours
    integer(c_int64_t) :: sends, receives
    pattern%comm = comm
    call placement%exchange_sizes(neighbours, sends, receives)
    allocate (pattern%ranks(neighbours))
    allocate (pattern%send_offsets(neighbours + 1), pattern%send_nodes(sends))
    allocate (pattern%receive_offsets(neighbours + 1), pattern%receive_nodes(receives))
    call placement%get_exchange(pattern%ranks, pattern%send_offsets, pattern%send_nodes, &
                                pattern%receive_offsets, pattern%receive_nodes)
  end subroutine

  !> Copies values at nodes to their ghosts. `values` holds owned nodes, then ghosts. Collective.
  subroutine fill_ghosts(pattern, values)
    type(exchange_pattern), intent(in) :: pattern
    real(c_double), intent(inout) :: values(:)
    real(c_double), asynchronous :: outgoing(size(pattern%send_nodes))
    real(c_double), asynchronous :: incoming(size(pattern%receive_nodes))
    integer :: requests(2 * size(pattern%ranks)), k, first, count, error
    integer, parameter :: tag = 1

    outgoing = values(pattern%send_nodes)
    do k = 1, size(pattern%ranks)
      first = int(pattern%receive_offsets(k))
      count = int(pattern%receive_offsets(k + 1)) - first
      call MPI_Irecv(incoming(first:), count, MPI_DOUBLE_PRECISION, pattern%ranks(k), tag, &
                     pattern%comm, requests(2 * k - 1), error)
      first = int(pattern%send_offsets(k))
      count = int(pattern%send_offsets(k + 1)) - first
      call MPI_Isend(outgoing(first:), count, MPI_DOUBLE_PRECISION, pattern%ranks(k), tag, &
                     pattern%comm, requests(2 * k), error)
    end do
    call MPI_Waitall(size(requests), requests, MPI_STATUSES_IGNORE, error)
    values(pattern%receive_nodes) = incoming
  end subroutine
end module ghost_exchange
