! SPDX-License-Identifier: BSD-3-Clause
!> Tests the module over the ranks of a communicator, with mpif.h: the same nodes as one process,
!> ghosts and exchange patterns against the C interface, and errors on one rank that are errors on
!> all.
program test_ranks
  use, intrinsic :: iso_c_binding
  use pnpbs
  use expectations
  use twins
  use watchers
  implicit none
  include 'mpif.h'
  type(cone), target :: asked
  integer :: rank, size, ierror, length, half
  character(len=MPI_MAX_LIBRARY_VERSION_STRING) :: library

  call MPI_Init(ierror)
  call MPI_Comm_rank(MPI_COMM_WORLD, rank, ierror)
  call MPI_Comm_size(MPI_COMM_WORLD, size, ierror)
  call MPI_Get_library_version(library, length, ierror)
  call compare_with_serial(MPI_COMM_WORLD)
  call MPI_Comm_split(MPI_COMM_WORLD, mod(rank, 2), rank, half, ierror)
  call compare_with_serial(half)
  call MPI_Comm_free(half, ierror)
  call about_space
  call about_fields
  call about_errors
  call MPI_Finalize(ierror)
  call finish

contains

  subroutine place(context, domain, placement)
    type(pnpbs_context), intent(in) :: context
    type(pnpbs_domain), intent(inout) :: domain
    type(pnpbs_placement), intent(inout) :: placement
    call square(context, domain, placement, 0.1d0)
    call placement%set('steps', 60)
    call placement%set_spacing_callback(cone_spacing, c_loc(asked))
    call placement%run
  end subroutine

  subroutine compare_with_serial(comm)
    integer, intent(in) :: comm
    type(pnpbs_context) :: context, alone
    type(pnpbs_domain) :: domain, domain_alone
    type(pnpbs_placement) :: placement, placement_alone
    character(len=:), allocatable :: hash, hash_alone
    integer(c_int64_t) :: mine, all_nodes, nodes_alone
    call context%create_mpi(comm, trim(library))
    call alone%create_serial
    call place(context, domain, placement)
    call place(alone, domain_alone, placement_alone)
    call placement%get('hash', hash)
    call placement_alone%get('hash', hash_alone)
    call expect(hash == hash_alone, 'the same nodes on any number of ranks')
    call placement%count(mine)
    call placement%get('nodes', all_nodes)
    call placement_alone%count(nodes_alone)
    call expect(all_nodes == nodes_alone .and. mine <= all_nodes, 'the nodes are shared')
    call compare_with_c(placement)
    call placement%rebalance
    call compare_with_c(placement)
    call placement%check
    call placement_alone%destroy
    call placement%destroy
    call domain%destroy
    call domain_alone%destroy
    call context%destroy
    call alone%destroy
  end subroutine

  !> Checks a box, graded in its height, against one process.
  subroutine about_space
    type(pnpbs_context) :: contexts(2)
    type(pnpbs_domain) :: domain
    type(pnpbs_placement) :: placement
    character(len=:), allocatable :: hash, hash_alone
    integer :: k
    call contexts(1)%create_serial
    call contexts(2)%create_mpi(MPI_COMM_WORLD)
    asked%finest = 0.15d0
    do k = 1, 2
      call domain%create(contexts(k), 3)
      call domain%add_box([0d0, 0d0, 0d0], [1d0, 1d0, 1d0])
      call placement%create(contexts(k), domain)
      call placement%set('steps', 20)
      call placement%set_spacing_callback(height_spacing, c_loc(asked))
      call placement%run
      call placement%get('hash', hash)
      if (k == 1) hash_alone = hash
      call compare_with_c(placement)
      call placement%destroy
      call domain%destroy
      call contexts(k)%destroy
    end do
    call expect(hash == hash_alone, 'the same nodes in space on any number of ranks')
  end subroutine

  !> Checks fields of one and two components: ghosts, sums, and transfer to other nodes.
  subroutine about_fields
    type(pnpbs_context) :: context, alone
    type(pnpbs_domain) :: domain, domain_alone
    type(pnpbs_placement) :: placement, placement_alone
    type(pnpbs_transfer) :: line, plane, same, bent, both_bent
    integer(c_int64_t) :: n, g
    integer(c_int32_t) :: dim, components, order
    integer(c_int64_t) :: linear_nodes
    real(c_double), allocatable :: xy(:,:), x(:), values(:,:), there(:), pairs(:,:)
    real(c_double) :: total, total_alone, square, sums(2), squares(2), points(2, 3), at(3), both(2, 3)
    integer(c_int) :: stat
    character(len=300) :: errmsg
    call context%create_mpi(MPI_COMM_WORLD)
    call place(context, domain, placement)
    call placement%count(n)
    call placement%ghost_count(g)
    allocate (xy(2, n + g), values(2, n + g), x(n + g))
    call placement%get_nodes(xy(:, :n))
    call placement%get_ghosts(xy(:, n+1:))
    values = -1
    values(:, :n) = xy(:, :n)
    x = values(1, :)
    call placement%update_ghosts(values)
    call expect(all(values == xy), 'two components of ghosts')
    call placement%begin_update_ghosts(x)
    call placement%begin_update_ghosts(x, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_STATE, errmsg, 'under way')
    call placement%end_update_ghosts(x)
    call expect(all(x == xy(1, :)), 'one component of ghosts')
    call placement%begin_update_ghosts(values)
    call placement%end_update_ghosts(values)
    call expect(all(values == xy), 'two components of ghosts, begun and ended')
    call placement%update_ghosts(x(2:), stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'argument n')

    call placement%add_from_ghosts(x(2:), stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'argument n')

    call alone%create_serial
    call place(alone, domain_alone, placement_alone)
    call placement_alone%count(n)
    allocate (pairs(2, n))
    call placement_alone%get_nodes(pairs)
    call placement%sum(x, total)
    call placement%sum(values, sums)
    call placement_alone%sum(pairs(1, :), total_alone)
    call expect(total == total_alone .and. sums(1) == total, 'sums of one process')
    call placement%dot(x, x, square)
    call placement%dot(values, values, squares)
    call placement_alone%dot(pairs(1, :), pairs(1, :), total_alone)
    call expect(square == total_alone .and. squares(1) == square, 'dot products of one process')
    call placement%sum(values, sums(:1), stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'total has an extent of 1')

    call placement%count(n)
    call line%create(placement, 3 * xy(1, :n) - xy(2, :n))
    call plane%create(placement, xy(:, :n))
    call bent%create_second_order(placement, xy(1, :n)**2 - xy(1, :n) * xy(2, :n))
    call both_bent%create_second_order(placement, xy(:, :n)**2)
    call bent%order(order, linear_nodes)
    call expect(order == 2 .and. linear_nodes == 0, 'second order at all nodes')
    call line%order(order, linear_nodes)
    call expect(order == 1 .and. linear_nodes == -1, 'first order')
    call plane%sizes(dim, components)
    call expect(dim == 2 .and. components == 2, 'sizes of a transfer')
    call placement%set_spacing_constant(0.08d0)
    call placement%run
    deallocate (xy)
    call placement%count(n)
    allocate (xy(2, n), there(n))
    call placement%get_nodes(xy)
    call line%at_nodes(placement, there)
    call expect(all(abs(there - 3 * xy(1, :) + xy(2, :)) < 1d-13), 'a linear field at new nodes')
    call line%at_nodes(placement, there, .true.)
    call expect(all(abs(there - 3 * xy(1, :) + xy(2, :)) < 1d-13), 'and with its integral')
    deallocate (values)
    allocate (values(2, n))
    call plane%at_nodes(placement, values)
    call expect(all(abs(values - xy) < 1d-13), 'two linear fields at new nodes')
    call bent%at_nodes(placement, there)
    call expect(all(abs(there - xy(1, :)**2 + xy(1, :) * xy(2, :)) < 1d-12), 'a quadratic field')
    call both_bent%at_nodes(placement, values)
    call expect(all(abs(values - xy**2) < 1d-12), 'two quadratic fields')
    call bent%destroy
    call both_bent%destroy
    points = reshape([0.1d0, 0.2d0, 0.5d0, 0.5d0, 1d0, 0.7d0], [2, 3])
    call line%at_points(points, at)
    call expect(all(abs(at - 3 * points(1, :) + points(2, :)) < 1d-13), 'a field at points')
    call same%from_handle(plane%handle())
    call same%at_points(points, both)
    call expect(all(abs(both - points) < 1d-13), 'two fields at points')
    call plane%at_points(points, at, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'values has an extent of 1')
    call line%at_nodes(placement, there(2:), stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_CAPACITY, errmsg, 'capacity')
    call line%destroy
    call plane%destroy
    call same%at_points(points, both, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_HANDLE, errmsg, 'transfer')
    call placement%destroy
    call placement_alone%destroy
    call domain%destroy
    call domain_alone%destroy
    call context%destroy
    call alone%destroy
  end subroutine

  subroutine about_errors
    type(pnpbs_context) :: context
    type(pnpbs_domain) :: domain
    type(pnpbs_placement) :: placement
    integer(c_int64_t) :: nodes, entries
    integer(c_int64_t), allocatable :: offsets(:), neighbours(:)
    real(c_double), allocatable :: xy(:,:)
    integer(c_int) :: stat
    character(len=300) :: errmsg
    call context%create_mpi(MPI_COMM_NULL, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_MPI, errmsg, 'MPI_COMM_NULL')
    call context%create_mpi(MPI_COMM_WORLD, 'Another MPI 3.0', stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_MPI, errmsg, 'Another MPI 3.0')

    ! An array that is too small on one rank, which the module itself detects, is an error on all
    ! ranks.
    call context%create_mpi(MPI_COMM_WORLD)
    call place(context, domain, placement)
    call placement%count(nodes)
    call placement%adjacency_size(entries)
    allocate (offsets(merge(nodes, nodes + 1, rank == size - 1)), neighbours(entries))
    call placement%get_adjacency(offsets, neighbours, stat, errmsg)
    call expect(stat < 0, 'an error on one rank is that of all')
    if (rank == size - 1) &
      call expect_failure(stat, PNPBS_ERROR_CAPACITY, errmsg, 'offsets has room for')
    ! An array with a wrong shape on one rank is an error on all ranks as well.
    allocate (xy(merge(3, 2, rank == 0), 1))
    xy = 0.5d0
    call placement%set_nodes(xy, stat=stat, errmsg=errmsg)
    call expect(stat < 0, 'a wrong shape on one rank')
    if (rank == 0) &
      call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'coordinates has an extent of 3')
    call placement%run(stat)
    call expect(stat >= 0, 'it goes on afterwards')
    call placement%destroy
    call domain%destroy
    call context%destroy
  end subroutine
end program test_ranks
