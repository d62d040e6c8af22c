! SPDX-License-Identifier: BSD-3-Clause
!> Tests domains in space and placements in them: known volumes, tetrahedra that fill the domains,
!> boundary triangles that enclose them, and spacings of three coordinates.
program test_space
  use, intrinsic :: iso_c_binding
  use pnpbs
  use curves
  use expectations
  use tetrahedra
  use twins
  use watchers
  implicit none
  real(c_double), parameter :: pi = 3.14159265358979323846d0
  real(c_double), parameter :: zero(3) = [0d0, 0d0, 0d0], one(3) = [1d0, 1d0, 1d0]
  type(pnpbs_context) :: context
  integer(c_int) :: stat
  character(len=300) :: errmsg

  call context%create_serial
  call about_shapes
  call about_surfaces
  call about_groups
  call about_level_sets
  call about_offsets
  call about_a_box
  call about_a_ball_in_a_box
  call about_spacings
  call about_a_sphere
  call context%destroy
  call finish

contains

  function volume(domain)
    type(pnpbs_domain), intent(in) :: domain
    real(c_double) :: volume
    call domain%measure(volume)
  end function

  subroutine about_shapes
    type(pnpbs_domain) :: domain
    real(c_double) :: low(3), high(3)
    integer(c_int32_t) :: dim, tags(4)
    call domain%create(context, 3)
    call domain%dimension(dim)
    call expect(dim == 3, 'dimension of a domain in space')
    call domain%add_box([-1d0, 0d0, 2d0], [1d0, 3d0, 6d0], 7)
    call expect(volume(domain) == 24, 'volume of a box')
    call domain%bounds(low, high)
    call expect(all(low == [-1d0, 0d0, 2d0]) .and. all(high == [1d0, 3d0, 6d0]), 'bounds')
    call domain%add_ball([0d0, 1.5d0, 4d0], 0.5d0)
    call expect(abs(volume(domain) - (24 - pi / 6)) < 1d-3, 'a ball in the box is a cavity')
    call domain%add_box([-0.9d0, 0.1d0, 2.1d0], [-0.6d0, 0.9d0, 3d0], role=PNPBS_INNER)
    call domain%add_ball([0d0, 0.5d0, 5.5d0], 0.3d0, role=PNPBS_INNER)
    call domain%add_cylinder([0d0, 2.5d0, 2.5d0], [0d0, 2.5d0, 5d0], 0.3d0, role=PNPBS_INNER)
    call expect(abs(volume(domain) - (24 - pi / 6)) < 1d-3, 'inner bodies divide the box')
    call domain%add_region([-0.7d0, 0.2d0, 2.2d0], 3)
    call domain%add_region([0d0, 0.5d0, 5.5d0], 4)
    call domain%add_region([0d0, 2.5d0, 3d0], 5)
    call domain%regions_at(reshape([-0.7d0, 0.8d0, 2.9d0, 0d0, 0.5d0, 5.3d0, 0.2d0, 2.5d0, 4.9d0, &
                                    -0.7d0, 0.8d0, 3.1d0], [3, 4]), tags)
    call expect(all(tags == [3, 4, 5, 0]), 'the regions in inner bodies')
    call domain%add_box(zero, one, role=2, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'role')
    call domain%destroy
    call domain%create(context, 3)
    call domain%add_cylinder([0d0, 0d0, 1d0], [0d0, 0d0, 4d0], 0.5d0, 2)
    call expect(abs(volume(domain) - 0.75d0 * pi) < 1d-3, 'volume of a cylinder')
    call domain%add_fixed_nodes(reshape([0d0, 0d0, 2d0], [3, 1]), [9])
    call domain%add_polyline(PNPBS_INNER, .false., &
                             reshape([0.1d0, 0d0, 2d0, 0.1d0, 0d0, 3d0], [3, 2]), [8])
    call domain%check
    call domain%destroy
  end subroutine

  subroutine about_surfaces
    type(pnpbs_domain) :: domain
    integer :: i
    call domain%create(context, 3)
    call domain%add_surface(PNPBS_BOUNDARY, vertices, faces, [1, 2, 3, 4], 30d0)
    call expect(abs(volume(domain) - 1d0 / 6) < 1d-15, 'volume of a tetrahedron')
    ! An inner surface is a smaller tetrahedron. Its inside is removed by a hole point.
    call domain%add_surface(PNPBS_INNER, 0.25d0 * vertices + 0.1d0, faces)
    call expect(abs(volume(domain) - 1d0 / 6) < 1d-15, 'an inner surface')
    call domain%set_filled(.false.)
    call expect(abs(volume(domain) - (1 + 0.25d0**2) * (1.5d0 + sqrt(0.75d0))) < 1d-12, &
                'the area of surfaces alone')
    call domain%set_filled(.true.)
    call domain%set_repair(0.02d0)
    call expect(abs(volume(domain) - 1d0 / 6) < 1d-15, 'a sound tetrahedron is not repaired')
    call domain%set_resurfaced(0.02d0)
    call expect(abs(volume(domain) - 1d0 / 6) < 1d-3, 'a tetrahedron with a new surface')
    call domain%destroy
    ! Two tetrahedra overlap in one with half of their edges.
    call domain%create(context, 3)
    call domain%add_surface(PNPBS_BOUNDARY, vertices, faces)
    call domain%add_surface(PNPBS_BOUNDARY, vertices + spread([0.5d0, 0d0, 0d0], 2, 4), faces)
    call domain%set_fragment(PNPBS_OVERLAP_OWN)
    call expect(abs(volume(domain) - (2 - 0.125d0) / 6) < 1d-15, 'two tetrahedra that overlap')
    call domain%destroy
    ! A tetrahedron is a cavity of a layer; half of it lies beyond a periodic side.
    call domain%create(context, 3)
    call domain%add_surface(PNPBS_BOUNDARY, vertices, faces)
    call domain%set_periodic([0.5d0, 0d0, -1d0], [2.5d0, 2d0, 2d0], [.true., .true., .false.], &
                             [1, 2, 3, 4, 5, 6])
    call expect(abs(volume(domain) - (12 - 1d0 / 6)) < 1d-14, 'a layer with a cavity')
    call domain%destroy
    call domain%create(context, 3)
    call domain%add_surface(PNPBS_BOUNDARY, vertices, faces, [1, 2, 3, 4], 30d0)
    call domain%add_surface(PNPBS_INNER, 0.25d0 * vertices + 0.1d0, faces)
    call domain%add_hole([0.15d0, 0.15d0, 0.15d0])
    call expect(abs(volume(domain) - (1 - 0.25d0**3) / 6) < 1d-15, 'a hole in the inner surface')
    call domain%destroy

    open (19, file='fortran_tetrahedron.off', status='replace')
    write (19, '(a)') 'OFF', '4 4 0'
    write (19, '(3f4.1)') vertices
    write (19, '(4i2)') (3, faces(:, i) - 1, i = 1, 4)
    close (19)
    call domain%create(context, 3)
    call domain%read_surface(PNPBS_BOUNDARY, 'fortran_tetrahedron.off   ')
    call expect(abs(volume(domain) - 1d0 / 6) < 1d-15, 'volume of a tetrahedron from a file')
    call domain%set_role(1, PNPBS_INNER)
    call domain%check(stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_DOMAIN, errmsg, 'no boundary')
    call domain%set_role(0, PNPBS_INNER, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'tag')
    call domain%read_surface(PNPBS_INNER, 'no/such/file.stl', 20d0, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_FILE, errmsg, 'no/such/file.stl')
    call domain%destroy
  end subroutine

  !> Checks a tetrahedron in a Gmsh file, one side of which has a name.
  subroutine about_groups
    type(pnpbs_domain) :: domain
    character(len=:), allocatable :: name
    integer(c_int32_t) :: dim, tag, count
    integer :: i
    open (19, file='fortran_tetrahedron.msh', status='replace')
    write (19, '(a)') '$MeshFormat', '2.2 0 8', '$EndMeshFormat', '$PhysicalNames', '1', &
      '2 3 "inlet"', '$EndPhysicalNames', '$Nodes', '4'
    write (19, '(i2, 3f4.1)') (i, vertices(:, i), i = 1, 4)
    write (19, '(a)') '$EndNodes', '$Elements', '4'
    write (19, '(8i2)') (i, 2, 2, i, i, faces(:, i), i = 1, 4)
    write (19, '(a)') '$EndElements'
    close (19)
    call pnpbs_file_dimension('fortran_tetrahedron.msh  ', dim)
    call expect(dim == 3, 'a body')
    call domain%create(context, 3)
    call domain%read_msh('fortran_tetrahedron.msh  ')
    call expect(abs(volume(domain) - 1d0 / 6) < 1d-15, 'volume of a tetrahedron of Gmsh''s')
    call domain%set_tag_name(2, 4, 'outlet  ')
    call domain%tag_name_count(count)
    call expect(count == 2, 'two names')
    call domain%get_tag_name(1, dim, tag, name)
    call expect(dim == 2 .and. tag == 3 .and. name == 'inlet', 'the name in the file')
    call domain%get_tag_name(2, dim, tag, name)
    call expect(dim == 2 .and. tag == 4 .and. name == 'outlet', 'the name given')
    call domain%get_tag_name(3, dim, tag, name, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, '2 names')
    call domain%set_tag_name(4, 1, 'none', stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'dim = 4')
    call domain%read_msh('no/such/file.msh', 20d0, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_FILE, errmsg, 'no/such/file.msh')
    call domain%destroy
  end subroutine

  !> Checks that nodes on the surface lie where the function is 0.
  subroutine about_level_sets
    type(pnpbs_domain) :: domain
    type(pnpbs_placement) :: placement
    real(c_double), target :: radius
    real(c_double), allocatable :: x(:,:)
    integer(c_int32_t), allocatable :: tags(:)
    integer(c_int64_t) :: nodes
    radius = 0.5d0
    call domain%create(context, 3)
    call domain%add_level_set(ball_level_set, -one, one, 0.1d0, 6, c_loc(radius))
    call expect(abs(volume(domain) - pi / 6) < 0.02, 'volume of a level set')
    call placement%create(context, domain)
    call placement%set_spacing_constant(0.15d0)
    call placement%run(stat)
    call expect(stat >= 0, 'run in a level set')
    call placement%count(nodes)
    allocate (x(3, nodes), tags(nodes))
    call placement%get_nodes(x, tags=tags)
    call expect(count(tags == 6) > 50, 'nodes on the surface of a level set')
    call expect(maxval(abs(sqrt(sum(x**2, dim=1)) - radius), mask=tags == 6) < 1d-12, &
                'nodes lie on the surface of a level set')
    call placement%destroy
    call domain%destroy
  end subroutine

  !> Checks that the callback is still called after the procedure ended and the domains are
  !> destroyed.
  subroutine about_offsets
    type(pnpbs_domain) :: box, inset
    type(pnpbs_placement) :: placement
    type(cone), target :: even
    real(c_double), allocatable :: x(:,:)
    integer(c_int32_t), allocatable :: tags(:)
    integer(c_int64_t) :: nodes, before
    even%finest = 0.25d0
    even%growth = 0
    call box%create(context, 3)
    call box%add_box(zero, one)
    call inset%create(context, 3)
    call inset%add_offset(box, -huge(1d0), -0.46d0, sideways_spacing, tag=6, user=c_loc(even))
    call expect(abs(volume(inset) - 0.77d0**3) < 1d-3, 'volume of an inset')
    call placement%create(context, inset)
    call placement%set('steps', 20)
    call placement%set_spacing_constant(0.25d0 * 1.147d0)
    call box%destroy
    call inset%destroy
    before = even%calls
    call placement%run(stat)
    call expect(stat >= 0, 'run in an inset')
    call expect(even%calls > before, 'the spacing of an inset is called')
    call placement%count(nodes)
    allocate (x(3, nodes), tags(nodes))
    call placement%get_nodes(x, tags=tags)
    call expect(count(tags == 6) > 20, 'nodes on the surface of an inset')
    call expect(maxval(abs(maxval(abs(x - 0.5d0), dim=1) - 0.385d0), mask=tags == 6) < 1d-12, &
                'nodes lie on the surface of an inset')
    call placement%destroy
  end subroutine

  !> Creates a placement in a domain, runs it, and compares all results with the C interface.
  subroutine place(domain, placement, d)
    type(pnpbs_domain), intent(in) :: domain
    type(pnpbs_placement), intent(inout) :: placement
    real(c_double), intent(in) :: d
    call placement%create(context, domain)
    call placement%set('steps', 40)
    call placement%set_spacing_constant(d)
    call placement%run(stat)
    call expect(stat >= 0, 'run')
    call placement%check(stat)
    call expect(stat == PNPBS_OK, 'the results are right')
    call compare_with_c(placement)
  end subroutine

  function determinant(a, b, c)
    real(c_double), intent(in) :: a(3), b(3), c(3)
    real(c_double) :: determinant
    determinant = a(1) * (b(2) * c(3) - b(3) * c(2)) - a(2) * (b(1) * c(3) - b(3) * c(1)) &
      + a(3) * (b(1) * c(2) - b(2) * c(1))
  end function

  !> Checks that tetrahedra are oriented and fill the volume that the boundary triangles enclose,
  !> and that these triangles close. Returns this volume and the tags of nodes and of boundary
  !> triangles.
  subroutine look_at_elements(placement, filled, node_tags, tags)
    type(pnpbs_placement), intent(in) :: placement
    real(c_double), intent(out) :: filled
    integer(c_int32_t), allocatable, intent(out) :: node_tags(:), tags(:)
    real(c_double), allocatable :: x(:,:), normals(:,:)
    integer(c_int64_t), allocatable :: corners(:,:), triangles(:,:)
    integer(c_int64_t) :: nodes, count, t
    real(c_double) :: least, enclosed, six_volumes
    call placement%count(nodes)
    call placement%tetrahedron_count(count)
    allocate (x(3, nodes), node_tags(nodes), corners(4, count))
    call placement%get_nodes(x, tags=node_tags)
    call placement%get_tetrahedra(corners)
    filled = 0
    least = 1
    do t = 1, count
      six_volumes = determinant(x(:, corners(2, t)) - x(:, corners(1, t)), &
                                x(:, corners(3, t)) - x(:, corners(1, t)), &
                                x(:, corners(4, t)) - x(:, corners(1, t)))
      least = min(least, six_volumes)
      filled = filled + six_volumes / 6
    end do
    call expect(least > 0, 'from the fourth corner the first three turn counter-clockwise')
    call placement%boundary_triangle_count(count)
    allocate (triangles(3, count), tags(count))
    call placement%get_boundary_triangles(triangles, tags)
    enclosed = 0
    do t = 1, count
      enclosed = enclosed + determinant(x(:, triangles(1, t)), x(:, triangles(2, t)), &
                                        x(:, triangles(3, t))) / 6
    end do
    call expect(abs(enclosed - filled) < 1d-12, 'the boundary triangles enclose the tetrahedra')
    call expect(all_closed(triangles, nodes), 'the boundary triangles are closed')
    allocate (normals(3, nodes))
    call placement%get_normals(normals)
    do t = 1, count
      call expect(all(abs(sum(normals(:, triangles(:, t))**2, 1) - 1) < 1d-12), 'unit normals')
    end do
  end subroutine

  !> Returns whether each directed side of the triangles occurs exactly once, and its reverse as
  !> well.
  function all_closed(triangles, nodes)
    integer(c_int64_t), intent(in) :: triangles(:,:), nodes
    logical :: all_closed
    integer, allocatable :: sides(:,:)
    integer :: t, k
    allocate (sides(nodes, nodes))
    sides = 0
    do t = 1, size(triangles, 2)
      do k = 1, 3
        associate (a => triangles(k, t), b => triangles(mod(k, 3) + 1, t))
          sides(a, b) = sides(a, b) + 1
        end associate
      end do
    end do
    all_closed = size(triangles) > 0 .and. maxval(sides) == 1 .and. all(sides == transpose(sides))
  end function

  subroutine about_a_box
    type(pnpbs_domain) :: domain
    type(pnpbs_placement) :: placement
    integer(c_int32_t), allocatable :: node_tags(:), tags(:)
    integer(c_int8_t), allocatable :: triangle(:)
    integer(c_int64_t), allocatable :: offsets(:), neighbours(:)
    integer(c_int32_t) :: dim
    integer(c_int64_t) :: nodes, entries, triangles
    real(c_double) :: filled
    call domain%create(context, 3)
    call domain%add_box(zero, one, 5)
    call place(domain, placement, 0.25d0)
    call placement%dimension(dim)
    call expect(dim == 3, 'dimension of a placement in space')
    call look_at_elements(placement, filled, node_tags, tags)
    call expect(abs(filled - 1) < 1d-12, 'tetrahedra fill the box')
    call expect(all(tags == 5) .and. all(node_tags == 0 .or. node_tags == 5), 'tags of the box')
    ! By Euler's formula, b nodes on a surface without handles have 2 b - 4 triangles.
    call placement%boundary_triangle_count(triangles)
    call expect(triangles == 2 * count(node_tags == 5) - 4, 'triangles by Euler''s formula')
    call placement%count(nodes)
    call placement%star_size(entries)
    allocate (offsets(nodes + 1), neighbours(entries), triangle(entries))
    call placement%get_stars(offsets, neighbours, triangle)
    call expect(all(triangle == 0), 'no triangle follows a neighbour in space')
    call placement%destroy
    call domain%destroy
  end subroutine

  subroutine about_a_ball_in_a_box
    type(pnpbs_domain) :: domain
    type(pnpbs_placement) :: placement
    integer(c_int32_t), allocatable :: node_tags(:), tags(:)
    real(c_double) :: filled
    call domain%create(context, 3)
    call domain%add_box(-one, one, 3)
    call domain%add_ball(zero, 0.5d0, 4)
    call place(domain, placement, 0.25d0)
    call look_at_elements(placement, filled, node_tags, tags)
    ! Chords cut off a part of the cavity.
    call expect(filled > volume(domain) .and. filled < 1.02d0 * volume(domain), 'around a ball')
    call expect(any(tags == 3) .and. any(tags == 4) .and. all(tags == 3 .or. tags == 4), &
                'tags of both surfaces')
    call placement%destroy
    call domain%destroy
  end subroutine

  function left_of_middle(placement) result(share)
    type(pnpbs_placement), intent(in) :: placement
    real(c_double), allocatable :: x(:,:)
    integer(c_int64_t) :: nodes
    real(c_double) :: share
    call placement%count(nodes)
    allocate (x(3, nodes))
    call placement%get_nodes(x)
    share = real(count(x(1, :) < 0.5d0), c_double) / real(nodes, c_double)
  end function

  subroutine about_spacings
    type(pnpbs_domain) :: domain
    type(pnpbs_placement) :: placement
    integer(c_int64_t) :: coarse, fine, same
    real(c_double), allocatable :: x(:,:), d(:)
    type(cone), target :: asked
    call domain%create(context, 3)
    call domain%add_surface(PNPBS_BOUNDARY, 2 * vertices, faces)
    call place(domain, placement, 0.4d0)
    call placement%count(coarse)
    asked%finest = 0.2d0
    call placement%set_spacing_callback(height_spacing, c_loc(asked))
    call placement%run
    call placement%count(fine)
    allocate (x(3, fine), d(fine))
    call placement%get_nodes(x, spacing=d)
    call expect(fine > coarse .and. asked%calls > 0, 'finer by a callback')
    call expect(maxval(abs(d - (asked%finest + asked%growth * x(3, :)))) < 1d-12, &
                'd of the third coordinate')
    d = 0.4d0
    call placement%set_spacing_at_nodes(d)
    call placement%run
    call placement%count(same)
    call expect(2 * same < fine, 'coarser by values at nodes')
    deallocate (d)
    allocate (d(same))
    call placement%get_nodes(spacing=d)
    call expect(maxval(abs(d - 0.4d0)) < 1d-12, 'd of values at nodes')
    call placement%destroy
    call domain%destroy

    call domain%create(context, 3)
    call domain%add_box(zero, one)
    call placement%create(context, domain)
    ! x varies fastest: d is fine on the left and coarse on the right.
    call placement%set_spacing_grid(zero, one, reshape([0.12d0, 0.4d0], [2, 1, 1]))
    call placement%run
    call expect(left_of_middle(placement) > 0.7, 'finer on the left')
    call placement%set_nodes(reshape([0.3d0, 0.4d0, 0.5d0], [3, 1]), [1234567_c_int64_t])
    call placement%initialise
    call expect_node(placement, 1234567_c_int64_t, [0.3d0, 0.4d0, 0.5d0])
    call placement%destroy
    call domain%destroy
  end subroutine

  subroutine expect_node(placement, id, place_of_it)
    type(pnpbs_placement), intent(in) :: placement
    integer(c_int64_t), intent(in) :: id
    real(c_double), intent(in) :: place_of_it(3)
    real(c_double), allocatable :: x(:,:)
    integer(c_int64_t), allocatable :: ids(:)
    integer(c_int64_t) :: nodes, i
    logical :: found
    call placement%count(nodes)
    allocate (x(3, nodes), ids(nodes))
    call placement%get_nodes(x, ids)
    found = .false.
    do i = 1, nodes
      if (ids(i) == id) found = all(x(:, i) == place_of_it)
    end do
    call expect(found, 'a node that was given')
  end subroutine

  subroutine about_a_sphere
    type(pnpbs_domain) :: domain
    type(pnpbs_placement) :: placement
    real(c_double) :: places(2, 180), found(2, 180), ring(3, 180), area, radius
    real(c_double), allocatable :: x(:,:), d(:), segments(:,:,:)
    integer(c_int64_t), allocatable :: triangles(:,:)
    integer(c_int64_t) :: nodes, again, count, edges, t
    integer(c_int32_t) :: dim
    integer :: i
    places = reshape([(real(2 * i - 180, c_double), -70d0, i = 1, 180)], [2, 180])
    call pnpbs_sphere_points(1d0, places, ring)
    call expect(maxval(abs(norm(ring) - 1)) < 1d-15, 'points on a sphere')
    call pnpbs_sphere_degrees(2 * ring, found)
    call expect(maxval(abs(found - places)) < 1d-12, 'degrees of points')
    call domain%create_sphere(context, 1d0, [0d0, 0d0, -1d0])
    call domain%dimension(dim)
    call expect(dim == 3, 'dimension of a domain on a sphere')
    call domain%add_polyline(PNPBS_BOUNDARY, .true., ring, corner_angle=30d0)
    call domain%measure(area)
    call expect(abs(area - 2 * pi * (1 + sin(70 * pi / 180))) < 1d-3, 'area on a sphere')
    call domain%segment_count(count)
    allocate (segments(3, 2, count))
    call domain%get_segments(segments)
    call expect(maxval(abs(norm(reshape(segments, [3, int(2 * count)])) - 1)) < 1d-14, &
                'segments on a sphere')
    call placement%create(context, domain)
    call placement%sphere_radius(radius)
    call expect(radius == 1, 'radius of the sphere of nodes')
    call placement%set_spacing_constant(0.1d0)
    call placement%run(stat)
    call expect(stat == PNPBS_OK, 'nodes on a sphere')
    call placement%count(nodes)
    call placement%triangle_count(count)
    call placement%boundary_edge_count(edges)
    allocate (x(3, nodes), triangles(3, count))
    call placement%get_nodes(x)
    call expect(maxval(abs(norm(x) - 1)) < 1d-15, 'nodes lie on the sphere')
    call placement%get_triangles(triangles)
    call expect(all([(from_centre(x(:, triangles(:, t))) > 0, t = 1, count)]), &
                'triangles counter-clockwise from outside')
    ! Inner sides belong to two triangles and sides of the boundary to one. The sum is twice V - E +
    ! F.
    call expect(2 * nodes - (3 * count + edges) + 2 * count == 2, &
                'triangles of a sphere with one hole')
    ! Grids on a sphere are in longitude and latitude.
    call placement%set_spacing_grid([-135d0, -90d0], [90d0, 90d0], &
                                    spread([0.1d0, 0.12d0, 0.14d0], 1, 4))
    call placement%run(stat)
    call expect(stat == PNPBS_OK, 'nodes by a grid on a sphere')
    call placement%count(nodes)
    deallocate (x)
    allocate (x(3, nodes), d(nodes))
    call placement%get_nodes(x, spacing=d)
    call expect(maxval(abs(d - (0.12d0 + 0.02d0 * asin(x(3, :)) / (pi / 2)))) < 1d-12, &
                'd by a grid on a sphere')
    ! d at the previous nodes gives about the same number of nodes.
    call placement%triangle_count(count)
    deallocate (triangles)
    allocate (triangles(3, count))
    call placement%get_triangles(triangles)
    call placement%set_spacing_mesh(x, d, triangles)
    call placement%run(stat)
    call expect(stat == PNPBS_OK, 'nodes by a mesh on a sphere')
    call placement%count(again)
    call expect(abs(again - nodes) < nodes / 50d0, 'as many nodes by a mesh on a sphere')
    call placement%set_spacing_points(x, d)
    call placement%run(stat)
    call expect(stat == PNPBS_OK, 'nodes by points on a sphere')
    call placement%count(again)
    call expect(abs(again - nodes) < nodes / 50d0, 'as many nodes by points on a sphere')
    call placement%set_spacing_mesh(x, d, reshape([1_c_int64_t], [4, 1], pad=[2_c_int64_t]), stat, &
                                    errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'corners')
    call placement%set_spacing_grid([0d0, 0d0, 0d0], [1d0, 1d0, 1d0], reshape([0.1d0], [1, 1, 1]), &
                                    stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'values')
    call placement%destroy
    call domain%destroy
  end subroutine

  function norm(x)
    real(c_double), intent(in) :: x(:,:)
    real(c_double) :: norm(size(x, 2))
    norm = sqrt(sum(x**2, 1))
  end function

  !> Returns six times the volume between a triangle and the origin. It is positive if the triangle
  !> is counter-clockwise as seen from outside.
  function from_centre(corners)
    real(c_double), intent(in) :: corners(3, 3)
    real(c_double) :: from_centre
    from_centre = dot_product(corners(:, 1), &
                              corners([2, 3, 1], 2) * corners([3, 1, 2], 3) - &
                              corners([3, 1, 2], 2) * corners([2, 3, 1], 3))
  end function
end program test_space
