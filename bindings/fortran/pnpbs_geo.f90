! SPDX-License-Identifier: BSD-3-Clause
!> PNPBS - geographic shapes: reads GeoJSON, shapefiles, GeoPackage and other formats of GDAL,
!> projects them by PROJ, and adds them to a domain in the plane or on a sphere. This is the Fortran
!> 2003 module of libpnpbs_geo, which exists only if PNPBS was built with GDAL.
!>
!> The module corresponds to the C interface (pnpbs/pnpbs_geo.h), which explains how polygons, lines
!> and points are interpreted. docs/guide/shapes.md has an example. The conventions of the module
!> pnpbs apply; errmsg holds the message of this library. All procedures are local. On several ranks
!> all must make the same calls.
module pnpbs_geo
  use, intrinsic :: iso_c_binding
  use pnpbs, only: pnpbs_context, pnpbs_domain
  use pnpbs_calls
  use pnpbs_geo_c
  implicit none
  private

  public :: pnpbs_geo_shapes, pnpbs_geo_grid
  public :: PNPBS_GEO_NOTE_NO_GEOMETRY, PNPBS_GEO_NOTE_HEIGHTS_LEFT_OUT
  public :: PNPBS_GEO_NOTE_NEARLY_TOUCHING, PNPBS_GEO_NOTE_NO_REFERENCE_SYSTEM
  public :: PNPBS_GEO_NOTE_DEGREES_IN_PLANE, PNPBS_GEO_NOTE_SCALE, PNPBS_GEO_NOTE_SEGMENTS_RETAGGED
  public :: PNPBS_GEO_NOTE_LINES_ALONG_BOUNDARY, PNPBS_GEO_NOTE_SHARED_SEGMENTS_LEFT_OUT
  public :: PNPBS_GEO_NOTE_WHOLE_SPHERE, PNPBS_GEO_NOTE_LINES_LEFT_OUT
  public :: PNPBS_GEO_NOTE_SEGMENTS_LEFT_OUT
  public :: pnpbs_geo_last_error, pnpbs_geo_build_info, pnpbs_geo_depth_spacing

  !> Shapes of one layer of a file, projected.
  type :: pnpbs_geo_shapes
    private
    type(c_ptr) :: c = c_null_ptr
  contains
    procedure :: read => geo_read
    procedure :: destroy => geo_destroy
    procedure :: add_to_domain => geo_add_to_domain
    procedure :: counts => geo_counts
    procedure :: projection => geo_projection
    procedure :: scale => geo_scale
    procedure :: write_prj => geo_write_prj
    procedure :: to_degrees => geo_to_degrees
    procedure :: from_degrees => geo_from_degrees
    procedure :: explain => geo_explain
    procedure :: note_count => geo_note_count
    procedure :: get_note => geo_get_note
    procedure :: get_note_data => geo_get_note_data
  end type

  !> Values on a grid in a file: GeoTIFF, NetCDF and other formats that GDAL reads.
  type :: pnpbs_geo_grid
    private
    type(c_ptr) :: c = c_null_ptr
  contains
    procedure :: read => grid_read
    procedure :: destroy => grid_destroy
    procedure :: values => grid_values
    procedure :: slopes => grid_slopes
    procedure :: extent => grid_extent
  end type

contains

  !> Returns the message of the last error of this library on the calling thread; '' if there was
  !> none. Local.
  function pnpbs_geo_last_error() result(text)
    character(len=:), allocatable :: text
    text = text_of(c_geo_last_error())
  end function

  !> Returns the versions of GDAL and PROJ in use, one "name: version" per line. Local.
  function pnpbs_geo_build_info() result(text)
    character(len=:), allocatable :: text
    text = text_of(c_geo_build_info())
  end function

  !> Reads one layer of a file and projects it. Destroy previously read shapes first. Local.
  !>   path        a file, or anything else that GDAL opens
  !>   layer       optional: the name of the layer; default: the only one
  !>   projection  optional: the coordinate system of x and y: 'auto', 'none', a code ('EPSG:2180'),
  !>               a PROJ string, WKT, the path of a .prj file, or, for a domain on a sphere,
  !>               'sphere(LON,LAT)' with longitude and latitude of the point outside. By default
  !>               longitude and latitude are projected as by 'auto', and projected coordinates are
  !>               kept
  !>   unit        optional: 'm' or 'km'; default: the unit of the projection, mostly metres
  !>   tag_field   optional: the attribute that becomes the tag; default: all tags are 1
  !>   region_field  optional: the attribute of polygons that becomes the tag of the elements in
  !>                 them: an integer as it is, 0 for none; if other values occur, all are numbered
  !>                 from 1 in sorted order and named; default: no regions
  subroutine geo_read(self, path, layer, projection, unit, tag_field, region_field, stat, errmsg)
    class(pnpbs_geo_shapes), intent(inout) :: self
    character(len=*), intent(in) :: path
    character(len=*), intent(in), optional :: layer, projection, unit, tag_field
    character(len=*), intent(in), optional :: region_field
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int) :: status
    status = c_geo_read_regions(c_text(path), given_text(layer), given_text(projection), &
                                given_text(unit), given_text(tag_field), &
                                given_text(region_field), self%c)
    call conclude_geo('read', status, stat, errmsg)
  end subroutine

  !> Destroys the shapes. Shapes that were added to domains remain there. Local.
  subroutine geo_destroy(self, stat, errmsg)
    class(pnpbs_geo_shapes), intent(inout) :: self
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude_geo('destroy', c_geo_destroy(self%c), stat, errmsg)
  end subroutine

  !> Adds the shapes to a domain in the plane or on a sphere: curves as domain%add_polyline does,
  !> points as domain%add_fixed_nodes does, and names of tags for dimension 1. domain%check finds
  !> curves that cross or do not close; see explain. Local.
  !>   context       the context of the domain
  !>   corner_angle  optional: degrees, 0 .. 180, as in domain%add_polyline. Default: 0, every
  !>                 vertex becomes a node
  subroutine geo_add_to_domain(self, context, domain, corner_angle, stat, errmsg)
    class(pnpbs_geo_shapes), intent(in) :: self
    type(pnpbs_context), intent(in) :: context
    type(pnpbs_domain), intent(in) :: domain
    real(c_double), intent(in), optional :: corner_angle
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    real(c_double) :: angle
    integer(c_int) :: status
    angle = 0
    if (present(corner_angle)) angle = corner_angle
    status = c_geo_add_to_domain(self%c, pointer_of(context%handle()), &
                                 pointer_of(domain%handle()), angle)
    call conclude_geo('add_to_domain', status, stat, errmsg)
  end subroutine

  !> Returns the numbers of entities that were read. Local.
  !>   vertices  distinct positions, including those of points
  !>   boundary  boundary curves, which are closed or lie between the vertices where curves meet
  !>   inner     inner curves, likewise
  !>   points    fixed nodes
  subroutine geo_counts(self, vertices, boundary, inner, points, stat, errmsg)
    class(pnpbs_geo_shapes), intent(in) :: self
    integer(c_int64_t), intent(out), optional :: vertices, boundary, inner, points
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: found(4)
    found = 0
    call conclude_geo('counts', c_geo_counts(self%c, found(1), found(2), found(3), found(4)), stat, &
                      errmsg)
    if (present(vertices)) vertices = found(1)
    if (present(boundary)) boundary = found(2)
    if (present(inner)) inner = found(3)
    if (present(points)) points = found(4)
  end subroutine

  !> Returns the projection as texts, which are '' if the file does not define its coordinate
  !> system, or if a form cannot express it. Local.
  !>   name  e.g. 'WGS 84 / UTM zone 34N'
  !>   unit  the unit of x and y, e.g. 'metre'
  !>   proj  the PROJ string, which may omit parts that it cannot express
  !>   wkt   WKT 2 (ISO 19162:2019), complete; accepted by read
  !>   prj   WKT 1 as defined by ESRI, the content of .prj files
  subroutine geo_projection(self, name, unit, proj, wkt, prj, stat, errmsg)
    class(pnpbs_geo_shapes), intent(in) :: self
    character(len=:), allocatable, intent(out), optional :: name, unit, proj, wkt, prj
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(c_ptr) :: c_name, c_unit, c_proj, c_wkt, c_prj
    integer(c_int) :: status
    status = c_geo_projection(self%c, c_name, c_unit, c_proj, c_wkt, c_prj)
    call conclude_geo('projection', status, stat, errmsg)
    if (status < 0) return
    if (present(name)) name = text_of(c_name)
    if (present(unit)) unit = text_of(c_unit)
    if (present(proj)) proj = text_of(c_proj)
    if (present(wkt)) wkt = text_of(c_wkt)
    if (present(prj)) prj = text_of(c_prj)
  end subroutine

  !> Returns the range of the scale, which is projected length over length on the Earth, along
  !> meridians and parallels at up to some thousand vertices. d deviates by this factor. Both are 1
  !> if the scale is not known. Local.
  subroutine geo_scale(self, least, greatest, stat, errmsg)
    class(pnpbs_geo_shapes), intent(in) :: self
    real(c_double), intent(out) :: least, greatest
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    least = 1
    greatest = 1
    call conclude_geo('scale', c_geo_scale(self%c, least, greatest), stat, errmsg)
  end subroutine

  !> Writes the projection next to a file of results, as for shapefiles: for 'out/nodes.vtu' it
  !> writes or replaces 'out/nodes.prj'. Local; on several ranks call it on one of them.
  subroutine geo_write_prj(self, results, stat, errmsg)
    class(pnpbs_geo_shapes), intent(in) :: self
    character(len=*), intent(in) :: results
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude_geo('write_prj', c_geo_write_prj(self%c, c_text(results)), stat, errmsg)
  end subroutine

  !> Converts x and y to longitude and latitude in degrees, on the ellipsoid of the file; in place.
  !> Values that do not exist become infinite. Local.
  !>   coordinates  (2, n), in and out
  subroutine geo_to_degrees(self, coordinates, stat, errmsg)
    class(pnpbs_geo_shapes), intent(in) :: self
    real(c_double), intent(inout) :: coordinates(:,:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call converted('to_degrees', c_geo_to_degrees, self, coordinates, stat, errmsg)
  end subroutine

  !> Converts longitude and latitude in degrees to x and y, in place. Values that do not exist
  !> become infinite. Local.
  !>   coordinates  (2, n), in and out
  subroutine geo_from_degrees(self, coordinates, stat, errmsg)
    class(pnpbs_geo_shapes), intent(in) :: self
    real(c_double), intent(inout) :: coordinates(:,:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call converted('from_degrees', c_geo_from_degrees, self, coordinates, stat, errmsg)
  end subroutine

  !> Returns the message of the last error about a domain of these shapes, with longitude and
  !> latitude after each point "(x, y)", then the features with a segment there. Where curves cross,
  !> advice follows in a line of its own. Any other text is returned without changes. Local.
  function geo_explain(self, message) result(text)
    class(pnpbs_geo_shapes), intent(in) :: self
    character(len=*), intent(in) :: message
    character(len=:), allocatable :: text
    text = text_of(c_geo_explain(self%c, c_text(message)))
  end function

  !> Returns the number of notes on how the file was interpreted. Local.
  subroutine geo_note_count(self, count, stat, errmsg)
    class(pnpbs_geo_shapes), intent(in) :: self
    integer(c_int32_t), intent(out) :: count
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    count = 0
    call conclude_geo('note_count', c_geo_note_count(self%c, count), stat, errmsg)
  end subroutine

  !> Returns one of the notes as data. Local.
  !>   index  1 .. count of notes
  !>   code   one of PNPBS_GEO_NOTE_...
  !>   count  number of features, lines or segments that the note is about; 0 if they are not
  !>          counted
  subroutine geo_get_note_data(self, index, code, count, stat, errmsg)
    class(pnpbs_geo_shapes), intent(in) :: self
    integer(c_int32_t), intent(in) :: index
    integer(c_int32_t), intent(out) :: code
    integer(c_int64_t), intent(out) :: count
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    code = 0
    count = 0
    call conclude_geo('get_note_data', &
                      c_geo_get_note_data(self%c, index - 1_c_int32_t, code, count), stat, errmsg)
  end subroutine

  !> Returns one of the notes. Local.
  !>   index  1 .. count
  subroutine geo_get_note(self, index, note, stat, errmsg)
    class(pnpbs_geo_shapes), intent(in) :: self
    integer(c_int32_t), intent(in) :: index
    character(len=:), allocatable, intent(out) :: note
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(c_ptr) :: c
    integer(c_int) :: status
    note = ''
    status = c_geo_get_note(self%c, index - 1_c_int32_t, c)
    call conclude_geo('get_note', status, stat, errmsg)
    if (status >= 0) note = text_of(c)
  end subroutine

  ! ------------------------------------------------------------ grids -------------------------

  !> Opens a part of a grid. Destroy a previously opened grid first. Local.
  !>   path        a file, or anything else that GDAL opens
  !>   low, high   (2) opposite corners of the requested part, in the projection of the points, e.g.
  !>               from domain%bounds
  !>   variable    optional: the name of a variable in a file of several, or the number of a band
  !>   projection  optional: the projection of the points at which the grid is evaluated, e.g. the
  !>               wkt of shapes%projection; default: the coordinate system of the grid
  subroutine grid_read(self, path, low, high, variable, projection, stat, errmsg)
    class(pnpbs_geo_grid), intent(inout) :: self
    character(len=*), intent(in) :: path
    real(c_double), intent(in) :: low(:), high(:)
    character(len=*), intent(in), optional :: variable, projection
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    integer(c_int) :: status
    call given%check_rows('low', size(low), 2)
    call given%check_rows('high', size(high), 2)
    status = given%found()
    if (.not. given%is_wrong()) &
      status = c_geo_grid_read(c_text(path), given_text(variable), given_text(projection), low, &
                               high, self%c)
    call conclude_grid('read', status, stat, errmsg, given)
  end subroutine

  !> Destroys the grid. Local.
  subroutine grid_destroy(self, stat, errmsg)
    class(pnpbs_geo_grid), intent(inout) :: self
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude_grid('destroy', c_geo_grid_destroy(self%c), stat, errmsg)
  end subroutine

  !> Evaluates the grid at points. Values are linear in each direction between the centres of the
  !> cells, and constant beyond the edge. Cells without data have the value of the nearest cell with
  !> data. Local.
  !>   coordinates  (2, n)
  !>   values       (n)
  !>   inside       optional: (n), false if a point lies half a cell or more beyond the edge; true
  !>                also if no cell around it has data
  subroutine grid_values(self, coordinates, values, inside, stat, errmsg)
    class(pnpbs_geo_grid), intent(in) :: self
    real(c_double), intent(in) :: coordinates(:,:)
    real(c_double), intent(out) :: values(:)
    logical, intent(out), optional :: inside(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    integer(c_int32_t), allocatable :: within(:)
    integer(c_int) :: status
    values = 0
    call given%check_rows('coordinates', size(coordinates, 1), 2)
    call given%check_rows('values', size(values), size(coordinates, 2))
    if (present(inside)) call given%check_rows('inside', size(inside), size(coordinates, 2))
    status = given%found()
    allocate (within(size(values)))
    within = 0
    if (.not. given%is_wrong()) &
      status = c_geo_grid_values(self%c, size(values, kind=c_int64_t), coordinates, values, within)
    if (present(inside) .and. .not. given%is_wrong()) inside = within /= 0
    call conclude_grid('values', status, stat, errmsg, given)
  end subroutine

  !> Computes the slope of the grid at points: the change of its values per unit of length. Local.
  !>   coordinates  (2, n)
  !>   slopes       (n)
  !>   radius       optional: radius of the sphere along which lengths are measured, if the points
  !>                are longitude and latitude in degrees; default: lengths are those in the plane
  !>                of the points
  subroutine grid_slopes(self, coordinates, slopes, radius, stat, errmsg)
    class(pnpbs_geo_grid), intent(in) :: self
    real(c_double), intent(in) :: coordinates(:,:)
    real(c_double), intent(out) :: slopes(:)
    real(c_double), intent(in), optional :: radius
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    real(c_double) :: of_sphere
    integer(c_int) :: status
    slopes = 0
    of_sphere = 0
    if (present(radius)) of_sphere = radius
    call given%check_rows('coordinates', size(coordinates, 1), 2)
    call given%check_rows('slopes', size(slopes), size(coordinates, 2))
    status = given%found()
    if (.not. given%is_wrong()) &
      status = c_geo_grid_slopes(self%c, of_sphere, size(slopes, kind=c_int64_t), coordinates, slopes)
    call conclude_grid('slopes', status, stat, errmsg, given)
  end subroutine

  !> Returns the spacing of models of tides and surges by the depth h of the water: the lesser of
  !> the spacings by the length of waves and by the slope of the bottom. Water shallower than least,
  !> and land, count as flat at that depth. Local.
  !>   depths  (n), metres, positive down: elevations must be negated
  !>   d       (n)
  !>   metres  metres per unit of length, for example 1000 for kilometres
  !>   slopes  optional: (n), slopes of the depths, metres per unit of length, as from grid%slopes
  !>   wave    optional: number of nodes per length of a long wave; default: 30; 0 for no such bound
  !>   period  optional: period of the wave in seconds; default: 44712, that of the tide M2
  !>   slope   optional: number of nodes per 2 pi h / |grad h|; default: 0, for no such bound
  !>   least   optional: least depth in metres; default: 10
  subroutine pnpbs_geo_depth_spacing(depths, d, metres, slopes, wave, period, slope, least, stat, &
                                     errmsg)
    real(c_double), intent(in) :: depths(:)
    real(c_double), intent(out) :: d(:)
    real(c_double), intent(in) :: metres
    real(c_double), intent(in), optional :: slopes(:), wave, period, slope, least
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    real(c_double), allocatable :: steep(:)
    real(c_double) :: rule(4)
    integer(c_int) :: status
    d = 0
    rule = [30d0, 44712d0, 0d0, 10d0]
    if (present(wave)) rule(1) = wave
    if (present(period)) rule(2) = period
    if (present(slope)) rule(3) = slope
    if (present(least)) rule(4) = least
    call given%check_rows('d', size(d), size(depths))
    if (present(slopes)) call given%check_rows('slopes', size(slopes), size(depths))
    if (rule(3) > 0 .and. .not. present(slopes)) call given%check_rows('slopes', 0, size(depths))
    status = given%found()
    allocate (steep(size(depths)))
    steep = 0
    if (present(slopes) .and. .not. given%is_wrong()) steep = slopes
    if (.not. given%is_wrong()) &
      status = c_geo_depth_spacing(size(depths, kind=c_int64_t), depths, steep, rule(1), rule(2), &
                                   rule(3), rule(4), metres, d)
    call conclude('depth_spacing', status, stat, errmsg, given, pnpbs_geo_last_error())
  end subroutine

  !> Returns the bounding box of the whole grid in the file, in the projection of the points. Local.
  !>   low, high  (2)
  subroutine grid_extent(self, low, high, stat, errmsg)
    class(pnpbs_geo_grid), intent(in) :: self
    real(c_double), intent(out) :: low(:), high(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    integer(c_int) :: status
    low = 0
    high = 0
    call given%check_rows('low', size(low), 2)
    call given%check_rows('high', size(high), 2)
    status = given%found()
    if (.not. given%is_wrong()) status = c_geo_grid_extent(self%c, low, high)
    call conclude_grid('extent', status, stat, errmsg, given)
  end subroutine

  ! ------------------------------------------------------------ small helpers -----------------

  subroutine conclude_grid(called, status, stat, errmsg, given)
    character(len=*), intent(in) :: called
    integer(c_int), intent(in) :: status
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    class(arguments), intent(in), optional :: given
    call conclude('grid%' // called, status, stat, errmsg, given, pnpbs_geo_last_error())
  end subroutine

  ! Converts points in place by a C function between degrees and x, y.
  subroutine converted(called, convert, self, coordinates, stat, errmsg)
    character(len=*), intent(in) :: called
    procedure(c_geo_to_degrees) :: convert
    class(pnpbs_geo_shapes), intent(in) :: self
    real(c_double), intent(inout) :: coordinates(:,:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    integer(c_int) :: status
    call given%check_rows('coordinates', size(coordinates, 1), 2)
    status = given%found()
    if (.not. given%is_wrong()) &
      status = convert(self%c, size(coordinates, 2, kind=c_int64_t), coordinates)
    call conclude_geo(called, status, stat, errmsg, given)
  end subroutine

  subroutine conclude_geo(called, status, stat, errmsg, given)
    character(len=*), intent(in) :: called
    integer(c_int), intent(in) :: status
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    class(arguments), intent(in), optional :: given
    call conclude('shapes%' // called, status, stat, errmsg, given, pnpbs_geo_last_error())
  end subroutine

  ! Returns the text of an optional argument; an absent one is '' in C.
  function given_text(text) result(c)
    character(len=*), intent(in), optional :: text
    character(kind=c_char, len=:), allocatable :: c
    c = c_null_char
    if (present(text)) c = c_text(text)
  end function
end module pnpbs_geo
