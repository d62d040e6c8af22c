! SPDX-License-Identifier: BSD-3-Clause
! Made from include/pnpbs/pnpbs.h by scripts/fortran_layer: change that, and write this by
!   cmake --build <folder> --target pnpbs-fortran-layer
!> The C interface of PNPBS (pnpbs/pnpbs.h), function by function, for the module pnpbs. Use that
!> module. tests/linkage/check_signatures.py compares every body below with the header, argument by
!> argument, by a reader of its own.
!>
!> The C function pnpbs_<name> is c_<name>, and its arguments have their names in C. Arrays that may
!> be NULL in C, and untyped addresses, are type(c_ptr), value, followed by the C type in a comment:
!> Fortran 2003 has no optional arguments in procedures with bind(C).
module pnpbs_c
  use, intrinsic :: iso_c_binding
  implicit none
  public

  ! ------------------------------------------------------------ status and constants ----------

  integer(c_int), parameter :: PNPBS_OK = 0                   !< done
  integer(c_int), parameter :: PNPBS_NOT_CONVERGED = 1        !< the step limit was reached before
                                                              !< the bubbles rested
  integer(c_int), parameter :: PNPBS_STOPPED = 2              !< stopped by the monitor
  integer(c_int), parameter :: PNPBS_SPACING_MISSED = 3       !< somewhere the nodes do not follow
                                                              !< the spacing
  integer(c_int), parameter :: PNPBS_NOT_CONFORMING = 4       !< the elements do not fill the domain
  integer(c_int), parameter :: PNPBS_ERROR_ARGUMENT = -1      !< invalid argument
  integer(c_int), parameter :: PNPBS_ERROR_HANDLE = -2        !< not a live handle
  integer(c_int), parameter :: PNPBS_ERROR_STATE = -3         !< call not allowed in this state
  integer(c_int), parameter :: PNPBS_ERROR_DOMAIN = -4        !< invalid domain
  integer(c_int), parameter :: PNPBS_ERROR_SPACING = -5       !< invalid spacing
  integer(c_int), parameter :: PNPBS_ERROR_KEY = -6           !< unknown option or statistic
  integer(c_int), parameter :: PNPBS_ERROR_CAPACITY = -7      !< array too small
  integer(c_int), parameter :: PNPBS_ERROR_FILE = -8          !< cannot read or write file
  integer(c_int), parameter :: PNPBS_ERROR_CALLBACK = -9      !< a callback asked to stop with an
                                                              !< error
  integer(c_int), parameter :: PNPBS_ERROR_MEMORY = -10       !< out of memory
  integer(c_int), parameter :: PNPBS_ERROR_MPI = -11          !< MPI is not usable
  integer(c_int), parameter :: PNPBS_ERROR_KOKKOS = -12       !< Kokkos is not usable
  integer(c_int), parameter :: PNPBS_ERROR_UNSUPPORTED = -13  !< not supported by this build
  integer(c_int), parameter :: PNPBS_ERROR_INTERNAL = -14     !< internal error

  !> What else is known of an error, for programs that act on it: the status and this number decide,
  !> never the text. PNPBS_REASON_CROSSING comes with PNPBS_ERROR_DOMAIN: segments of curves cross
  !> or overlap, which pnpbs_domain_set_fragment allows. More may be added.
  integer(c_int32_t), parameter :: PNPBS_REASON_OTHER = 0
  integer(c_int32_t), parameter :: PNPBS_REASON_CROSSING = 1

  !> Role of a curve, or of a surface in space. PNPBS_BOUNDARY separates inside from outside: a
  !> point is inside if it lies behind an odd number of them (holes and islands nest to any depth).
  !> PNPBS_INNER lies in the domain, and nodes follow it. Curves in space are always PNPBS_INNER.
  integer(c_int32_t), parameter :: PNPBS_BOUNDARY = 0
  integer(c_int32_t), parameter :: PNPBS_INNER = 1

  !> The region tag of a part of a domain that several solids contain; see
  !> pnpbs_domain_set_fragment. PNPBS_OVERLAP_LAST and PNPBS_OVERLAP_FIRST: that of the solid added
  !> last or first. PNPBS_OVERLAP_OWN: one for each combination of solids, following those of the
  !> solids.
  integer(c_int32_t), parameter :: PNPBS_OVERLAP_LAST = 0
  integer(c_int32_t), parameter :: PNPBS_OVERLAP_FIRST = 1
  integer(c_int32_t), parameter :: PNPBS_OVERLAP_OWN = 2

  !> An axis in pnpbs_domain_set_periodic. PNPBS_BOUNDED: the sides across it bound the domain.
  !> PNPBS_PERIODIC: the domain repeats itself along it. PNPBS_FLAT: as PNPBS_PERIODIC, and no
  !> element crosses the sides.
  integer(c_int32_t), parameter :: PNPBS_BOUNDED = 0
  integer(c_int32_t), parameter :: PNPBS_PERIODIC = 1
  integer(c_int32_t), parameter :: PNPBS_FLAT = 2

  !> Warnings about the domain. In parentheses: what `count` and `value` of
  !> pnpbs_placement_get_warning_data are. More codes may be added: programs must expect numbers
  !> that they do not know. PNPBS_WARNING_UNKNOWN is none of the others. LEFT_OUT_OUTSIDE: curves or
  !> triangles outside of the domain are left out (their names). UNUSED_VERTICES: vertices are in no
  !> segment (vertices). REGION_POINTS: region points have no effect (points). SIMPLIFIED: vertices
  !> were left out (vertices). REPAIRED: the body was repaired (triangles, resolution), or 0
  !> triangles: it was sound. TRIANGLES_LEFT_OUT: they have no area, are given twice, or follow
  !> those that a binary STL announces (triangles). TRIANGLES_TURNED: to agree with neighbours, or
  !> outwards (triangles). VERTICES_MERGED: they were closer than the tolerance to others, or in the
  !> plane to a curve (vertices, tolerance). SURFACES_TOUCH: in single vertices (vertices).
  !> PIECES_LEFT_OUT: parts of a body are too thin (parts, mean thickness). EDGES_ROUNDED: edges of
  !> a level set are rounded by the resolution (triangle edges). CREASES_IGNORED: short creases are
  !> no features (edges). FEATURE_ANGLE: the smallest holds for all surfaces (-, degrees).
  !> CURVED_ELEMENTS: elements of a file are treated as straight (elements). GROUPS: entities of a
  !> file are in several groups (entities).
  integer(c_int32_t), parameter :: PNPBS_WARNING_UNKNOWN = 0
  integer(c_int32_t), parameter :: PNPBS_WARNING_LEFT_OUT_OUTSIDE = 101
  integer(c_int32_t), parameter :: PNPBS_WARNING_UNUSED_VERTICES = 102
  integer(c_int32_t), parameter :: PNPBS_WARNING_REGION_POINTS = 103
  integer(c_int32_t), parameter :: PNPBS_WARNING_SIMPLIFIED = 104
  integer(c_int32_t), parameter :: PNPBS_WARNING_REPAIRED = 105
  integer(c_int32_t), parameter :: PNPBS_WARNING_TRIANGLES_LEFT_OUT = 106
  integer(c_int32_t), parameter :: PNPBS_WARNING_TRIANGLES_TURNED = 107
  integer(c_int32_t), parameter :: PNPBS_WARNING_VERTICES_MERGED = 108
  integer(c_int32_t), parameter :: PNPBS_WARNING_SURFACES_TOUCH = 109
  integer(c_int32_t), parameter :: PNPBS_WARNING_PIECES_LEFT_OUT = 110
  integer(c_int32_t), parameter :: PNPBS_WARNING_EDGES_ROUNDED = 111
  integer(c_int32_t), parameter :: PNPBS_WARNING_CREASES_IGNORED = 112
  integer(c_int32_t), parameter :: PNPBS_WARNING_FEATURE_ANGLE = 113
  integer(c_int32_t), parameter :: PNPBS_WARNING_CURVED_ELEMENTS = 114
  integer(c_int32_t), parameter :: PNPBS_WARNING_GROUPS = 115

  !> Warnings about the spacing. FEATURE_UNRESOLVED: d is larger than a feature (boundary edges or
  !> nodes, the least length or distance over d). FIXED_NODES_CLOSE: to the boundary or each other
  !> (fixed nodes, the least distance over d). GROWTH: d grows too fast (-, growth per length).
  !> PARTIAL_EXTENT: d is given for a part of the domain only (nodes beyond it). SPACING_COARSE: d
  !> is too large for the whole domain (-, least d). SPACING_MISSED: the nodes do not follow d
  !> (edges of a band of d, their mean length over d). SPACING_HELD: d was reduced where it did not
  !> resolve the shape (points, least d).
  integer(c_int32_t), parameter :: PNPBS_WARNING_FEATURE_UNRESOLVED = 201
  integer(c_int32_t), parameter :: PNPBS_WARNING_FIXED_NODES_CLOSE = 202
  integer(c_int32_t), parameter :: PNPBS_WARNING_GROWTH = 203
  integer(c_int32_t), parameter :: PNPBS_WARNING_PARTIAL_EXTENT = 204
  integer(c_int32_t), parameter :: PNPBS_WARNING_SPACING_COARSE = 205
  integer(c_int32_t), parameter :: PNPBS_WARNING_SPACING_MISSED = 206
  integer(c_int32_t), parameter :: PNPBS_WARNING_SPACING_HELD = 207

  !> Warnings about the elements. BOUNDARY_NOT_FOLLOWED: by the tetrahedra (triangles).
  !> NOT_CONFORMING: they do not fill the domain (nodes, edges or tetrahedra, or 0). SMALL_ANGLES:
  !> some dihedral angles are below a limit (tetrahedra, degrees). FEATURES_LEFT_OUT: the tetrahedra
  !> of a thin body do not reach corners and sharp edges (nodes).
  integer(c_int32_t), parameter :: PNPBS_WARNING_BOUNDARY_NOT_FOLLOWED = 301
  integer(c_int32_t), parameter :: PNPBS_WARNING_NOT_CONFORMING = 302
  integer(c_int32_t), parameter :: PNPBS_WARNING_SMALL_ANGLES = 303
  integer(c_int32_t), parameter :: PNPBS_WARNING_FEATURES_LEFT_OUT = 304

  !> Warnings about options and the run. OPTION_WITHOUT_EFFECT: an option does nothing here.
  !> OPTIONS_CHANGED: since the checkpoint (options). DEPENDS_ON_RANKS: the nodes may do so
  !> (decisions).
  integer(c_int32_t), parameter :: PNPBS_WARNING_OPTION_WITHOUT_EFFECT = 401
  integer(c_int32_t), parameter :: PNPBS_WARNING_OPTIONS_CHANGED = 402
  integer(c_int32_t), parameter :: PNPBS_WARNING_DEPENDS_ON_RANKS = 403

  !> The version this module was written for; pnpbs_version returns the library's.
  integer(c_int32_t), parameter :: PNPBS_VERSION_MAJOR = 0
  integer(c_int32_t), parameter :: PNPBS_VERSION_MINOR = 2
  integer(c_int32_t), parameter :: PNPBS_VERSION_PATCH = 0

  ! ------------------------------------------------------------ callbacks ---------------------
  ! Write callbacks as module procedures with bind(C): internal procedures need an executable stack,
  ! which many systems forbid. Never stop or jump out of one: return a nonzero value. Pass data
  ! through user, the c_loc of a target that outlives the calls. How often a callback is called,
  ! with which points and on which rank may differ from run to run.

  abstract interface
    !> Parametric curve in the plane: fills coordinates(dim,n), dim = 2, for t(n). Must be a pure
    !> function, continuous and without self-intersection. Return 0, or nonzero to fail the call
    !> with PNPBS_ERROR_CALLBACK.
    function pnpbs_curve_fn(n, dim, t, coordinates, user) bind(C)
      import
      implicit none
      integer(c_int64_t), value :: n
      integer(c_int32_t), value :: dim
      real(c_double), intent(in) :: t(n)
      real(c_double), intent(out) :: coordinates(dim, n)
      type(c_ptr), value :: user ! void *
      integer(c_int32_t) :: pnpbs_curve_fn
    end function

    !> Level set callback: fills values(n) with f at coordinates(dim,n), dim = 3 in space; the body
    !> is where f < 0. Must be a pure function of the point, the same on all ranks, continuous and
    !> finite in the whole box; it need not be a distance. Return 0, or nonzero to fail the call
    !> with PNPBS_ERROR_CALLBACK.
    function pnpbs_level_set_fn(n, dim, coordinates, values, user) bind(C)
      import
      implicit none
      integer(c_int64_t), value :: n
      integer(c_int32_t), value :: dim
      real(c_double), intent(in) :: coordinates(dim, n)
      real(c_double), intent(out) :: values(n)
      type(c_ptr), value :: user ! void *
      integer(c_int32_t) :: pnpbs_level_set_fn
    end function

    !> Spacing callback: fills d(n) for coordinates(dim,n). n may be 0. Must be a pure function of
    !> the point; it may be evaluated anywhere in the domain's bounding box that lies inside the
    !> domain or on its boundary. Return 0, or nonzero to fail the call with PNPBS_ERROR_CALLBACK.
    function pnpbs_spacing_fn(n, dim, coordinates, d, user) bind(C)
      import
      implicit none
      integer(c_int64_t), value :: n
      integer(c_int32_t), value :: dim
      real(c_double), intent(in) :: coordinates(dim, n)
      real(c_double), intent(out) :: d(n)
      type(c_ptr), value :: user ! void *
      integer(c_int32_t) :: pnpbs_spacing_fn
    end function

    !> Progress callback. It is called at fixed step numbers and, a few times a second, while the
    !> first nodes are laid or the growth of the spacing is limited, between steps that take long
    !> (on one rank), and between the parts of the finish. While nodes are laid or growth is
    !> limited, each rank calls it by its own clock: do nothing collective when fraction is 0.
    !> Return 0 to continue, nonzero to stop: the call in progress then returns PNPBS_STOPPED with
    !> valid nodes; stopped before the first nodes are laid, it has none.
    !> @param fraction   of the work of the call in progress, 0 .. 1
    !> @param step       steps done so far
    !> @param nodes      current number of nodes, 0 while the first ones are laid
    !> @param max_speed  largest scaled speed (spacings per unit time)
    function pnpbs_monitor_fn(fraction, step, nodes, max_speed, user) bind(C)
      import
      implicit none
      real(c_double), value :: fraction
      integer(c_int64_t), value :: step, nodes
      real(c_double), value :: max_speed
      type(c_ptr), value :: user ! void *
      integer(c_int32_t) :: pnpbs_monitor_fn
    end function
  end interface

  ! ------------------------------------------------------------ functions ---------------------

  interface
    function c_status_string(status) bind(C, name="pnpbs_status_string")
      import
      implicit none
      integer(c_int), value :: status
      type(c_ptr) :: c_status_string
    end function

    function c_last_error(context) bind(C, name="pnpbs_last_error")
      import
      implicit none
      type(c_ptr), value :: context
      type(c_ptr) :: c_last_error
    end function

    function c_last_error_data(context, reason, points) bind(C, name="pnpbs_last_error_data")
      import
      implicit none
      type(c_ptr), value :: context
      integer(c_int32_t), intent(out) :: reason, points
      integer(c_int) :: c_last_error_data
    end function

    function c_last_error_point(context, index, point, begin, end) bind(C, &
      name="pnpbs_last_error_point")
      import
      implicit none
      type(c_ptr), value :: context
      integer(c_int32_t), value :: index
      type(c_ptr), value :: point ! double *
      integer(c_int64_t), intent(out) :: begin, end
      integer(c_int) :: c_last_error_point
    end function

    function c_version(major, minor, patch) bind(C, name="pnpbs_version")
      import
      implicit none
      integer(c_int32_t), intent(out) :: major, minor, patch
      integer(c_int) :: c_version
    end function

    function c_build_info() bind(C, name="pnpbs_build_info")
      import
      implicit none
      type(c_ptr) :: c_build_info
    end function

    function c_mpi_library() bind(C, name="pnpbs_mpi_library")
      import
      implicit none
      type(c_ptr) :: c_mpi_library
    end function

    function c_context_create_serial(context) bind(C, name="pnpbs_context_create_serial")
      import
      implicit none
      type(c_ptr), intent(out) :: context
      integer(c_int) :: c_context_create_serial
    end function

    function c_context_create_f(comm, context) bind(C, name="pnpbs_context_create_f")
      import
      implicit none
      integer(c_int32_t), value :: comm
      type(c_ptr), intent(out) :: context
      integer(c_int) :: c_context_create_f
    end function

    function c_context_create_checked_f(comm, library, context) bind(C, &
      name="pnpbs_context_create_checked_f")
      import
      implicit none
      integer(c_int32_t), value :: comm
      character(kind=c_char), intent(in) :: library(*)
      type(c_ptr), intent(out) :: context
      integer(c_int) :: c_context_create_checked_f
    end function

    function c_context_destroy(context) bind(C, name="pnpbs_context_destroy")
      import
      implicit none
      type(c_ptr), intent(inout) :: context
      integer(c_int) :: c_context_destroy
    end function

    function c_finalize() bind(C, name="pnpbs_finalize")
      import
      implicit none
      integer(c_int) :: c_finalize
    end function

    function c_context_set(context, key, value) bind(C, name="pnpbs_context_set")
      import
      implicit none
      type(c_ptr), value :: context
      character(kind=c_char), intent(in) :: key(*), value(*)
      integer(c_int) :: c_context_set
    end function

    function c_context_set_int64(context, key, value) bind(C, name="pnpbs_context_set_int64")
      import
      implicit none
      type(c_ptr), value :: context
      character(kind=c_char), intent(in) :: key(*)
      integer(c_int64_t), value :: value
      integer(c_int) :: c_context_set_int64
    end function

    function c_context_set_double(context, key, value) bind(C, name="pnpbs_context_set_double")
      import
      implicit none
      type(c_ptr), value :: context
      character(kind=c_char), intent(in) :: key(*)
      real(c_double), value :: value
      integer(c_int) :: c_context_set_double
    end function

    function c_option_count(count) bind(C, name="pnpbs_option_count")
      import
      implicit none
      integer(c_int32_t), intent(out) :: count
      integer(c_int) :: c_option_count
    end function

    function c_option_info(index, name, type, default_value, range, help) bind(C, &
      name="pnpbs_option_info")
      import
      implicit none
      integer(c_int32_t), value :: index
      type(c_ptr), intent(out) :: name, type, default_value, range, help
      integer(c_int) :: c_option_info
    end function

    function c_statistic_count(count) bind(C, name="pnpbs_statistic_count")
      import
      implicit none
      integer(c_int32_t), intent(out) :: count
      integer(c_int) :: c_statistic_count
    end function

    function c_statistic_info(index, name, type, help) bind(C, name="pnpbs_statistic_info")
      import
      implicit none
      integer(c_int32_t), value :: index
      type(c_ptr), intent(out) :: name, type, help
      integer(c_int) :: c_statistic_info
    end function

    function c_format_count(count) bind(C, name="pnpbs_format_count")
      import
      implicit none
      integer(c_int32_t), intent(out) :: count
      integer(c_int) :: c_format_count
    end function

    function c_format_info(index, name, help, binary, elements) bind(C, name="pnpbs_format_info")
      import
      implicit none
      integer(c_int32_t), value :: index
      type(c_ptr), intent(out) :: name, help
      integer(c_int32_t), intent(out) :: binary, elements
      integer(c_int) :: c_format_info
    end function

    function c_domain_create(context, dim, domain) bind(C, name="pnpbs_domain_create")
      import
      implicit none
      type(c_ptr), value :: context
      integer(c_int32_t), value :: dim
      type(c_ptr), intent(out) :: domain
      integer(c_int) :: c_domain_create
    end function

    function c_domain_create_sphere(context, radius, outside, domain) bind(C, &
      name="pnpbs_domain_create_sphere")
      import
      implicit none
      type(c_ptr), value :: context
      real(c_double), value :: radius
      real(c_double), intent(in) :: outside(*)
      type(c_ptr), intent(out) :: domain
      integer(c_int) :: c_domain_create_sphere
    end function

    function c_sphere_points(radius, n, degrees, coordinates) bind(C, name="pnpbs_sphere_points")
      import
      implicit none
      real(c_double), value :: radius
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: degrees(*)
      real(c_double), intent(inout) :: coordinates(*)
      integer(c_int) :: c_sphere_points
    end function

    function c_sphere_degrees(n, coordinates, degrees) bind(C, name="pnpbs_sphere_degrees")
      import
      implicit none
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: coordinates(*)
      real(c_double), intent(inout) :: degrees(*)
      integer(c_int) :: c_sphere_degrees
    end function

    function c_domain_destroy(domain) bind(C, name="pnpbs_domain_destroy")
      import
      implicit none
      type(c_ptr), intent(inout) :: domain
      integer(c_int) :: c_domain_destroy
    end function

    function c_domain_dimension(domain, dim) bind(C, name="pnpbs_domain_dimension")
      import
      implicit none
      type(c_ptr), value :: domain
      integer(c_int32_t), intent(out) :: dim
      integer(c_int) :: c_domain_dimension
    end function

    function c_domain_set_filled(domain, filled) bind(C, name="pnpbs_domain_set_filled")
      import
      implicit none
      type(c_ptr), value :: domain
      integer(c_int32_t), value :: filled
      integer(c_int) :: c_domain_set_filled
    end function

    function c_domain_set_repair(domain, resolution) bind(C, name="pnpbs_domain_set_repair")
      import
      implicit none
      type(c_ptr), value :: domain
      real(c_double), value :: resolution
      integer(c_int) :: c_domain_set_repair
    end function

    function c_domain_set_resurfaced(domain, resolution) bind(C, &
      name="pnpbs_domain_set_resurfaced")
      import
      implicit none
      type(c_ptr), value :: domain
      real(c_double), value :: resolution
      integer(c_int) :: c_domain_set_resurfaced
    end function

    function c_domain_set_fragment(domain, overlap) bind(C, name="pnpbs_domain_set_fragment")
      import
      implicit none
      type(c_ptr), value :: domain
      integer(c_int32_t), value :: overlap
      integer(c_int) :: c_domain_set_fragment
    end function

    function c_domain_set_periodic(domain, low, high, periodic, tags) bind(C, &
      name="pnpbs_domain_set_periodic")
      import
      implicit none
      type(c_ptr), value :: domain
      real(c_double), intent(in) :: low(*), high(*)
      integer(c_int32_t), intent(in) :: periodic(*)
      type(c_ptr), value :: tags ! const int32_t *
      integer(c_int) :: c_domain_set_periodic
    end function

    function c_domain_add_polyline(domain, role, closed, n, coordinates, tags, corner_angle) &
      bind(C, name="pnpbs_domain_add_polyline")
      import
      implicit none
      type(c_ptr), value :: domain
      integer(c_int32_t), value :: role, closed
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: coordinates(*)
      type(c_ptr), value :: tags ! const int32_t *
      real(c_double), value :: corner_angle
      integer(c_int) :: c_domain_add_polyline
    end function

    function c_domain_add_surface(domain, role, vertices, coordinates, triangles, corners, tags, &
      feature_angle) bind(C, name="pnpbs_domain_add_surface")
      import
      implicit none
      type(c_ptr), value :: domain
      integer(c_int32_t), value :: role
      integer(c_int64_t), value :: vertices
      real(c_double), intent(in) :: coordinates(*)
      integer(c_int64_t), value :: triangles
      integer(c_int64_t), intent(in) :: corners(*)
      type(c_ptr), value :: tags ! const int32_t *
      real(c_double), value :: feature_angle
      integer(c_int) :: c_domain_add_surface
    end function

    function c_domain_read_surface(domain, role, path, feature_angle) bind(C, &
      name="pnpbs_domain_read_surface")
      import
      implicit none
      type(c_ptr), value :: domain
      integer(c_int32_t), value :: role
      character(kind=c_char), intent(in) :: path(*)
      real(c_double), value :: feature_angle
      integer(c_int) :: c_domain_read_surface
    end function

    function c_domain_set_role(domain, tag, role) bind(C, name="pnpbs_domain_set_role")
      import
      implicit none
      type(c_ptr), value :: domain
      integer(c_int32_t), value :: tag, role
      integer(c_int) :: c_domain_set_role
    end function

    function c_domain_read_msh(domain, path, feature_angle) bind(C, name="pnpbs_domain_read_msh")
      import
      implicit none
      type(c_ptr), value :: domain
      character(kind=c_char), intent(in) :: path(*)
      real(c_double), value :: feature_angle
      integer(c_int) :: c_domain_read_msh
    end function

    function c_file_dimension(path, dim) bind(C, name="pnpbs_file_dimension")
      import
      implicit none
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int32_t), intent(out) :: dim
      integer(c_int) :: c_file_dimension
    end function

    function c_domain_set_tag_name(domain, dim, tag, name) bind(C, &
      name="pnpbs_domain_set_tag_name")
      import
      implicit none
      type(c_ptr), value :: domain
      integer(c_int32_t), value :: dim, tag
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int) :: c_domain_set_tag_name
    end function

    function c_domain_tag_name_count(domain, count) bind(C, name="pnpbs_domain_tag_name_count")
      import
      implicit none
      type(c_ptr), value :: domain
      integer(c_int32_t), intent(out) :: count
      integer(c_int) :: c_domain_tag_name_count
    end function

    function c_domain_get_tag_name(domain, index, dim, tag, name) bind(C, &
      name="pnpbs_domain_get_tag_name")
      import
      implicit none
      type(c_ptr), value :: domain
      integer(c_int32_t), value :: index
      integer(c_int32_t), intent(out) :: dim, tag
      type(c_ptr), intent(out) :: name
      integer(c_int) :: c_domain_get_tag_name
    end function

    function c_domain_add_box(domain, low, high, tag) bind(C, name="pnpbs_domain_add_box")
      import
      implicit none
      type(c_ptr), value :: domain
      real(c_double), intent(in) :: low(*), high(*)
      integer(c_int32_t), value :: tag
      integer(c_int) :: c_domain_add_box
    end function

    function c_domain_add_ball(domain, centre, radius, tag) bind(C, name="pnpbs_domain_add_ball")
      import
      implicit none
      type(c_ptr), value :: domain
      real(c_double), intent(in) :: centre(*)
      real(c_double), value :: radius
      integer(c_int32_t), value :: tag
      integer(c_int) :: c_domain_add_ball
    end function

    function c_domain_add_cylinder(domain, begin, end, radius, tag) bind(C, &
      name="pnpbs_domain_add_cylinder")
      import
      implicit none
      type(c_ptr), value :: domain
      real(c_double), intent(in) :: begin(*), end(*)
      real(c_double), value :: radius
      integer(c_int32_t), value :: tag
      integer(c_int) :: c_domain_add_cylinder
    end function

    function c_domain_add_box_surface(domain, role, low, high, tag) bind(C, &
      name="pnpbs_domain_add_box_surface")
      import
      implicit none
      type(c_ptr), value :: domain
      integer(c_int32_t), value :: role
      real(c_double), intent(in) :: low(*), high(*)
      integer(c_int32_t), value :: tag
      integer(c_int) :: c_domain_add_box_surface
    end function

    function c_domain_add_ball_surface(domain, role, centre, radius, tag) bind(C, &
      name="pnpbs_domain_add_ball_surface")
      import
      implicit none
      type(c_ptr), value :: domain
      integer(c_int32_t), value :: role
      real(c_double), intent(in) :: centre(*)
      real(c_double), value :: radius
      integer(c_int32_t), value :: tag
      integer(c_int) :: c_domain_add_ball_surface
    end function

    function c_domain_add_cylinder_surface(domain, role, begin, end, radius, tag) bind(C, &
      name="pnpbs_domain_add_cylinder_surface")
      import
      implicit none
      type(c_ptr), value :: domain
      integer(c_int32_t), value :: role
      real(c_double), intent(in) :: begin(*), end(*)
      real(c_double), value :: radius
      integer(c_int32_t), value :: tag
      integer(c_int) :: c_domain_add_cylinder_surface
    end function

    function c_domain_add_level_set(domain, level_set, user, low, high, resolution, tag) bind(C, &
      name="pnpbs_domain_add_level_set")
      import
      implicit none
      type(c_ptr), value :: domain
      type(c_funptr), value :: level_set ! pnpbs_level_set_fn
      type(c_ptr), value :: user ! void *
      real(c_double), intent(in) :: low(*), high(*)
      real(c_double), value :: resolution
      integer(c_int32_t), value :: tag
      integer(c_int) :: c_domain_add_level_set
    end function

    function c_domain_add_arc(domain, role, centre, radius, begin, end, tag) bind(C, &
      name="pnpbs_domain_add_arc")
      import
      implicit none
      type(c_ptr), value :: domain
      integer(c_int32_t), value :: role
      real(c_double), intent(in) :: centre(*)
      real(c_double), value :: radius, begin, end
      integer(c_int32_t), value :: tag
      integer(c_int) :: c_domain_add_arc
    end function

    function c_domain_add_curve(domain, role, curve, user, begin, end, tag) bind(C, &
      name="pnpbs_domain_add_curve")
      import
      implicit none
      type(c_ptr), value :: domain
      integer(c_int32_t), value :: role
      type(c_funptr), value :: curve ! pnpbs_curve_fn
      type(c_ptr), value :: user ! void *
      real(c_double), value :: begin, end
      integer(c_int32_t), value :: tag
      integer(c_int) :: c_domain_add_curve
    end function

    function c_domain_add_pslg(domain, vertices, coordinates, vertex_tags, segments, segment_ends, &
      segment_tags, holes, hole_points) bind(C, name="pnpbs_domain_add_pslg")
      import
      implicit none
      type(c_ptr), value :: domain
      integer(c_int64_t), value :: vertices
      real(c_double), intent(in) :: coordinates(*)
      type(c_ptr), value :: vertex_tags ! const int32_t *
      integer(c_int64_t), value :: segments
      integer(c_int64_t), intent(in) :: segment_ends(*)
      type(c_ptr), value :: segment_tags ! const int32_t *
      integer(c_int64_t), value :: holes
      type(c_ptr), value :: hole_points ! const double *
      integer(c_int) :: c_domain_add_pslg
    end function

    function c_domain_add_hole(domain, point) bind(C, name="pnpbs_domain_add_hole")
      import
      implicit none
      type(c_ptr), value :: domain
      real(c_double), intent(in) :: point(*)
      integer(c_int) :: c_domain_add_hole
    end function

    function c_domain_add_region(domain, point, tag) bind(C, name="pnpbs_domain_add_region")
      import
      implicit none
      type(c_ptr), value :: domain
      real(c_double), intent(in) :: point(*)
      integer(c_int32_t), value :: tag
      integer(c_int) :: c_domain_add_region
    end function

    function c_domain_add_fixed_nodes(domain, n, coordinates, tags) bind(C, &
      name="pnpbs_domain_add_fixed_nodes")
      import
      implicit none
      type(c_ptr), value :: domain
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: coordinates(*)
      type(c_ptr), value :: tags ! const int32_t *
      integer(c_int) :: c_domain_add_fixed_nodes
    end function

    function c_domain_read_poly(domain, path) bind(C, name="pnpbs_domain_read_poly")
      import
      implicit none
      type(c_ptr), value :: domain
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int) :: c_domain_read_poly
    end function

    function c_domain_parse_poly(domain, text, length, name) bind(C, &
      name="pnpbs_domain_parse_poly")
      import
      implicit none
      type(c_ptr), value :: domain
      character(kind=c_char), intent(in) :: text(*)
      integer(c_int64_t), value :: length
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int) :: c_domain_parse_poly
    end function

    function c_domain_tag_outline(domain, level_set, user, tag, count) bind(C, &
      name="pnpbs_domain_tag_outline")
      import
      implicit none
      type(c_ptr), value :: domain
      type(c_funptr), value :: level_set ! pnpbs_level_set_fn
      type(c_ptr), value :: user ! void *
      integer(c_int32_t), value :: tag
      integer(c_int64_t), intent(out) :: count
      integer(c_int) :: c_domain_tag_outline
    end function

    function c_domain_set_corner_angle(domain, corner_angle) bind(C, &
      name="pnpbs_domain_set_corner_angle")
      import
      implicit none
      type(c_ptr), value :: domain
      real(c_double), value :: corner_angle
      integer(c_int) :: c_domain_set_corner_angle
    end function

    function c_domain_set_snap(domain, length) bind(C, name="pnpbs_domain_set_snap")
      import
      implicit none
      type(c_ptr), value :: domain
      real(c_double), value :: length
      integer(c_int) :: c_domain_set_snap
    end function

    function c_domain_simplify(domain, spacing, user, tolerance, smallest, vertices, curves) &
      bind(C, name="pnpbs_domain_simplify")
      import
      implicit none
      type(c_ptr), value :: domain
      type(c_funptr), value :: spacing ! pnpbs_spacing_fn
      type(c_ptr), value :: user ! void *
      real(c_double), value :: tolerance, smallest
      integer(c_int64_t), intent(out) :: vertices, curves
      integer(c_int) :: c_domain_simplify
    end function

    function c_domain_simplify_by_file(domain, path, field, tolerance, smallest, vertices, curves) &
      bind(C, name="pnpbs_domain_simplify_by_file")
      import
      implicit none
      type(c_ptr), value :: domain
      character(kind=c_char), intent(in) :: path(*), field(*)
      real(c_double), value :: tolerance, smallest
      integer(c_int64_t), intent(out) :: vertices, curves
      integer(c_int) :: c_domain_simplify_by_file
    end function

    function c_domain_add_offset(domain, body, low, high, spacing, user, resolution, tag) bind(C, &
      name="pnpbs_domain_add_offset")
      import
      implicit none
      type(c_ptr), value :: domain, body
      real(c_double), value :: low, high
      type(c_funptr), value :: spacing ! pnpbs_spacing_fn
      type(c_ptr), value :: user ! void *
      real(c_double), value :: resolution
      integer(c_int32_t), value :: tag
      integer(c_int) :: c_domain_add_offset
    end function

    function c_domain_check(domain) bind(C, name="pnpbs_domain_check")
      import
      implicit none
      type(c_ptr), value :: domain
      integer(c_int) :: c_domain_check
    end function

    function c_domain_bounds(domain, low, high) bind(C, name="pnpbs_domain_bounds")
      import
      implicit none
      type(c_ptr), value :: domain
      real(c_double), intent(inout) :: low(*), high(*)
      integer(c_int) :: c_domain_bounds
    end function

    function c_domain_measure(domain, measure) bind(C, name="pnpbs_domain_measure")
      import
      implicit none
      type(c_ptr), value :: domain
      real(c_double), intent(out) :: measure
      integer(c_int) :: c_domain_measure
    end function

    function c_domain_distance(domain, tag, n, coordinates, distances) bind(C, &
      name="pnpbs_domain_distance")
      import
      implicit none
      type(c_ptr), value :: domain
      integer(c_int32_t), value :: tag
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: coordinates(*)
      real(c_double), intent(inout) :: distances(*)
      integer(c_int) :: c_domain_distance
    end function

    function c_domain_regions_at(domain, n, coordinates, columns, tags) bind(C, &
      name="pnpbs_domain_regions_at")
      import
      implicit none
      type(c_ptr), value :: domain
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: coordinates(*)
      integer(c_int32_t), value :: columns
      integer(c_int32_t), intent(inout) :: tags(*)
      integer(c_int) :: c_domain_regions_at
    end function

    function c_domain_shape_spacing(domain, nodes_per_turn, nodes_across, nodes_per_edge, growth, &
      n, coordinates, d) bind(C, name="pnpbs_domain_shape_spacing")
      import
      implicit none
      type(c_ptr), value :: domain
      real(c_double), value :: nodes_per_turn, nodes_across, nodes_per_edge, growth
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: coordinates(*)
      real(c_double), intent(inout) :: d(*)
      integer(c_int) :: c_domain_shape_spacing
    end function

    function c_domain_get_segments(domain, capacity, count, segments, tags) bind(C, &
      name="pnpbs_domain_get_segments")
      import
      implicit none
      type(c_ptr), value :: domain
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(out) :: count
      type(c_ptr), value :: segments ! double *
      type(c_ptr), value :: tags ! int32_t *
      integer(c_int) :: c_domain_get_segments
    end function

    function c_placement_create(context, domain, placement) bind(C, name="pnpbs_placement_create")
      import
      implicit none
      type(c_ptr), value :: context, domain
      type(c_ptr), intent(out) :: placement
      integer(c_int) :: c_placement_create
    end function

    function c_placement_destroy(placement) bind(C, name="pnpbs_placement_destroy")
      import
      implicit none
      type(c_ptr), intent(inout) :: placement
      integer(c_int) :: c_placement_destroy
    end function

    function c_placement_set(placement, key, value) bind(C, name="pnpbs_placement_set")
      import
      implicit none
      type(c_ptr), value :: placement
      character(kind=c_char), intent(in) :: key(*), value(*)
      integer(c_int) :: c_placement_set
    end function

    function c_placement_set_int64(placement, key, value) bind(C, &
      name="pnpbs_placement_set_int64")
      import
      implicit none
      type(c_ptr), value :: placement
      character(kind=c_char), intent(in) :: key(*)
      integer(c_int64_t), value :: value
      integer(c_int) :: c_placement_set_int64
    end function

    function c_placement_set_double(placement, key, value) bind(C, &
      name="pnpbs_placement_set_double")
      import
      implicit none
      type(c_ptr), value :: placement
      character(kind=c_char), intent(in) :: key(*)
      real(c_double), value :: value
      integer(c_int) :: c_placement_set_double
    end function

    function c_placement_set_spacing_constant(placement, d) bind(C, &
      name="pnpbs_placement_set_spacing_constant")
      import
      implicit none
      type(c_ptr), value :: placement
      real(c_double), value :: d
      integer(c_int) :: c_placement_set_spacing_constant
    end function

    function c_placement_set_spacing_callback(placement, spacing, user) bind(C, &
      name="pnpbs_placement_set_spacing_callback")
      import
      implicit none
      type(c_ptr), value :: placement
      type(c_funptr), value :: spacing ! pnpbs_spacing_fn
      type(c_ptr), value :: user ! void *
      integer(c_int) :: c_placement_set_spacing_callback
    end function

    function c_placement_set_spacing_grid(placement, size, origin, step, values) bind(C, &
      name="pnpbs_placement_set_spacing_grid")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int64_t), intent(in) :: size(*)
      real(c_double), intent(in) :: origin(*), step(*), values(*)
      integer(c_int) :: c_placement_set_spacing_grid
    end function

    function c_placement_set_spacing_mesh(placement, n, coordinates, d, elements, corners) bind(C, &
      name="pnpbs_placement_set_spacing_mesh")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: coordinates(*), d(*)
      integer(c_int64_t), value :: elements
      integer(c_int64_t), intent(in) :: corners(*)
      integer(c_int) :: c_placement_set_spacing_mesh
    end function

    function c_placement_set_spacing_points(placement, n, coordinates, d) bind(C, &
      name="pnpbs_placement_set_spacing_points")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: coordinates(*), d(*)
      integer(c_int) :: c_placement_set_spacing_points
    end function

    function c_placement_set_spacing_file(placement, path, field) bind(C, &
      name="pnpbs_placement_set_spacing_file")
      import
      implicit none
      type(c_ptr), value :: placement
      character(kind=c_char), intent(in) :: path(*), field(*)
      integer(c_int) :: c_placement_set_spacing_file
    end function

    function c_placement_set_spacing_from_shape(placement, nodes_per_turn, nodes_across, &
      nodes_per_edge, growth, min_spacing, max_spacing) bind(C, &
      name="pnpbs_placement_set_spacing_from_shape")
      import
      implicit none
      type(c_ptr), value :: placement
      real(c_double), value :: nodes_per_turn, nodes_across, nodes_per_edge, growth, min_spacing
      real(c_double), value :: max_spacing
      integer(c_int) :: c_placement_set_spacing_from_shape
    end function

    function c_placement_set_spacing_at_nodes(placement, n, d) bind(C, &
      name="pnpbs_placement_set_spacing_at_nodes")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: d(*)
      integer(c_int) :: c_placement_set_spacing_at_nodes
    end function

    function c_placement_add_spacing_hints(placement, n, coordinates) bind(C, &
      name="pnpbs_placement_add_spacing_hints")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: coordinates(*)
      integer(c_int) :: c_placement_add_spacing_hints
    end function

    function c_placement_set_monitor(placement, monitor, user) bind(C, &
      name="pnpbs_placement_set_monitor")
      import
      implicit none
      type(c_ptr), value :: placement
      type(c_funptr), value :: monitor ! pnpbs_monitor_fn
      type(c_ptr), value :: user ! void *
      integer(c_int) :: c_placement_set_monitor
    end function

    function c_placement_set_nodes(placement, n, coordinates, ids) bind(C, &
      name="pnpbs_placement_set_nodes")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: coordinates(*)
      type(c_ptr), value :: ids ! const int64_t *
      integer(c_int) :: c_placement_set_nodes
    end function

    function c_placement_estimate(placement, nodes, bytes, seconds) bind(C, &
      name="pnpbs_placement_estimate")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int64_t), intent(out) :: nodes, bytes
      real(c_double), intent(out) :: seconds
      integer(c_int) :: c_placement_estimate
    end function

    function c_placement_initialise(placement) bind(C, name="pnpbs_placement_initialise")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int) :: c_placement_initialise
    end function

    function c_placement_step(placement, n) bind(C, name="pnpbs_placement_step")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int64_t), value :: n
      integer(c_int) :: c_placement_step
    end function

    function c_placement_adjust_population(placement, inserted, deleted) bind(C, &
      name="pnpbs_placement_adjust_population")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int64_t), intent(out) :: inserted, deleted
      integer(c_int) :: c_placement_adjust_population
    end function

    function c_placement_rebalance(placement) bind(C, name="pnpbs_placement_rebalance")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int) :: c_placement_rebalance
    end function

    function c_placement_run(placement) bind(C, name="pnpbs_placement_run")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int) :: c_placement_run
    end function

    function c_placement_dimension(placement, dim) bind(C, name="pnpbs_placement_dimension")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int32_t), intent(out) :: dim
      integer(c_int) :: c_placement_dimension
    end function

    function c_placement_sphere_radius(placement, radius) bind(C, &
      name="pnpbs_placement_sphere_radius")
      import
      implicit none
      type(c_ptr), value :: placement
      real(c_double), intent(out) :: radius
      integer(c_int) :: c_placement_sphere_radius
    end function

    function c_placement_count(placement, nodes) bind(C, name="pnpbs_placement_count")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int64_t), intent(out) :: nodes
      integer(c_int) :: c_placement_count
    end function

    function c_placement_get_nodes(placement, capacity, coordinates, ids, tags, spacing) bind(C, &
      name="pnpbs_placement_get_nodes")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int64_t), value :: capacity
      type(c_ptr), value :: coordinates ! double *
      type(c_ptr), value :: ids ! int64_t *
      type(c_ptr), value :: tags ! int32_t *
      type(c_ptr), value :: spacing ! double *
      integer(c_int) :: c_placement_get_nodes
    end function

    function c_placement_get_normals(placement, capacity, normals) bind(C, &
      name="pnpbs_placement_get_normals")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int64_t), value :: capacity
      real(c_double), intent(inout) :: normals(*)
      integer(c_int) :: c_placement_get_normals
    end function

    function c_placement_ghost_count(placement, ghosts) bind(C, &
      name="pnpbs_placement_ghost_count")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int64_t), intent(out) :: ghosts
      integer(c_int) :: c_placement_ghost_count
    end function

    function c_placement_get_ghosts(placement, capacity, coordinates, ids, tags, spacing, owners) &
      bind(C, name="pnpbs_placement_get_ghosts")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int64_t), value :: capacity
      type(c_ptr), value :: coordinates ! double *
      type(c_ptr), value :: ids ! int64_t *
      type(c_ptr), value :: tags ! int32_t *
      type(c_ptr), value :: spacing ! double *
      type(c_ptr), value :: owners ! int32_t *
      integer(c_int) :: c_placement_get_ghosts
    end function

    function c_placement_exchange_sizes(placement, neighbours, sends, receives) bind(C, &
      name="pnpbs_placement_exchange_sizes")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int32_t), intent(out) :: neighbours
      integer(c_int64_t), intent(out) :: sends, receives
      integer(c_int) :: c_placement_exchange_sizes
    end function

    function c_placement_get_exchange(placement, neighbours, sends, receives, ranks, send_offsets, &
      send_nodes, receive_offsets, receive_nodes) bind(C, name="pnpbs_placement_get_exchange")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int32_t), value :: neighbours
      integer(c_int64_t), value :: sends, receives
      type(c_ptr), value :: ranks ! int32_t *
      type(c_ptr), value :: send_offsets ! int64_t *
      type(c_ptr), value :: send_nodes ! int64_t *
      type(c_ptr), value :: receive_offsets ! int64_t *
      type(c_ptr), value :: receive_nodes ! int64_t *
      integer(c_int) :: c_placement_get_exchange
    end function

    function c_placement_get_numbering(placement, capacity, first, count, ghost_numbers) bind(C, &
      name="pnpbs_placement_get_numbering")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(out) :: first, count
      type(c_ptr), value :: ghost_numbers ! int64_t *
      integer(c_int) :: c_placement_get_numbering
    end function

    function c_placement_update_ghosts(placement, n, components, values) bind(C, &
      name="pnpbs_placement_update_ghosts")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int64_t), value :: n
      integer(c_int32_t), value :: components
      real(c_double), intent(inout) :: values(*)
      integer(c_int) :: c_placement_update_ghosts
    end function

    function c_placement_begin_update_ghosts(placement, n, components, values) bind(C, &
      name="pnpbs_placement_begin_update_ghosts")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int64_t), value :: n
      integer(c_int32_t), value :: components
      real(c_double), intent(in) :: values(*)
      integer(c_int) :: c_placement_begin_update_ghosts
    end function

    function c_placement_end_update_ghosts(placement, n, components, values) bind(C, &
      name="pnpbs_placement_end_update_ghosts")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int64_t), value :: n
      integer(c_int32_t), value :: components
      real(c_double), intent(inout) :: values(*)
      integer(c_int) :: c_placement_end_update_ghosts
    end function

    function c_placement_add_from_ghosts(placement, n, components, values) bind(C, &
      name="pnpbs_placement_add_from_ghosts")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int64_t), value :: n
      integer(c_int32_t), value :: components
      real(c_double), intent(inout) :: values(*)
      integer(c_int) :: c_placement_add_from_ghosts
    end function

    function c_placement_sum(placement, n, components, values, sums) bind(C, &
      name="pnpbs_placement_sum")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int64_t), value :: n
      integer(c_int32_t), value :: components
      real(c_double), intent(in) :: values(*)
      real(c_double), intent(inout) :: sums(*)
      integer(c_int) :: c_placement_sum
    end function

    function c_placement_dot(placement, n, components, x, y, products) bind(C, &
      name="pnpbs_placement_dot")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int64_t), value :: n
      integer(c_int32_t), value :: components
      real(c_double), intent(in) :: x(*), y(*)
      real(c_double), intent(inout) :: products(*)
      integer(c_int) :: c_placement_dot
    end function

    function c_placement_adjacency_size(placement, entries) bind(C, &
      name="pnpbs_placement_adjacency_size")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int64_t), intent(out) :: entries
      integer(c_int) :: c_placement_adjacency_size
    end function

    function c_placement_get_adjacency(placement, capacity, offsets, neighbours) bind(C, &
      name="pnpbs_placement_get_adjacency")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int64_t), value :: capacity
      type(c_ptr), value :: offsets ! int64_t *
      type(c_ptr), value :: neighbours ! int64_t *
      integer(c_int) :: c_placement_get_adjacency
    end function

    function c_placement_star_size(placement, entries) bind(C, name="pnpbs_placement_star_size")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int64_t), intent(out) :: entries
      integer(c_int) :: c_placement_star_size
    end function

    function c_placement_get_stars(placement, capacity, offsets, neighbours, triangle) bind(C, &
      name="pnpbs_placement_get_stars")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int64_t), value :: capacity
      type(c_ptr), value :: offsets ! int64_t *
      type(c_ptr), value :: neighbours ! int64_t *
      type(c_ptr), value :: triangle ! int8_t *
      integer(c_int) :: c_placement_get_stars
    end function

    function c_placement_get_triangles(placement, capacity, count, triangles) bind(C, &
      name="pnpbs_placement_get_triangles")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(out) :: count
      type(c_ptr), value :: triangles ! int64_t *
      integer(c_int) :: c_placement_get_triangles
    end function

    function c_placement_get_tetrahedra(placement, capacity, count, tetrahedra) bind(C, &
      name="pnpbs_placement_get_tetrahedra")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(out) :: count
      type(c_ptr), value :: tetrahedra ! int64_t *
      integer(c_int) :: c_placement_get_tetrahedra
    end function

    function c_placement_get_element_tags(placement, capacity, count, tags) bind(C, &
      name="pnpbs_placement_get_element_tags")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(out) :: count
      type(c_ptr), value :: tags ! int32_t *
      integer(c_int) :: c_placement_get_element_tags
    end function

    function c_placement_get_incident_elements(placement, capacity, count, corners, elements) &
      bind(C, name="pnpbs_placement_get_incident_elements")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(out) :: count
      integer(c_int32_t), intent(out) :: corners
      type(c_ptr), value :: elements ! int64_t *
      integer(c_int) :: c_placement_get_incident_elements
    end function

    function c_placement_get_edges(placement, capacity, count, straight, ends, numbers, midpoints) &
      bind(C, name="pnpbs_placement_get_edges")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(out) :: count, straight
      type(c_ptr), value :: ends ! int64_t *
      type(c_ptr), value :: numbers ! int64_t *
      type(c_ptr), value :: midpoints ! double *
      integer(c_int) :: c_placement_get_edges
    end function

    function c_placement_find_edges(placement, n, corners, cells, edges) bind(C, &
      name="pnpbs_placement_find_edges")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int64_t), value :: n
      integer(c_int32_t), value :: corners
      integer(c_int64_t), intent(in) :: cells(*)
      integer(c_int64_t), intent(inout) :: edges(*)
      integer(c_int) :: c_placement_find_edges
    end function

    function c_placement_set_cracks(placement, n, tags) bind(C, name="pnpbs_placement_set_cracks")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int32_t), value :: n
      integer(c_int32_t), intent(in) :: tags(*)
      integer(c_int) :: c_placement_set_cracks
    end function

    function c_placement_get_crack_nodes(placement, capacity, count, all, nodes, numbers) bind(C, &
      name="pnpbs_placement_get_crack_nodes")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(out) :: count, all
      type(c_ptr), value :: nodes ! int64_t *
      type(c_ptr), value :: numbers ! int64_t *
      integer(c_int) :: c_placement_get_crack_nodes
    end function

    function c_placement_get_cracked_elements(placement, capacity, count, elements) bind(C, &
      name="pnpbs_placement_get_cracked_elements")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(out) :: count
      type(c_ptr), value :: elements ! int64_t *
      integer(c_int) :: c_placement_get_cracked_elements
    end function

    function c_placement_get_crack_facets(placement, capacity, count, covered, front, back, tags) &
      bind(C, name="pnpbs_placement_get_crack_facets")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(out) :: count
      real(c_double), intent(out) :: covered
      type(c_ptr), value :: front ! int64_t *
      type(c_ptr), value :: back ! int64_t *
      type(c_ptr), value :: tags ! int32_t *
      integer(c_int) :: c_placement_get_crack_facets
    end function

    function c_placement_get_boundary_triangles(placement, capacity, count, triangles, tags) &
      bind(C, name="pnpbs_placement_get_boundary_triangles")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(out) :: count
      type(c_ptr), value :: triangles ! int64_t *
      type(c_ptr), value :: tags ! int32_t *
      integer(c_int) :: c_placement_get_boundary_triangles
    end function

    function c_placement_get_boundary_edges(placement, capacity, count, edges, tags) bind(C, &
      name="pnpbs_placement_get_boundary_edges")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(out) :: count
      type(c_ptr), value :: edges ! int64_t *
      type(c_ptr), value :: tags ! int32_t *
      integer(c_int) :: c_placement_get_boundary_edges
    end function

    function c_placement_check(placement) bind(C, name="pnpbs_placement_check")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int) :: c_placement_check
    end function

    function c_placement_get_int64(placement, key, value) bind(C, &
      name="pnpbs_placement_get_int64")
      import
      implicit none
      type(c_ptr), value :: placement
      character(kind=c_char), intent(in) :: key(*)
      integer(c_int64_t), intent(out) :: value
      integer(c_int) :: c_placement_get_int64
    end function

    function c_placement_get_double(placement, key, value) bind(C, &
      name="pnpbs_placement_get_double")
      import
      implicit none
      type(c_ptr), value :: placement
      character(kind=c_char), intent(in) :: key(*)
      real(c_double), intent(out) :: value
      integer(c_int) :: c_placement_get_double
    end function

    function c_placement_get_string(placement, key, value) bind(C, &
      name="pnpbs_placement_get_string")
      import
      implicit none
      type(c_ptr), value :: placement
      character(kind=c_char), intent(in) :: key(*)
      type(c_ptr), intent(out) :: value
      integer(c_int) :: c_placement_get_string
    end function

    function c_placement_get_edge_bands(placement, capacity, count, d_from, d_to, edges, mean, &
      deviation) bind(C, name="pnpbs_placement_get_edge_bands")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(out) :: count
      type(c_ptr), value :: d_from ! double *
      type(c_ptr), value :: d_to ! double *
      type(c_ptr), value :: edges ! int64_t *
      type(c_ptr), value :: mean ! double *
      type(c_ptr), value :: deviation ! double *
      integer(c_int) :: c_placement_get_edge_bands
    end function

    function c_placement_get_regions(placement, capacity, count, tags, nodes, elements, measures) &
      bind(C, name="pnpbs_placement_get_regions")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(out) :: count
      type(c_ptr), value :: tags ! int32_t *
      type(c_ptr), value :: nodes ! int64_t *
      type(c_ptr), value :: elements ! int64_t *
      type(c_ptr), value :: measures ! double *
      integer(c_int) :: c_placement_get_regions
    end function

    function c_placement_get_cell_bands(placement, measure, capacity, count, d_from, d_to, number, &
      mean, worst) bind(C, name="pnpbs_placement_get_cell_bands")
      import
      implicit none
      type(c_ptr), value :: placement
      character(kind=c_char), intent(in) :: measure(*)
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(out) :: count
      type(c_ptr), value :: d_from ! double *
      type(c_ptr), value :: d_to ! double *
      type(c_ptr), value :: number ! int64_t *
      type(c_ptr), value :: mean ! double *
      type(c_ptr), value :: worst ! double *
      integer(c_int) :: c_placement_get_cell_bands
    end function

    function c_placement_warning_count(placement, count) bind(C, &
      name="pnpbs_placement_warning_count")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int32_t), intent(out) :: count
      integer(c_int) :: c_placement_warning_count
    end function

    function c_placement_get_warning(placement, index, text) bind(C, &
      name="pnpbs_placement_get_warning")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int32_t), value :: index
      type(c_ptr), intent(out) :: text
      integer(c_int) :: c_placement_get_warning
    end function

    function c_placement_get_warning_data(placement, index, code, count, value, point) bind(C, &
      name="pnpbs_placement_get_warning_data")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int32_t), value :: index
      integer(c_int32_t), intent(out) :: code
      integer(c_int64_t), intent(out) :: count
      real(c_double), intent(out) :: value
      type(c_ptr), value :: point ! double *
      integer(c_int) :: c_placement_get_warning_data
    end function

    function c_transfer_create(placement, n, components, values, transfer) bind(C, &
      name="pnpbs_transfer_create")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int64_t), value :: n
      integer(c_int32_t), value :: components
      real(c_double), intent(in) :: values(*)
      type(c_ptr), intent(out) :: transfer
      integer(c_int) :: c_transfer_create
    end function

    function c_transfer_create_second_order(placement, n, components, values, transfer) bind(C, &
      name="pnpbs_transfer_create_second_order")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int64_t), value :: n
      integer(c_int32_t), value :: components
      real(c_double), intent(in) :: values(*)
      type(c_ptr), intent(out) :: transfer
      integer(c_int) :: c_transfer_create_second_order
    end function

    function c_transfer_order(transfer, order, linear_nodes) bind(C, name="pnpbs_transfer_order")
      import
      implicit none
      type(c_ptr), value :: transfer
      integer(c_int32_t), intent(out) :: order
      integer(c_int64_t), intent(out) :: linear_nodes
      integer(c_int) :: c_transfer_order
    end function

    function c_transfer_destroy(transfer) bind(C, name="pnpbs_transfer_destroy")
      import
      implicit none
      type(c_ptr), intent(inout) :: transfer
      integer(c_int) :: c_transfer_destroy
    end function

    function c_transfer_sizes(transfer, dim, components) bind(C, name="pnpbs_transfer_sizes")
      import
      implicit none
      type(c_ptr), value :: transfer
      integer(c_int32_t), intent(out) :: dim, components
      integer(c_int) :: c_transfer_sizes
    end function

    function c_transfer_at_nodes(transfer, placement, conserve, capacity, values) bind(C, &
      name="pnpbs_transfer_at_nodes")
      import
      implicit none
      type(c_ptr), value :: transfer, placement
      integer(c_int32_t), value :: conserve
      integer(c_int64_t), value :: capacity
      real(c_double), intent(inout) :: values(*)
      integer(c_int) :: c_transfer_at_nodes
    end function

    function c_transfer_at_points(transfer, n, coordinates, values) bind(C, &
      name="pnpbs_transfer_at_points")
      import
      implicit none
      type(c_ptr), value :: transfer
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: coordinates(*)
      real(c_double), intent(inout) :: values(*)
      integer(c_int) :: c_transfer_at_points
    end function

    function c_mesh_create(placement, ghost_layers, mesh) bind(C, name="pnpbs_mesh_create")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int32_t), value :: ghost_layers
      type(c_ptr), intent(out) :: mesh
      integer(c_int) :: c_mesh_create
    end function

    function c_mesh_destroy(mesh) bind(C, name="pnpbs_mesh_destroy")
      import
      implicit none
      type(c_ptr), intent(inout) :: mesh
      integer(c_int) :: c_mesh_destroy
    end function

    function c_mesh_sizes(mesh, dim, corners, owned_nodes, nodes, owned_elements, elements, &
      facets) bind(C, name="pnpbs_mesh_sizes")
      import
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int32_t), intent(out) :: dim, corners
      integer(c_int64_t), intent(out) :: owned_nodes, nodes, owned_elements, elements, facets
      integer(c_int) :: c_mesh_sizes
    end function

    function c_mesh_numbering(mesh, first_node, all_nodes, first_element, all_elements) bind(C, &
      name="pnpbs_mesh_numbering")
      import
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int64_t), intent(out) :: first_node, all_nodes, first_element, all_elements
      integer(c_int) :: c_mesh_numbering
    end function

    function c_mesh_get_nodes(mesh, capacity, coordinates, numbers, ids, owners, tags) bind(C, &
      name="pnpbs_mesh_get_nodes")
      import
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int64_t), value :: capacity
      type(c_ptr), value :: coordinates ! double *
      type(c_ptr), value :: numbers ! int64_t *
      type(c_ptr), value :: ids ! int64_t *
      type(c_ptr), value :: owners ! int32_t *
      type(c_ptr), value :: tags ! int32_t *
      integer(c_int) :: c_mesh_get_nodes
    end function

    function c_mesh_get_elements(mesh, capacity, nodes, numbers, owners, tags) bind(C, &
      name="pnpbs_mesh_get_elements")
      import
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int64_t), value :: capacity
      type(c_ptr), value :: nodes ! int32_t *
      type(c_ptr), value :: numbers ! int64_t *
      type(c_ptr), value :: owners ! int32_t *
      type(c_ptr), value :: tags ! int32_t *
      integer(c_int) :: c_mesh_get_elements
    end function

    function c_mesh_get_connectivity(mesh, capacity, numbers) bind(C, &
      name="pnpbs_mesh_get_connectivity")
      import
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(inout) :: numbers(*)
      integer(c_int) :: c_mesh_get_connectivity
    end function

    function c_mesh_get_connectivity_int32(mesh, capacity, numbers) bind(C, &
      name="pnpbs_mesh_get_connectivity_int32")
      import
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int64_t), value :: capacity
      integer(c_int32_t), intent(inout) :: numbers(*)
      integer(c_int) :: c_mesh_get_connectivity_int32
    end function

    function c_mesh_get_facets(mesh, capacity, nodes, tags, elements, opposite, inner, owners) &
      bind(C, name="pnpbs_mesh_get_facets")
      import
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int64_t), value :: capacity
      type(c_ptr), value :: nodes ! int32_t *
      type(c_ptr), value :: tags ! int32_t *
      type(c_ptr), value :: elements ! int32_t *
      type(c_ptr), value :: opposite ! int32_t *
      type(c_ptr), value :: inner ! int8_t *
      type(c_ptr), value :: owners ! int32_t *
      integer(c_int) :: c_mesh_get_facets
    end function

    function c_mesh_sharing_sizes(mesh, nodes, entries) bind(C, name="pnpbs_mesh_sharing_sizes")
      import
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int64_t), intent(out) :: nodes, entries
      integer(c_int) :: c_mesh_sharing_sizes
    end function

    function c_mesh_get_sharing(mesh, nodes, entries, shared, offsets, ranks) bind(C, &
      name="pnpbs_mesh_get_sharing")
      import
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int64_t), value :: nodes, entries
      integer(c_int32_t), intent(inout) :: shared(*)
      integer(c_int64_t), intent(inout) :: offsets(*)
      integer(c_int32_t), intent(inout) :: ranks(*)
      integer(c_int) :: c_mesh_get_sharing
    end function

    function c_mesh_write(mesh, prefix) bind(C, name="pnpbs_mesh_write")
      import
      implicit none
      type(c_ptr), value :: mesh
      character(kind=c_char), intent(in) :: prefix(*)
      integer(c_int) :: c_mesh_write
    end function

    function c_voronoi_create(placement, voronoi) bind(C, name="pnpbs_voronoi_create")
      import
      implicit none
      type(c_ptr), value :: placement
      type(c_ptr), intent(out) :: voronoi
      integer(c_int) :: c_voronoi_create
    end function

    function c_voronoi_destroy(voronoi) bind(C, name="pnpbs_voronoi_destroy")
      import
      implicit none
      type(c_ptr), intent(inout) :: voronoi
      integer(c_int) :: c_voronoi_destroy
    end function

    function c_voronoi_sizes(voronoi, dim, nodes, faces) bind(C, name="pnpbs_voronoi_sizes")
      import
      implicit none
      type(c_ptr), value :: voronoi
      integer(c_int32_t), intent(out) :: dim
      integer(c_int64_t), intent(out) :: nodes, faces
      integer(c_int) :: c_voronoi_sizes
    end function

    function c_voronoi_get_cells(voronoi, capacity, volumes, boundary) bind(C, &
      name="pnpbs_voronoi_get_cells")
      import
      implicit none
      type(c_ptr), value :: voronoi
      integer(c_int64_t), value :: capacity
      type(c_ptr), value :: volumes ! double *
      type(c_ptr), value :: boundary ! double *
      integer(c_int) :: c_voronoi_get_cells
    end function

    function c_voronoi_get_faces(voronoi, nodes, faces, offsets, ids, numbers, areas, distances, &
      normals) bind(C, name="pnpbs_voronoi_get_faces")
      import
      implicit none
      type(c_ptr), value :: voronoi
      integer(c_int64_t), value :: nodes, faces
      type(c_ptr), value :: offsets ! int64_t *
      type(c_ptr), value :: ids ! int64_t *
      type(c_ptr), value :: numbers ! int64_t *
      type(c_ptr), value :: areas ! double *
      type(c_ptr), value :: distances ! double *
      type(c_ptr), value :: normals ! double *
      integer(c_int) :: c_voronoi_get_faces
    end function

    function c_particles_create(placement, body, particles) bind(C, name="pnpbs_particles_create")
      import
      implicit none
      type(c_ptr), value :: placement, body
      type(c_ptr), intent(out) :: particles
      integer(c_int) :: c_particles_create
    end function

    function c_particles_destroy(particles) bind(C, name="pnpbs_particles_destroy")
      import
      implicit none
      type(c_ptr), intent(inout) :: particles
      integer(c_int) :: c_particles_destroy
    end function

    function c_particles_sizes(particles, dim, count, all) bind(C, name="pnpbs_particles_sizes")
      import
      implicit none
      type(c_ptr), value :: particles
      integer(c_int32_t), intent(out) :: dim
      integer(c_int64_t), intent(out) :: count, all
      integer(c_int) :: c_particles_sizes
    end function

    function c_particles_figures(particles, left_out, moved, closest) bind(C, &
      name="pnpbs_particles_figures")
      import
      implicit none
      type(c_ptr), value :: particles
      integer(c_int64_t), intent(out) :: left_out, moved
      real(c_double), intent(out) :: closest
      integer(c_int) :: c_particles_figures
    end function

    function c_particles_get(particles, capacity, x, volumes, spacing, ids, tags) bind(C, &
      name="pnpbs_particles_get")
      import
      implicit none
      type(c_ptr), value :: particles
      integer(c_int64_t), value :: capacity
      type(c_ptr), value :: x ! double *
      type(c_ptr), value :: volumes ! double *
      type(c_ptr), value :: spacing ! double *
      type(c_ptr), value :: ids ! int64_t *
      type(c_ptr), value :: tags ! int32_t *
      integer(c_int) :: c_particles_get
    end function

    function c_particles_add_output_field(particles, name, n, components, values) bind(C, &
      name="pnpbs_particles_add_output_field")
      import
      implicit none
      type(c_ptr), value :: particles
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int64_t), value :: n
      integer(c_int32_t), value :: components
      real(c_double), intent(in) :: values(*)
      integer(c_int) :: c_particles_add_output_field
    end function

    function c_particles_write(particles, n, paths, formats) bind(C, name="pnpbs_particles_write")
      import
      implicit none
      type(c_ptr), value :: particles
      integer(c_int32_t), value :: n
      type(c_ptr), intent(in) :: paths(*)
      type(c_ptr), value :: formats ! const char *const *
      integer(c_int) :: c_particles_write
    end function

    function c_placement_write(placement, path, elements) bind(C, name="pnpbs_placement_write")
      import
      implicit none
      type(c_ptr), value :: placement
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int32_t), value :: elements
      integer(c_int) :: c_placement_write
    end function

    function c_placement_write_files(placement, n, paths, formats, elements) bind(C, &
      name="pnpbs_placement_write_files")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int32_t), value :: n
      type(c_ptr), intent(in) :: paths(*)
      type(c_ptr), value :: formats ! const char *const *
      type(c_ptr), value :: elements ! const int32_t *
      integer(c_int) :: c_placement_write_files
    end function

    function c_placement_add_output_field(placement, name, n, components, values) bind(C, &
      name="pnpbs_placement_add_output_field")
      import
      implicit none
      type(c_ptr), value :: placement
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int64_t), value :: n
      integer(c_int32_t), value :: components
      real(c_double), intent(in) :: values(*)
      integer(c_int) :: c_placement_add_output_field
    end function

    function c_placement_clear_output_fields(placement) bind(C, &
      name="pnpbs_placement_clear_output_fields")
      import
      implicit none
      type(c_ptr), value :: placement
      integer(c_int) :: c_placement_clear_output_fields
    end function

    function c_placement_write_checkpoint(placement, path) bind(C, &
      name="pnpbs_placement_write_checkpoint")
      import
      implicit none
      type(c_ptr), value :: placement
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int) :: c_placement_write_checkpoint
    end function

    function c_placement_read_checkpoint(placement, path) bind(C, &
      name="pnpbs_placement_read_checkpoint")
      import
      implicit none
      type(c_ptr), value :: placement
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int) :: c_placement_read_checkpoint
    end function

    function c_discard_unfinished_files() bind(C, name="pnpbs_discard_unfinished_files")
      import
      implicit none
      integer(c_int) :: c_discard_unfinished_files
    end function
  end interface
end module pnpbs_c
