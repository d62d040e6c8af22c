! SPDX-License-Identifier: BSD-3-Clause
!> Tests distributed meshes of one process, in the plane, in space and on a surface: numbers,
!> orientation of elements by local indices, facets, files, and invalid arguments. test_ranks tests
!> meshes over ranks.
program test_mesh
  use, intrinsic :: iso_c_binding
  use pnpbs
  use expectations
  implicit none
  real(c_double), parameter :: zero(3) = [0d0, 0d0, 0d0], one(3) = [1d0, 1d0, 1d0]
  type(pnpbs_context) :: context
  integer(c_int) :: stat
  character(len=300) :: errmsg

  call context%create_serial
  call about_the_plane
  call about_regions
  call about_cracks
  call about_a_box
  call about_a_surface
  call about_wrong_arguments
  call context%destroy
  call finish

contains

  !> Checks a mesh of the unit square with an inner curve, whose edges have triangles on both sides.
  subroutine about_the_plane
    type(pnpbs_domain) :: domain
    type(pnpbs_placement) :: placement
    type(pnpbs_mesh) :: mesh
    integer(c_int64_t) :: elements, facets
    call square(context, domain, placement, 0.15d0)
    call domain%add_polyline(PNPBS_INNER, .false., &
                             reshape([0.3d0, 0.3d0, 0.7d0, 0.3d0, 0.7d0, 0.6d0], [2, 3]), [8, 8])
    call placement%set('steps', 20)
    call placement%run
    call placement%triangle_count(elements)
    call placement%boundary_edge_count(facets)
    call mesh%create(placement)
    call look_at(placement, mesh, 2, 3, elements, facets)
    call placement%destroy
    call domain%destroy
    call look_at_elements(mesh, 1d0, 0)
    call look_at_facets(mesh, 1d0, inner_tag=8)
    call mesh%destroy
  end subroutine

  !> Checks a mesh of the unit square, which a line divides into two regions with tags.
  subroutine about_regions
    type(pnpbs_domain) :: domain
    type(pnpbs_placement) :: placement
    type(pnpbs_mesh) :: mesh
    integer(c_int64_t), allocatable :: triangles(:,:)
    integer(c_int32_t), allocatable :: tags(:), corners(:,:)
    real(c_double), allocatable :: x(:,:)
    integer(c_int64_t) :: nodes, elements, regions, counts(2)
    integer(c_int32_t) :: found(2), both(2, 2)
    real(c_double) :: areas(2)
    call square(context, domain, placement, 0.15d0)
    call domain%add_polyline(PNPBS_INNER, .false., reshape([0.5d0, 0d0, 0.5d0, 1d0], [2, 2]))
    call domain%add_region([0.2d0, 0.5d0], 3)
    call domain%add_region([0.8d0, 0.5d0], 7)
    call placement%set('steps', 20)
    call placement%run
    call placement%count(nodes)
    call placement%triangle_count(elements)
    allocate (x(2, nodes), triangles(3, elements), tags(elements + 1), corners(3, elements))
    call placement%get_nodes(x)
    call placement%get_triangles(triangles)
    tags = -7
    call placement%get_element_tags(tags)
    call expect(tags(elements + 1) == -7, 'room for tags that is not needed')
    call look_at_regions(x, triangles, tags(:elements))
    call placement%region_count(regions)
    call expect(regions == 2, 'number of regions')
    call placement%get_regions(found, elements=counts, measures=areas)
    call expect(all(found == [3, 7]), 'tags of regions')
    call expect(all(counts == [count(tags(:elements) == 3), count(tags(:elements) == 7)]), &
                'elements of regions')
    call expect(all(abs(areas - 0.5d0) < 1d-12), 'areas of regions')
    call domain%regions_at(reshape([0.2d0, 0.2d0, 0.8d0, 0.2d0], [2, 2]), found)
    call expect(all(found == [3, 7]), 'regions at points')
    call domain%regions_at(reshape([0.5d0, 0.2d0, 0.8d0, 0.2d0], [2, 2]), both)
    call expect(sum(both(:, 1)) == 10 .and. all(both(:, 2) == 7), 'regions at an interface')
    call placement%get_element_tags(tags(:elements - 1), stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_CAPACITY, errmsg, 'are needed')
    call placement%get_element_tags(tags(::2), stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'tags has gaps')

    call mesh%create(placement)
    call mesh%get_nodes(x)
    call mesh%get_elements(corners, tags=tags)
    call look_at_regions(x, int(corners, c_int64_t), tags(:elements))
    call mesh%destroy
    call placement%destroy

    call domain%add_region([0.2d0, 0.5d0], 0, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'tag')
    call domain%add_region([0.2d0, 0.5d0, 0d0], 3, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'point has an extent of 3; 2')
    call domain%add_region([0.2d0, 0.9d0], 4)
    call domain%check(stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_DOMAIN, errmsg, 'region 2 at (0.2, 0.9)')
    call domain%destroy
  end subroutine

  !> Checks a square that a crack cuts into two parts.
  subroutine about_cracks
    type(pnpbs_domain) :: domain
    type(pnpbs_placement) :: placement
    integer(c_int64_t), allocatable :: whole(:,:), opened(:,:), pairs(:), front(:,:), back(:,:)
    integer(c_int64_t), allocatable :: originals(:)
    integer(c_int32_t), allocatable :: tags(:)
    integer(c_int64_t) :: nodes, elements, copies, all_copies, facets, i
    call square(context, domain, placement, 0.15d0)
    call domain%add_polyline(PNPBS_INNER, .false., reshape([0.5d0, 0d0, 0.5d0, 1d0], [2, 2]), [7])
    call placement%set('steps', 20)
    call placement%run
    call placement%set_cracks([7])
    call placement%count(nodes)
    call placement%triangle_count(elements)
    call placement%crack_node_count(copies, all_copies)
    call placement%crack_facet_count(facets)
    call expect(copies == all_copies .and. copies == facets + 1, 'number of copies')
    allocate (whole(3, elements), opened(3, elements), pairs(copies), front(2, facets), &
              back(2, facets), tags(facets))
    call placement%get_triangles(whole)
    call placement%get_cracked_elements(opened)
    call placement%get_crack_nodes(pairs)
    call placement%get_crack_facets(front, back, tags)
    originals = [[(i, i=1, nodes)], pairs]
    call expect(all(reshape(originals([opened]), [3, int(elements)]) == whole), &
                'elements with copies')
    call expect(all(originals([front]) == originals([back])), 'sides of a crack')
    call expect(all(front <= nodes) .and. all(back > nodes) .and. all(tags == 7), 'copies behind')
    call placement%set_cracks([0], stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, '0')
    call placement%set_cracks([99])
    call placement%get_crack_nodes(pairs, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'tag 99')
    call placement%destroy
    call domain%destroy
  end subroutine

  !> Checks that triangles with the tag 3 fill the left half and those with the tag 7 the right
  !> half.
  subroutine look_at_regions(x, corners, tags)
    real(c_double), intent(in) :: x(:,:)
    integer(c_int64_t), intent(in) :: corners(:,:)
    integer(c_int32_t), intent(in) :: tags(:)
    real(c_double) :: areas(2), a(2), b(2)
    logical :: agree
    integer :: t, side
    areas = 0
    agree = .true.
    do t = 1, size(tags)
      side = merge(1, 2, sum(x(1, corners(:, t))) < 1.5d0)
      agree = agree .and. tags(t) == merge(3, 7, side == 1)
      a = x(:, corners(2, t)) - x(:, corners(1, t))
      b = x(:, corners(3, t)) - x(:, corners(1, t))
      areas(merge(1, 2, tags(t) == 3)) = areas(merge(1, 2, tags(t) == 3)) &
        + (a(1) * b(2) - a(2) * b(1)) / 2
    end do
    call expect(agree, 'tags of the regions on either side')
    call expect(maxval(abs(areas - 0.5d0)) < 1d-12, 'areas of the regions')
  end subroutine

  !> Checks a mesh of a box with a wall inside.
  subroutine about_a_box
    type(pnpbs_domain) :: domain
    type(pnpbs_placement) :: placement
    type(pnpbs_mesh) :: mesh
    integer(c_int64_t) :: elements, facets
    integer(c_int32_t), allocatable :: tags(:)
    real(c_double) :: wall(3, 4)
    wall = reshape([0.2d0, 0.2d0, 0.5d0, 0.8d0, 0.2d0, 0.5d0, 0.8d0, 0.8d0, 0.5d0, &
                    0.2d0, 0.8d0, 0.5d0], [3, 4])
    call domain%create(context, 3)
    call domain%add_box(zero, one, 5)
    call placement%create(context, domain)
    call placement%set('steps', 20)
    call placement%set_spacing_constant(0.3d0)
    call placement%run
    call placement%tetrahedron_count(elements)
    call placement%boundary_triangle_count(facets)
    call mesh%create(placement, 1)
    call look_at(placement, mesh, 3, 4, elements, facets)
    call look_at_elements(mesh, 1d0, 0)
    call look_at_facets(mesh, 1d0)
    call look_at_file(mesh, elements, facets)
    call mesh%destroy
    call placement%destroy

    call domain%add_surface(PNPBS_INNER, wall, &
                            reshape(int([1, 2, 3, 1, 3, 4], c_int64_t), [3, 2]), [9, 9])
    call domain%add_region([0.9d0, 0.9d0, 0.9d0], 4)
    call placement%create(context, domain)
    call placement%set('steps', 20)
    call placement%set_spacing_constant(0.25d0)
    call placement%run
    call placement%tetrahedron_count(elements)
    allocate (tags(elements))
    call placement%get_element_tags(tags)
    call expect(all(tags == 4), 'tags of tetrahedra')
    call mesh%create(placement, 0)
    call placement%destroy
    call domain%destroy
    call look_at_elements(mesh, 1d0, 4)
    call look_at_facets(mesh, 1d0, inner_tag=9)
    call mesh%destroy
  end subroutine

  !> Checks meshes of the surface of a box, which has no border, and of half of this surface, which
  !> has one.
  subroutine about_a_surface
    type(pnpbs_domain) :: domain
    type(pnpbs_placement) :: placement
    type(pnpbs_mesh) :: mesh
    integer(c_int64_t) :: elements, facets
    integer(c_int32_t), allocatable :: two(:,:)
    integer(c_int32_t) :: tags(1)
    call domain%create(context, 3)
    call domain%add_box(zero, one, 5)
    call domain%set_filled(.false.)
    call placement%create(context, domain)
    call placement%set('steps', 20)
    call placement%set_spacing_constant(0.3d0)
    call placement%run
    call placement%boundary_triangle_count(elements)
    call mesh%create(placement)
    call look_at(placement, mesh, 3, 3, elements, 0_c_int64_t)
    call look_at_elements(mesh, 6d0, 5)
    call placement%get_element_tags(tags, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'surfaces alone')
    call mesh%destroy
    call placement%destroy
    call domain%destroy

    call domain%create(context, 3)
    call domain%add_surface(PNPBS_BOUNDARY, reshape([zero, 1d0, 0d0, 0d0, 0d0, 1d0, 0d0], [3, 3]), &
                            reshape(int([1, 2, 3], c_int64_t), [3, 1]), [6])
    call domain%set_filled(.false.)
    call placement%create(context, domain)
    call placement%set('steps', 20)
    call placement%set_spacing_constant(0.3d0)
    call placement%run
    call mesh%create(placement)
    call placement%destroy
    call domain%destroy
    call look_at_elements(mesh, 0.5d0, 6)
    call mesh%sizes(facets=facets)
    allocate (two(2, facets))
    call mesh%get_facets(elements=two)
    call expect(facets > 5 .and. all(two(1, :) > 0) .and. all(two(2, :) == 0), 'a border')
    call mesh%destroy
  end subroutine

  !> Checks that the file of one rank has all elements and facets, numbered from 1.
  subroutine look_at_file(mesh, elements, facets)
    type(pnpbs_mesh), intent(in) :: mesh
    integer(c_int64_t), intent(in) :: elements, facets
    character(len=80) :: line
    integer(c_int64_t) :: sizes(4)
    integer, parameter :: unit = 30
    integer :: stat
    call mesh%write('fortran_mesh  ')
    open (unit, file='fortran_mesh_1.msh', status='old', action='read')
    sizes = 0
    do
      read (unit, '(a)', iostat=stat) line
      if (stat /= 0) exit
      if (line == '$Elements') read (unit, *) sizes
    end do
    close (unit, status='delete')
    call expect(sizes(2) == elements + facets .and. sizes(3) == 1 .and. sizes(4) == sizes(2), &
                'a file with all elements')
    call mesh%write(' ', stat)
    call expect(stat == PNPBS_ERROR_ARGUMENT, 'an empty prefix')
  end subroutine

  !> Checks sizes and numbers, and that nodes are those of the placement.
  subroutine look_at(placement, mesh, dim, corners, elements, facets)
    type(pnpbs_placement), intent(in) :: placement
    type(pnpbs_mesh), intent(in) :: mesh
    integer, intent(in) :: dim, corners
    integer(c_int64_t), intent(in) :: elements, facets
    type(pnpbs_mesh) :: same
    integer(c_int32_t) :: found(2)
    integer(c_int64_t) :: owned(2), here(2), sides, first(2), all(2), count, i, k
    real(c_double), allocatable :: x(:,:), y(:,:)
    integer(c_int64_t), allocatable :: numbers(:), ids(:), placed_ids(:)
    integer(c_int32_t), allocatable :: owners(:), tags(:), placed_tags(:)
    integer(c_int32_t) :: shared(0), ranks(0)
    integer(c_int64_t) :: offsets(1)
    logical :: agree
    call placement%count(count)
    call mesh%sizes(found(1), found(2), owned(1), here(1), owned(2), here(2), sides)
    call expect(found(1) == dim .and. found(2) == corners, 'dimension and corners')
    call expect(owned(1) == count .and. here(1) == count, 'nodes of one rank')
    call expect(owned(2) == elements .and. here(2) == elements, 'elements of one rank')
    call expect(sides == facets, 'facets of one rank')
    call mesh%numbering(first(1), all(1), first(2), all(2))
    call expect(first(1) == 0 .and. first(2) == 0, 'the first numbers')
    call expect(all(1) == count .and. all(2) == elements, 'how many there are')

    allocate (x(dim, count), y(dim, count), numbers(count), ids(count), placed_ids(count))
    allocate (owners(count), tags(count), placed_tags(count))
    call placement%get_nodes(y, placed_ids, placed_tags)
    call same%from_handle(mesh%handle())
    call same%get_nodes(x, numbers, ids, owners, tags)
    agree = .true.
    do i = 1, count
      agree = agree .and. numbers(i) == i - 1 .and. owners(i) == 0
      if (i > 1) agree = agree .and. ids(i) > ids(i - 1)
      do k = 1, count
        if (placed_ids(k) == ids(i)) exit
      end do
      if (k > count) then
        agree = .false.
        exit
      end if
      agree = agree .and. maxval(abs(x(:, i) - y(:, k))) == 0 .and. tags(i) == placed_tags(k)
    end do
    call expect(agree, 'nodes by id, numbered from 0')

    call mesh%sharing_sizes(owned(1), owned(2))
    call expect(owned(1) == 0 .and. owned(2) == 0, 'one rank shares nothing')
    call mesh%get_sharing(shared, offsets, ranks)
    call expect(offsets(1) == 1, 'offsets of nothing')
  end subroutine

  !> Checks that elements are oriented and fill the measure, and that numbers at their corners are
  !> those of the local indices.
  subroutine look_at_elements(mesh, measure, tag)
    type(pnpbs_mesh), intent(in) :: mesh
    real(c_double), intent(in) :: measure
    integer, intent(in) :: tag
    integer(c_int32_t) :: dim, corners
    integer(c_int64_t) :: nodes, elements, e
    real(c_double), allocatable :: x(:,:)
    integer(c_int32_t), allocatable :: at(:,:), owners(:), tags(:), short(:,:)
    integer(c_int64_t), allocatable :: numbers(:), of_nodes(:), long(:,:)
    real(c_double) :: least, filled, one_of_them
    logical :: agree
    call mesh%sizes(dim, corners, nodes=nodes, elements=elements)
    allocate (x(dim, nodes), of_nodes(nodes), at(corners, elements + 1), numbers(elements))
    allocate (owners(elements), tags(elements), short(corners, elements), long(corners, elements))
    call mesh%get_nodes(x, of_nodes)
    at = -7
    call mesh%get_elements(at)
    call mesh%get_elements(numbers=numbers, owners=owners, tags=tags)
    call expect(all(at(:, elements + 1) == -7), 'room that is not needed')
    call expect(all(numbers == [(e - 1, e = 1, elements)]), 'elements numbered from 0')
    call expect(all(owners == 0) .and. all(tags == tag), 'owners and tags of elements')
    call expect(minval(at(:, :elements)) == 1 .and. maxval(at) == nodes, 'indices from 1')
    call mesh%get_connectivity(long)
    call mesh%get_connectivity(short)
    agree = .true.
    filled = 0
    least = 1
    do e = 1, elements
      agree = agree .and. all(long(:, e) == of_nodes(at(:, e))) .and. all(long(:, e) == short(:, e))
      one_of_them = measure_of(x(:, at(:, e)))
      least = min(least, one_of_them)
      filled = filled + one_of_them
    end do
    call expect(agree, 'numbers at corners, in eight and four bytes')
    call expect(least > 0, 'elements turn rightly')
    call expect(abs(filled - measure) < 1d-12, 'elements fill the domain')
  end subroutine

  !> Checks that facets belong to their elements and that those of the boundary enclose the measure.
  !> inner_tag is the tag of inner facets, if there are any.
  subroutine look_at_facets(mesh, measure, inner_tag)
    type(pnpbs_mesh), intent(in) :: mesh
    real(c_double), intent(in) :: measure
    integer, intent(in), optional :: inner_tag
    integer(c_int32_t) :: dim, corners
    integer(c_int64_t) :: nodes, elements, facets, f
    real(c_double), allocatable :: x(:,:)
    integer(c_int32_t), allocatable :: at(:,:), of(:,:), tags(:), sides(:,:), opposite(:), owners(:)
    integer(c_int8_t), allocatable :: flags(:)
    logical, allocatable :: inner(:)
    real(c_double) :: enclosed
    logical :: agree(4)
    integer :: tag
    tag = -1
    if (present(inner_tag)) tag = inner_tag
    call mesh%sizes(dim, corners, nodes=nodes, elements=elements, facets=facets)
    allocate (x(dim, nodes), of(corners, elements), at(corners - 1, facets), tags(facets))
    allocate (sides(2, facets), opposite(facets), owners(facets), flags(facets), inner(facets))
    call mesh%get_nodes(x)
    call mesh%get_elements(of)
    call mesh%get_facets(at, tags, sides, opposite, inner, owners)
    call mesh%get_facets(inner=flags)
    call expect(all(inner .eqv. flags /= 0), 'inner facets as logicals')
    call expect(any(inner) .eqv. present(inner_tag), 'are there inner facets?')
    call expect(all(owners == 0), 'owners of facets')
    agree = .true.
    enclosed = 0
    do f = 1, facets
      associate (first => of(:, sides(1, f)))
        ! The facet must have all corners of the element except the opposite one.
        agree(1) = agree(1) .and. lies_at(at(:, f), first)
        agree(2) = agree(2) .and. .not. any(at(:, f) == first(opposite(f)))
      end associate
      agree(3) = agree(3) .and. (inner(f) .eqv. sides(2, f) > 0) .and. sides(2, f) >= 0
      agree(4) = agree(4) .and. (inner(f) .eqv. tags(f) == tag)
      if (inner(f)) then
        agree(1) = agree(1) .and. lies_at(at(:, f), of(:, sides(2, f)))
      else
        enclosed = enclosed + cone_of(x(:, at(:, f)))
      end if
    end do
    call expect(agree(1), 'facets at their elements')
    call expect(agree(2), 'the corner opposite to a facet')
    call expect(agree(3), 'elements on both sides of inner facets alone')
    call expect(agree(4), 'tags of facets')
    call expect(abs(enclosed - measure) < 1d-12, 'facets turn rightly')
  end subroutine

  !> Returns whether all corners of a facet are corners of an element.
  function lies_at(facet, element)
    integer(c_int32_t), intent(in) :: facet(:), element(:)
    logical :: lies_at
    integer :: k
    lies_at = all([(any(element == facet(k)), k = 1, size(facet))])
  end function

  !> Returns the measure of a simplex. It has a sign except for a triangle in space.
  function measure_of(x) result(measure)
    real(c_double), intent(in) :: x(:,:)
    real(c_double) :: measure
    if (size(x, 1) == 2) then
      measure = (x(1, 2) - x(1, 1)) * (x(2, 3) - x(2, 1)) / 2 &
        - (x(2, 2) - x(2, 1)) * (x(1, 3) - x(1, 1)) / 2
    else if (size(x, 2) == 3) then
      measure = sqrt(sum(product_of(x(:, 2) - x(:, 1), x(:, 3) - x(:, 1))**2)) / 2
    else
      measure = sum(product_of(x(:, 2) - x(:, 1), x(:, 3) - x(:, 1)) * (x(:, 4) - x(:, 1))) / 6
    end if
  end function

  !> Returns the measure of the simplex of a facet and the origin.
  function cone_of(x) result(measure)
    real(c_double), intent(in) :: x(:,:)
    real(c_double) :: measure
    if (size(x, 1) == 2) then
      measure = (x(1, 1) * x(2, 2) - x(2, 1) * x(1, 2)) / 2
    else
      measure = sum(product_of(x(:, 1), x(:, 2)) * x(:, 3)) / 6
    end if
  end function

  function product_of(a, b) result(c)
    real(c_double), intent(in) :: a(3), b(3)
    real(c_double) :: c(3)
    c = [a(2) * b(3) - a(3) * b(2), a(3) * b(1) - a(1) * b(3), a(1) * b(2) - a(2) * b(1)]
  end function

  subroutine about_wrong_arguments
    type(pnpbs_domain) :: domain
    type(pnpbs_placement) :: placement
    type(pnpbs_mesh) :: mesh
    integer(c_int32_t), allocatable :: four(:,:)
    integer(c_int64_t), allocatable :: long(:,:)
    real(c_double), allocatable :: x(:,:)
    integer(c_int64_t) :: nodes, elements, facets, offsets(0), numbers(1)
    integer(c_int32_t) :: shared(0), ranks(0), dim
    logical :: inner(1)
    call square(context, domain, placement, 0.3d0)
    call mesh%create(placement, stat=stat)
    call expect(stat == PNPBS_ERROR_STATE .and. mesh%handle() == 0, 'no mesh without nodes')
    call placement%initialise
    call mesh%create(placement, -1, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'ghost_layers = -1')
    call mesh%create(placement, 17, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'ghost_layers = 17')
    call expect(mesh%handle() == 0, 'no mesh after an error')
    call mesh%destroy(stat)
    call expect(stat == PNPBS_OK, 'destroying none')
    call mesh%create(placement, 16)
    call mesh%sizes(nodes=nodes, elements=elements, facets=facets)
    allocate (x(3, nodes), four(4, elements), long(2, elements))
    call mesh%get_nodes(x, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'has an extent of 3; 2')
    call mesh%get_nodes(x(:2, :), stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'coordinates has gaps in memory')
    call mesh%get_nodes(numbers=numbers, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_CAPACITY, errmsg, 'are needed')
    call mesh%get_nodes(stat=stat)
    call expect(stat == PNPBS_OK, 'asking for nothing')
    call mesh%get_elements(four, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'nodes has an extent of 4; 3')
    call mesh%get_elements(four(:3, :), stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'nodes has gaps in memory')
    call mesh%get_elements(numbers=numbers, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_CAPACITY, errmsg, 'are needed')
    call mesh%get_connectivity(long, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'numbers has an extent of 2; 3')
    call mesh%get_connectivity(four(:3, 2:), stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_CAPACITY, errmsg, 'are needed')
    call mesh%get_facets(elements=four(:, :facets), stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_ARGUMENT, errmsg, 'elements has an extent of 4; 2')
    call mesh%get_facets(inner=inner, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_CAPACITY, errmsg, 'are needed')
    call mesh%get_sharing(shared, offsets, ranks, stat, errmsg)
    call expect_failure(stat, PNPBS_ERROR_CAPACITY, errmsg, 'offsets has room for 0; 1')

    call placement%destroy
    call domain%destroy
    call mesh%sizes(dim)
    call expect(dim == 2, 'a mesh outlives its placement')
    call mesh%destroy
    call mesh%sizes(dim, stat=stat, errmsg=errmsg)
    call expect_failure(stat, PNPBS_ERROR_HANDLE, errmsg, 'mesh')
    call expect(dim == 0, 'no sizes of a dead mesh')
    call mesh%get_nodes(x, stat=stat)
    call expect(stat == PNPBS_ERROR_HANDLE, 'a dead mesh, whatever the array')
    call mesh%get_connectivity(long, stat)
    call expect(stat == PNPBS_ERROR_HANDLE, 'a dead mesh, whatever the numbers')
    call mesh%get_sharing(shared, offsets, ranks, stat)
    call expect(stat == PNPBS_ERROR_HANDLE, 'a dead mesh, whatever is shared')
  end subroutine
end program test_mesh
