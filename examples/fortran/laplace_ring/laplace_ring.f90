! SPDX-License-Identifier: BSD-3-Clause
!
! A finite element solver on the library's nodes, over the ranks of an MPI program. It solves
! -Laplace u = 0 in the ring 0.5 <= r <= 1 with u = log r on both circles; the solution is log r
! everywhere. The row of a node follows from the triangles of its Delaunay star alone, so every
! rank assembles the rows of its own nodes without a mesh file and without messages.
! examples/c/laplace_ring is the same program in C and explains the expected results.
!
!   mpirun -np 4 ./laplace_ring [FOLDER]
!
! If a folder is given, every rank writes its piece of the solution into it; the folder must exist.
module ring
  use, intrinsic :: iso_c_binding, only: c_double, c_int8_t, c_int32_t, c_int64_t
  use, intrinsic :: iso_fortran_env, only: error_unit
  use mpi
  use pnpbs
  implicit none

  real(c_double), parameter :: pi = 3.14159265358979323846d0
  real(c_double), parameter :: inner_radius = 0.5d0, outer_radius = 1, d = 0.03d0
  integer(c_int32_t), parameter :: inner_circle = 1, outer_circle = 2

  ! The mesh of this rank. Arrays over `all` hold the owned nodes first, then the ghosts, which are
  ! nearby nodes that other ranks own.
  type :: mesh
    integer :: comm
    integer(c_int64_t) :: owned, all                ! all = owned + ghosts
    real(c_double), allocatable :: xy(:,:)          ! (2, all)
    integer(c_int32_t), allocatable :: tags(:)      ! (all)
    integer(c_int64_t) :: triangles
    integer(c_int64_t), allocatable :: corners(:,:) ! (3, triangles)
  end type

  ! The halo exchange pattern of get_exchange, with message buffers.
  type :: exchange
    integer(c_int32_t) :: neighbours
    integer(c_int32_t), allocatable :: ranks(:)
    integer(c_int64_t), allocatable :: send_offsets(:), send_nodes(:)
    integer(c_int64_t), allocatable :: receive_offsets(:), receive_nodes(:)
    real(c_double), allocatable :: sent(:), received(:)
    integer, allocatable :: requests(:)
  end type

  ! The matrix rows of the owned nodes. Row i has a diagonal entry and one entry for each node of
  ! the star of node i, at offsets(i) .. offsets(i + 1) - 1.
  type :: matrix
    integer(c_int64_t), allocatable :: offsets(:), columns(:)
    real(c_double), allocatable :: diagonal(:), values(:)
  end type

contains

  pure function known_solution(x)
    real(c_double), intent(in) :: x(2)
    real(c_double) :: known_solution
    known_solution = log(sqrt(sum(x**2)))
  end function

  ! -------------------------------------------------------------- from the library -------------

  subroutine get_mesh(p, m)
    type(pnpbs_placement), intent(in) :: p
    type(mesh), intent(inout) :: m
    integer(c_int64_t) :: ghosts
    call p%count(m%owned)
    call p%ghost_count(ghosts)
    m%all = m%owned + ghosts
    allocate (m%xy(2, m%all), m%tags(m%all))
    call p%get_nodes(m%xy(:, :m%owned), tags=m%tags(:m%owned))
    call p%get_ghosts(m%xy(:, m%owned + 1:), tags=m%tags(m%owned + 1:))
    call p%triangle_count(m%triangles)
    allocate (m%corners(3, m%triangles))
    call p%get_triangles(m%corners)
  end subroutine

  subroutine get_exchange(p, e)
    type(pnpbs_placement), intent(in) :: p
    type(exchange), intent(inout) :: e
    integer(c_int64_t) :: sends, receives
    call p%exchange_sizes(e%neighbours, sends, receives)
    allocate (e%ranks(e%neighbours))
    allocate (e%send_offsets(e%neighbours + 1), e%send_nodes(sends))
    allocate (e%receive_offsets(e%neighbours + 1), e%receive_nodes(receives))
    call p%get_exchange(e%ranks, e%send_offsets, e%send_nodes, e%receive_offsets, e%receive_nodes)
    allocate (e%sent(sends), e%received(receives), e%requests(2 * e%neighbours))
  end subroutine

  ! Returns the cotangent of the angle at a in the counter-clockwise triangle a, b, c.
  pure function cotangent(a, b, c)
    real(c_double), intent(in) :: a(2), b(2), c(2)
    real(c_double) :: cotangent, ab(2), ac(2)
    ab = b - a
    ac = c - a
    cotangent = dot_product(ab, ac) / (ab(1) * ac(2) - ab(2) * ac(1))
  end function

  ! Assembles the rows of the owned nodes from their Delaunay stars. For linear elements the
  ! integral of grad phi_i . grad phi_j over a triangle is -1/2 times the cotangent of the angle
  ! opposite to the edge ij, and every row sums to zero. Collective.
  subroutine assemble(p, m, a)
    type(pnpbs_placement), intent(in) :: p
    type(mesh), intent(in) :: m
    type(matrix), intent(inout) :: a
    integer(c_int64_t) :: entries, i, k, next
    integer(c_int8_t), allocatable :: triangle(:)
    real(c_double) :: xi(2), xk(2), xn(2)
    call p%star_size(entries)
    allocate (a%offsets(m%owned + 1), a%columns(entries), triangle(entries))
    allocate (a%diagonal(m%owned), a%values(entries))
    call p%get_stars(a%offsets, a%columns, triangle)
    a%diagonal = 0
    a%values = 0
    do i = 1, m%owned
      do k = a%offsets(i), a%offsets(i + 1) - 1
        next = k + 1
        if (next == a%offsets(i + 1)) next = a%offsets(i)
        if (triangle(k) == 0) cycle ! a gap outside the domain
        xi = m%xy(:, i)
        xk = m%xy(:, a%columns(k))
        xn = m%xy(:, a%columns(next))
        a%values(k) = a%values(k) - cotangent(xn, xi, xk) / 2
        a%values(next) = a%values(next) - cotangent(xk, xn, xi) / 2
        a%diagonal(i) = a%diagonal(i) + (cotangent(xn, xi, xk) + cotangent(xk, xn, xi)) / 2
      end do
    end do
  end subroutine

  ! -------------------------------------------------------------- the solver -------------------

  function sum_over_ranks(m, part)
    type(mesh), intent(in) :: m
    real(c_double), intent(in) :: part
    real(c_double) :: sum_over_ranks
    integer :: ierror
    call MPI_Allreduce(part, sum_over_ranks, 1, MPI_DOUBLE_PRECISION, MPI_SUM, m%comm, ierror)
  end function

  function dot(m, x, y)
    type(mesh), intent(in) :: m
    real(c_double), intent(in) :: x(:), y(:)
    real(c_double) :: dot
    dot = sum_over_ranks(m, dot_product(x(:m%owned), y(:m%owned)))
  end function

  ! Copies the values at nodes to their ghosts on other ranks. Collective.
  subroutine update_ghosts(m, e, x)
    type(mesh), intent(in) :: m
    type(exchange), intent(inout), asynchronous :: e ! asynchronous: MPI_Waitall fills its buffer
    real(c_double), intent(inout) :: x(:)
    integer :: k, n, first, ierror
    do k = 1, e%neighbours
      first = int(e%receive_offsets(k))
      n = int(e%receive_offsets(k + 1)) - first
      call MPI_Irecv(e%received(first:), n, MPI_DOUBLE_PRECISION, e%ranks(k), 0, m%comm, &
                     e%requests(k), ierror)
    end do
    e%sent = x(e%send_nodes)
    do k = 1, e%neighbours
      first = int(e%send_offsets(k))
      n = int(e%send_offsets(k + 1)) - first
      call MPI_Isend(e%sent(first:), n, MPI_DOUBLE_PRECISION, e%ranks(k), 0, m%comm, &
                     e%requests(e%neighbours + k), ierror)
    end do
    call MPI_Waitall(size(e%requests), e%requests, MPI_STATUSES_IGNORE, ierror)
    x(e%receive_nodes) = e%received
  end subroutine

  ! Computes y = A x at the owned nodes. Updates the ghosts of x first. Collective.
  subroutine multiply(m, e, a, x, y)
    type(mesh), intent(in) :: m
    type(exchange), intent(inout) :: e
    type(matrix), intent(in) :: a
    real(c_double), intent(inout) :: x(:)
    real(c_double), intent(out) :: y(:)
    integer(c_int64_t) :: i, k
    call update_ghosts(m, e, x)
    do i = 1, m%owned
      y(i) = a%diagonal(i) * x(i)
      do k = a%offsets(i), a%offsets(i + 1) - 1
        y(i) = y(i) + a%values(k) * x(a%columns(k))
      end do
    end do
  end subroutine

  ! Solves A u = 0 at the inner nodes by conjugate gradients. Values of u on the boundary do not
  ! change, because the residual is set to zero there. Collective.
  subroutine solve(m, e, a, u)
    type(mesh), intent(in) :: m
    type(exchange), intent(inout) :: e
    type(matrix), intent(in) :: a
    real(c_double), intent(inout) :: u(:)
    real(c_double) :: r(m%owned), q(m%owned), p(m%all), rr, rr_before, enough, alpha
    integer(c_int64_t) :: n
    integer :: steps, ierror
    n = m%owned
    steps = 0
    call multiply(m, e, a, u, q)
    r = merge(0d0, -q, m%tags(:n) /= 0)
    p = 0
    p(:n) = r
    rr = dot(m, r, r)
    enough = 1d-20 * rr
    do while (rr > enough)
      steps = steps + 1
      if (steps > 10000) then
        write (error_unit, '(a)') 'conjugate gradients do not converge'
        call MPI_Abort(m%comm, 1, ierror)
      end if
      call multiply(m, e, a, p, q)
      alpha = rr / dot(m, p, q)
      u(:n) = u(:n) + alpha * p(:n)
      r = merge(0d0, r - alpha * q, m%tags(:n) /= 0)
      rr_before = rr
      rr = dot(m, r, r)
      p(:n) = r + rr / rr_before * p(:n)
    end do
    call update_ghosts(m, e, u)
  end subroutine

  ! -------------------------------------------------------------- the results ------------------

  function largest_error(m, u)
    type(mesh), intent(in) :: m
    real(c_double), intent(in) :: u(:)
    real(c_double) :: largest_error, part
    integer(c_int64_t) :: i
    integer :: ierror
    part = 0
    do i = 1, m%owned
      part = max(part, abs(u(i) - known_solution(m%xy(:, i))))
    end do
    call MPI_Allreduce(part, largest_error, 1, MPI_DOUBLE_PRECISION, MPI_MAX, m%comm, ierror)
  end function

  ! Returns the root of the integral of (u - log r)^2, computed with the midpoints of the edges of
  ! each triangle. Collective.
  function l2_error(m, u)
    type(mesh), intent(in) :: m
    real(c_double), intent(in) :: u(:)
    real(c_double) :: l2_error, part, area, xy(2, 3), error
    integer(c_int64_t) :: t, c(3)
    integer :: i, j
    part = 0
    do t = 1, m%triangles
      c = m%corners(:, t)
      xy = m%xy(:, c)
      area = ((xy(1, 2) - xy(1, 1)) * (xy(2, 3) - xy(2, 1)) - &
              (xy(2, 2) - xy(2, 1)) * (xy(1, 3) - xy(1, 1))) / 2
      do i = 1, 3
        j = mod(i, 3) + 1
        error = (u(c(i)) + u(c(j))) / 2 - known_solution((xy(:, i) + xy(:, j)) / 2)
        part = part + area / 3 * error**2
      end do
    end do
    l2_error = sqrt(sum_over_ranks(m, part))
  end function

  ! Returns the integral of the normal derivative of u over the outer circle, which is the sum of A
  ! u over the nodes there. Collective.
  function outer_flux(m, e, a, u)
    type(mesh), intent(in) :: m
    type(exchange), intent(inout) :: e
    type(matrix), intent(in) :: a
    real(c_double), intent(inout) :: u(:)
    real(c_double) :: outer_flux, q(m%owned)
    call multiply(m, e, a, u, q)
    outer_flux = sum_over_ranks(m, sum(q, mask=m%tags(:m%owned) == outer_circle))
  end function

  subroutine print_results(m, e, a, u)
    type(mesh), intent(in) :: m
    type(exchange), intent(inout) :: e
    type(matrix), intent(in) :: a
    real(c_double), intent(inout) :: u(:)
    real(c_double) :: area, bound, nodes, triangles, boundary, flux, largest, l2
    integer :: rank, ierror
    area = pi * (outer_radius**2 - inner_radius**2)
    bound = d**2 / 6 / inner_radius**2
    nodes = sum_over_ranks(m, real(m%owned, c_double))
    triangles = sum_over_ranks(m, real(m%triangles, c_double))
    boundary = sum_over_ranks(m, real(count(m%tags(:m%owned) /= 0), c_double))
    flux = outer_flux(m, e, a, u)
    largest = largest_error(m, u)
    l2 = l2_error(m, u)
    call MPI_Comm_rank(m%comm, rank, ierror)
    if (rank /= 0) return
    print '(a, i0, a, i0)', 'nodes: ', nint(nodes), ', expected about ', &
      nint(2 * area / sqrt(3d0) / d**2 + boundary / 2)
    print '(a, i0, a, i0)', 'triangles: ', nint(triangles), ', expected ', &
      nint(2 * nodes - boundary)
    print '(a, f7.5, a, f7.5)', 'flux through the outer circle: ', flux, ', expected about ', 2 * pi
    print '(a, f10.8, a, f10.8)', 'largest error: ', largest, ', expected at most ', bound
    print '(a, f10.8, a, f10.8)', 'L2 error: ', l2, ', expected at most ', bound * sqrt(area)
  end subroutine

  ! Writes FOLDER/laplace_ring_<rank>.vtk for examples/draw_pieces.py or ParaView.
  subroutine write_piece(folder, m, u)
    character(len=*), intent(in) :: folder
    type(mesh), intent(in) :: m
    real(c_double), intent(in) :: u(:)
    integer, parameter :: file = 10
    character(len=3) :: number
    integer(c_int64_t) :: i
    integer :: rank, ierror
    call MPI_Comm_rank(m%comm, rank, ierror)
    write (number, '(i3.3)') rank
    open (file, file=folder // '/laplace_ring_' // number // '.vtk', action='write')
    write (file, '(a)') '# vtk DataFile Version 3.0', 'laplace_ring', 'ASCII', &
      'DATASET UNSTRUCTURED_GRID'
    write (file, '(a, i0, a)') 'POINTS ', m%all, ' double'
    write (file, '(2es17.9, a)') (m%xy(:, i), ' 0', i = 1, m%all)
    write (file, '(a, i0, 1x, i0)') 'CELLS ', m%triangles, 4 * m%triangles
    write (file, '(a, i0, 1x, i0, 1x, i0)') ('3 ', m%corners(:, i) - 1, i = 1, m%triangles)
    write (file, '(a, i0)') 'CELL_TYPES ', m%triangles
    write (file, '(a)') ('5', i = 1, m%triangles)
    write (file, '(a, i0)') 'POINT_DATA ', m%all
    write (file, '(a)') 'SCALARS solution double', 'LOOKUP_TABLE default'
    write (file, '(es16.9)') u
    write (file, '(a)') 'SCALARS error double', 'LOOKUP_TABLE default'
    write (file, '(es16.9)') (abs(u(i) - known_solution(m%xy(:, i))), i = 1, m%all)
    close (file)
  end subroutine
end module ring

program laplace_ring
  use ring
  implicit none
  real(c_double), parameter :: centre(2) = [0, 0]
  type(pnpbs_context) :: context
  type(pnpbs_domain) :: domain
  type(pnpbs_placement) :: placement
  type(mesh) :: m
  type(exchange) :: e
  type(matrix) :: a
  real(c_double), allocatable :: u(:)
  integer(c_int64_t) :: i
  integer :: ierror
  character(len=1000) :: folder

  call MPI_Init(ierror)
  m%comm = MPI_COMM_WORLD ! or any other communicator
  call context%create_mpi(m%comm)
  call domain%create(context)
  call domain%add_arc(PNPBS_BOUNDARY, centre, inner_radius, 0d0, 2 * pi, inner_circle)
  call domain%add_arc(PNPBS_BOUNDARY, centre, outer_radius, 0d0, 2 * pi, outer_circle)
  call placement%create(context, domain)
  call placement%set_spacing_constant(d)
  call placement%run

  call get_mesh(placement, m)
  call get_exchange(placement, e)
  call assemble(placement, m, a)
  allocate (u(m%all))
  u = 0
  do i = 1, m%owned
    if (m%tags(i) /= 0) u(i) = known_solution(m%xy(:, i))
  end do
  call solve(m, e, a, u)
  call print_results(m, e, a, u)
  call get_command_argument(1, folder)
  if (folder /= '') call write_piece(trim(folder), m, u)

  call placement%destroy
  call domain%destroy
  call context%destroy
  call MPI_Finalize(ierror)
end program laplace_ring
