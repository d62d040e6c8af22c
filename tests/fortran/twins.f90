! SPDX-License-Identifier: BSD-3-Clause
!> Compares results of the Fortran module with those of the C interface (twin.c).
module twins
  use, intrinsic :: iso_c_binding
  use pnpbs
  use expectations
  implicit none
  private
  public :: compare_with_c, twin_segments

  interface
    function twin_nodes(handle, n, xyz, ids, tags, d) bind(C)
      import
      implicit none
      integer(c_int64_t), value :: handle, n
      real(c_double), intent(in) :: xyz(*), d(*)
      integer(c_int64_t), intent(in) :: ids(*)
      integer(c_int32_t), intent(in) :: tags(*)
      integer(c_int64_t) :: twin_nodes
    end function

    function twin_ghosts(handle, n, xyz, ids, tags, d, owners, numbers) bind(C)
      import
      implicit none
      integer(c_int64_t), value :: handle, n
      real(c_double), intent(in) :: xyz(*), d(*)
      integer(c_int64_t), intent(in) :: ids(*), numbers(*)
      integer(c_int32_t), intent(in) :: tags(*), owners(*)
      integer(c_int64_t) :: twin_ghosts
    end function

    function twin_lists(handle, stars, nodes, offsets, neighbours, triangle) bind(C)
      import
      implicit none
      integer(c_int64_t), value :: handle, nodes
      integer(c_int32_t), value :: stars
      integer(c_int64_t), intent(in) :: offsets(*), neighbours(*)
      integer(c_int8_t), intent(in) :: triangle(*)
      integer(c_int64_t) :: twin_lists
    end function

    function twin_triangles(handle, n, triangles) bind(C)
      import
      implicit none
      integer(c_int64_t), value :: handle, n
      integer(c_int64_t), intent(in) :: triangles(*)
      integer(c_int64_t) :: twin_triangles
    end function

    function twin_edges(handle, n, edges, tags) bind(C)
      import
      implicit none
      integer(c_int64_t), value :: handle, n
      integer(c_int64_t), intent(in) :: edges(*)
      integer(c_int32_t), intent(in) :: tags(*)
      integer(c_int64_t) :: twin_edges
    end function

    function twin_tetrahedra(handle, n, tetrahedra) bind(C)
      import
      implicit none
      integer(c_int64_t), value :: handle, n
      integer(c_int64_t), intent(in) :: tetrahedra(*)
      integer(c_int64_t) :: twin_tetrahedra
    end function

    function twin_incident_elements(handle, n, corners, elements) bind(C)
      import
      implicit none
      integer(c_int64_t), value :: handle, n
      integer(c_int32_t), value :: corners
      integer(c_int64_t), intent(in) :: elements(*)
      integer(c_int64_t) :: twin_incident_elements
    end function

    function twin_boundary_triangles(handle, n, triangles, tags) bind(C)
      import
      implicit none
      integer(c_int64_t), value :: handle, n
      integer(c_int64_t), intent(in) :: triangles(*)
      integer(c_int32_t), intent(in) :: tags(*)
      integer(c_int64_t) :: twin_boundary_triangles
    end function

    function twin_exchange(handle, neighbours, ranks, send_offsets, send_nodes, receive_offsets, &
                           receive_nodes) bind(C)
      import
      implicit none
      integer(c_int64_t), value :: handle
      integer(c_int32_t), value :: neighbours
      integer(c_int32_t), intent(in) :: ranks(*)
      integer(c_int64_t), intent(in) :: send_offsets(*), send_nodes(*), receive_offsets(*)
      integer(c_int64_t), intent(in) :: receive_nodes(*)
      integer(c_int64_t) :: twin_exchange
    end function

    function twin_mesh_nodes(handle, n, xyz, numbers, ids, owners, tags) bind(C)
      import
      implicit none
      integer(c_int64_t), value :: handle, n
      real(c_double), intent(in) :: xyz(*)
      integer(c_int64_t), intent(in) :: numbers(*), ids(*)
      integer(c_int32_t), intent(in) :: owners(*), tags(*)
      integer(c_int64_t) :: twin_mesh_nodes
    end function

    function twin_mesh_elements(handle, n, nodes, numbers, owners, tags, at_corners) bind(C)
      import
      implicit none
      integer(c_int64_t), value :: handle, n
      integer(c_int32_t), intent(in) :: nodes(*), owners(*), tags(*)
      integer(c_int64_t), intent(in) :: numbers(*), at_corners(*)
      integer(c_int64_t) :: twin_mesh_elements
    end function

    function twin_mesh_facets(handle, n, nodes, tags, elements, opposite, inner, owners) bind(C)
      import
      implicit none
      integer(c_int64_t), value :: handle, n
      integer(c_int32_t), intent(in) :: nodes(*), tags(*), elements(*), opposite(*), owners(*)
      integer(c_int8_t), intent(in) :: inner(*)
      integer(c_int64_t) :: twin_mesh_facets
    end function

    function twin_mesh_sharing(handle, nodes, entries, shared, offsets, ranks) bind(C)
      import
      implicit none
      integer(c_int64_t), value :: handle, nodes, entries
      integer(c_int32_t), intent(in) :: shared(*), ranks(*)
      integer(c_int64_t), intent(in) :: offsets(*)
      integer(c_int64_t) :: twin_mesh_sharing
    end function

    function twin_segments(handle, n, segments, tags) bind(C)
      import
      implicit none
      integer(c_int64_t), value :: handle, n
      real(c_double), intent(in) :: segments(*)
      integer(c_int32_t), intent(in) :: tags(*)
      integer(c_int64_t) :: twin_segments
    end function
  end interface

contains

  !> Extracts all results and compares them with those of the C interface. Collective.
  subroutine compare_with_c(placement)
    type(pnpbs_placement), intent(in) :: placement
    integer(c_int32_t) :: dim
    call placement%dimension(dim)
    call compare_nodes(placement)
    call compare_ghosts(placement)
    call compare_lists(placement)
    if (dim == 2) call compare_elements(placement)
    if (dim == 3) call compare_elements_in_space(placement)
    call compare_exchange(placement)
    call compare_assembly(placement)
    call compare_edges(placement)
    call compare_mesh(placement)
  end subroutine

  subroutine compare_nodes(placement)
    type(pnpbs_placement), intent(in) :: placement
    real(c_double), allocatable :: xyz(:,:), d(:)
    integer(c_int64_t), allocatable :: ids(:)
    integer(c_int32_t), allocatable :: tags(:)
    integer(c_int64_t) :: n
    integer(c_int32_t) :: dim
    call placement%count(n)
    call placement%dimension(dim)
    allocate (xyz(dim, n), ids(n), tags(n), d(n))
    call placement%get_nodes(xyz, ids, tags, d)
    call expect(twin_nodes(placement%handle(), n, xyz, ids, tags, d) == 0, 'nodes as in C')
    ! Each array is extracted alone. Arrays may be larger than needed, and the rest must not change.
    deallocate (ids)
    allocate (ids(n + 2))
    ids = -7
    xyz = 0
    call placement%get_nodes(ids=ids)
    call expect(all(ids(n + 1:) == -7), 'room that is not needed')
    call placement%get_nodes(coordinates=xyz)
    call expect(twin_nodes(placement%handle(), n, xyz, ids, tags, d) == 0, 'nodes one by one')
  end subroutine

  subroutine compare_ghosts(placement)
    type(pnpbs_placement), intent(in) :: placement
    real(c_double), allocatable :: xyz(:,:), d(:)
    integer(c_int64_t), allocatable :: ids(:), numbers(:)
    integer(c_int32_t), allocatable :: tags(:), owners(:)
    integer(c_int64_t) :: ghosts, nodes, first, mine
    integer(c_int32_t) :: dim
    call placement%count(nodes)
    call placement%ghost_count(ghosts)
    call placement%dimension(dim)
    allocate (xyz(dim, ghosts), ids(ghosts), tags(ghosts), d(ghosts), owners(ghosts))
    allocate (numbers(ghosts))
    call placement%get_ghosts(xyz, ids, tags, d, owners)
    call placement%get_numbering(first, mine, numbers)
    call expect(first >= 0 .and. mine == nodes, 'numbering')
    call expect(twin_ghosts(placement%handle(), ghosts, xyz, ids, tags, d, owners, numbers) == 0, &
                'ghosts as in C')
  end subroutine

  subroutine compare_lists(placement)
    type(pnpbs_placement), intent(in) :: placement
    integer(c_int64_t), allocatable :: offsets(:), neighbours(:), star_neighbours(:)
    integer(c_int8_t), allocatable :: triangle(:)
    logical, allocatable :: closed(:)
    integer(c_int64_t) :: nodes, entries
    call placement%count(nodes)
    allocate (offsets(nodes + 1))
    call placement%adjacency_size(entries)
    allocate (neighbours(entries), triangle(0))
    call placement%get_adjacency(offsets, neighbours)
    call expect(twin_lists(placement%handle(), 0, nodes, offsets, neighbours, triangle) == 0, &
                'adjacency as in C')
    deallocate (triangle)
    call placement%star_size(entries)
    allocate (star_neighbours(entries), triangle(entries))
    call placement%get_stars(offsets, star_neighbours)
    call placement%get_stars(offsets, star_neighbours, triangle)
    call expect(twin_lists(placement%handle(), 1, nodes, offsets, star_neighbours, triangle) == 0, &
                'stars as in C')
    allocate (closed(entries))
    call placement%get_stars(offsets, star_neighbours, closed)
    call expect(all(closed .eqv. triangle /= 0), 'triangles of stars as logicals')
  end subroutine

  subroutine compare_elements(placement)
    type(pnpbs_placement), intent(in) :: placement
    integer(c_int64_t), allocatable :: triangles(:,:), edges(:,:)
    integer(c_int32_t), allocatable :: tags(:)
    integer(c_int64_t) :: count
    call placement%triangle_count(count)
    allocate (triangles(3, count))
    call placement%get_triangles(triangles)
    call expect(twin_triangles(placement%handle(), count, triangles) == 0, 'triangles as in C')
    call placement%boundary_edge_count(count)
    allocate (edges(2, count), tags(count))
    call placement%get_boundary_edges(edges)
    call placement%get_boundary_edges(tags=tags)
    call expect(twin_edges(placement%handle(), count, edges, tags) == 0, 'boundary edges as in C')
  end subroutine

  subroutine compare_elements_in_space(placement)
    type(pnpbs_placement), intent(in) :: placement
    integer(c_int64_t), allocatable :: tetrahedra(:,:), triangles(:,:)
    integer(c_int32_t), allocatable :: tags(:)
    integer(c_int64_t) :: count
    call placement%tetrahedron_count(count)
    allocate (tetrahedra(4, count))
    call placement%get_tetrahedra(tetrahedra)
    call expect(twin_tetrahedra(placement%handle(), count, tetrahedra) == 0, 'tetrahedra as in C')
    call placement%boundary_triangle_count(count)
    allocate (triangles(3, count), tags(count))
    call placement%get_boundary_triangles(triangles)
    call placement%get_boundary_triangles(tags=tags)
    call expect(twin_boundary_triangles(placement%handle(), count, triangles, tags) == 0, &
                'boundary triangles as in C')
  end subroutine

  !> Checks sums at nodes: each rank counts its own elements at their corners. The sums with the
  !> counts at ghosts must be the numbers of all elements around the nodes.
  subroutine compare_assembly(placement)
    type(pnpbs_placement), intent(in) :: placement
    integer(c_int64_t), allocatable :: elements(:,:)
    real(c_double), allocatable :: around(:), sums(:), both(:,:)
    integer(c_int64_t) :: count, owned, ghosts, e
    integer(c_int32_t) :: dim, corners
    call placement%dimension(dim)
    call placement%incident_element_count(count, corners)
    call expect(corners == dim + 1, 'corners of an element')
    allocate (elements(corners, count))
    call placement%get_incident_elements(elements)
    call expect(twin_incident_elements(placement%handle(), count, corners, elements) == 0, &
                'incident elements as in C')
    call placement%count(owned)
    call placement%ghost_count(ghosts)
    allocate (around(owned + ghosts), sums(owned + ghosts), both(2, owned + ghosts))
    around = 0
    sums = 0
    do e = 1, count
      around(elements(:, e)) = around(elements(:, e)) + 1
      if (elements(1, e) <= owned) sums(elements(:, e)) = sums(elements(:, e)) + 1
    end do
    both(1, :) = sums
    both(2, :) = 2 * sums
    call placement%add_from_ghosts(sums)
    call expect(all(sums(:owned) == around(:owned)), 'counts from ghosts')
    call expect(all(sums(owned + 1:) == both(1, owned + 1:)), 'ghosts keep their values')
    call placement%add_from_ghosts(both)
    call expect(all(both(1, :) == sums .and. both(2, :) == 2 * sums), 'two components from ghosts')
  end subroutine

  !> Checks that the edges of elements join their corners, and that mid nodes in the plane and in
  !> bodies are near the middles of the ends.
  subroutine compare_edges(placement)
    type(pnpbs_placement), intent(in) :: placement
    integer(c_int64_t), allocatable :: elements(:,:), of_elements(:,:), ends(:,:), numbers(:)
    real(c_double), allocatable :: x(:,:), ghosts_x(:,:), middles(:,:), apart(:)
    integer(c_int64_t) :: count, straight, edges, owned, ghosts, t, e
    integer(c_int32_t) :: dim, corners
    integer :: k, wrong
    integer, parameter :: pair(2, 6) = reshape([1, 2, 2, 3, 1, 3, 1, 4, 2, 4, 3, 4], [2, 6])
    call placement%dimension(dim)
    call placement%incident_element_count(count, corners)
    call placement%edge_count(edges, straight)
    call placement%count(owned)
    call placement%ghost_count(ghosts)
    allocate (elements(corners, count), of_elements(corners * (corners - 1) / 2, count))
    allocate (ends(2, edges), numbers(edges), middles(dim, edges), apart(dim))
    allocate (x(dim, owned + ghosts), ghosts_x(dim, ghosts))
    call placement%get_nodes(x)
    call placement%get_ghosts(ghosts_x)
    x(:, owned + 1:) = ghosts_x
    call placement%get_incident_elements(elements)
    call placement%get_edges(ends, numbers, middles)
    call placement%find_edges(elements, of_elements)
    wrong = 0
    do t = 1, count
      do k = 1, size(of_elements, 1)
        e = of_elements(k, t)
        if (e == 0) then  ! only elements of other ranks
          if (elements(1, t) <= owned) wrong = wrong + 1
        else if (any(ends(:, e) /= [minval(elements(pair(:, k), t)), &
                                    maxval(elements(pair(:, k), t))])) then
          wrong = wrong + 1
        end if
      end do
    end do
    call expect(wrong == 0 .and. straight >= 0, 'edges join corners of elements')
    wrong = 0
    do e = 1, edges
      apart = x(:, ends(1, e)) - x(:, ends(2, e))
      if (sum((middles(:, e) - 0.5_c_double * (x(:, ends(1, e)) + x(:, ends(2, e))))**2) > &
          0.1_c_double * sum(apart**2)) wrong = wrong + 1
    end do
    call expect(wrong == 0 .and. minval(numbers) >= 0, 'mid nodes are on their edges')
    call expect(edges > 0, 'there are edges')
  end subroutine

  subroutine compare_exchange(placement)
    type(pnpbs_placement), intent(in) :: placement
    integer(c_int32_t), allocatable :: ranks(:)
    integer(c_int64_t), allocatable :: send_offsets(:), send_nodes(:)
    integer(c_int64_t), allocatable :: receive_offsets(:), receive_nodes(:)
    integer(c_int32_t) :: neighbours
    integer(c_int64_t) :: sends, receives
    call placement%exchange_sizes(neighbours, sends, receives)
    allocate (ranks(neighbours), send_offsets(neighbours + 1), send_nodes(sends))
    allocate (receive_offsets(neighbours + 1), receive_nodes(receives))
    call placement%get_exchange(ranks, send_offsets, send_nodes, receive_offsets, receive_nodes)
    call expect(twin_exchange(placement%handle(), neighbours, ranks, send_offsets, send_nodes, &
                              receive_offsets, receive_nodes) == 0, 'exchange as in C')
  end subroutine

  subroutine compare_mesh(placement)
    type(pnpbs_placement), intent(in) :: placement
    type(pnpbs_mesh) :: mesh
    integer(c_int32_t) :: layers
    integer(c_int64_t) :: count, begin, owned, here, first, numbered
    call placement%count(count)
    call placement%get_numbering(begin)
    do layers = 0, 1
      call mesh%create(placement, layers)
      call mesh%sizes(owned_nodes=owned, nodes=here)
      call mesh%numbering(first, numbered)
      call expect(owned == count .and. first == begin, 'a mesh has the nodes of the placement')
      call expect(here >= owned .and. first + owned <= numbered, 'nodes of a mesh')
      call compare_mesh_nodes(mesh)
      call compare_mesh_elements(mesh)
      call compare_mesh_facets(mesh)
      call compare_mesh_sharing(mesh)
      call mesh%destroy
    end do
  end subroutine

  subroutine compare_mesh_nodes(mesh)
    type(pnpbs_mesh), intent(in) :: mesh
    real(c_double), allocatable :: xyz(:,:)
    integer(c_int64_t), allocatable :: numbers(:), ids(:)
    integer(c_int32_t), allocatable :: owners(:), tags(:)
    integer(c_int64_t) :: n
    integer(c_int32_t) :: dim
    call mesh%sizes(dim, nodes=n)
    allocate (xyz(dim, n), numbers(n), ids(n), owners(n), tags(n))
    call mesh%get_nodes(xyz, numbers, ids, owners, tags)
    call expect(twin_mesh_nodes(mesh%handle(), n, xyz, numbers, ids, owners, tags) == 0, &
                'nodes of a mesh as in C')
  end subroutine

  subroutine compare_mesh_elements(mesh)
    type(pnpbs_mesh), intent(in) :: mesh
    integer(c_int32_t), allocatable :: nodes(:,:), owners(:), tags(:), short(:,:)
    integer(c_int64_t), allocatable :: numbers(:), long(:,:)
    integer(c_int64_t) :: n
    integer(c_int32_t) :: corners
    call mesh%sizes(corners=corners, elements=n)
    allocate (nodes(corners, n), numbers(n), owners(n), tags(n))
    allocate (long(corners, n), short(corners, n))
    call mesh%get_elements(nodes, numbers, owners, tags)
    call mesh%get_connectivity(long)
    call mesh%get_connectivity(short)
    call expect(all(short == long), 'numbers at corners in four bytes')
    call expect(twin_mesh_elements(mesh%handle(), n, nodes, numbers, owners, tags, long) == 0, &
                'elements of a mesh as in C')
  end subroutine

  subroutine compare_mesh_facets(mesh)
    type(pnpbs_mesh), intent(in) :: mesh
    integer(c_int32_t), allocatable :: nodes(:,:), tags(:), elements(:,:), opposite(:), owners(:)
    integer(c_int8_t), allocatable :: inner(:)
    integer(c_int64_t) :: n
    integer(c_int32_t) :: corners
    call mesh%sizes(corners=corners, facets=n)
    allocate (nodes(corners - 1, n), tags(n), elements(2, n), opposite(n), inner(n), owners(n))
    call mesh%get_facets(nodes, tags, elements, opposite, inner, owners)
    call expect(twin_mesh_facets(mesh%handle(), n, nodes, tags, elements, opposite, inner, &
                                 owners) == 0, 'facets as in C')
  end subroutine

  subroutine compare_mesh_sharing(mesh)
    type(pnpbs_mesh), intent(in) :: mesh
    integer(c_int32_t), allocatable :: shared(:), ranks(:)
    integer(c_int64_t), allocatable :: offsets(:)
    integer(c_int64_t) :: nodes, entries
    call mesh%sharing_sizes(nodes, entries)
    allocate (shared(nodes), offsets(nodes + 1), ranks(entries))
    call mesh%get_sharing(shared, offsets, ranks)
    call expect(twin_mesh_sharing(mesh%handle(), nodes, entries, shared, offsets, ranks) == 0, &
                'shared nodes as in C')
  end subroutine
end module twins
