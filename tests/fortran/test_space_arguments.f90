! SPDX-License-Identifier: BSD-3-Clause
!> Tests domains and placements in space: invalid arguments, and procedures of the plane.
program test_space_arguments
  use, intrinsic :: iso_c_binding
  use pnpbs
  use expectations
  use curves
  use tetrahedra
  implicit none
  real(c_double), parameter :: zero(3) = [0d0, 0d0, 0d0], one(3) = [1d0, 1d0, 1d0]
  type(pnpbs_context) :: context
  integer(c_int) :: stat
  character(len=300) :: errmsg

  call context%create_serial
  call about_wrong_arguments
  call about_the_plane
  call about_a_sphere
  call context%destroy
  call finish

contains

  subroutine about_wrong_arguments
    type(pnpbs_domain) :: domain
    type(pnpbs_placement) :: placement
    real(c_double), allocatable :: x(:,:)
    real(c_double) :: two(2)
    integer(c_int64_t) :: too_few(4, 1), nodes, three(3, 1)
    call domain%create(context, 4, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'dim = 4')
    call domain%create(context, 3)
    call domain%add_surface(PNPBS_BOUNDARY, vertices(1:2, :), faces, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'coordinates has an extent of 2; 3')
    call domain%add_surface(PNPBS_BOUNDARY, vertices, faces(1:2, :), stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'corners has an extent of 2; 3')
    call domain%add_surface(PNPBS_BOUNDARY, vertices, faces, [1, 2], stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_CAPACITY, errmsg, 'tags has room for 2; 4')
    ! The last vertex has the index 4, as Fortran counts from 1.
    call domain%add_surface(PNPBS_BOUNDARY, vertices, faces + 1, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'corners')
    call domain%add_surface(PNPBS_BOUNDARY, vertices, faces, feature_angle=999d0, stat=stat, &
                            errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, '999')
    call domain%add_box([0d0, 0d0], one, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'low')
    call domain%add_box(one, zero, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'high[0]')
    call domain%add_ball(zero, -1d0, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'radius')
    call domain%add_ball([0d0], 1d0, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'centre')
    call domain%add_cylinder(zero, [1d0], 1d0, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'end')
    call domain%add_cylinder(zero, zero, 1d0, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'begin and end')
    call domain%add_level_set(ball_level_set, -one, one, 0.1d0, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_CALLBACK, errmsg, '5')
    call domain%add_level_set(ball_level_set, [0d0], one, 0.1d0, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'low')
    call domain%add_level_set(ball_level_set, -one, one, -7d0, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, '-7')
    call domain%add_hole([0d0, 0d0], stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'point has an extent of 2; 3')
    call domain%add_fixed_nodes(vertices(1:2, :), stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'coordinates has an extent of 2; 3')

    call domain%add_box(zero, one)
    call domain%bounds(two, two, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'low has an extent of 2; 3')
    call placement%create(context, domain)
    call placement%set_spacing_grid([0d0, 0d0], [1d0, 1d0], reshape([0.5d0], [1, 1]), stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'values has rank 2; 3 was expected')
    call placement%set_spacing_grid(zero, [1d0], reshape([0.5d0], [1, 1, 1]), stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'step has an extent of 1; 3')
    call placement%set_spacing_constant(0.5d0)
    call placement%run
    call placement%count(nodes)
    allocate (x(2, nodes))
    call placement%get_nodes(x, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'coordinates has an extent of 2; 3')
    call placement%set_nodes(x, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'coordinates has an extent of 2; 3')
    call placement%get_tetrahedra(too_few, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_CAPACITY, errmsg, 'are needed')
    call placement%get_tetrahedra(three, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'tetrahedra has an extent of 3; 4')
    call placement%get_incident_elements(too_few, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_CAPACITY, errmsg, 'are needed')
    call placement%get_incident_elements(three, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'elements has an extent of 3; 4')
    call placement%get_boundary_triangles(too_few, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'triangles has an extent of 4; 3')
    call placement%get_boundary_triangles(three, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_CAPACITY, errmsg, 'are needed')
    call placement%destroy
    call placement%get_nodes(x, stat=stat, errmsg=errmsg)
    call expect(stat == PNPBS_ERROR_HANDLE, 'a dead placement, whatever the array')
    call domain%destroy
    call domain%add_hole(zero, stat, errmsg)
    call expect(stat == PNPBS_ERROR_HANDLE, 'a dead domain, whatever the point')
  end subroutine

  !> Checks that procedures for the plane reject domains in space, and the other way round.
  subroutine about_the_plane
    type(pnpbs_domain) :: domain
    type(pnpbs_placement) :: placement
    integer(c_int64_t) :: n, triangles(3, 1)
    integer(c_int32_t) :: dim
    call domain%create(context, 3)
    call domain%add_box(zero, one)
    call domain%add_polyline(PNPBS_BOUNDARY, .true., vertices(:, 1:3), stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'curves do not bound a domain in space')
    call domain%add_arc(PNPBS_INNER, [0.5d0, 0.5d0], 0.1d0, 0d0, 1d0, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'for domains in the plane')
    call domain%add_curve(PNPBS_INNER, ellipse, 0d0, 1d0, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'for domains in the plane')
    call domain%add_pslg(vertices(1:2, 1:3), faces(1:2, 1:1), stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'for domains in the plane')
    call domain%read_poly('any.poly', stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'for domains in the plane')
    call domain%segment_count(n, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'for domains in the plane')
    call placement%create(context, domain)
    call placement%set_spacing_constant(0.5d0)
    call placement%run
    call placement%triangle_count(n, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'placement has 3 dimensions')
    call placement%boundary_edge_count(n, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'placement has 3 dimensions')
    call placement%destroy
    call domain%destroy

    call square(context, domain, placement, 0.2d0)
    call domain%dimension(dim)
    call expect(dim == 2, 'dimension of a domain in the plane')
    call domain%add_box(zero, one, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'for domains in space')
    call domain%add_ball(zero, 1d0, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'for domains in space')
    call domain%add_cylinder(zero, one, 1d0, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'for domains in space')
    call domain%add_surface(PNPBS_BOUNDARY, vertices, faces, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'for domains in space')
    call domain%read_surface(PNPBS_BOUNDARY, 'any.stl', stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'for domains in space')
    call placement%set_spacing_grid(zero, one, reshape([0.5d0], [1, 1, 1]), stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'values has rank 3; 2 was expected')
    call placement%run
    call placement%tetrahedron_count(n, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'placement has 2 dimensions')
    call placement%get_boundary_triangles(triangles, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'placement has 2 dimensions')
    call placement%destroy
    call domain%destroy
  end subroutine

  subroutine about_a_sphere
    type(pnpbs_domain) :: domain
    real(c_double) :: points(3, 2), degrees(2, 2)
    degrees = reshape([0d0, 0d0, 0d0, 91d0], [2, 2])
    call domain%create_sphere(context, 0d0, [0d0, 0d0, -1d0], stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'radius is 0')
    call domain%create_sphere(context, 1d0, zero, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'outside')
    call domain%create_sphere(context, 1d0, [0d0, -1d0], stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'outside has an extent of 2; 3')
    call pnpbs_sphere_points(0d0, degrees, points, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'radius is 0')
    call pnpbs_sphere_points(1d0, degrees, points, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'degrees[1][1] = 91')
    call pnpbs_sphere_points(1d0, points, points, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'degrees has an extent of 3; 2')
    call pnpbs_sphere_points(1d0, degrees, degrees, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'coordinates has an extent of 2; 3')
    call pnpbs_sphere_points(1d0, degrees, points(:, 1:1), stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_CAPACITY, errmsg, 'coordinates has room for 1; 2')
    points = 0
    call pnpbs_sphere_degrees(points, degrees, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'coordinates[0]')
    call pnpbs_sphere_degrees(points, degrees(:, 1:1), stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_CAPACITY, errmsg, 'degrees has room for 1; 2')
    call domain%create_sphere(context, 1d0, [0d0, 0d0, -1d0])
    call domain%add_arc(PNPBS_INNER, [0d0, 0d0], 0.1d0, 0d0, 1d0, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'on a sphere')
    call domain%destroy
  end subroutine
end program test_space_arguments
