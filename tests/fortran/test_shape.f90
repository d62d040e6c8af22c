! SPDX-License-Identifier: BSD-3-Clause
!> Tests the shape of a domain and spacings that follow it: distances, curvature, width, edges,
!> growth and bounds, in the plane and in space.
program test_shape
  use, intrinsic :: iso_c_binding
  use pnpbs
  use expectations
  implicit none
  real(c_double), parameter :: pi = 3.14159265358979323846d0
  type(pnpbs_context) :: context
  integer(c_int) :: stat
  character(len=300) :: errmsg

  call context%create_serial
  call about_a_ring
  call about_nodes_of_a_ring
  call about_edges_of_a_square
  call about_a_box
  call about_wrong_arguments
  call context%destroy
  call finish

contains

  !> Creates a ring around the origin. The circle of radius 2 has tag 1, and that of radius 1 has
  !> tag 2.
  subroutine make_ring(domain)
    type(pnpbs_domain), intent(inout) :: domain
    call domain%create(context)
    call domain%add_arc(PNPBS_BOUNDARY, [0d0, 0d0], 2d0, 0d0, 2 * pi, 1)
    call domain%add_arc(PNPBS_BOUNDARY, [0d0, 0d0], 1d0, 0d0, 2 * pi, 2)
  end subroutine

  subroutine about_a_ring
    type(pnpbs_domain) :: domain
    real(c_double), parameter :: x(2, 3) = reshape([1d0, 0d0, 2d0, 0d0, 0d0, 1.5d0], [2, 3])
    real(c_double) :: found(3)
    call make_ring(domain)
    call domain%distance(x, found)
    call expect(all(abs(found - [0d0, 0d0, 0.5d0]) < 1d-6), 'distance from the boundary')
    call domain%distance(x, found, 2)
    call expect(all(abs(found - [0d0, 1d0, 0.5d0]) < 1d-6), 'distance from a tag')
    call domain%distance(x, found, 5, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'tag = 5')

    ! By curvature, the circle of radius 1 requires 2 pi / 20, and d grows from there.
    call domain%shape_spacing(x, found, nodes_per_turn=20d0)
    call expect(all(abs(found - 2 * pi / 20 - [0d0, 0.15d0, 0.075d0]) < 1d-5), 'by curvature')
    ! By width, d is 1 / 8, since the ring is 1 wide.
    call domain%shape_spacing(x, found, nodes_across=8d0, growth=0.3d0)
    call expect(all(abs(found - 0.125d0 - [0d0, 0d0, 0.15d0]) < 1d-5), 'by width')
    ! The smaller of the two values counts.
    call domain%shape_spacing(x, found, nodes_per_turn=20d0, nodes_across=8d0)
    call expect(all(abs(found - 0.125d0 - [0d0, 0d0, 0.075d0]) < 1d-5), 'by both')
    call domain%shape_spacing(x, found, nodes_per_turn=-1d0, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'nodes_per_turn = -1')
    call domain%shape_spacing(x, found(:2), nodes_per_turn=20d0, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'd has')
    call domain%destroy
  end subroutine

  !> Checks that d at the nodes equals the spacing of the domain within the bounds.
  subroutine about_nodes_of_a_ring
    type(pnpbs_domain) :: domain
    type(pnpbs_placement) :: placement
    real(c_double), allocatable :: x(:,:), d(:), wanted(:)
    integer(c_int64_t) :: nodes
    call make_ring(domain)
    call placement%create(context, domain)
    call placement%set('steps', 20)
    call placement%set_spacing_from_shape(nodes_per_turn=40d0, nodes_across=5d0)
    call placement%run
    call placement%count(nodes)
    allocate (x(2, nodes), d(nodes), wanted(nodes))
    call placement%get_nodes(x, spacing=d)
    call domain%shape_spacing(x, wanted, nodes_per_turn=40d0, nodes_across=5d0)
    call expect(all(d >= wanted) .and. all(d <= wanted), 'nodes have the spacing of the shape')

    call placement%set_spacing_from_shape(nodes_per_turn=40d0, min_spacing=0.17d0, &
                                          max_spacing=0.2d0, growth=1d0)
    call placement%run
    call placement%count(nodes)
    deallocate (x, d, wanted)
    allocate (x(2, nodes), d(nodes), wanted(nodes))
    call placement%get_nodes(x, spacing=d)
    call domain%shape_spacing(x, wanted, nodes_per_turn=40d0, growth=1d0)
    wanted = min(max(wanted, 0.17d0), 0.2d0)
    call expect(all(d >= wanted) .and. all(d <= wanted), 'bounds of the spacing')
    call expect(minval(d) < 0.171d0 .and. maxval(d) > 0.199d0, 'both bounds count')
    call placement%destroy
    call domain%destroy
  end subroutine

  !> Checks the spacing by edges: a quarter of the sides of a square, which are 1 long.
  subroutine about_edges_of_a_square
    type(pnpbs_domain) :: domain
    type(pnpbs_placement) :: placement
    real(c_double) :: found(1)
    call square(context, domain, placement, 0.1d0)
    call domain%shape_spacing(reshape([0.5d0, 0.5d0], [2, 1]), found, nodes_per_edge=4d0)
    call expect(abs(found(1) - 0.25d0 - 0.5d0 * 0.15d0) < 1d-6, 'by edges')
    call domain%shape_spacing(reshape([0.5d0, 0.5d0, 0.5d0], [3, 1]), found, nodes_per_edge=4d0, &
                              stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'coordinates')
    call placement%destroy
    call domain%destroy
  end subroutine

  !> Checks a box that is 0.5 thick: four nodes across require 0.125.
  subroutine about_a_box
    type(pnpbs_domain) :: domain
    type(pnpbs_placement) :: placement
    real(c_double), parameter :: x(3, 2) = reshape([0.5d0, 0.5d0, 0d0, 0.5d0, 0.5d0, 0.25d0], &
                                                   [3, 2])
    real(c_double) :: found(2)
    real(c_double), allocatable :: d(:)
    integer(c_int64_t) :: nodes
    call domain%create(context, 3)
    call domain%add_box([0d0, 0d0, 0d0], [1d0, 1d0, 0.5d0])
    call domain%distance(x, found)
    call expect(all(abs(found - [0d0, 0.25d0]) < 1d-9), 'distance in space')
    call domain%shape_spacing(x, found, nodes_across=4d0, growth=0.2d0)
    call expect(all(abs(found - [0.125d0, 0.175d0]) < 1d-3), 'by width in space')
    call placement%create(context, domain)
    call placement%set('steps', 5)
    call placement%set_spacing_from_shape(nodes_across=2d0, min_spacing=0.2d0)
    call placement%initialise
    call placement%count(nodes)
    allocate (d(nodes))
    call placement%get_nodes(spacing=d)
    call expect(nodes > 20 .and. minval(d) >= 0.2d0, 'nodes in space')
    call placement%destroy
    call domain%destroy
  end subroutine

  subroutine about_wrong_arguments
    type(pnpbs_domain) :: domain
    type(pnpbs_placement) :: placement
    call square(context, domain, placement, 0.1d0)
    call placement%set_spacing_from_shape(nodes_across=3d0, min_spacing=2d0, max_spacing=1d0, &
                                          stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'min_spacing = 2')
    call placement%set_spacing_from_shape(growth=-1d0, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'growth = -1')
    call placement%destroy
    call domain%destroy
  end subroutine
end program
