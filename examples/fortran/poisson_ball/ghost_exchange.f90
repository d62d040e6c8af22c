! SPDX-License-Identifier: BSD-3-Clause
!
! What ranks tell each other about nodes: values at nodes go to their ghosts on other ranks, and sums
! collected at ghosts go back to the ranks that own these nodes.
module ghost_exchange
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t
  use mpi
  use pnpbs, only: pnpbs_placement
  implicit none
  private
  public :: exchange_pattern, take_exchange_pattern, fill_ghosts, add_ghosts

  !> Nodes by rank: those that rank k of the pattern has to do with are
  !> nodes(offsets(k) : offsets(k+1)-1).
  type :: nodes_by_rank
    integer(c_int64_t), allocatable :: offsets(:), nodes(:)
  end type

  !> This rank's nodes that are ghosts elsewhere, its ghosts, and the communicator of the solver.
  type :: exchange_pattern
    integer :: comm
    integer(c_int32_t), allocatable :: ranks(:)
    type(nodes_by_rank) :: shared, ghosts
  end type

contains

  subroutine take_exchange_pattern(placement, comm, pattern)
    type(pnpbs_placement), intent(in) :: placement
    integer, intent(in) :: comm
    type(exchange_pattern), intent(out) :: pattern
    integer(c_int32_t) :: neighbours
    integer(c_int64_t) :: sends, receives
    pattern%comm = comm
    call placement%exchange_sizes(neighbours, sends, receives)
    allocate (pattern%ranks(neighbours))
    allocate (pattern%shared%offsets(neighbours + 1), pattern%shared%nodes(sends))
    allocate (pattern%ghosts%offsets(neighbours + 1), pattern%ghosts%nodes(receives))
    call placement%get_exchange(pattern%ranks, pattern%shared%offsets, pattern%shared%nodes, &
                                pattern%ghosts%offsets, pattern%ghosts%nodes)
  end subroutine

  !> On entry values(i) is right at this rank's nodes, on return at its ghosts, too. Collective.
  subroutine fill_ghosts(pattern, values)
    type(exchange_pattern), intent(in) :: pattern
    real(c_double), intent(inout) :: values(:)
    real(c_double) :: outgoing(size(pattern%shared%nodes)), incoming(size(pattern%ghosts%nodes))
    outgoing = values(pattern%shared%nodes)
    call transfer_values(pattern, pattern%shared, outgoing, pattern%ghosts, incoming)
    values(pattern%ghosts%nodes) = incoming
  end subroutine

  !> On entry sums(i) is this rank's part at nodes and ghosts, on return it is at this rank's nodes
  !> the sum of all parts. Collective.
  subroutine add_ghosts(pattern, sums)
    type(exchange_pattern), intent(in) :: pattern
    real(c_double), intent(inout) :: sums(:)
    real(c_double) :: outgoing(size(pattern%ghosts%nodes)), incoming(size(pattern%shared%nodes))
    integer(c_int64_t) :: k, i
    outgoing = sums(pattern%ghosts%nodes)
    call transfer_values(pattern, pattern%ghosts, outgoing, pattern%shared, incoming)
    do k = 1, size(incoming)  ! a node may be there several times, for several ranks
      i = pattern%shared%nodes(k)
      sums(i) = sums(i) + incoming(k)
    end do
  end subroutine

  !> Sends values to the ranks as `from` tells, and receives what `to` waits for.
  subroutine transfer_values(pattern, from, outgoing, to, incoming)
    type(exchange_pattern), intent(in) :: pattern
    type(nodes_by_rank), intent(in) :: from, to
    real(c_double), intent(in), asynchronous :: outgoing(:)
    real(c_double), intent(out), asynchronous :: incoming(:)
    integer :: requests(2 * size(pattern%ranks)), k, first, count, error
    integer, parameter :: tag = 1
    do k = 1, size(pattern%ranks)
      first = int(to%offsets(k))
      count = int(to%offsets(k + 1)) - first
      call MPI_Irecv(incoming(first:), count, MPI_DOUBLE_PRECISION, pattern%ranks(k), tag, &
                     pattern%comm, requests(2 * k - 1), error)
      first = int(from%offsets(k))
      count = int(from%offsets(k + 1)) - first
      call MPI_Isend(outgoing(first:), count, MPI_DOUBLE_PRECISION, pattern%ranks(k), tag, &
                     pattern%comm, requests(2 * k), error)
    end do
    call MPI_Waitall(size(requests), requests, MPI_STATUSES_IGNORE, error)
  end subroutine
end module ghost_exchange
