! SPDX-License-Identifier: BSD-3-Clause
! Made from include/pnpbs/pnpbs_geo.h by scripts/fortran_layer: change that, and write this by
!   cmake --build <folder> --target pnpbs-fortran-layer
!> The C interface of libpnpbs_geo (pnpbs/pnpbs_geo.h), function by function, for the module
!> pnpbs_geo. Use that module. Bodies have the form of those in pnpbs_c.f90.
module pnpbs_geo_c
  use, intrinsic :: iso_c_binding
  implicit none
  public

  ! ------------------------------------------------------------ status and constants ----------

  !> Codes of notes. More may be added: programs must expect numbers that they do not know. In
  !> parentheses: what is counted. NO_GEOMETRY: features without a geometry are left out (features).
  !> HEIGHTS_LEFT_OUT: heights in the file are ignored. NEARLY_TOUCHING: features that may be meant
  !> as neighbours have no edge in common (features). NO_REFERENCE_SYSTEM: the file does not say
  !> what its coordinates are. DEGREES_IN_PLANE: longitude and latitude are taken as x and y. SCALE:
  !> lengths in the projection differ from those on the Earth by 2 percent or more.
  !> SEGMENTS_RETAGGED: segments of polygons have the tag of a line (segments).
  !> LINES_ALONG_BOUNDARY: lines are parts of the boundary (lines). SHARED_SEGMENTS_LEFT_OUT: they
  !> lie between polygons (segments). WHOLE_SPHERE: nothing bounds the domain. LINES_LEFT_OUT:
  !> another line has the segments with another tag (segments). SEGMENTS_LEFT_OUT: they repeat
  !> others, or lead there and back (segments).
  integer(c_int32_t), parameter :: PNPBS_GEO_NOTE_NO_GEOMETRY = 1
  integer(c_int32_t), parameter :: PNPBS_GEO_NOTE_HEIGHTS_LEFT_OUT = 2
  integer(c_int32_t), parameter :: PNPBS_GEO_NOTE_NEARLY_TOUCHING = 3
  integer(c_int32_t), parameter :: PNPBS_GEO_NOTE_NO_REFERENCE_SYSTEM = 4
  integer(c_int32_t), parameter :: PNPBS_GEO_NOTE_DEGREES_IN_PLANE = 5
  integer(c_int32_t), parameter :: PNPBS_GEO_NOTE_SCALE = 6
  integer(c_int32_t), parameter :: PNPBS_GEO_NOTE_SEGMENTS_RETAGGED = 7
  integer(c_int32_t), parameter :: PNPBS_GEO_NOTE_LINES_ALONG_BOUNDARY = 8
  integer(c_int32_t), parameter :: PNPBS_GEO_NOTE_SHARED_SEGMENTS_LEFT_OUT = 9
  integer(c_int32_t), parameter :: PNPBS_GEO_NOTE_WHOLE_SPHERE = 10
  integer(c_int32_t), parameter :: PNPBS_GEO_NOTE_LINES_LEFT_OUT = 11
  integer(c_int32_t), parameter :: PNPBS_GEO_NOTE_SEGMENTS_LEFT_OUT = 12

  ! ------------------------------------------------------------ functions ---------------------

  interface
    function c_geo_last_error() bind(C, name="pnpbs_geo_last_error")
      import
      implicit none
      type(c_ptr) :: c_geo_last_error
    end function

    function c_geo_build_info() bind(C, name="pnpbs_geo_build_info")
      import
      implicit none
      type(c_ptr) :: c_geo_build_info
    end function

    function c_geo_read(path, layer, projection, unit, tag_field, shapes) bind(C, &
      name="pnpbs_geo_read")
      import
      implicit none
      character(kind=c_char), intent(in) :: path(*), layer(*), projection(*), unit(*), tag_field(*)
      type(c_ptr), intent(out) :: shapes
      integer(c_int) :: c_geo_read
    end function

    function c_geo_read_regions(path, layer, projection, unit, tag_field, region_field, shapes) &
      bind(C, name="pnpbs_geo_read_regions")
      import
      implicit none
      character(kind=c_char), intent(in) :: path(*), layer(*), projection(*), unit(*), tag_field(*)
      character(kind=c_char), intent(in) :: region_field(*)
      type(c_ptr), intent(out) :: shapes
      integer(c_int) :: c_geo_read_regions
    end function

    function c_geo_destroy(shapes) bind(C, name="pnpbs_geo_destroy")
      import
      implicit none
      type(c_ptr), intent(inout) :: shapes
      integer(c_int) :: c_geo_destroy
    end function

    function c_geo_add_to_domain(shapes, context, domain, corner_angle) bind(C, &
      name="pnpbs_geo_add_to_domain")
      import
      implicit none
      type(c_ptr), value :: shapes, context, domain
      real(c_double), value :: corner_angle
      integer(c_int) :: c_geo_add_to_domain
    end function

    function c_geo_counts(shapes, vertices, boundary, inner, points) bind(C, &
      name="pnpbs_geo_counts")
      import
      implicit none
      type(c_ptr), value :: shapes
      integer(c_int64_t), intent(out) :: vertices, boundary, inner, points
      integer(c_int) :: c_geo_counts
    end function

    function c_geo_projection(shapes, name, unit, proj, wkt, prj) bind(C, &
      name="pnpbs_geo_projection")
      import
      implicit none
      type(c_ptr), value :: shapes
      type(c_ptr), intent(out) :: name, unit, proj, wkt, prj
      integer(c_int) :: c_geo_projection
    end function

    function c_geo_scale(shapes, least, greatest) bind(C, name="pnpbs_geo_scale")
      import
      implicit none
      type(c_ptr), value :: shapes
      real(c_double), intent(out) :: least, greatest
      integer(c_int) :: c_geo_scale
    end function

    function c_geo_write_prj(shapes, results) bind(C, name="pnpbs_geo_write_prj")
      import
      implicit none
      type(c_ptr), value :: shapes
      character(kind=c_char), intent(in) :: results(*)
      integer(c_int) :: c_geo_write_prj
    end function

    function c_geo_to_degrees(shapes, n, coordinates) bind(C, name="pnpbs_geo_to_degrees")
      import
      implicit none
      type(c_ptr), value :: shapes
      integer(c_int64_t), value :: n
      real(c_double), intent(inout) :: coordinates(*)
      integer(c_int) :: c_geo_to_degrees
    end function

    function c_geo_from_degrees(shapes, n, coordinates) bind(C, name="pnpbs_geo_from_degrees")
      import
      implicit none
      type(c_ptr), value :: shapes
      integer(c_int64_t), value :: n
      real(c_double), intent(inout) :: coordinates(*)
      integer(c_int) :: c_geo_from_degrees
    end function

    function c_geo_explain(shapes, message) bind(C, name="pnpbs_geo_explain")
      import
      implicit none
      type(c_ptr), value :: shapes
      character(kind=c_char), intent(in) :: message(*)
      type(c_ptr) :: c_geo_explain
    end function

    function c_geo_note_count(shapes, count) bind(C, name="pnpbs_geo_note_count")
      import
      implicit none
      type(c_ptr), value :: shapes
      integer(c_int32_t), intent(out) :: count
      integer(c_int) :: c_geo_note_count
    end function

    function c_geo_get_note(shapes, index, note) bind(C, name="pnpbs_geo_get_note")
      import
      implicit none
      type(c_ptr), value :: shapes
      integer(c_int32_t), value :: index
      type(c_ptr), intent(out) :: note
      integer(c_int) :: c_geo_get_note
    end function

    function c_geo_get_note_data(shapes, index, code, count) bind(C, &
      name="pnpbs_geo_get_note_data")
      import
      implicit none
      type(c_ptr), value :: shapes
      integer(c_int32_t), value :: index
      integer(c_int32_t), intent(out) :: code
      integer(c_int64_t), intent(out) :: count
      integer(c_int) :: c_geo_get_note_data
    end function

    function c_geo_grid_read(path, variable, projection, low, high, grid) bind(C, &
      name="pnpbs_geo_grid_read")
      import
      implicit none
      character(kind=c_char), intent(in) :: path(*), variable(*), projection(*)
      real(c_double), intent(in) :: low(*), high(*)
      type(c_ptr), intent(out) :: grid
      integer(c_int) :: c_geo_grid_read
    end function

    function c_geo_grid_destroy(grid) bind(C, name="pnpbs_geo_grid_destroy")
      import
      implicit none
      type(c_ptr), intent(inout) :: grid
      integer(c_int) :: c_geo_grid_destroy
    end function

    function c_geo_grid_values(grid, n, coordinates, values, inside) bind(C, &
      name="pnpbs_geo_grid_values")
      import
      implicit none
      type(c_ptr), value :: grid
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: coordinates(*)
      real(c_double), intent(inout) :: values(*)
      integer(c_int32_t), intent(inout) :: inside(*)
      integer(c_int) :: c_geo_grid_values
    end function

    function c_geo_grid_slopes(grid, radius, n, coordinates, slopes) bind(C, &
      name="pnpbs_geo_grid_slopes")
      import
      implicit none
      type(c_ptr), value :: grid
      real(c_double), value :: radius
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: coordinates(*)
      real(c_double), intent(inout) :: slopes(*)
      integer(c_int) :: c_geo_grid_slopes
    end function

    function c_geo_depth_spacing(n, depths, slopes, nodes_per_wave, period, nodes_per_slope, &
      least_depth, metres, d) bind(C, name="pnpbs_geo_depth_spacing")
      import
      implicit none
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: depths(*), slopes(*)
      real(c_double), value :: nodes_per_wave, period, nodes_per_slope, least_depth, metres
      real(c_double), intent(inout) :: d(*)
      integer(c_int) :: c_geo_depth_spacing
    end function

    function c_geo_grid_extent(grid, low, high) bind(C, name="pnpbs_geo_grid_extent")
      import
      implicit none
      type(c_ptr), value :: grid
      real(c_double), intent(inout) :: low(*), high(*)
      integer(c_int) :: c_geo_grid_extent
    end function
  end interface
end module pnpbs_geo_c
