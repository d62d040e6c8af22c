! SPDX-License-Identifier: BSD-3-Clause
!> Tests a communicator of the module mpi_f08.
program test_mpi_f08
  use, intrinsic :: iso_c_binding
  use mpi_f08
  use pnpbs
  use expectations
  implicit none
  type(pnpbs_context) :: context
  type(pnpbs_domain) :: domain
  type(pnpbs_placement) :: placement
  integer(c_int64_t) :: mine, all_nodes, total
  integer(c_int) :: stat
  character(len=300) :: errmsg
  call MPI_Init()
  call context%create_mpi(MPI_COMM_WORLD, stat=stat, errmsg=errmsg)
  call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'give comm%MPI_VAL')
  call context%create_mpi(MPI_COMM_WORLD%MPI_VAL)
  call square(context, domain, placement, 0.1d0)
  call placement%initialise
  call placement%count(mine)
  call placement%get('nodes', all_nodes)
  call MPI_Allreduce(mine, total, 1, MPI_INTEGER8, MPI_SUM, MPI_COMM_WORLD)
  call expect(total == all_nodes, 'each node once')
  call placement%destroy
  call domain%destroy
  call context%destroy
  call MPI_Finalize()
  call finish
end program test_mpi_f08
