! SPDX-License-Identifier: BSD-3-Clause
!> PNPBS - parallel node placement by bubble simulation: the Fortran 2003 module.
!>
!> The module corresponds to the C interface (pnpbs/pnpbs.h), which defines the terms node, spacing,
!> boundary, tag, adjacency and star. docs/fortran.md has an example.
!>
!> Conventions of every procedure
!>   stat        optional: an integer of four or eight bytes, set to the outcome: PNPBS_OK (0), > 0
!>               an outcome with valid results, < 0 an error, after which nothing has changed.
!>               Without stat an error writes its message to standard error and stops the program
!>               with exit status 1; outcomes > 0 do not.
!>   errmsg      optional: set to the message of an error; otherwise unchanged.
!>   collective  "Collective" procedures must be called by all ranks of the context, in the same
!>               order, and have the same outcome on all of them. "Local" ones may be called by any
!>               rank.
!>   arrays      belong to the caller, are read or filled during the call, and are never kept.
!>               Coordinates are (dim, n) with dim = 2 in the plane, 3 in space and on a sphere;
!>               another number of rows is PNPBS_ERROR_ARGUMENT. Output arrays may be larger than
!>               needed; too small ones are PNPBS_ERROR_CAPACITY. Output arrays and optional arrays
!>               must be contiguous in memory: whole arrays, or their sections x(i:j) and x(:,i:j).
!>   dimension   procedures for domains or placements "in the plane" or "in space" reject others
!>               with PNPBS_ERROR_ARGUMENT; all others are for both.
!>   integers    ids, counts, indices and offsets are integer(c_int64_t), the others
!>               integer(c_int32_t), as are the local indices of a pnpbs_mesh. Local indices and
!>               offsets count from 1; ids and numbers of nodes and elements are the same as in C,
!>               ranks are as in MPI.
!>   objects     are handles: a copy refers to the same object. There is no finalisation: call
!>               destroy, in any order. A dead handle returns PNPBS_ERROR_HANDLE.
!>   callbacks   are module procedures with bind(C) and the interface stated; they run on the
!>               calling thread, one at a time. Inside a callback only queries of the library work.
module pnpbs
  use, intrinsic :: iso_c_binding
  use pnpbs_c
  use pnpbs_calls
  implicit none
  private

  public :: PNPBS_OK, PNPBS_NOT_CONVERGED, PNPBS_STOPPED, PNPBS_SPACING_MISSED
  public :: PNPBS_NOT_CONFORMING
  public :: PNPBS_ERROR_ARGUMENT, PNPBS_ERROR_HANDLE, PNPBS_ERROR_STATE, PNPBS_ERROR_DOMAIN
  public :: PNPBS_ERROR_SPACING, PNPBS_ERROR_KEY, PNPBS_ERROR_CAPACITY, PNPBS_ERROR_FILE
  public :: PNPBS_ERROR_CALLBACK, PNPBS_ERROR_MEMORY, PNPBS_ERROR_MPI, PNPBS_ERROR_KOKKOS
  public :: PNPBS_ERROR_UNSUPPORTED, PNPBS_ERROR_INTERNAL
  public :: PNPBS_BOUNDARY, PNPBS_INNER
  public :: PNPBS_OVERLAP_LAST, PNPBS_OVERLAP_FIRST, PNPBS_OVERLAP_OWN
  public :: PNPBS_REASON_OTHER, PNPBS_REASON_CROSSING, PNPBS_WARNING_UNKNOWN
  public :: PNPBS_WARNING_LEFT_OUT_OUTSIDE, PNPBS_WARNING_UNUSED_VERTICES
  public :: PNPBS_WARNING_REGION_POINTS, PNPBS_WARNING_SIMPLIFIED, PNPBS_WARNING_REPAIRED
  public :: PNPBS_WARNING_TRIANGLES_LEFT_OUT, PNPBS_WARNING_TRIANGLES_TURNED
  public :: PNPBS_WARNING_VERTICES_MERGED, PNPBS_WARNING_SURFACES_TOUCH
  public :: PNPBS_WARNING_PIECES_LEFT_OUT, PNPBS_WARNING_EDGES_ROUNDED
  public :: PNPBS_WARNING_CREASES_IGNORED, PNPBS_WARNING_FEATURE_ANGLE
  public :: PNPBS_WARNING_CURVED_ELEMENTS, PNPBS_WARNING_GROUPS, PNPBS_WARNING_FEATURE_UNRESOLVED
  public :: PNPBS_WARNING_FIXED_NODES_CLOSE, PNPBS_WARNING_GROWTH, PNPBS_WARNING_PARTIAL_EXTENT
  public :: PNPBS_WARNING_SPACING_COARSE, PNPBS_WARNING_SPACING_MISSED, PNPBS_WARNING_SPACING_HELD
  public :: PNPBS_WARNING_BOUNDARY_NOT_FOLLOWED, PNPBS_WARNING_NOT_CONFORMING
  public :: PNPBS_WARNING_SMALL_ANGLES, PNPBS_WARNING_FEATURES_LEFT_OUT
  public :: PNPBS_WARNING_OPTION_WITHOUT_EFFECT, PNPBS_WARNING_OPTIONS_CHANGED
  public :: PNPBS_WARNING_DEPENDS_ON_RANKS
  public :: PNPBS_VERSION_MAJOR, PNPBS_VERSION_MINOR, PNPBS_VERSION_PATCH
  public :: pnpbs_curve_fn, pnpbs_level_set_fn, pnpbs_spacing_fn, pnpbs_monitor_fn
  public :: pnpbs_context, pnpbs_domain, pnpbs_placement, pnpbs_transfer, pnpbs_mesh
  public :: pnpbs_voronoi, pnpbs_particles
  public :: pnpbs_status_string, pnpbs_last_error, pnpbs_version, pnpbs_build_info
  public :: pnpbs_mpi_library, pnpbs_finalize, pnpbs_discard_unfinished_files
  public :: pnpbs_sphere_points, pnpbs_sphere_degrees, pnpbs_file_dimension
  public :: pnpbs_option_count, pnpbs_option_info, pnpbs_statistic_count, pnpbs_statistic_info
  public :: pnpbs_format_count, pnpbs_format_info

  ! ------------------------------------------------------------ types -------------------------

  !> A context: one process, or the ranks of an MPI communicator.
  type :: pnpbs_context
    private
    type(c_ptr) :: c = c_null_ptr
  contains
    procedure :: create_serial => context_create_serial
    procedure :: create_mpi => context_create_mpi
    procedure :: destroy => context_destroy
    procedure, private :: context_set_text
    procedure, private :: context_set_int32
    procedure, private :: context_set_int64
    procedure, private :: context_set_real
    generic :: set => context_set_text, context_set_int32, context_set_int64, context_set_real
    procedure :: last_error => context_last_error
    procedure :: last_error_data => context_last_error_data
    procedure :: last_error_point => context_last_error_point
    procedure :: handle => context_handle
    procedure :: from_handle => context_from_handle
  end type

  !> A domain, which is filled with nodes.
  type :: pnpbs_domain
    private
    type(c_ptr) :: c = c_null_ptr
  contains
    procedure :: create => domain_create
    procedure :: create_sphere => domain_create_sphere
    procedure :: destroy => domain_destroy
    procedure :: dimension => domain_dimension
    procedure :: add_polyline => domain_add_polyline
    procedure :: add_surface => domain_add_surface
    procedure :: read_surface => domain_read_surface
    procedure :: set_role => domain_set_role
    procedure :: read_msh => domain_read_msh
    procedure :: set_tag_name => domain_set_tag_name
    procedure :: tag_name_count => domain_tag_name_count
    procedure :: get_tag_name => domain_get_tag_name
    procedure :: add_box => domain_add_box
    procedure :: add_ball => domain_add_ball
    procedure :: add_cylinder => domain_add_cylinder
    procedure :: add_level_set => domain_add_level_set
    procedure :: add_arc => domain_add_arc
    procedure :: add_curve => domain_add_curve
    procedure :: add_pslg => domain_add_pslg
    procedure :: set_filled => domain_set_filled
    procedure :: set_repair => domain_set_repair
    procedure :: set_resurfaced => domain_set_resurfaced
    procedure :: set_fragment => domain_set_fragment
    procedure :: set_periodic => domain_set_periodic
    procedure :: add_hole => domain_add_hole
    procedure :: add_region => domain_add_region
    procedure :: add_fixed_nodes => domain_add_fixed_nodes
    procedure :: read_poly => domain_read_poly
    procedure :: parse_poly => domain_parse_poly
    procedure :: set_corner_angle => domain_set_corner_angle
    procedure :: set_snap => domain_set_snap
    procedure :: tag_outline => domain_tag_outline
    procedure :: simplify => domain_simplify
    procedure :: simplify_by_file => domain_simplify_by_file
    procedure :: add_offset => domain_add_offset
    procedure :: check => domain_check
    procedure :: bounds => domain_bounds
    procedure :: measure => domain_measure
    procedure :: distance => domain_distance
    procedure, private :: domain_regions_at
    procedure, private :: domain_regions_at_columns
    generic :: regions_at => domain_regions_at, domain_regions_at_columns
    procedure :: shape_spacing => domain_shape_spacing
    procedure :: segment_count => domain_segment_count
    procedure :: get_segments => domain_get_segments
    procedure :: handle => domain_handle
    procedure :: from_handle => domain_from_handle
  end type

  !> A placement: the nodes in a domain, and the runs that compute them.
  type :: pnpbs_placement
    private
    type(c_ptr) :: c = c_null_ptr
  contains
    procedure :: create => placement_create
    procedure :: destroy => placement_destroy
    procedure, private :: placement_set_text
    procedure, private :: placement_set_int32
    procedure, private :: placement_set_int64
    procedure, private :: placement_set_real
    generic :: set => placement_set_text, placement_set_int32, placement_set_int64, &
      placement_set_real
    procedure :: set_spacing_constant => placement_set_spacing_constant
    procedure :: set_spacing_callback => placement_set_spacing_callback
    procedure, private :: placement_set_spacing_grid
    procedure, private :: placement_set_spacing_grid_in_space
    generic :: set_spacing_grid => placement_set_spacing_grid, placement_set_spacing_grid_in_space
    procedure :: set_spacing_mesh => placement_set_spacing_mesh
    procedure :: set_spacing_points => placement_set_spacing_points
    procedure :: set_spacing_file => placement_set_spacing_file
    procedure :: set_spacing_from_shape => placement_set_spacing_from_shape
    procedure :: set_spacing_at_nodes => placement_set_spacing_at_nodes
    procedure :: add_spacing_hints => placement_add_spacing_hints
    procedure :: set_monitor => placement_set_monitor
    procedure :: set_nodes => placement_set_nodes
    procedure :: estimate => placement_estimate
    procedure :: initialise => placement_initialise
    procedure, private :: placement_step_int32
    procedure, private :: placement_step_int64
    generic :: step => placement_step_int32, placement_step_int64
    procedure :: adjust_population => placement_adjust_population
    procedure :: rebalance => placement_rebalance
    procedure :: run => placement_run
    procedure :: dimension => placement_dimension
    procedure :: sphere_radius => placement_sphere_radius
    procedure :: count => placement_count
    procedure :: get_nodes => placement_get_nodes
    procedure :: get_normals => placement_get_normals
    procedure :: ghost_count => placement_ghost_count
    procedure :: get_ghosts => placement_get_ghosts
    procedure :: exchange_sizes => placement_exchange_sizes
    procedure :: get_exchange => placement_get_exchange
    procedure :: get_numbering => placement_get_numbering
    procedure, private :: placement_update_ghosts
    procedure, private :: placement_update_ghosts_columns
    generic :: update_ghosts => placement_update_ghosts, placement_update_ghosts_columns
    procedure, private :: placement_begin_update_ghosts
    procedure, private :: placement_begin_update_ghosts_columns
    generic :: begin_update_ghosts => placement_begin_update_ghosts, &
      placement_begin_update_ghosts_columns
    procedure, private :: placement_end_update_ghosts
    procedure, private :: placement_end_update_ghosts_columns
    generic :: end_update_ghosts => placement_end_update_ghosts, &
      placement_end_update_ghosts_columns
    procedure, private :: placement_add_from_ghosts
    procedure, private :: placement_add_from_ghosts_columns
    generic :: add_from_ghosts => placement_add_from_ghosts, placement_add_from_ghosts_columns
    procedure, private :: placement_sum
    procedure, private :: placement_sum_columns
    generic :: sum => placement_sum, placement_sum_columns
    procedure, private :: placement_dot
    procedure, private :: placement_dot_columns
    generic :: dot => placement_dot, placement_dot_columns
    procedure :: adjacency_size => placement_adjacency_size
    procedure :: get_adjacency => placement_get_adjacency
    procedure :: star_size => placement_star_size
    procedure, private :: placement_get_stars
    procedure, private :: placement_get_stars_logical
    generic :: get_stars => placement_get_stars, placement_get_stars_logical
    procedure :: triangle_count => placement_triangle_count
    procedure :: get_triangles => placement_get_triangles
    procedure :: tetrahedron_count => placement_tetrahedron_count
    procedure :: get_tetrahedra => placement_get_tetrahedra
    procedure :: get_element_tags => placement_get_element_tags
    procedure :: incident_element_count => placement_incident_element_count
    procedure :: get_incident_elements => placement_get_incident_elements
    procedure :: edge_count => placement_edge_count
    procedure :: get_edges => placement_get_edges
    procedure :: find_edges => placement_find_edges
    procedure :: set_cracks => placement_set_cracks
    procedure :: crack_node_count => placement_crack_node_count
    procedure :: get_crack_nodes => placement_get_crack_nodes
    procedure :: get_cracked_elements => placement_get_cracked_elements
    procedure :: crack_facet_count => placement_crack_facet_count
    procedure :: get_crack_facets => placement_get_crack_facets
    procedure :: boundary_triangle_count => placement_boundary_triangle_count
    procedure :: get_boundary_triangles => placement_get_boundary_triangles
    procedure :: boundary_edge_count => placement_boundary_edge_count
    procedure :: get_boundary_edges => placement_get_boundary_edges
    procedure :: check => placement_check
    procedure, private :: placement_get_int64
    procedure, private :: placement_get_real
    procedure, private :: placement_get_text
    generic :: get => placement_get_int64, placement_get_real, placement_get_text
    procedure :: edge_band_count => placement_edge_band_count
    procedure :: get_edge_bands => placement_get_edge_bands
    procedure :: region_count => placement_region_count
    procedure :: get_regions => placement_get_regions
    procedure :: cell_band_count => placement_cell_band_count
    procedure :: get_cell_bands => placement_get_cell_bands
    procedure :: warning_count => placement_warning_count
    procedure :: get_warning => placement_get_warning
    procedure :: get_warning_data => placement_get_warning_data
    procedure :: write => placement_write
    procedure :: write_files => placement_write_files
    procedure, private :: placement_add_output_field
    procedure, private :: placement_add_output_field_columns
    generic :: add_output_field => placement_add_output_field, placement_add_output_field_columns
    procedure :: clear_output_fields => placement_clear_output_fields
    procedure :: write_checkpoint => placement_write_checkpoint
    procedure :: read_checkpoint => placement_read_checkpoint
    procedure :: handle => placement_handle
    procedure :: from_handle => placement_from_handle
  end type

  !> A transfer of a field to other nodes.
  type :: pnpbs_transfer
    private
    type(c_ptr) :: c = c_null_ptr
  contains
    procedure, private :: transfer_create
    procedure, private :: transfer_create_columns
    generic :: create => transfer_create, transfer_create_columns
    procedure, private :: transfer_create_second_order
    procedure, private :: transfer_create_second_order_columns
    generic :: create_second_order => transfer_create_second_order, &
      transfer_create_second_order_columns
    procedure :: order => transfer_order
    procedure :: destroy => transfer_destroy
    procedure :: sizes => transfer_sizes
    procedure, private :: transfer_at_nodes
    procedure, private :: transfer_at_nodes_columns
    generic :: at_nodes => transfer_at_nodes, transfer_at_nodes_columns
    procedure, private :: transfer_at_points
    procedure, private :: transfer_at_points_columns
    generic :: at_points => transfer_at_points, transfer_at_points_columns
    procedure :: handle => transfer_handle
    procedure :: from_handle => transfer_from_handle
  end type

  !> A distributed mesh: the nodes, elements and facets of a rank, and layers of ghosts.
  type :: pnpbs_mesh
    private
    type(c_ptr) :: c = c_null_ptr
  contains
    procedure :: create => mesh_create
    procedure :: destroy => mesh_destroy
    procedure :: sizes => mesh_sizes
    procedure :: numbering => mesh_numbering
    procedure :: get_nodes => mesh_get_nodes
    procedure :: get_elements => mesh_get_elements
    procedure, private :: mesh_get_connectivity
    procedure, private :: mesh_get_connectivity_int32
    generic :: get_connectivity => mesh_get_connectivity, mesh_get_connectivity_int32
    procedure, private :: mesh_get_facets
    procedure, private :: mesh_get_facets_logical
    generic :: get_facets => mesh_get_facets, mesh_get_facets_logical
    procedure :: sharing_sizes => mesh_sharing_sizes
    procedure :: get_sharing => mesh_get_sharing
    procedure :: write => mesh_write
    procedure :: handle => mesh_handle
    procedure :: from_handle => mesh_from_handle
  end type

  !> The Voronoi cells of the nodes of a rank: volumes, faces to neighbours, shares of the boundary.
  type :: pnpbs_voronoi
    private
    type(c_ptr) :: c = c_null_ptr
  contains
    procedure :: create => voronoi_create
    procedure :: destroy => voronoi_destroy
    procedure :: sizes => voronoi_sizes
    procedure :: get_cells => voronoi_get_cells
    procedure :: get_faces => voronoi_get_faces
    procedure :: handle => voronoi_handle
    procedure :: from_handle => voronoi_from_handle
  end type

  !> The particles of a rank that fill a body, with their volumes.
  type :: pnpbs_particles
    private
    type(c_ptr) :: c = c_null_ptr
  contains
    procedure :: create => particles_create
    procedure :: destroy => particles_destroy
    procedure :: sizes => particles_sizes
    procedure :: figures => particles_figures
    procedure :: get => particles_get
    procedure, private :: particles_add_output_field
    procedure, private :: particles_add_output_field_columns
    generic :: add_output_field => particles_add_output_field, particles_add_output_field_columns
    procedure :: write => particles_write
    procedure :: write_files => particles_write_files
    procedure :: handle => particles_handle
    procedure :: from_handle => particles_from_handle
  end type

contains

  ! ------------------------------------------------------------ the library -------------------

  !> Returns the meaning of a status in a few words. Local.
  function pnpbs_status_string(status) result(text)
    integer(c_int), intent(in) :: status
    character(len=:), allocatable :: text
    text = text_of(c_status_string(status))
  end function

  !> Returns the message of the calling thread's last error, whatever object it belongs to; '' if
  !> there was none. Local.
  function pnpbs_last_error() result(text)
    character(len=:), allocatable :: text
    text = text_of(c_last_error(c_null_ptr))
  end function

  !> Returns the version of the library at run time. Local.
  subroutine pnpbs_version(major, minor, patch)
    integer(c_int32_t), intent(out) :: major, minor, patch
    call conclude('pnpbs_version', c_version(major, minor, patch))
  end subroutine

  !> Returns the build configuration, one "name: value" per line: version, compiler, Kokkos and its
  !> back ends, linkage, MPI. Local.
  function pnpbs_build_info() result(text)
    character(len=:), allocatable :: text
    text = text_of(c_build_info())
  end function

  !> Returns the MPI library that PNPBS was built with; '' in a build without MPI. Local.
  function pnpbs_mpi_library() result(text)
    character(len=:), allocatable :: text
    text = text_of(c_mpi_library())
  end function

  !> Finalises Kokkos if PNPBS initialised it. Optional: otherwise Kokkos runs until the process
  !> ends. Kokkos cannot be initialised twice, so computing calls fail afterwards. Local.
  subroutine pnpbs_finalize(stat, errmsg)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('pnpbs_finalize', c_finalize(), stat, errmsg)
  end subroutine

  !> Removes the temporary files of unfinished calls of this process. Local.
  subroutine pnpbs_discard_unfinished_files()
    call conclude('pnpbs_discard_unfinished_files', c_discard_unfinished_files())
  end subroutine

  ! ------------------------------------------------------------ tables ------------------------

  !> Returns the number of options. Local.
  subroutine pnpbs_option_count(count, stat, errmsg)
    integer(c_int32_t), intent(out) :: count
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('pnpbs_option_count', c_option_count(count), stat, errmsg)
  end subroutine

  !> Returns one row of the options table. Local.
  !>   index          1 .. count
  !>   type           'integer', 'real', 'choice'
  !>   default_value  as text
  !>   range          e.g. '1 .. 1000000' or 'paper | default'
  !>   help           one line
  subroutine pnpbs_option_info(index, name, type, default_value, range, help, stat, errmsg)
    integer(c_int32_t), intent(in) :: index
    character(len=:), allocatable, intent(out), optional :: name, type, default_value, range, help
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(c_ptr) :: c_name, c_type, c_default, c_range, c_help
    integer(c_int) :: status
    status = c_option_info(index - 1_c_int32_t, c_name, c_type, c_default, c_range, c_help)
    call conclude('pnpbs_option_info', status, stat, errmsg)
    if (status < 0) return
    if (present(name)) name = text_of(c_name)
    if (present(type)) type = text_of(c_type)
    if (present(default_value)) default_value = text_of(c_default)
    if (present(range)) range = text_of(c_range)
    if (present(help)) help = text_of(c_help)
  end subroutine

  !> Returns the number of statistics. Local.
  subroutine pnpbs_statistic_count(count, stat, errmsg)
    integer(c_int32_t), intent(out) :: count
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('pnpbs_statistic_count', c_statistic_count(count), stat, errmsg)
  end subroutine

  !> Returns one row of the statistics table (the keys of the report). Local.
  !>   index  1 .. count
  !>   type   'integer', 'real' or 'string': the type of value that placement%get requires
  !>   help   one line, with the unit
  subroutine pnpbs_statistic_info(index, name, type, help, stat, errmsg)
    integer(c_int32_t), intent(in) :: index
    character(len=:), allocatable, intent(out), optional :: name, type, help
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(c_ptr) :: c_name, c_type, c_help
    integer(c_int) :: status
    status = c_statistic_info(index - 1_c_int32_t, c_name, c_type, c_help)
    call conclude('pnpbs_statistic_info', status, stat, errmsg)
    if (status < 0) return
    if (present(name)) name = text_of(c_name)
    if (present(type)) type = text_of(c_type)
    if (present(help)) help = text_of(c_help)
  end subroutine

  !> Returns the number of file formats. Local.
  subroutine pnpbs_format_count(count, stat, errmsg)
    integer(c_int32_t), intent(out) :: count
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('pnpbs_format_count', c_format_count(count), stat, errmsg)
  end subroutine

  !> Returns one row of the table of file formats (see placement%write). Local.
  !>   index     1 .. count
  !>   name      also the extension, without its dot
  !>   help      one line
  !>   binary    whether the format is not text
  !>   elements  whether one file holds nodes and, on request, elements
  subroutine pnpbs_format_info(index, name, help, binary, elements, stat, errmsg)
    integer(c_int32_t), intent(in) :: index
    character(len=:), allocatable, intent(out), optional :: name, help
    logical, intent(out), optional :: binary, elements
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(c_ptr) :: c_name, c_help
    integer(c_int32_t) :: is_binary, has_elements
    integer(c_int) :: status
    status = c_format_info(index - 1_c_int32_t, c_name, c_help, is_binary, has_elements)
    call conclude('pnpbs_format_info', status, stat, errmsg)
    if (status < 0) return
    if (present(name)) name = text_of(c_name)
    if (present(help)) help = text_of(c_help)
    if (present(binary)) binary = is_binary /= 0
    if (present(elements)) elements = has_elements /= 0
  end subroutine

  ! ------------------------------------------------------------ context -----------------------

  !> Creates a context for one process. It never calls an MPI procedure. Local.
  subroutine context_create_serial(self, stat, errmsg)
    class(pnpbs_context), intent(inout) :: self
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('context%create_serial', c_context_create_serial(self%c), stat, errmsg)
  end subroutine

  !> Creates a context on a duplicate of an MPI communicator: messages of the caller never mix with
  !> those of PNPBS. Collective. Errors: PNPBS_ERROR_UNSUPPORTED in a build without MPI,
  !> PNPBS_ERROR_MPI if MPI is not initialised, already finalised, comm is MPI_COMM_NULL, or the
  !> library is another one.
  !>   comm     as in mpif.h and the module mpi; for mpi_f08, comm%MPI_VAL
  !>   library  optional: what MPI_Get_library_version returns in the caller, compared with the MPI
  !>            that PNPBS calls; the communicator of one MPI library is meaningless to another
  subroutine context_create_mpi(self, comm, library, stat, errmsg)
    class(pnpbs_context), intent(inout) :: self
    class(*), intent(in) :: comm
    character(len=*), intent(in), optional :: library
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    integer(c_int32_t) :: handle
    select type (comm)
    type is (integer(c_int32_t))
      handle = comm
    type is (integer(c_int64_t))
      handle = int(comm, c_int32_t)
    class default
      call given%refuse(PNPBS_ERROR_ARGUMENT, 'argument comm is no integer: with the module ' // &
        'mpi_f08 give comm%MPI_VAL, as in create_mpi(MPI_COMM_WORLD%MPI_VAL)')
      call conclude('context%create_mpi', given%found(), stat, errmsg, given)
      return
    end select
    if (present(library)) then
      call conclude('context%create_mpi', &
                    c_context_create_checked_f(handle, c_text(library), self%c), stat, errmsg)
    else
      call conclude('context%create_mpi', c_context_create_f(handle, self%c), stat, errmsg)
    end if
  end subroutine

  !> Destroys the context, if it exists. Its domains and placements remain valid until they are
  !> destroyed. Collective.
  subroutine context_destroy(self, stat, errmsg)
    class(pnpbs_context), intent(inout) :: self
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('context%destroy', c_context_destroy(self%c), stat, errmsg)
  end subroutine

  !> set(key, value): sets an option that placements created later on this context start with (see
  !> pnpbs_option_info). 'threads' can only be set here, and only before the first placement of the
  !> process is created. Local. Errors: PNPBS_ERROR_KEY (the message names the nearest known
  !> option), PNPBS_ERROR_ARGUMENT (the message gives the range).
  !>   value  text, an integer of four or eight bytes, or real(c_double)
  subroutine context_set_text(self, key, value, stat, errmsg)
    class(pnpbs_context), intent(in) :: self
    character(len=*), intent(in) :: key, value
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('context%set', c_context_set(self%c, c_text(key), c_text(value)), stat, errmsg)
  end subroutine

  subroutine context_set_int32(self, key, value, stat, errmsg)
    class(pnpbs_context), intent(in) :: self
    character(len=*), intent(in) :: key
    integer(c_int32_t), intent(in) :: value
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call self%set(key, int(value, c_int64_t), stat, errmsg)
  end subroutine

  subroutine context_set_int64(self, key, value, stat, errmsg)
    class(pnpbs_context), intent(in) :: self
    character(len=*), intent(in) :: key
    integer(c_int64_t), intent(in) :: value
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('context%set', c_context_set_int64(self%c, c_text(key), value), stat, errmsg)
  end subroutine

  subroutine context_set_real(self, key, value, stat, errmsg)
    class(pnpbs_context), intent(in) :: self
    character(len=*), intent(in) :: key
    real(c_double), intent(in) :: value
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('context%set', c_context_set_double(self%c, c_text(key), value), stat, errmsg)
  end subroutine

  !> Returns the message of the last error on the context or on its domains and placements, or '' if
  !> there was none. For a dead context, returns that of the calling thread. Local.
  function context_last_error(self) result(text)
    class(pnpbs_context), intent(in) :: self
    character(len=:), allocatable :: text
    text = text_of(c_last_error(self%c))
  end function

  !> Returns data of that error: one of PNPBS_REASON_..., and the number of points that the message
  !> names. Local.
  subroutine context_last_error_data(self, reason, points)
    class(pnpbs_context), intent(in) :: self
    integer(c_int32_t), intent(out) :: reason
    integer(c_int32_t), intent(out), optional :: points
    integer(c_int32_t) :: named
    integer(c_int) :: status
    status = c_last_error_data(self%c, reason, named)
    if (present(points)) points = named
  end subroutine

  !> Returns a point that the message names, or NaN if there is no such point. Local.
  !>   index  1 .. points, in the order of the message
  !>   point  (3) coordinates; the third is NaN in the plane
  !>   first  index of the first character of the message that names it
  !>   last   index of the last one
  subroutine context_last_error_point(self, index, point, first, last)
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    class(pnpbs_context), intent(in) :: self
    integer(c_int32_t), intent(in) :: index
    real(c_double), intent(out) :: point(3)
    integer(c_int64_t), intent(out), optional :: first, last
    real(c_double), target :: x(3)
    integer(c_int64_t) :: begins, ends
    integer(c_int) :: status
    begins = 0
    ends = 0
    x = ieee_value(x, ieee_quiet_nan)
    status = c_last_error_point(self%c, index - 1_c_int32_t, c_loc(x), begins, ends)
    point = x
    if (present(first)) first = begins + 1
    if (present(last)) last = ends
  end subroutine

  !> Returns the handle as an integer, for COMMON blocks and other code without derived types, or 0
  !> if there is no context. Local.
  function context_handle(self) result(handle)
    class(pnpbs_context), intent(in) :: self
    integer(c_int64_t) :: handle
    handle = integer_of(self%c)
  end function

  !> Sets the context to the object with the given handle, without checks. Local.
  subroutine context_from_handle(self, handle)
    class(pnpbs_context), intent(inout) :: self
    integer(c_int64_t), intent(in) :: handle
    self%c = pointer_of(handle)
  end subroutine

  ! ------------------------------------------------------------ domain ------------------------

  !> Creates an empty domain. Local.
  !>   dim  optional: 2, in the plane, or 3, in space; default: 2
  subroutine domain_create(self, context, dim, stat, errmsg)
    class(pnpbs_domain), intent(inout) :: self
    type(pnpbs_context), intent(in) :: context
    integer(c_int32_t), intent(in), optional :: dim
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: dimensions
    dimensions = 2
    if (present(dim)) dimensions = dim
    call conclude('domain%create', c_domain_create(context%c, dimensions, self%c), stat, errmsg)
  end subroutine

  !> Creates an empty domain on a sphere about the origin. Its nodes lie on the sphere, spacings are
  !> lengths along it, and points have three coordinates. Boundary curves (add_polyline) follow
  !> great circles from vertex to vertex. The domain lies behind an odd number of them, as seen from
  !> a point outside. Nodes are placed in the stereographic projection from that point, which should
  !> be at least ten spacings away from the domain. Without a boundary curve the domain is the whole
  !> sphere; nodes around that point are laid first and stay fixed then. Placements have triangles
  !> and boundary edges, as in the plane. pnpbs_domain_create_sphere in pnpbs.h lists the functions
  !> that are not available on a sphere. Local.
  !>   radius   > 0
  !>   outside  (3) direction of a point outside the domain; any length except 0
  subroutine domain_create_sphere(self, context, radius, outside, stat, errmsg)
    class(pnpbs_domain), intent(inout) :: self
    type(pnpbs_context), intent(in) :: context
    real(c_double), intent(in) :: radius, outside(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    integer(c_int) :: status
    call given%check_rows('outside', size(outside), 3)
    status = PNPBS_OK
    if (.not. given%is_wrong()) status = c_domain_create_sphere(context%c, radius, outside, self%c)
    call conclude('domain%create_sphere', status, stat, errmsg, given)
  end subroutine

  !> Computes points on a sphere about the origin from longitude and latitude. Local.
  !>   radius       > 0
  !>   degrees      (2, n) longitude, which may exceed a full turn, and latitude, -90 .. 90
  !>   coordinates  (3, n)
  subroutine pnpbs_sphere_points(radius, degrees, coordinates, stat, errmsg)
    real(c_double), intent(in) :: radius, degrees(:,:)
    real(c_double), intent(inout) :: coordinates(:,:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    integer(c_int64_t) :: n
    integer(c_int) :: status
    n = size(degrees, 2, kind=c_int64_t)
    call given%check_rows('degrees', size(degrees, 1), 2)
    call given%check_rows('coordinates', size(coordinates, 1), 3)
    call given%require('coordinates', size(coordinates, 2, kind=c_int64_t), n)
    status = PNPBS_OK
    if (.not. given%is_wrong()) status = c_sphere_points(radius, n, degrees, coordinates)
    call conclude('pnpbs_sphere_points', status, stat, errmsg, given)
  end subroutine

  !> Computes longitude and latitude of the directions of points. Local.
  !>   coordinates  (3, n), not 0
  !>   degrees      (2, n) longitude, -180 .. 180, and latitude, -90 .. 90
  subroutine pnpbs_sphere_degrees(coordinates, degrees, stat, errmsg)
    real(c_double), intent(in) :: coordinates(:,:)
    real(c_double), intent(inout) :: degrees(:,:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    integer(c_int64_t) :: n
    integer(c_int) :: status
    n = size(coordinates, 2, kind=c_int64_t)
    call given%check_rows('coordinates', size(coordinates, 1), 3)
    call given%check_rows('degrees', size(degrees, 1), 2)
    call given%require('degrees', size(degrees, 2, kind=c_int64_t), n)
    status = PNPBS_OK
    if (.not. given%is_wrong()) status = c_sphere_degrees(n, coordinates, degrees)
    call conclude('pnpbs_sphere_degrees', status, stat, errmsg, given)
  end subroutine

  !> Destroys the domain, if it exists. Local.
  subroutine domain_destroy(self, stat, errmsg)
    class(pnpbs_domain), intent(inout) :: self
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('domain%destroy', c_domain_destroy(self%c), stat, errmsg)
  end subroutine

  !> Returns the dimension that the domain was created with. Local.
  !>   dim  2: in the plane, 3: in space and on a sphere
  subroutine domain_dimension(self, dim, stat, errmsg)
    class(pnpbs_domain), intent(in) :: self
    integer(c_int32_t), intent(out) :: dim
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    dim = 0
    call conclude('domain%dimension', c_domain_dimension(self%c, dim), stat, errmsg)
  end subroutine

  !> Adds straight segments through n vertices. Local.
  !>   role          PNPBS_BOUNDARY or PNPBS_INNER; in space PNPBS_INNER
  !>   closed        whether a segment joins the last vertex to the first; the first vertex is not
  !>                 repeated
  !>   coordinates   (dim, n)
  !>   tags          optional: one for each segment, nonzero; default: 1
  !>   corner_angle  optional, degrees, 0 .. 180; default: 0, every vertex becomes a node. Otherwise
  !>                 only vertices where the direction turns by more than this, ends of open
  !>                 polylines and vertices where curves meet become nodes; between them the
  !>                 polyline represents a smooth curve. In space it is ignored, and the
  !>                 feature_angle of the surfaces is used instead
  subroutine domain_add_polyline(self, role, closed, coordinates, tags, corner_angle, stat, errmsg)
    class(pnpbs_domain), intent(in) :: self
    integer(c_int32_t), intent(in) :: role
    logical, intent(in) :: closed
    real(c_double), intent(in) :: coordinates(:,:)
    integer(c_int32_t), intent(in), optional :: tags(:)
    real(c_double), intent(in), optional :: corner_angle
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    type(c_ptr) :: a_tags
    integer(c_int64_t) :: n, segments, room
    integer(c_int) :: status
    integer :: dim
    real(c_double) :: angle
    n = size(coordinates, 2, kind=c_int64_t)
    segments = merge(n, n - 1, closed)
    dim = dimension_of(self, given)
    call given%check_rows('coordinates', size(coordinates, 1), dim)
    call given%place_int32('tags', tags, a_tags, room)
    call given%require('tags', room, segments)
    angle = 0
    if (present(corner_angle)) angle = corner_angle
    status = PNPBS_OK
    if (.not. given%is_wrong()) &
      status = c_domain_add_polyline(self%c, role, flag(closed), n, coordinates, a_tags, angle)
    call conclude('domain%add_polyline', status, stat, errmsg, given)
  end subroutine

  !> Adds a triangulated surface to a domain in space. Closed surfaces with the role PNPBS_BOUNDARY
  !> bound the domain: its inside lies behind an odd number of them. Nodes follow surfaces with the
  !> role PNPBS_INNER, closed or open, inside the domain. Coincident vertices are merged. The
  !> triangles may have any orientation, because the enclosed volume determines it. Local.
  !>   role           PNPBS_BOUNDARY or PNPBS_INNER
  !>   coordinates    (3, vertices)
  !>   corners        (3, triangles) vertices, counted from 1
  !>   tags           optional, (triangles), nonzero; default: 1
  !>   feature_angle  optional, degrees, 0 .. 180; default: 40. Nodes lie on the edge between two
  !>                  triangles if their normals differ by more than this, or if their tags differ.
  !>                  Between such edges the triangles only define the shape, whatever their size
  subroutine domain_add_surface(self, role, coordinates, corners, tags, feature_angle, stat, errmsg)
    class(pnpbs_domain), intent(in) :: self
    integer(c_int32_t), intent(in) :: role
    real(c_double), intent(in) :: coordinates(:,:)
    integer(c_int64_t), intent(in) :: corners(:,:)
    integer(c_int32_t), intent(in), optional :: tags(:)
    real(c_double), intent(in), optional :: feature_angle
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    type(c_ptr) :: a_tags
    integer(c_int64_t) :: vertices, triangles, room
    integer(c_int) :: status
    vertices = size(coordinates, 2, kind=c_int64_t)
    triangles = size(corners, 2, kind=c_int64_t)
    call given%check_rows('coordinates', size(coordinates, 1), 3)
    call given%check_rows('corners', size(corners, 1), 3)
    call given%place_int32('tags', tags, a_tags, room)
    call given%require('tags', room, triangles)
    status = PNPBS_OK
    if (.not. given%is_wrong()) &
      status = c_domain_add_surface(self%c, role, vertices, coordinates, triangles, corners - 1, &
                                    a_tags, angle_or_40(feature_angle))
    call conclude('domain%add_surface', status, stat, errmsg, given)
  end subroutine

  !> Reads a surface from a file and adds it as add_surface does. The formats are .stl (text or
  !> binary), .off, .obj, .ply, and TetGen's .poly and .smesh. Solids, groups, materials and facet
  !> markers become tags with their names (get_tag_name). Hole points become holes of the domain.
  !> Local. Errors: PNPBS_ERROR_FILE with file, line and what was expected.
  !>   role           PNPBS_BOUNDARY or PNPBS_INNER
  !>   path           trailing blanks are ignored
  !>   feature_angle  optional, as in add_surface
  subroutine domain_read_surface(self, role, path, feature_angle, stat, errmsg)
    class(pnpbs_domain), intent(in) :: self
    integer(c_int32_t), intent(in) :: role
    character(len=*), intent(in) :: path
    real(c_double), intent(in), optional :: feature_angle
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('domain%read_surface', &
                  c_domain_read_surface(self%c, role, c_text(path), angle_or_40(feature_angle)), &
                  stat, errmsg)
  end subroutine

  !> Sets the role of all triangles with a tag in a domain in space. It overrides the role with
  !> which they are added, before or after this call, so that single groups of a file can be inner
  !> surfaces. Local. Checking the domain fails if no triangle has the tag.
  !>   tag   nonzero
  !>   role  PNPBS_BOUNDARY or PNPBS_INNER
  subroutine domain_set_role(self, tag, role, stat, errmsg)
    class(pnpbs_domain), intent(in) :: self
    integer(c_int32_t), intent(in) :: tag, role
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('domain%set_role', c_domain_set_role(self%c, tag, role), stat, errmsg)
  end subroutine

  !> Reads a mesh in Gmsh's MSH format, 4.1 or 2.2, text or binary, and adds its boundary, and the
  !> curves, surfaces and points inside, to the domain: see pnpbs_domain_read_msh in pnpbs.h. The
  !> tag of a physical group becomes the tag, and its name is kept (get_tag_name). Local. Errors:
  !> PNPBS_ERROR_FILE with file, line or byte, and what was expected.
  !>   path           trailing blanks are ignored
  !>   feature_angle  optional, as in add_surface, in the plane as the corner_angle of add_polyline
  subroutine domain_read_msh(self, path, feature_angle, stat, errmsg)
    class(pnpbs_domain), intent(in) :: self
    character(len=*), intent(in) :: path
    real(c_double), intent(in), optional :: feature_angle
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('domain%read_msh', &
                  c_domain_read_msh(self%c, c_text(path), angle_or_40(feature_angle)), stat, errmsg)
  end subroutine

  !> Returns the dimension of the domain that a file describes, 2 or 3. The extension determines it.
  !> For .poly it is the second number in the file; for .msh it is 2 if the mesh lies in a plane of
  !> constant z. Local.
  !>   path  trailing blanks are ignored
  subroutine pnpbs_file_dimension(path, dim, stat, errmsg)
    character(len=*), intent(in) :: path
    integer(c_int32_t), intent(out) :: dim
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('pnpbs_file_dimension', c_file_dimension(c_text(path), dim), stat, errmsg)
  end subroutine

  !> Sets the name of a tag, for files with physical groups (.msh). It replaces an existing name.
  !> Local.
  !>   dim   of the entity with the tag: 0 points, 1 curves, 2 surfaces, 3 bodies. The inside of the
  !>         domain has the dimension of the domain
  !>   tag   nonzero
  !>   name  trailing blanks are ignored
  subroutine domain_set_tag_name(self, dim, tag, name, stat, errmsg)
    class(pnpbs_domain), intent(in) :: self
    integer(c_int32_t), intent(in) :: dim, tag
    character(len=*), intent(in) :: name
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('domain%set_tag_name', c_domain_set_tag_name(self%c, dim, tag, c_text(name)), &
                  stat, errmsg)
  end subroutine

  !> Returns the number of tags with names, set or from files. Local.
  subroutine domain_tag_name_count(self, count, stat, errmsg)
    class(pnpbs_domain), intent(in) :: self
    integer(c_int32_t), intent(out) :: count
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('domain%tag_name_count', c_domain_tag_name_count(self%c, count), stat, errmsg)
  end subroutine

  !> Returns one of the names, sorted by dimension, then by tag. Local.
  !>   index  1 .. count
  subroutine domain_get_tag_name(self, index, dim, tag, name, stat, errmsg)
    class(pnpbs_domain), intent(in) :: self
    integer(c_int32_t), intent(in) :: index
    integer(c_int32_t), intent(out) :: dim, tag
    character(len=:), allocatable, intent(out) :: name
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(c_ptr) :: c
    integer(c_int) :: status
    dim = -1
    tag = 0
    name = ''
    status = c_domain_get_tag_name(self%c, index - 1_c_int32_t, dim, tag, c)
    call conclude('domain%get_tag_name', status, stat, errmsg)
    if (status >= 0) name = text_of(c)
  end subroutine

  !> Adds a box to a domain in space; its sides bound the domain or lie in it. Local.
  !>   low, high  (3)
  !>   tag        optional: nonzero; default: 1
  !>   role       optional: PNPBS_BOUNDARY, the default, or PNPBS_INNER
  subroutine domain_add_box(self, low, high, tag, role, stat, errmsg)
    class(pnpbs_domain), intent(in) :: self
    real(c_double), intent(in) :: low(:), high(:)
    integer(c_int32_t), intent(in), optional :: tag, role
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    integer(c_int) :: status
    call given%check_rows('low', size(low), 3)
    call given%check_rows('high', size(high), 3)
    status = PNPBS_OK
    if (.not. given%is_wrong()) &
      status = c_domain_add_box_surface(self%c, role_or_boundary(role), low, high, tag_or_one(tag))
    call conclude('domain%add_box', status, stat, errmsg, given)
  end subroutine

  !> Adds a ball to a domain in space, as triangles within 1e-4 of the radius. Local.
  !>   centre  (3)
  !>   radius  > 0
  !>   tag     optional: nonzero; default: 1
  !>   role    optional: PNPBS_BOUNDARY, the default, or PNPBS_INNER
  subroutine domain_add_ball(self, centre, radius, tag, role, stat, errmsg)
    class(pnpbs_domain), intent(in) :: self
    real(c_double), intent(in) :: centre(:), radius
    integer(c_int32_t), intent(in), optional :: tag, role
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    integer(c_int) :: status
    call given%check_rows('centre', size(centre), 3)
    status = PNPBS_OK
    if (.not. given%is_wrong()) &
      status = c_domain_add_ball_surface(self%c, role_or_boundary(role), centre, radius, &
                                         tag_or_one(tag))
    call conclude('domain%add_ball', status, stat, errmsg, given)
  end subroutine

  !> Adds a circular cylinder to a domain in space, as triangles within 1e-4 of the radius. Local.
  !>   begin, end  (3), the centres of its two circles
  !>   radius      > 0
  !>   tag         optional: nonzero; default: 1
  !>   role        optional: PNPBS_BOUNDARY, the default, or PNPBS_INNER
  subroutine domain_add_cylinder(self, begin, end, radius, tag, role, stat, errmsg)
    class(pnpbs_domain), intent(in) :: self
    real(c_double), intent(in) :: begin(:), end(:), radius
    integer(c_int32_t), intent(in), optional :: tag, role
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    integer(c_int) :: status
    call given%check_rows('begin', size(begin), 3)
    call given%check_rows('end', size(end), 3)
    status = PNPBS_OK
    if (.not. given%is_wrong()) &
      status = c_domain_add_cylinder_surface(self%c, role_or_boundary(role), begin, end, radius, &
                                             tag_or_one(tag))
    call conclude('domain%add_cylinder', status, stat, errmsg, given)
  end subroutine

  !> Adds the body where f < 0 to a domain in space. The box must contain it. Its surface is found
  !> on an octree that is refined near f = 0 down to cells of side resolution. Thinner features can
  !> be lost, and so can a body that is small relative to the box and towards which f does not
  !> decrease. Nodes on the surface lie where f = 0, however coarse the triangles of the octree are.
  !> Where the gradient of f jumps by more than 40 degrees, as that of max(g, h) does, the surface
  !> has an edge with nodes on it. Where triangles would cross, as they may at edges of less than 60
  !> degrees, it stays rounded by the resolution, with a warning. The callback is called during this
  !> procedure, whenever a placement is initialised or runs, and for its normals, so it and user
  !> must outlive the placements made on the domain. Local.
  !>   low, high   (3), the box; f is evaluated only inside it
  !>   resolution  > 0, at most the box's shortest side; no more than the spacing at the surface,
  !>               and half of the minimum radius of curvature
  !>   tag         optional: nonzero; default: 1
  !>   user        optional: passed to the callback; default: null
  subroutine domain_add_level_set(self, level_set, low, high, resolution, tag, user, stat, errmsg)
    class(pnpbs_domain), intent(in) :: self
    procedure(pnpbs_level_set_fn) :: level_set
    real(c_double), intent(in) :: low(:), high(:), resolution
    integer(c_int32_t), intent(in), optional :: tag
    type(c_ptr), intent(in), optional :: user
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    integer(c_int) :: status
    call given%check_rows('low', size(low), 3)
    call given%check_rows('high', size(high), 3)
    status = PNPBS_OK
    if (.not. given%is_wrong()) &
      status = c_domain_add_level_set(self%c, c_funloc(level_set), pointer_or_null(user), low, &
                                      high, resolution, tag_or_one(tag))
    call conclude('domain%add_level_set', status, stat, errmsg, given)
  end subroutine

  !> Adds a circular arc to a domain in the plane; its ends join curves that end at the same point
  !> (within 1e-9 of the domain's size). Local.
  !>   centre      (2)
  !>   radius      > 0
  !>   begin, end  angles in radians; |end - begin| = 2 pi makes a full circle
  !>   tag         optional: nonzero; default: 1
  subroutine domain_add_arc(self, role, centre, radius, begin, end, tag, stat, errmsg)
    class(pnpbs_domain), intent(in) :: self
    integer(c_int32_t), intent(in) :: role
    real(c_double), intent(in) :: centre(:), radius, begin, end
    integer(c_int32_t), intent(in), optional :: tag
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    integer(c_int) :: status
    call given%check_rows('centre', size(centre), 2)
    status = PNPBS_OK
    if (.not. given%is_wrong()) &
      status = c_domain_add_arc(self%c, role, centre, radius, begin, end, tag_or_one(tag))
    call conclude('domain%add_arc', status, stat, errmsg, given)
  end subroutine

  !> Adds a general curve, given by a callback on begin <= t <= end, to a domain in the plane. The
  !> callback is called during this procedure and whenever a placement is initialised, so it and
  !> user must outlive the placements made on the domain. A curve whose ends coincide is closed. The
  !> curve is smooth between its ends: corners exist only where curves meet. Local.
  !>   tag   optional: nonzero; default: 1
  !>   user  optional: passed to the callback; default: null
  subroutine domain_add_curve(self, role, curve, begin, end, tag, user, stat, errmsg)
    class(pnpbs_domain), intent(in) :: self
    integer(c_int32_t), intent(in) :: role
    procedure(pnpbs_curve_fn) :: curve
    real(c_double), intent(in) :: begin, end
    integer(c_int32_t), intent(in), optional :: tag
    type(c_ptr), intent(in), optional :: user
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('domain%add_curve', &
                  c_domain_add_curve(self%c, role, c_funloc(curve), pointer_or_null(user), begin, &
                                     end, tag_or_one(tag)), stat, errmsg)
  end subroutine

  !> Adds a planar straight-line graph, as Triangle defines it, to a domain in the plane. The
  !> segments enclose the domain, except for regions that contain a hole point. A loop without a
  !> hole point and any open chain are inner curves. Every vertex becomes a node. Shared vertices
  !> and T-junctions (within 1e-12 of the domain's size) are allowed. Once a graph is added, this
  !> rule holds for all curves of the domain. Local.
  !>   coordinates   (2, vertices)
  !>   segment_ends  (2, segments) vertices, counted from 1
  !>   vertex_tags   optional, (vertices); 0 stands for the tag of the segment
  !>   segment_tags  optional, (segments); default: 1
  !>   hole_points   optional, (2, holes)
  subroutine domain_add_pslg(self, coordinates, segment_ends, vertex_tags, segment_tags, &
                             hole_points, stat, errmsg)
    class(pnpbs_domain), intent(in) :: self
    real(c_double), intent(in) :: coordinates(:,:)
    integer(c_int64_t), intent(in) :: segment_ends(:,:)
    integer(c_int32_t), intent(in), optional :: vertex_tags(:), segment_tags(:)
    real(c_double), intent(in), optional :: hole_points(:,:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    type(c_ptr) :: a_vertex_tags, a_segment_tags, a_holes
    integer(c_int64_t) :: vertices, segments, holes, room
    integer(c_int) :: status
    vertices = size(coordinates, 2, kind=c_int64_t)
    segments = size(segment_ends, 2, kind=c_int64_t)
    call given%check_rows('coordinates', size(coordinates, 1), 2)
    call given%check_rows('segment_ends', size(segment_ends, 1), 2)
    call given%place_int32('vertex_tags', vertex_tags, a_vertex_tags, room)
    call given%require('vertex_tags', room, vertices)
    call given%place_int32('segment_tags', segment_tags, a_segment_tags, room)
    call given%require('segment_tags', room, segments)
    call given%place_real_columns('hole_points', hole_points, 2, a_holes, holes)
    if (.not. present(hole_points)) holes = 0
    status = PNPBS_OK
    if (.not. given%is_wrong()) &
      status = c_domain_add_pslg(self%c, vertices, coordinates, a_vertex_tags, segments, &
        segment_ends - 1, &
                                 a_segment_tags, holes, a_holes)
    call conclude('domain%add_pslg', status, stat, errmsg, given)
  end subroutine

  !> Sets whether a domain in space is the volume enclosed by its surfaces (the default) or the
  !> surfaces alone: nodes lie on them, triangles join these nodes, and there is no interior. On
  !> surfaces alone, both roles are equivalent and surfaces may be closed or open. Polylines must
  !> follow edges of the triangles, fixed nodes must be vertices of them, and there are no holes.
  !> Options have the same meaning as in the plane. Local.
  !>   filled  .true.: the enclosed volume; .false.: the surfaces alone
  subroutine domain_set_filled(self, filled, stat, errmsg)
    class(pnpbs_domain), intent(in) :: self
    logical, intent(in) :: filled
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('domain%set_filled', &
                  c_domain_set_filled(self%c, merge(1_c_int32_t, 0_c_int32_t, filled)), stat, &
                  errmsg)
  end subroutine

  !> Repairs the triangulated boundary surfaces of a domain in space that enclose one body
  !> imperfectly: open, crossing, folded or inconsistently oriented. Sound surfaces do not change,
  !> and a warning reports that nothing is repaired. The body is the set of points around which the
  !> surfaces wind more than half a time, in either orientation. Holes are closed, overlapping
  !> bodies are joined, and surfaces that enclose nothing are removed. The surface of the body is
  !> extracted as that of a level set, with its sharp edges. All of it has the tag of the first
  !> triangle. A warning reports its distance from the given triangles. Thinner features than the
  !> resolution can be lost. Local.
  !>   resolution  > 0, no more than the spacing at the surface. 0 stands for 1/64 of the longest
  !>               side of the bounding box of the triangles
  subroutine domain_set_repair(self, resolution, stat, errmsg)
    class(pnpbs_domain), intent(in) :: self
    real(c_double), intent(in) :: resolution
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('domain%set_repair', c_domain_set_repair(self%c, resolution), stat, errmsg)
  end subroutine

  !> Replaces the triangulated boundary surfaces of a domain in space as set_repair does, even if
  !> they need no repair. This removes features of the body that are smaller than the resolution.
  !> Local.
  !>   resolution  as in set_repair
  subroutine domain_set_resurfaced(self, resolution, stat, errmsg)
    class(pnpbs_domain), intent(in) :: self
    real(c_double), intent(in) :: resolution
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('domain%set_resurfaced', c_domain_set_resurfaced(self%c, resolution), stat, &
                  errmsg)
  end subroutine

  !> Splits the curves or surfaces of a domain where they cross, touch or lie on each other, so that
  !> several solids, sheets and curves become regions of one domain with common nodes and facets.
  !> The domain is what any solid contains. Curves and surfaces that enclose nothing lie inside of
  !> it, and their parts outside are left out. The first of several curves or triangles that lie on
  !> each other gives the tag. The k-th solid, counted from 1 in the order in which they are added
  !> (groups by tag), gives its elements the region tag k. add_region sets other tags, and add_hole
  !> removes regions.
  !> In space each box, ball, cylinder and level set is a solid, and so is each closed group of an
  !> added surface, which are its triangles with one tag: a solid contains the points around which
  !> it winds, so triangles of a cavity are oriented into it. The other triangles of a surface
  !> enclose a further solid. Surfaces with the role PNPBS_INNER are no solids. Without this call,
  !> surfaces that touch are accepted if no solids overlap and each surface ends on others, as for
  !> stacked boxes and for a sheet from side to side of a box. Gaps up to the length of set_snap are
  !> closed.
  !> In the plane each closed boundary curve is a solid, and so are boundary curves that are joined
  !> at their ends to a closed one. It is a cavity if the solid before it encloses it and runs
  !> around in the other direction. Each closed group of a graph, which are its segments with one
  !> tag, is a solid, and the rest of what the graph encloses is a further one. Without this call,
  !> curves that touch, also along common edges, are accepted if no solids overlap. Excludes
  !> set_repair. Not on a sphere. Local.
  !>   overlap  PNPBS_OVERLAP_LAST, PNPBS_OVERLAP_FIRST or PNPBS_OVERLAP_OWN: the region tag where
  !>            solids overlap
  subroutine domain_set_fragment(self, overlap, stat, errmsg)
    class(pnpbs_domain), intent(in) :: self
    integer(c_int32_t), intent(in) :: overlap
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('domain%set_fragment', c_domain_set_fragment(self%c, overlap), stat, errmsg)
  end subroutine

  !> Makes the domain a box that repeats itself along some axes. It has no boundary across these
  !> axes: bubbles on both sides of a seam act on each other. The other sides of the box are
  !> boundaries. Closed curves and surfaces are holes and cavities or, with the role PNPBS_INNER or
  !> as fragments, inclusions. They are given once, stand for all their copies, and may extend
  !> beyond a periodic side. d is evaluated at points of the box only, and continued with its
  !> periods.
  !> Nodes lie in the box; low <= x < high along a periodic axis. Results have the images of nodes
  !> near the box as ghosts, on a single rank as well: an image has the id of its node, and its
  !> coordinates differ from those of the node by whole periods. Adjacency lists and elements refer
  !> to images, so an element at a seam has its true shape, and no element occurs twice.
  !> Coordinates along a periodic axis, and the period, are rounded to multiples of 2**(-50) times
  !> the largest coordinate of an image. Not on a sphere, nor for surfaces alone, level sets and
  !> inner curves in space. Not yet for a periodic domain, but PNPBS_ERROR_UNSUPPORTED: files with
  !> elements of second order, distributed meshes, Voronoi cells, particles and cracks. Local.
  !> initialise and run return PNPBS_ERROR_SPACING if a period is shorter than four spacings.
  !>   low, high  (dim) corners of the box
  !>   periodic   (dim) true along the axes on which the domain is periodic
  !>   tags       (2 dim) of the sides that are not periodic or are flat: low x, high x, low y, ...;
  !>              all are 1 if absent
  !>   flat       (dim) true along periodic axes whose sides no element crosses: nodes lie on them,
  !>              and opposite sides have the same facets, as solvers need that work on a box. In
  !>              the plane curves may cross them, in space surfaces must not, and all periodic axes
  !>              or none are flat
  subroutine domain_set_periodic(self, low, high, periodic, tags, flat, stat, errmsg)
    class(pnpbs_domain), intent(in) :: self
    real(c_double), intent(in) :: low(:), high(:)
    logical, intent(in) :: periodic(:)
    integer(c_int32_t), intent(in), optional :: tags(:)
    logical, intent(in), optional :: flat(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    type(c_ptr) :: a_tags
    integer(c_int64_t) :: room
    integer(c_int) :: status
    integer(c_int32_t) :: axes(size(periodic))
    integer :: dim
    dim = dimension_of(self, given)
    call given%check_rows('low', size(low), dim)
    call given%check_rows('high', size(high), dim)
    call given%check_rows('periodic', size(periodic), dim)
    call given%place_int32('tags', tags, a_tags, room)
    call given%require('tags', room, int(2 * dim, c_int64_t))
    axes = merge(PNPBS_PERIODIC, PNPBS_BOUNDED, periodic)
    if (present(flat)) then
      call given%check_rows('flat', size(flat), dim)
      if (size(flat) == size(axes)) axes = merge(PNPBS_FLAT, axes, periodic .and. flat)
    end if
    status = PNPBS_OK
    if (.not. given%is_wrong()) status = c_domain_set_periodic(self%c, low, high, axes, a_tags)
    call conclude('domain%set_periodic', status, stat, errmsg, given)
  end subroutine

  !> Removes the region around a point from the domain, up to the next curves or surfaces of either
  !> role. Local.
  !>   point  (dim)
  subroutine domain_add_hole(self, point, stat, errmsg)
    class(pnpbs_domain), intent(in) :: self
    real(c_double), intent(in) :: point(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    integer(c_int) :: status
    integer :: dim
    dim = dimension_of(self, given)
    call given%check_rows('point', size(point), dim)
    status = PNPBS_OK
    if (.not. given%is_wrong()) status = c_domain_add_hole(self%c, point)
    call conclude('domain%add_hole', status, stat, errmsg, given)
  end subroutine

  !> Gives a tag to the region around a point, up to the next curves or surfaces of either role.
  !> Elements in the region have this tag (placement%get_element_tags, mesh%get_elements), also in
  !> files. Inner curves and surfaces thus divide a domain into materials. Elements of regions
  !> without a point have the tag 0. Local. Errors of domain%check: PNPBS_ERROR_DOMAIN if the point
  !> lies outside the domain, on a curve or surface, or in a region with another tag.
  !>   point  (dim)
  !>   tag    nonzero
  subroutine domain_add_region(self, point, tag, stat, errmsg)
    class(pnpbs_domain), intent(in) :: self
    real(c_double), intent(in) :: point(:)
    integer(c_int32_t), intent(in) :: tag
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    integer(c_int) :: status
    integer :: dim
    dim = dimension_of(self, given)
    call given%check_rows('point', size(point), dim)
    status = PNPBS_OK
    if (.not. given%is_wrong()) status = c_domain_add_region(self%c, point, tag)
    call conclude('domain%add_region', status, stat, errmsg, given)
  end subroutine

  !> Adds fixed nodes, which keep their exact coordinates. Local.
  !>   coordinates  (dim, n), inside the domain or on a vertex of its curves or surfaces
  !>   tags         optional, (n), nonzero; default: 1
  subroutine domain_add_fixed_nodes(self, coordinates, tags, stat, errmsg)
    class(pnpbs_domain), intent(in) :: self
    real(c_double), intent(in) :: coordinates(:,:)
    integer(c_int32_t), intent(in), optional :: tags(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    type(c_ptr) :: a_tags
    integer(c_int64_t) :: n, room
    integer(c_int) :: status
    integer :: dim
    n = size(coordinates, 2, kind=c_int64_t)
    dim = dimension_of(self, given)
    call given%check_rows('coordinates', size(coordinates, 1), dim)
    call given%place_int32('tags', tags, a_tags, room)
    call given%require('tags', room, n)
    status = PNPBS_OK
    if (.not. given%is_wrong()) status = c_domain_add_fixed_nodes(self%c, n, coordinates, a_tags)
    call conclude('domain%add_fixed_nodes', status, stat, errmsg, given)
  end subroutine

  !> Reads a file in Triangle's .poly format (vertices numbered from 0 or 1, attributes ignored,
  !> markers kept as tags) and adds it to a domain in the plane as add_pslg does. Local. Errors:
  !> PNPBS_ERROR_FILE with file, line and what was expected.
  !>   path  trailing blanks are ignored
  subroutine domain_read_poly(self, path, stat, errmsg)
    class(pnpbs_domain), intent(in) :: self
    character(len=*), intent(in) :: path
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('domain%read_poly', c_domain_read_poly(self%c, c_text(path)), stat, errmsg)
  end subroutine

  !> Adds a text in memory as read_poly adds a file. Local.
  !>   text  lines that end with new_line('a')
  !>   name  the name of the text in messages
  subroutine domain_parse_poly(self, text, name, stat, errmsg)
    class(pnpbs_domain), intent(in) :: self
    character(len=*), intent(in) :: text, name
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('domain%parse_poly', &
                  c_domain_parse_poly(self%c, text // c_null_char, len(text, kind=c_int64_t), &
                                      c_text(name)), stat, errmsg)
  end subroutine

  !> Sets the corner angle of the graphs of a domain in the plane (add_pslg, read_poly, parse_poly),
  !> both of those added already and of later ones. Corners are vertices where the direction turns
  !> by more than this angle, where segments of different tags or other than two segments end, and
  !> vertices with a tag of their own. Nodes lie on corners. Between corners a graph represents a
  !> smooth curve, with nodes spaced by d. Local.
  !>   corner_angle  degrees, 0 .. 180. 0, the default: every vertex becomes a node
  subroutine domain_set_corner_angle(self, corner_angle, stat, errmsg)
    class(pnpbs_domain), intent(in) :: self
    real(c_double), intent(in) :: corner_angle
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('domain%set_corner_angle', c_domain_set_corner_angle(self%c, corner_angle), stat, &
                  errmsg)
  end subroutine

  !> In the plane, sets the largest distance over which loose points are moved onto a curve or
  !> vertex that they miss: ends of open curves, ends of segments that join no other one, and fixed
  !> nodes. By default it is 1e-7 of the size of the domain, the longest side of its bounding box.
  !> check moves them, with a warning; set it before. With 0, none are moved. On a sphere none are
  !> moved. In space, with set_fragment, surfaces become one where they are no farther from each
  !> other, with the same warning: gaps between solids and thin overlaps are closed. Vertices within
  !> 16 times the length are then merged, and what is thinner is lost. By default no gaps are
  !> closed. Local.
  !>   length  0: none are moved
  subroutine domain_set_snap(self, length, stat, errmsg)
    class(pnpbs_domain), intent(in) :: self
    real(c_double), intent(in) :: length
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('domain%set_snap', c_domain_set_snap(self%c, length), stat, errmsg)
  end subroutine

  !> Gives a tag to the parts of the boundary around a domain in the plane or on a sphere where a
  !> function is negative, such as the open boundary of a sea where it is deep. Boundaries around
  !> holes, such as islands, keep their tags. A segment has the tag if the function is negative at
  !> its middle, an arc or a general curve likewise as a whole. Nodes are placed where the tag
  !> changes. Checks the domain first. Local; must be called identically on all ranks.
  !>   level_set  the function, called only during this procedure, with dim = 2 in the plane and 3 on
  !>              a sphere
  !>   tag        nonzero
  !>   user       optional: passed to the callback
  !>   count      optional: number of segments and curves that have the tag now because of it
  subroutine domain_tag_outline(self, level_set, tag, user, count, stat, errmsg)
    class(pnpbs_domain), intent(in) :: self
    procedure(pnpbs_level_set_fn) :: level_set
    integer(c_int32_t), intent(in) :: tag
    type(c_ptr), intent(in), optional :: user
    integer(c_int64_t), intent(out), optional :: count
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: tagged
    tagged = 0
    call conclude('domain%tag_outline', &
                  c_domain_tag_outline(self%c, c_funloc(level_set), pointer_or_null(user), tag, tagged), &
                  stat, errmsg)
    if (present(count)) count = tagged
  end subroutine

  !> Removes features smaller than d, such as those of coastlines, from the graphs and polylines of
  !> a domain in the plane. It removes vertices next to segments shorter than d, as long as the
  !> curve then passes them within tolerance * d. It also removes closed curves, such as islands and
  !> lakes, whose extent is less than smallest * d, where the extent is the longer side of the
  !> bounding box. No other vertex, fixed node or hole point changes to another side of a curve.
  !> Vertices are kept where curves meet or end, where tags change, where a vertex has a tag of its
  !> own, and at fixed nodes. Local; must be called identically on all ranks.
  !>   spacing    d, called only during this procedure
  !>   tolerance  >= 0; 0.25 suits most
  !>   smallest   >= 0; 0 removes no curve
  !>   user       optional: passed to the callback
  !>   vertices   optional: number of removed vertices, including those of removed curves
  !>   curves     optional: number of removed curves
  subroutine domain_simplify(self, spacing, tolerance, smallest, user, vertices, curves, stat, errmsg)
    class(pnpbs_domain), intent(in) :: self
    procedure(pnpbs_spacing_fn) :: spacing
    real(c_double), intent(in) :: tolerance, smallest
    type(c_ptr), intent(in), optional :: user
    integer(c_int64_t), intent(out), optional :: vertices, curves
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: left_out(2)
    left_out = 0
    call conclude('domain%simplify', &
                  c_domain_simplify(self%c, c_funloc(spacing), pointer_or_null(user), tolerance, &
                                    smallest, left_out(1), left_out(2)), stat, errmsg)
    if (present(vertices)) vertices = left_out(1)
    if (present(curves)) curves = left_out(2)
  end subroutine

  !> Removes features as simplify does, with a spacing from a file with values at points, as in
  !> placement%set_spacing_file. Local; must be called identically on all ranks. Checks the domain
  !> first.
  !>   field  optional: the name of the values; default: the only name, or 'spacing'
  subroutine domain_simplify_by_file(self, path, tolerance, smallest, field, vertices, curves, stat, &
                                     errmsg)
    class(pnpbs_domain), intent(in) :: self
    character(len=*), intent(in) :: path
    real(c_double), intent(in) :: tolerance, smallest
    character(len=*), intent(in), optional :: field
    integer(c_int64_t), intent(out), optional :: vertices, curves
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: left_out(2)
    integer(c_int) :: status
    left_out = 0
    if (present(field)) then
      status = c_domain_simplify_by_file(self%c, c_text(path), c_text(field), tolerance, smallest, &
                                         left_out(1), left_out(2))
    else
      status = c_domain_simplify_by_file(self%c, c_text(path), c_text(''), tolerance, smallest, &
                                         left_out(1), left_out(2))
    end if
    call conclude('domain%simplify_by_file', status, stat, errmsg)
    if (present(vertices)) vertices = left_out(1)
    if (present(curves)) curves = left_out(2)
  end subroutine

  !> Adds the body between two distances from the boundary of another body. A point belongs to it if
  !> its signed distance from that boundary, negative inside, lies between low and high times d.
  !> Particles that each represent d**dim of matter lie half a spacing inside the wall. To place
  !> them, use low = -huge(low) and high = -0.42 in the plane or -0.46 in space, with nodes of the
  !> spacing 1.076 d or 1.147 d. Their number is then nearly the integral of 1 / d**dim over the
  !> body. n layers of wall particles lie outside, between 0.42 and n - 0.58, or in space between
  !> 0.46 and n - 0.54. The boundary of the new body is found as that of a level set
  !> (add_level_set). In the plane it consists of curves through points about a resolution apart,
  !> with corners where it turns by more than 20 degrees within it. Thinner parts are lost. The body
  !> is checked first, and is not needed afterwards. In space the callback is also called later, as
  !> that of a level set, so it and user must outlive the placements made on the domain. Local; must
  !> be called identically on all ranks. Errors: PNPBS_ERROR_DOMAIN as in domain%check, or if
  !> nothing lies between these distances; PNPBS_ERROR_SPACING for a d that is zero, negative or not
  !> finite.
  !>   body        on the same context and with the same dimension; must have an inside
  !>   low         less than high. Values up to -huge(low), which include minus infinity, are passed
  !>               as minus infinity, for points at any depth
  !>   high        finite
  !>   spacing     optional: d, which is evaluated in the body's bounding box and around it, a
  !>               little farther than the new body reaches; default: 1 everywhere, so that low and
  !>               high are lengths
  !>   resolution  optional: > 0; default: an eighth (in space half) of the least d at the body's
  !>               boundary, or of the lesser of |low| and |high| without a callback
  !>   tag         optional: tag of the new boundary, nonzero; default: 1
  !>   user        optional: passed to the callback; default: null
  subroutine domain_add_offset(self, body, low, high, spacing, resolution, tag, user, stat, errmsg)
    class(pnpbs_domain), intent(in) :: self
    type(pnpbs_domain), intent(in) :: body
    real(c_double), intent(in) :: low, high
    procedure(pnpbs_spacing_fn), optional :: spacing
    real(c_double), intent(in), optional :: resolution
    integer(c_int32_t), intent(in), optional :: tag
    type(c_ptr), intent(in), optional :: user
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(c_funptr) :: address
    real(c_double) :: fineness
    address = c_null_funptr
    if (present(spacing)) address = c_funloc(spacing)
    fineness = 0
    if (present(resolution)) fineness = resolution
    call conclude('domain%add_offset', &
                  c_domain_add_offset(self%c, body%c, lower_limit(low), high, address, &
                                      pointer_or_null(user), fineness, tag_or_one(tag)), stat, &
                  errmsg)
  end subroutine

  ! Returns minus infinity for numbers that stand for it, and other numbers unchanged. Fortran has
  ! no literal for infinity. This is a separate function because a procedure that uses the module
  ! saves and restores the floating-point status, which must not happen around callbacks.
  function lower_limit(low)
    use, intrinsic :: ieee_arithmetic, only: ieee_negative_inf, ieee_value
    real(c_double), intent(in) :: low
    real(c_double) :: lower_limit
    lower_limit = low
    if (low <= -huge(low)) lower_limit = ieee_value(low, ieee_negative_inf)
  end function

  !> Checks the whole geometry: duplicate vertices, self-intersections, boundary curves or surfaces
  !> that do not close, hole points outside or on one, fixed nodes outside or too close. Placements
  !> check it, too; checking early adds no cost. Local. Errors: PNPBS_ERROR_DOMAIN naming the
  !> vertex, segment or triangle.
  subroutine domain_check(self, stat, errmsg)
    class(pnpbs_domain), intent(in) :: self
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('domain%check', c_domain_check(self%c), stat, errmsg)
  end subroutine

  !> Returns the bounding box of the curves or surfaces. Local.
  !>   low, high  (dim)
  subroutine domain_bounds(self, low, high, stat, errmsg)
    class(pnpbs_domain), intent(in) :: self
    real(c_double), intent(inout) :: low(:), high(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    integer(c_int) :: status
    integer :: dim
    dim = dimension_of(self, given)
    call given%check_rows('low', size(low), dim)
    call given%check_rows('high', size(high), dim)
    status = PNPBS_OK
    if (.not. given%is_wrong()) status = c_domain_bounds(self%c, low, high)
    call conclude('domain%bounds', status, stat, errmsg, given)
  end subroutine

  !> Returns the area of the inside, in space its volume, or the area of surfaces alone. Local;
  !> checks the domain first.
  subroutine domain_measure(self, measure, stat, errmsg)
    class(pnpbs_domain), intent(in) :: self
    real(c_double), intent(out) :: measure
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('domain%measure', c_domain_measure(self%c, measure), stat, errmsg)
  end subroutine

  !> Evaluates distances from the shape of the domain. They are exact for segments and triangles,
  !> and within 1e-7 of the domain's size for arcs and parametric curves. Local; checks the domain
  !> first. The first query after a change of the domain builds a search tree and calls the
  !> callbacks of curves. If a callback queries distances, query one before the run. Errors:
  !> PNPBS_ERROR_ARGUMENT if nothing has the tag.
  !>   coordinates  (dim, n)
  !>   distances    (n)
  !>   tag          optional: of curves, surfaces or nodes; default: the boundary of the domain
  subroutine domain_distance(self, coordinates, distances, tag, stat, errmsg)
    class(pnpbs_domain), intent(in) :: self
    real(c_double), intent(in) :: coordinates(:,:)
    real(c_double), intent(inout) :: distances(:)
    integer, intent(in), optional :: tag
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    integer(c_int32_t) :: which
    integer(c_int) :: status
    call check_places(self, coordinates, size(distances, kind=c_int64_t), 'distances', given)
    which = 0
    if (present(tag)) which = int(tag, c_int32_t)
    status = PNPBS_OK
    if (.not. given%is_wrong()) &
      status = c_domain_distance(self%c, which, size(distances, kind=c_int64_t), coordinates, &
                                 distances)
    call conclude('domain%distance', status, stat, errmsg, given)
  end subroutine

  !> Returns the region tags at points (domain%add_region, domain%set_fragment), for use in a
  !> spacing callback: 0 where a region has no tag, and outside of the domain the tag of the region
  !> behind the nearest point of the boundary. A point within 1e-6 of the size of the domain from
  !> interfaces lies in the regions on both sides: use the least d of these, because nodes on
  !> interfaces lie on one side or the other by rounding. Local; checks the domain first. If a
  !> callback queries regions, query them once before the run. Errors: PNPBS_ERROR_ARGUMENT if no
  !> region of the domain has a tag.
  !>   coordinates  (dim, n)
  !>   tags         (n), or (rows, n): first of the region that contains the point, then of others at
  !>                interfaces, and the first one again where there are fewer
  subroutine domain_regions_at(self, coordinates, tags, stat, errmsg)
    class(pnpbs_domain), intent(in) :: self
    real(c_double), intent(in) :: coordinates(:,:)
    integer(c_int32_t), intent(inout) :: tags(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    integer(c_int) :: status
    call check_places(self, coordinates, size(tags, kind=c_int64_t), 'tags', given)
    status = PNPBS_OK
    if (.not. given%is_wrong()) &
      status = c_domain_regions_at(self%c, size(tags, kind=c_int64_t), coordinates, 1_c_int32_t, &
                                   tags)
    call conclude('domain%regions_at', status, stat, errmsg, given)
  end subroutine

  subroutine domain_regions_at_columns(self, coordinates, tags, stat, errmsg)
    class(pnpbs_domain), intent(in) :: self
    real(c_double), intent(in) :: coordinates(:,:)
    integer(c_int32_t), intent(inout) :: tags(:,:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    integer(c_int) :: status
    call check_places(self, coordinates, size(tags, 2, kind=c_int64_t), 'tags', given)
    status = PNPBS_OK
    if (.not. given%is_wrong()) &
      status = c_domain_regions_at(self%c, size(tags, 2, kind=c_int64_t), coordinates, &
                                   size(tags, 1, kind=c_int32_t), tags)
    call conclude('domain%regions_at', status, stat, errmsg, given)
  end subroutine

  !> Evaluates the spacing that placement%set_spacing_from_shape sets, without its bounds, for use
  !> in a spacing callback. Local; checks the domain first. The first query computes what the shape
  !> requires. If a callback queries this spacing, query it once before the run.
  !>   coordinates                                           (dim, n)
  !>   d                                                     (n)
  !>   nodes_per_turn, nodes_across, nodes_per_edge, growth  optional, as in set_spacing_from_shape
  subroutine domain_shape_spacing(self, coordinates, d, nodes_per_turn, nodes_across, &
                                  nodes_per_edge, growth, stat, errmsg)
    class(pnpbs_domain), intent(in) :: self
    real(c_double), intent(in) :: coordinates(:,:)
    real(c_double), intent(inout) :: d(:)
    real(c_double), intent(in), optional :: nodes_per_turn, nodes_across, nodes_per_edge, growth
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    integer(c_int) :: status
    call check_places(self, coordinates, size(d, kind=c_int64_t), 'd', given)
    status = PNPBS_OK
    if (.not. given%is_wrong()) &
      status = c_domain_shape_spacing(self%c, or_none(nodes_per_turn), or_none(nodes_across), &
                                      or_none(nodes_per_edge), or_none(growth), &
                                      size(d, kind=c_int64_t), coordinates, d)
    call conclude('domain%shape_spacing', status, stat, errmsg, given)
  end subroutine

  ! Rejects points of another dimension, and a number of values that differs from that of points.
  subroutine check_places(self, coordinates, values, name, given)
    class(pnpbs_domain), intent(in) :: self
    real(c_double), intent(in) :: coordinates(:,:)
    integer(c_int64_t), intent(in) :: values
    character(len=*), intent(in) :: name
    type(arguments), intent(inout) :: given
    integer :: dim
    dim = dimension_of(self, given)
    call given%check_rows('coordinates', size(coordinates, 1), dim)
    call given%check_rows(name, int(values), size(coordinates, 2))
  end subroutine

  function or_none(value)
    real(c_double), intent(in), optional :: value
    real(c_double) :: or_none
    or_none = 0
    if (present(value)) or_none = value
  end function

  !> Returns the number of segments that get_segments returns. Local.
  subroutine domain_segment_count(self, count, stat, errmsg)
    class(pnpbs_domain), intent(in) :: self
    integer(c_int64_t), intent(out) :: count
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('domain%segment_count', &
                  c_domain_get_segments(self%c, 0_c_int64_t, count, c_null_ptr, c_null_ptr), stat, &
                  errmsg)
  end subroutine

  !> Returns straight segments that approximate the curves of a domain in the plane or on a sphere,
  !> for pictures. Local.
  !>   segments  optional, (dim, 2, count): coordinates of both ends of each segment
  !>   tags      optional, (count)
  subroutine domain_get_segments(self, segments, tags, stat, errmsg)
    class(pnpbs_domain), intent(in) :: self
    real(c_double), intent(inout), optional :: segments(:,:,:)
    integer(c_int32_t), intent(inout), optional :: tags(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    type(c_ptr) :: a_segments, a_tags
    integer(c_int64_t) :: room, room_for_tags, count
    integer :: dim
    integer(c_int) :: status
    dim = dimension_of(self, given)
    call given%place_real_pairs('segments', segments, dim, a_segments, room)
    call given%place_int32('tags', tags, a_tags, room_for_tags)
    room = given%capacity(min(room, room_for_tags))
    status = c_domain_get_segments(self%c, room, count, a_segments, a_tags)
    call conclude('domain%get_segments', status, stat, errmsg, given)
  end subroutine

  !> Returns the handle as an integer, or 0 if there is no domain. Local.
  function domain_handle(self) result(handle)
    class(pnpbs_domain), intent(in) :: self
    integer(c_int64_t) :: handle
    handle = integer_of(self%c)
  end function

  !> Sets the domain to the object with the given handle, without checks. Local.
  subroutine domain_from_handle(self, handle)
    class(pnpbs_domain), intent(inout) :: self
    integer(c_int64_t), intent(in) :: handle
    self%c = pointer_of(handle)
  end subroutine

  ! ------------------------------------------------------------ placement: settings -----------

  !> Creates a placement of nodes in domain, with the options of its context. The domain is read
  !> when the placement is initialised. Collective.
  subroutine placement_create(self, context, domain, stat, errmsg)
    class(pnpbs_placement), intent(inout) :: self
    type(pnpbs_context), intent(in) :: context
    type(pnpbs_domain), intent(in) :: domain
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('placement%create', c_placement_create(context%c, domain%c, self%c), stat, errmsg)
  end subroutine

  !> Destroys the placement, if it exists. Local.
  subroutine placement_destroy(self, stat, errmsg)
    class(pnpbs_placement), intent(inout) :: self
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('placement%destroy', c_placement_destroy(self%c), stat, errmsg)
  end subroutine

  !> set(key, value): sets an option of this placement. Otherwise it is like set of a context.
  !> Local.
  subroutine placement_set_text(self, key, value, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    character(len=*), intent(in) :: key, value
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('placement%set', &
                  c_placement_set(self%c, c_text(key), c_text(value)), stat, errmsg)
  end subroutine

  subroutine placement_set_int32(self, key, value, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    character(len=*), intent(in) :: key
    integer(c_int32_t), intent(in) :: value
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call self%set(key, int(value, c_int64_t), stat, errmsg)
  end subroutine

  subroutine placement_set_int64(self, key, value, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    character(len=*), intent(in) :: key
    integer(c_int64_t), intent(in) :: value
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('placement%set', c_placement_set_int64(self%c, c_text(key), value), stat, errmsg)
  end subroutine

  subroutine placement_set_real(self, key, value, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    character(len=*), intent(in) :: key
    real(c_double), intent(in) :: value
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('placement%set', c_placement_set_double(self%c, c_text(key), value), stat, errmsg)
  end subroutine

  !> Sets a constant spacing. On a live placement it replaces the spacing: the current nodes are
  !> kept, and the next run starts from them. Collective. Errors: PNPBS_ERROR_SPACING for zero,
  !> negative, not finite.
  subroutine placement_set_spacing_constant(self, d, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    real(c_double), intent(in) :: d
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('placement%set_spacing_constant', &
                  c_placement_set_spacing_constant(self%c, d), stat, errmsg)
  end subroutine

  !> Sets the spacing to a callback. It and user must stay valid as long as the placement uses it.
  !> Collective. Invalid values are detected when it is called, in initialise or run: the error
  !> names the point and the number of nodes that the value implies.
  !>   user  optional: passed to the callback; default: null
  subroutine placement_set_spacing_callback(self, spacing, user, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    procedure(pnpbs_spacing_fn) :: spacing
    type(c_ptr), intent(in), optional :: user
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('placement%set_spacing_callback', &
                  c_placement_set_spacing_callback(self%c, c_funloc(spacing), &
                                                   pointer_or_null(user)), stat, errmsg)
  end subroutine

  !> Sets the spacing to values on a rectangular grid, which are copied. It is linear in each
  !> direction between grid points and constant beyond the edge of the grid. On a sphere the grid
  !> has two directions, longitude and latitude in degrees; columns all around the sphere are
  !> joined. Collective.
  !>   origin  (dim), on a sphere (2): the first grid point
  !>   step    (dim), on a sphere (2): > 0, distance between grid points
  !>   values  (nx, ny), in space (nx, ny, nz)
  subroutine placement_set_spacing_grid(self, origin, step, values, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    real(c_double), intent(in) :: origin(:), step(:), values(:,:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    integer(c_int64_t) :: points(2)
    integer(c_int) :: status
    call check_grid(self, size(origin), size(step), 2, given)
    points = shape(values, kind=c_int64_t)
    points(1) = given%capacity(points(1))
    status = c_placement_set_spacing_grid(self%c, points, origin, step, values)
    call conclude('placement%set_spacing_grid', status, stat, errmsg, given)
  end subroutine

  subroutine placement_set_spacing_grid_in_space(self, origin, step, values, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    real(c_double), intent(in) :: origin(:), step(:), values(:,:,:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    integer(c_int64_t) :: points(3)
    integer(c_int) :: status
    call check_grid(self, size(origin), size(step), 3, given)
    points = shape(values, kind=c_int64_t)
    points(1) = given%capacity(points(1))
    status = c_placement_set_spacing_grid(self%c, points, origin, step, values)
    call conclude('placement%set_spacing_grid', status, stat, errmsg, given)
  end subroutine

  ! Rejects values of another dimension, and grids without an origin or step in each direction.
  subroutine check_grid(self, origins, steps, rank_of_values, given)
    class(pnpbs_placement), intent(in) :: self
    integer, intent(in) :: origins, steps, rank_of_values
    type(arguments), intent(inout) :: given
    integer :: extent
    extent = extent_of_elements(self, given)
    call given%check_rank('values', rank_of_values, extent)
    call given%check_rows('origin', origins, rank_of_values)
    call given%check_rows('step', steps, rank_of_values)
  end subroutine

  !> Sets the spacing to values at the nodes of a background mesh, which are copied. It is linear on
  !> each triangle, in space on each tetrahedron. Beyond the mesh it is equal to the value at the
  !> nearest point of the mesh. Collective; every rank passes and stores the same arrays. Checks the
  !> domain first. Errors: PNPBS_ERROR_SPACING for a value that is zero, negative or not finite,
  !> and, except on spheres, for a mesh whose bounding box does not meet that of the domain;
  !> PNPBS_ERROR_ARGUMENT for a node number out of range, a flat element, or arrays that differ
  !> between ranks.
  !>   coordinates  (dim, n)
  !>   d            (n)
  !>   corners      (dim + 1, elements), on a sphere (3, elements): node numbers, counted from 1, in
  !>                either orientation
  subroutine placement_set_spacing_mesh(self, coordinates, d, corners, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    real(c_double), intent(in) :: coordinates(:,:), d(:)
    integer(c_int64_t), intent(in) :: corners(:,:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    integer(c_int64_t) :: n, elements
    integer :: extent
    integer(c_int) :: status
    call check_field(self, coordinates, d, given)
    extent = extent_of_elements(self, given)
    call given%check_rows('corners', size(corners, 1), extent + 1)
    n = given%capacity(size(d, kind=c_int64_t))
    elements = size(corners, 2, kind=c_int64_t)
    status = c_placement_set_spacing_mesh(self%c, n, coordinates, d, elements, corners - 1)
    call conclude('placement%set_spacing_mesh', status, stat, errmsg, given)
  end subroutine

  !> Sets the spacing to values at scattered points, which are copied. It equals the given value at
  !> each point. Elsewhere it is a weighted mean of the values of the 8 (in space 16) nearest
  !> points, in which points behind others count less or not at all. On a sphere distances are along
  !> it. Collective; every rank passes and stores the same arrays. Checks the domain first. Errors:
  !> PNPBS_ERROR_SPACING for a value that is zero, negative or not finite, for coincident points
  !> with different values, and, except on spheres, for points whose bounding box does not meet that
  !> of the domain; PNPBS_ERROR_ARGUMENT for arrays that differ between ranks.
  !>   coordinates  (dim, n)
  !>   d            (n)
  subroutine placement_set_spacing_points(self, coordinates, d, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    real(c_double), intent(in) :: coordinates(:,:), d(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    integer(c_int) :: status
    call check_field(self, coordinates, d, given)
    status = c_placement_set_spacing_points(self%c, given%capacity(size(d, kind=c_int64_t)), &
                                            coordinates, d)
    call conclude('placement%set_spacing_points', status, stat, errmsg, given)
  end subroutine

  !> Sets the spacing to values at points from a file: .vtu (unstructured grid of VTK), .msh (Gmsh,
  !> with $NodeData) or .csv (columns x, y, (z) and others). Triangles and quadrangles, in space
  !> tetrahedra, form a mesh as in set_spacing_mesh; on a sphere elements are those of the plane.
  !> Without elements the points are used as in set_spacing_points. In the plane z is ignored.
  !> Collective; every rank reads the file. Errors: PNPBS_ERROR_FILE, and those of these two
  !> procedures.
  !>   path   trailing blanks are ignored
  !>   field  optional: the name of the values in the file; default: the only name, or 'spacing'
  subroutine placement_set_spacing_file(self, path, field, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    character(len=*), intent(in) :: path
    character(len=*), intent(in), optional :: field
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int) :: status
    if (present(field)) then
      status = c_placement_set_spacing_file(self%c, c_text(path), c_text(field))
    else
      status = c_placement_set_spacing_file(self%c, c_text(path), c_text(''))
    end if
    call conclude('placement%set_spacing_file', status, stat, errmsg)
  end subroutine

  ! Rejects points of another dimension, and a number of values that differs from that of points.
  subroutine check_field(self, coordinates, d, given)
    class(pnpbs_placement), intent(in) :: self
    real(c_double), intent(in) :: coordinates(:,:), d(:)
    type(arguments), intent(inout) :: given
    call given%check_rows('coordinates', size(coordinates, 1), dimension_of(self, given))
    call given%require('d', size(d, kind=c_int64_t), size(coordinates, 2, kind=c_int64_t))
  end subroutine

  !> Sets the spacing from the current shape of the domain. It is the minimum of the values that
  !> curves and surfaces require, each growing with the distance from them. It does not depend on
  !> the number of ranks. Collective. Errors: PNPBS_ERROR_DOMAIN as in domain%check,
  !> PNPBS_ERROR_ARGUMENT for negative numbers, PNPBS_ERROR_SPACING where the domain is too narrow
  !> to measure its width everywhere.
  !>   nodes_per_turn  optional: by curvature: number of nodes on a full circle of the radius of
  !>                   curvature; default: not used
  !>   nodes_across    optional: by width: number of nodes across the diameter of the largest ball
  !>                   that touches the boundary at a point and meets no other part of it ahead;
  !>                   default: not used
  !>   nodes_per_edge  optional: by the input: number of nodes along a segment, or along the mean
  !>                   edge of a triangle; default: not used
  !>   growth          optional: growth of d per distance; default: 0.15
  !>   min_spacing     optional: lower bound of d
  !>   max_spacing     optional: upper bound of d; default: the size of the domain
  subroutine placement_set_spacing_from_shape(self, nodes_per_turn, nodes_across, nodes_per_edge, &
                                              growth, min_spacing, max_spacing, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    real(c_double), intent(in), optional :: nodes_per_turn, nodes_across, nodes_per_edge, growth
    real(c_double), intent(in), optional :: min_spacing, max_spacing
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('placement%set_spacing_from_shape', &
                  c_placement_set_spacing_from_shape(self%c, or_none(nodes_per_turn), &
                                                     or_none(nodes_across), &
                                                     or_none(nodes_per_edge), or_none(growth), &
                                                     or_none(min_spacing), or_none(max_spacing)), &
                  stat, errmsg)
  end subroutine

  !> Sets the spacing to values at the current nodes. It is linear on each triangle or tetrahedron
  !> of their Delaunay triangulation (get_triangles, get_tetrahedra). Beyond its boundary, next to
  !> curved boundaries, it is equal to the value at the nearest point of it. Each rank passes the
  !> values of its own nodes. They stay on that rank, copied together with the triangles or
  !> tetrahedra, and the nodes may be replaced afterwards. Collective. Errors: PNPBS_ERROR_STATE
  !> without nodes, PNPBS_ERROR_SPACING for a value that is zero, negative or not finite: the
  !> message names the rank, the id of the node and the value.
  !>   d  a value for each node of this rank, in the order of get_nodes
  subroutine placement_set_spacing_at_nodes(self, d, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    real(c_double), intent(in) :: d(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('placement%set_spacing_at_nodes', &
                  c_placement_set_spacing_at_nodes(self%c, size(d, kind=c_int64_t), d), stat, &
                  errmsg)
  end subroutine

  !> Adds points at which the spacing is sampled as well. A procedure is sampled at some points of
  !> each cell of a tree, so a place with a small d that is much smaller than the cells around it may
  !> be missed: give one point in each such place. The points are used from the next initialise or
  !> run on, until another spacing is set. Points outside a body in space are ignored. Collective;
  !> each rank may pass other points, including none. Errors: PNPBS_ERROR_STATE without a spacing,
  !> PNPBS_ERROR_SPACING for a value that is zero, negative or not finite, PNPBS_ERROR_CALLBACK,
  !> PNPBS_ERROR_DOMAIN.
  !>   coordinates  (dim, n)
  subroutine placement_add_spacing_hints(self, coordinates, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    real(c_double), intent(in) :: coordinates(:,:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    integer(c_int64_t) :: n
    integer(c_int) :: status
    integer :: dim
    n = size(coordinates, 2, kind=c_int64_t)
    dim = dimension_of(self, given)
    call given%check_rows('coordinates', size(coordinates, 1), dim)
    status = c_placement_add_spacing_hints(self%c, given%capacity(n), coordinates)
    call conclude('placement%add_spacing_hints', status, stat, errmsg, given)
  end subroutine

  !> Sets the monitor, or removes it if none is given. Local.
  !>   user  optional: passed to the monitor; default: null
  subroutine placement_set_monitor(self, monitor, user, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    procedure(pnpbs_monitor_fn), optional :: monitor
    type(c_ptr), intent(in), optional :: user
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(c_funptr) :: address
    address = c_null_funptr
    if (present(monitor)) address = c_funloc(monitor)
    call conclude('placement%set_monitor', &
                  c_placement_set_monitor(self%c, address, pointer_or_null(user)), stat, errmsg)
  end subroutine

  !> Sets inner nodes from which the simulation starts instead of the initial fill. They are copied,
  !> and the library places the boundary nodes. On several ranks each rank passes some of the nodes,
  !> anywhere in the domain. Nodes many times too dense for d are thinned (statistic 'deleted').
  !> Points outside the domain or too close to its boundary are dropped (statistic 'dropped'). The
  !> current nodes are removed. In a periodic domain each point stands for its image in the box, and
  !> ids above 2**50 are refused when the nodes are placed. Collective.
  !>   coordinates  (dim, n)
  !>   ids          optional, (n): distinct, 0 .. 2**62; default: chosen by the library
  subroutine placement_set_nodes(self, coordinates, ids, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    real(c_double), intent(in) :: coordinates(:,:)
    integer(c_int64_t), intent(in), optional :: ids(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    type(c_ptr) :: a_ids
    integer(c_int64_t) :: n, room
    integer(c_int) :: status
    integer :: dim
    n = size(coordinates, 2, kind=c_int64_t)
    dim = dimension_of(self, given)
    call given%check_rows('coordinates', size(coordinates, 1), dim)
    call given%place_int64('ids', ids, a_ids, room)
    call given%require('ids', room, n)
    status = c_placement_set_nodes(self%c, given%capacity(n), coordinates, a_ids)
    call conclude('placement%set_nodes', status, stat, errmsg, given)
  end subroutine

  ! ------------------------------------------------------------ placement: computing ----------

  !> Estimates a run from scratch, from domain, spacing and options alone. It samples d at some
  !> thousand points and creates no inner node; the current nodes do not change. Collective. Errors:
  !> PNPBS_ERROR_DOMAIN, _SPACING, _CALLBACK.
  !>   nodes    optional: number of nodes on all ranks, mostly within a few percent
  !>   bytes    optional: memory of each process in bytes, for the run alone
  !>   seconds  optional: approximate time in seconds
  subroutine placement_estimate(self, nodes, bytes, seconds, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int64_t), intent(out), optional :: nodes, bytes
    real(c_double), intent(out), optional :: seconds
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: all_nodes, memory
    real(c_double) :: time
    all_nodes = 0
    memory = 0
    time = 0
    call conclude('placement%estimate', c_placement_estimate(self%c, all_nodes, memory, time), stat, &
                  errmsg)
    if (present(nodes)) nodes = all_nodes
    if (present(bytes)) bytes = memory
    if (present(seconds)) seconds = time
  end subroutine

  !> Checks domain and spacing, builds the background tree, and lays the boundary nodes and the
  !> initial inner nodes. Collective. Errors: PNPBS_ERROR_DOMAIN, _SPACING, _CALLBACK, _MEMORY.
  subroutine placement_initialise(self, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('placement%initialise', c_placement_initialise(self%c), stat, errmsg)
  end subroutine

  !> step(n): advances the simulation by n steps, with the events (refresh of d, population, stop
  !> test) that fall on them. Initialises first if necessary. Collective. stat: PNPBS_OK if the
  !> bubbles are at rest (stop test met), PNPBS_NOT_CONVERGED if they still move, PNPBS_STOPPED.
  subroutine placement_step_int32(self, n, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int32_t), intent(in) :: n
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call self%step(int(n, c_int64_t), stat, errmsg)
  end subroutine

  subroutine placement_step_int64(self, n, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int64_t), intent(in) :: n
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('placement%step', c_placement_step(self%c, n), stat, errmsg)
  end subroutine

  !> Performs one population adjustment: deletes bubbles where the overlap ratio is too large,
  !> inserts them where it is too small (equation (3) of the paper). Collective.
  !>   inserted, deleted  optional: number of nodes
  subroutine placement_adjust_population(self, inserted, deleted, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int64_t), intent(out), optional :: inserted, deleted
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: in, out
    in = 0
    out = 0
    call conclude('placement%adjust_population', &
                  c_placement_adjust_population(self%c, in, out), stat, errmsg)
    if (present(inserted)) inserted = in
    if (present(deleted)) deleted = out
  end subroutine

  !> Repartitions the work over the ranks, by METIS with the work counted in the lists, so that each
  !> rank owns an equal share and few nodes change rank. The nodes are unchanged; their owners and
  !> the ghosts of each rank change. A run does this by itself where the statistic 'imbalance'
  !> (largest over mean work) exceeds the option 'rebalance_above'. Initialises first if necessary.
  !> Collective.
  subroutine placement_rebalance(self, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('placement%rebalance', c_placement_rebalance(self%c), stat, errmsg)
  end subroutine

  !> Runs the whole placement: initialises if necessary, steps until the stop test is met or the
  !> option 'steps' is reached, and finishes. A later call starts a new schedule from the current
  !> nodes. Collective. stat: PNPBS_OK; PNPBS_NOT_CONVERGED (the best state is kept);
  !> PNPBS_SPACING_MISSED, whether or not the bubbles are at rest, if in a band of get_edge_bands
  !> with 50 edges or more the mean differs from 1 by more than 0.1 (a warning names the band);
  !> PNPBS_NOT_CONFORMING if the elements do not fill the domain (a warning names the place);
  !> PNPBS_STOPPED.
  subroutine placement_run(self, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('placement%run', c_placement_run(self%c), stat, errmsg)
  end subroutine

  ! ------------------------------------------------------------ placement: results ------------

  !> Returns the dimension of the placement's domain. Local.
  !>   dim  2: in the plane, 3: in space and on a sphere
  subroutine placement_dimension(self, dim, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int32_t), intent(out) :: dim
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    dim = 0
    call conclude('placement%dimension', c_placement_dimension(self%c, dim), stat, errmsg)
  end subroutine

  !> Returns the radius of the sphere on which the nodes of the placement lie. Local.
  !>   radius  0 if the domain is not on a sphere
  subroutine placement_sphere_radius(self, radius, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    real(c_double), intent(out) :: radius
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    radius = 0
    call conclude('placement%sphere_radius', c_placement_sphere_radius(self%c, radius), stat, errmsg)
  end subroutine

  !> Returns the number of nodes of this rank. Local.
  subroutine placement_count(self, nodes, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int64_t), intent(out) :: nodes
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    nodes = 0
    call conclude('placement%count', c_placement_count(self%c, nodes), stat, errmsg)
  end subroutine

  !> Copies the nodes of this rank, in their local order; all arrays are optional. Local.
  !>   coordinates  (dim, nodes)
  !>   ids          (nodes) global ids, the same for any number of ranks and threads
  !>   tags         (nodes) 0 for inner nodes, otherwise the tag of the curve, surface or fixed node
  !>   spacing      (nodes) d at the node
  subroutine placement_get_nodes(self, coordinates, ids, tags, spacing, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    real(c_double), intent(inout), optional :: coordinates(:,:), spacing(:)
    integer(c_int64_t), intent(inout), optional :: ids(:)
    integer(c_int32_t), intent(inout), optional :: tags(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    type(c_ptr) :: a_xyz, a_ids, a_tags, a_spacing
    integer(c_int64_t) :: room(4)
    integer(c_int) :: status
    integer :: dim
    dim = dimension_of(self, given)
    call given%place_real_columns('coordinates', coordinates, dim, a_xyz, room(1))
    call given%place_int64('ids', ids, a_ids, room(2))
    call given%place_int32('tags', tags, a_tags, room(3))
    call given%place_real('spacing', spacing, a_spacing, room(4))
    status = c_placement_get_nodes(self%c, given%capacity(minval(room)), a_xyz, a_ids, a_tags, &
                                   a_spacing)
    call conclude('placement%get_nodes', status, stat, errmsg, given)
  end subroutine

  !> Copies the surface normals at the nodes of this rank, for a placement in space. They are the
  !> unit normals of the triangles on which the nodes lie. On feature edges and in corners they are
  !> means of the adjacent normals. They are 0 at inner nodes. Local.
  !>   normals  (3, nodes)
  subroutine placement_get_normals(self, normals, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    real(c_double), intent(inout) :: normals(:,:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    integer(c_int) :: status
    call given%check_rows('normals', size(normals, 1), 3)
    status = c_placement_get_normals(self%c, given%capacity(size(normals, 2, c_int64_t)), normals)
    call conclude('placement%get_normals', status, stat, errmsg, given)
  end subroutine

  !> Returns the number of ghosts: nodes of other ranks close to those of this rank. In lists,
  !> stars, triangles and tetrahedra, ghost g has the local index nodes + g. Collective.
  subroutine placement_ghost_count(self, ghosts, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int64_t), intent(out) :: ghosts
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    ghosts = 0
    call conclude('placement%ghost_count', c_placement_ghost_count(self%c, ghosts), stat, errmsg)
  end subroutine

  !> Copies the ghosts in the order of their ids; all arrays are optional. Collective.
  !>   coordinates, ids, tags, spacing  as in get_nodes
  !>   owners                           (ghosts) the rank that owns each ghost
  subroutine placement_get_ghosts(self, coordinates, ids, tags, spacing, owners, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    real(c_double), intent(inout), optional :: coordinates(:,:), spacing(:)
    integer(c_int64_t), intent(inout), optional :: ids(:)
    integer(c_int32_t), intent(inout), optional :: tags(:), owners(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    type(c_ptr) :: a_xyz, a_ids, a_tags, a_spacing, a_owners
    integer(c_int64_t) :: room(5)
    integer(c_int) :: status
    integer :: dim
    dim = dimension_of(self, given)
    call given%place_real_columns('coordinates', coordinates, dim, a_xyz, room(1))
    call given%place_int64('ids', ids, a_ids, room(2))
    call given%place_int32('tags', tags, a_tags, room(3))
    call given%place_real('spacing', spacing, a_spacing, room(4))
    call given%place_int32('owners', owners, a_owners, room(5))
    status = c_placement_get_ghosts(self%c, given%capacity(minval(room)), a_xyz, a_ids, a_tags, &
                                    a_spacing, a_owners)
    call conclude('placement%get_ghosts', status, stat, errmsg, given)
  end subroutine

  !> Returns the sizes of the halo exchange pattern, which describes how values at nodes are sent to
  !> their ghosts on other ranks. Collective; all are optional.
  !>   neighbours  ranks with ghosts of nodes of this rank, or with nodes that are ghosts on this
  !>               rank
  !>   sends       nodes to send, counted once for every rank that has the node as a ghost
  !>   receives    nodes to receive: the number of ghosts
  subroutine placement_exchange_sizes(self, neighbours, sends, receives, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int32_t), intent(out), optional :: neighbours
    integer(c_int64_t), intent(out), optional :: sends, receives
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: ranks
    integer(c_int64_t) :: out, in
    ranks = 0
    out = 0
    in = 0
    call conclude('placement%exchange_sizes', &
                  c_placement_exchange_sizes(self%c, ranks, out, in), stat, errmsg)
    if (present(neighbours)) neighbours = ranks
    if (present(sends)) sends = out
    if (present(receives)) receives = in
  end subroutine

  !> Copies the halo exchange pattern, for use in a solver: send the values at nodes
  !> send_nodes(send_offsets(k) : send_offsets(k+1)-1) to ranks(k), and store the values received
  !> from it at receive_nodes(receive_offsets(k) : receive_offsets(k+1)-1), in the same order, which
  !> is that of ids. The pattern is valid until nodes move. Collective.
  !>   ranks            (neighbours) in increasing order, counted from 0 as in MPI
  !>   send_offsets     (neighbours + 1)
  !>   send_nodes       (sends) local indices of this rank's nodes
  !>   receive_offsets  (neighbours + 1)
  !>   receive_nodes    (receives) local indices of ghosts (nodes + g)
  subroutine placement_get_exchange(self, ranks, send_offsets, send_nodes, receive_offsets, &
                                    receive_nodes, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int32_t), intent(inout) :: ranks(:)
    integer(c_int64_t), intent(inout) :: send_offsets(:), send_nodes(:)
    integer(c_int64_t), intent(inout) :: receive_offsets(:), receive_nodes(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    type(c_ptr) :: a_ranks, a_send_offsets, a_send_nodes, a_receive_offsets, a_receive_nodes
    integer(c_int64_t) :: room(5), sends, receives
    integer(c_int32_t) :: neighbours
    integer(c_int) :: status
    if (c_placement_exchange_sizes(self%c, neighbours, sends, receives) < 0) then
      neighbours = 0
      sends = 0
      receives = 0
    end if
    call given%place_int32('ranks', ranks, a_ranks, room(1))
    call given%place_int64('send_offsets', send_offsets, a_send_offsets, room(2))
    call given%place_int64('send_nodes', send_nodes, a_send_nodes, room(3))
    call given%place_int64('receive_offsets', receive_offsets, a_receive_offsets, room(4))
    call given%place_int64('receive_nodes', receive_nodes, a_receive_nodes, room(5))
    call given%require('ranks', room(1), int(neighbours, c_int64_t))
    call given%require('send_offsets', room(2), neighbours + 1_c_int64_t)
    call given%require('send_nodes', room(3), sends)
    call given%require('receive_offsets', room(4), neighbours + 1_c_int64_t)
    call given%require('receive_nodes', room(5), receives)
    status = c_placement_get_exchange(self%c, neighbours, given%capacity(sends), receives, &
                                      a_ranks, a_send_offsets, a_send_nodes, a_receive_offsets, &
                                      a_receive_nodes)
    call conclude('placement%get_exchange', status, stat, errmsg, given)
    if (status < 0) return
    call count_from_one(send_offsets(:neighbours + 1))
    call count_from_one(receive_offsets(:neighbours + 1))
    call count_from_one(send_nodes(:sends))
    call count_from_one(receive_nodes(:receives))
  end subroutine

  !> Returns numbers that are contiguous per rank, as PETSc and hypre require, in addition to the
  !> ids. Node i of this rank has the number first + i - 1, and the numbers of rank r follow those
  !> of rank r - 1. They count from 0, as in C. Unlike ids they depend on the partition. Collective;
  !> all are optional.
  !>   first          the number of this rank's first node; 0 on rank 0
  !>   count          number of nodes of this rank
  !>   ghost_numbers  (ghosts) the numbers of the ghosts, in the order of get_ghosts
  subroutine placement_get_numbering(self, first, count, ghost_numbers, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int64_t), intent(out), optional :: first, count
    integer(c_int64_t), intent(inout), optional :: ghost_numbers(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    type(c_ptr) :: a_ghost_numbers
    integer(c_int64_t) :: room, begin, nodes
    integer(c_int) :: status
    begin = 0
    nodes = 0
    call given%place_int64('ghost_numbers', ghost_numbers, a_ghost_numbers, room)
    status = c_placement_get_numbering(self%c, given%capacity(room), begin, nodes, a_ghost_numbers)
    call conclude('placement%get_numbering', status, stat, errmsg, given)
    if (present(first)) first = begin
    if (present(count)) count = nodes
  end subroutine

  !> Updates the values at ghosts from their owners. The exchange plan is built at the first call
  !> after nodes have moved, and kept. Collective. Errors: PNPBS_ERROR_ARGUMENT for another number
  !> of values, or numbers of components that differ between ranks; PNPBS_ERROR_STATE without nodes,
  !> or while an update is in progress.
  !>   values  (nodes + ghosts), or (components, nodes + ghosts): those of this rank's nodes, then
  !>           those of its ghosts, which are filled
  subroutine placement_update_ghosts(self, values, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    real(c_double), intent(inout) :: values(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('placement%update_ghosts', &
                  c_placement_update_ghosts(self%c, size(values, kind=c_int64_t), 1_c_int32_t, &
                                            values), stat, errmsg)
  end subroutine

  subroutine placement_update_ghosts_columns(self, values, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    real(c_double), intent(inout) :: values(:,:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('placement%update_ghosts', &
                  c_placement_update_ghosts(self%c, size(values, 2, c_int64_t), &
                                            size(values, 1, c_int32_t), values), stat, errmsg)
  end subroutine

  !> Begins an update of ghosts, for a solver that computes while messages are being sent. It copies
  !> the values of the nodes of this rank that other ranks need, and starts sending them. The array
  !> may be changed or freed after the call. A placement has at most one update in progress; other
  !> calls are allowed before it ends. Collective. Errors: as in update_ghosts.
  !>   values  as in update_ghosts
  subroutine placement_begin_update_ghosts(self, values, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    real(c_double), intent(in) :: values(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('placement%begin_update_ghosts', &
                  c_placement_begin_update_ghosts(self%c, size(values, kind=c_int64_t), &
                                                  1_c_int32_t, values), stat, errmsg)
  end subroutine

  subroutine placement_begin_update_ghosts_columns(self, values, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    real(c_double), intent(in) :: values(:,:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('placement%begin_update_ghosts', &
                  c_placement_begin_update_ghosts(self%c, size(values, 2, c_int64_t), &
                                                  size(values, 1, c_int32_t), values), stat, errmsg)
  end subroutine

  !> Ends an update of ghosts: waits for the values that the other ranks have sent, and fills those
  !> of the ghosts. Values at the nodes of this rank do not change. Local: does not wait for other
  !> ranks to end theirs. Errors: PNPBS_ERROR_STATE without an update in progress, or if nodes have
  !> moved since it began, which ends it; PNPBS_ERROR_ARGUMENT for another shape, after which the
  !> update is still in progress.
  !>   values  as in update_ghosts; may be another array than at the beginning
  subroutine placement_end_update_ghosts(self, values, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    real(c_double), intent(inout) :: values(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('placement%end_update_ghosts', &
                  c_placement_end_update_ghosts(self%c, size(values, kind=c_int64_t), 1_c_int32_t, &
                                                values), stat, errmsg)
  end subroutine

  subroutine placement_end_update_ghosts_columns(self, values, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    real(c_double), intent(inout) :: values(:,:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('placement%end_update_ghosts', &
                  c_placement_end_update_ghosts(self%c, size(values, 2, c_int64_t), &
                                                size(values, 1, c_int32_t), values), stat, errmsg)
  end subroutine

  !> Adds the values at ghosts to the values of the nodes that they represent, on the ranks that own
  !> these nodes. It is the reverse of update_ghosts, for sums over elements to which several ranks
  !> contribute. Each sum, of the value of a node and those at its ghosts, is exact and rounded
  !> once, so the order of ranks has no effect. Values that a rank has summed before are rounded
  !> already. Unless those sums are exact, results for different numbers of ranks differ by
  !> rounding. Use get_incident_elements where all bits must agree. Collective. Errors: as in
  !> update_ghosts, except for updates in progress.
  !>   values  (nodes + ghosts), or (components, nodes + ghosts): those of this rank's nodes, which
  !>           become the sums, then those of its ghosts, which are unchanged
  subroutine placement_add_from_ghosts(self, values, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    real(c_double), intent(inout) :: values(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('placement%add_from_ghosts', &
                  c_placement_add_from_ghosts(self%c, size(values, kind=c_int64_t), 1_c_int32_t, &
                                              values), stat, errmsg)
  end subroutine

  subroutine placement_add_from_ghosts_columns(self, values, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    real(c_double), intent(inout) :: values(:,:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('placement%add_from_ghosts', &
                  c_placement_add_from_ghosts(self%c, size(values, 2, c_int64_t), &
                                              size(values, 1, c_int32_t), values), stat, errmsg)
  end subroutine

  !> Sums each component of a field over the nodes of all ranks. The sum is exact and rounded once
  !> to the nearest number, so its bits do not depend on the number of ranks and threads or the
  !> order of nodes. It is NaN if a value is NaN or if there are infinities of both signs. It is
  !> infinite if a value is, or if the sum exceeds the largest number. Collective. Errors: as in
  !> update_ghosts, except for updates in progress.
  !>   values  (n), or (components, n): values at the nodes of this rank; values at its ghosts may
  !>           follow and are ignored
  !>   total   a number, or (components): the same on all ranks
  subroutine placement_sum(self, values, total, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    real(c_double), intent(in) :: values(:)
    real(c_double), intent(inout) :: total
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    real(c_double) :: found(1)
    integer(c_int) :: status
    status = c_placement_sum(self%c, size(values, kind=c_int64_t), 1_c_int32_t, values, found)
    call conclude('placement%sum', status, stat, errmsg)
    if (status >= 0) total = found(1)
  end subroutine

  subroutine placement_sum_columns(self, values, total, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    real(c_double), intent(in) :: values(:,:)
    real(c_double), intent(inout) :: total(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    call given%check_rows('total', size(total), size(values, 1))
    call conclude('placement%sum', &
                  c_placement_sum(self%c, given%capacity(size(values, 2, c_int64_t)), &
                                  size(values, 1, c_int32_t), values, total), stat, errmsg, given)
  end subroutine

  !> Computes the dot product of two fields over the nodes of all ranks, for each component. It is
  !> the sum of the exact products, rounded once, with the properties of sum. Products do not
  !> overflow or underflow; the product of an infinity and 0 is NaN. Collective.
  !>   x, y     (n), or (components, n): values at the nodes of this rank; values at its ghosts may
  !>            follow
  !>   product  a number, or (components): the same on all ranks
  subroutine placement_dot(self, x, y, product, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    real(c_double), intent(in) :: x(:), y(:)
    real(c_double), intent(inout) :: product
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    real(c_double) :: found(1)
    integer(c_int) :: status
    status = c_placement_dot(self%c, min(size(x, kind=c_int64_t), size(y, kind=c_int64_t)), &
                             1_c_int32_t, x, y, found)
    call conclude('placement%dot', status, stat, errmsg)
    if (status >= 0) product = found(1)
  end subroutine

  subroutine placement_dot_columns(self, x, y, product, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    real(c_double), intent(in) :: x(:,:), y(:,:)
    real(c_double), intent(inout) :: product(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    integer(c_int64_t) :: n
    call given%check_rows('y', size(y, 1), size(x, 1))
    call given%check_rows('product', size(product), size(x, 1))
    n = min(size(x, 2, c_int64_t), size(y, 2, c_int64_t))
    call conclude('placement%dot', &
                  c_placement_dot(self%c, given%capacity(n), size(x, 1, c_int32_t), x, y, product), &
                  stat, errmsg, given)
  end subroutine

  !> Returns the number of entries of all adjacency lists of this rank's nodes. Collective.
  subroutine placement_adjacency_size(self, entries, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int64_t), intent(out) :: entries
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    entries = 0
    call conclude('placement%adjacency_size', &
                  c_placement_adjacency_size(self%c, entries), stat, errmsg)
  end subroutine

  !> Copies the adjacency lists in compressed rows: the neighbours of local node i are
  !> neighbours(offsets(i) : offsets(i+1)-1), local indices in the order of global ids. They can be
  !> used directly for node-based local mesh generation. Pairs separated by a boundary are not
  !> neighbours. Collective.
  !>   offsets     (nodes + 1)
  !>   neighbours  (entries)
  subroutine placement_get_adjacency(self, offsets, neighbours, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int64_t), intent(inout) :: offsets(:), neighbours(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    type(c_ptr) :: a_offsets, a_neighbours
    integer(c_int64_t) :: nodes, rows, room
    integer(c_int) :: status
    nodes = nodes_of(self%c)
    call given%place_int64('offsets', offsets, a_offsets, rows)
    call given%require('offsets', rows, nodes + 1)
    call given%place_int64('neighbours', neighbours, a_neighbours, room)
    status = c_placement_get_adjacency(self%c, given%capacity(room), a_offsets, a_neighbours)
    call conclude('placement%get_adjacency', status, stat, errmsg, given)
    if (status < 0) return
    call count_from_one(offsets(:nodes + 1))
    call count_from_one(neighbours(:offsets(nodes + 1) - 1))
  end subroutine

  !> Returns the number of entries of all Delaunay stars. Collective.
  subroutine placement_star_size(self, entries, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int64_t), intent(out) :: entries
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    entries = 0
    call conclude('placement%star_size', c_placement_star_size(self%c, entries), stat, errmsg)
  end subroutine

  !> Copies the star of each node in the constrained Delaunay triangulation of the domain. In the
  !> plane it is counter-clockwise. In space it consists of all nodes that share a tetrahedron with
  !> the node, in no particular order. Collective.
  !>   offsets     (nodes + 1)
  !>   neighbours  (entries) local indices
  !>   triangle    optional, (entries), logical or integer(c_int8_t): true or 1 if the node, this
  !>               neighbour and the next one around (the first one after the last) form a triangle
  !>               of the domain; false or 0 if a gap outside the domain lies between them, and
  !>               everywhere in space
  subroutine placement_get_stars(self, offsets, neighbours, triangle, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int64_t), intent(inout) :: offsets(:), neighbours(:)
    integer(c_int8_t), intent(inout), optional :: triangle(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    type(c_ptr) :: a_offsets, a_neighbours, a_triangle
    integer(c_int64_t) :: nodes, rows, room(2)
    integer(c_int) :: status
    nodes = nodes_of(self%c)
    call given%place_int64('offsets', offsets, a_offsets, rows)
    call given%require('offsets', rows, nodes + 1)
    call given%place_int64('neighbours', neighbours, a_neighbours, room(1))
    call given%place_int8('triangle', triangle, a_triangle, room(2))
    status = c_placement_get_stars(self%c, given%capacity(minval(room)), a_offsets, a_neighbours, &
                                   a_triangle)
    call conclude('placement%get_stars', status, stat, errmsg, given)
    if (status < 0) return
    call count_from_one(offsets(:nodes + 1))
    call count_from_one(neighbours(:offsets(nodes + 1) - 1))
  end subroutine

  subroutine placement_get_stars_logical(self, offsets, neighbours, triangle, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int64_t), intent(inout) :: offsets(:), neighbours(:)
    logical, intent(inout) :: triangle(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int8_t), allocatable :: flags(:)
    integer(c_int8_t), parameter :: not_set = -1
    allocate (flags(size(triangle)), source=not_set)
    call self%get_stars(offsets, neighbours, flags, stat, errmsg)
    where (flags /= not_set) triangle = flags /= 0
  end subroutine

  !> Returns the number of triangles that get_triangles returns, in the plane or on a sphere.
  !> Collective.
  subroutine placement_triangle_count(self, count, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int64_t), intent(out) :: count
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    count = 0
    call conclude('placement%triangle_count', &
                  c_placement_get_triangles(self%c, 0_c_int64_t, count, c_null_ptr), stat, errmsg)
  end subroutine

  !> Copies the triangles of the stars of a placement in the plane or on a sphere, each once,
  !> counter-clockwise, on a sphere as seen from outside. On several ranks a triangle belongs to the
  !> rank that owns its node with the lowest id; other corners may be ghosts, and the triangles of
  !> all ranks together are one conforming triangulation of the domain. Collective.
  !>   triangles  (3, count) local indices
  subroutine placement_get_triangles(self, triangles, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int64_t), intent(inout) :: triangles(:,:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    type(c_ptr) :: a_triangles
    integer(c_int64_t) :: room, count, t
    integer(c_int) :: status
    call given%place_int64_columns('triangles', triangles, 3, a_triangles, room)
    status = c_placement_get_triangles(self%c, given%capacity(room), count, a_triangles)
    call conclude('placement%get_triangles', status, stat, errmsg, given)
    if (status < 0) return
    do t = 1, count
      call count_from_one(triangles(:, t))
    end do
  end subroutine

  !> Returns the number of tetrahedra that get_tetrahedra returns, in space. Collective.
  subroutine placement_tetrahedron_count(self, count, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int64_t), intent(out) :: count
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    count = 0
    call conclude('placement%tetrahedron_count', &
                  c_placement_get_tetrahedra(self%c, 0_c_int64_t, count, c_null_ptr), stat, errmsg)
  end subroutine

  !> Copies the tetrahedra of the stars of a placement in space, each once. Seen from the fourth
  !> corner, the first three are counter-clockwise, so the volume (b-a) x (c-a) . (d-a) / 6 of
  !> corners a, b, c, d is positive. On several ranks a tetrahedron belongs to the rank that owns
  !> its node with the lowest id; other corners may be ghosts, and the tetrahedra of all ranks
  !> together are one conforming triangulation of the domain. Collective.
  !>   tetrahedra  (4, count) local indices
  subroutine placement_get_tetrahedra(self, tetrahedra, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int64_t), intent(inout) :: tetrahedra(:,:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    type(c_ptr) :: a_tetrahedra
    integer(c_int64_t) :: room, count, t
    integer(c_int) :: status
    call given%place_int64_columns('tetrahedra', tetrahedra, 4, a_tetrahedra, room)
    status = c_placement_get_tetrahedra(self%c, given%capacity(room), count, a_tetrahedra)
    call conclude('placement%get_tetrahedra', status, stat, errmsg, given)
    if (status < 0) return
    do t = 1, count
      call count_from_one(tetrahedra(:, t))
    end do
  end subroutine

  !> Copies the tag of each element, which is that of its region (domain%add_region), or 0 if the
  !> region has none. The order is that of get_triangles, in space that of get_tetrahedra.
  !> Collective. Errors: PNPBS_ERROR_CAPACITY; PNPBS_ERROR_ARGUMENT on surfaces alone.
  !>   tags  (count), as many as triangle_count or tetrahedron_count returns
  subroutine placement_get_element_tags(self, tags, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int32_t), intent(inout) :: tags(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    type(c_ptr) :: a_tags
    integer(c_int64_t) :: room, count
    integer(c_int) :: status
    call given%place_int32('tags', tags, a_tags, room)
    status = c_placement_get_element_tags(self%c, given%capacity(room), count, a_tags)
    call conclude('placement%get_element_tags', status, stat, errmsg, given)
  end subroutine

  !> Returns the number of elements that get_incident_elements returns. Collective.
  !>   corners  optional: number of corners of an element, 3 or 4
  subroutine placement_incident_element_count(self, count, corners, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int64_t), intent(out) :: count
    integer(c_int32_t), intent(out), optional :: corners
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: rows
    count = 0
    rows = 0
    call conclude('placement%incident_element_count', &
                  c_placement_get_incident_elements(self%c, 0_c_int64_t, count, rows, c_null_ptr), &
                  stat, errmsg)
    if (present(corners)) corners = rows
  end subroutine

  !> Copies every element with a corner among the nodes of this rank, also those that belong to
  !> other ranks: triangles in the plane and on surfaces alone, tetrahedra in space. With these a
  !> rank assembles the rows of its nodes without communication. The corner with the lowest id comes
  !> first. An element belongs to this rank, as defined by get_triangles and get_tetrahedra, if its
  !> first corner is one of the nodes of the rank. Elements are in the order of the ids of their
  !> corners, so those of a node are the same, in the same order, for any number of ranks. A row
  !> that is summed in this order always has the same bits. Collective.
  !>   elements  (corners, count) local indices
  subroutine placement_get_incident_elements(self, elements, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int64_t), intent(inout) :: elements(:,:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    type(c_ptr) :: a_elements
    integer(c_int64_t) :: room, count, t
    integer(c_int32_t) :: corners
    integer(c_int) :: status
    status = c_placement_get_incident_elements(self%c, 0_c_int64_t, count, corners, c_null_ptr)
    if (status >= 0) then
      call given%place_int64_columns('elements', elements, int(corners), a_elements, room)
      status = c_placement_get_incident_elements(self%c, given%capacity(room), count, corners, &
                                                 a_elements)
    end if
    call conclude('placement%get_incident_elements', status, stat, errmsg, given)
    if (status < 0) return
    do t = 1, count
      call count_from_one(elements(:, t))
    end do
  end subroutine

  !> Sets which inner curves, in space inner surfaces, are cracks: those with these tags. Then
  !> get_cracked_elements and files of elements in .msh, .msh2, .vtu and .vtkhdf have elements that
  !> share no node across a crack; other formats of elements are an error, and all other results
  !> are unchanged. The elements around a node fall into sectors that cracks separate. One of them
  !> keeps the node, along a crack that on the left of a curve or in front of a surface, and each
  !> other one gets a copy of it. At the tip of a crack there is no copy. Local, with the same tags
  !> on all ranks. Errors: PNPBS_ERROR_ARGUMENT for the tag 0.
  !>   tags  (n); n = 0: no cracks
  subroutine placement_set_cracks(self, tags, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int32_t), intent(in) :: tags(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('placement%set_cracks', &
                  c_placement_set_cracks(self%c, size(tags, kind=c_int32_t), tags), &
                  stat, errmsg)
  end subroutine

  !> Returns the number of copies that get_crack_nodes returns. Collective.
  !>   all  optional: number of copies of all ranks
  subroutine placement_crack_node_count(self, count, all, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int64_t), intent(out) :: count
    integer(c_int64_t), intent(out), optional :: all
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: copies
    count = 0
    copies = 0
    call conclude('placement%crack_node_count', &
                  c_placement_get_crack_nodes(self%c, 0_c_int64_t, count, copies, c_null_ptr, &
                                              c_null_ptr), stat, errmsg)
    if (present(all)) all = copies
  end subroutine

  !> Copies the pairs of nodes on cracks: copies of this rank's nodes, and then copies of ghosts that
  !> its elements refer to. Copy k of this list has the local index nodes + ghosts + k, and
  !> position, tag and spacing of its original. Collective. Errors: PNPBS_ERROR_ARGUMENT if no inner
  !> curve or surface has one of the tags of set_cracks, and on surfaces alone; PNPBS_ERROR_CAPACITY.
  !>   nodes    optional, (count): local indices of the originals
  !>   numbers  optional, (count): 0, 1, ... over all ranks, in the order of the ids of the originals
  subroutine placement_get_crack_nodes(self, nodes, numbers, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int64_t), intent(inout), optional :: nodes(:), numbers(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    type(c_ptr) :: a_nodes, a_numbers
    integer(c_int64_t) :: room(2), count, all
    integer(c_int) :: status
    call given%place_int64('nodes', nodes, a_nodes, room(1))
    call given%place_int64('numbers', numbers, a_numbers, room(2))
    status = c_placement_get_crack_nodes(self%c, given%capacity(minval(room)), count, all, a_nodes, &
                                         a_numbers)
    call conclude('placement%get_crack_nodes', status, stat, errmsg, given)
    if (status < 0) return
    if (present(nodes)) call count_from_one(nodes(:count))
  end subroutine

  !> Copies the elements with doubled nodes along cracks (set_cracks): triangles in the plane,
  !> tetrahedra in space, in the order of get_triangles and get_tetrahedra, which is also that of
  !> get_element_tags. Collective. Errors: as get_crack_nodes.
  !>   elements  (3 or 4, count) local indices, those behind all nodes and ghosts of copies; as many
  !>             as triangle_count or tetrahedron_count returns
  subroutine placement_get_cracked_elements(self, elements, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int64_t), intent(inout) :: elements(:,:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    type(c_ptr) :: a_elements
    integer(c_int64_t) :: room, count, t
    integer(c_int) :: status
    integer :: dim
    dim = dimension_filled(self)
    call given%place_int64_columns('elements', elements, dim + 1, a_elements, room)
    status = c_placement_get_cracked_elements(self%c, given%capacity(room), count, a_elements)
    call conclude('placement%get_cracked_elements', status, stat, errmsg, given)
    if (status < 0) return
    do t = 1, count
      call count_from_one(elements(:, t))
    end do
  end subroutine

  !> Returns the number of facets that get_crack_facets returns. Collective.
  !>   covered  optional: the area of the facets of all ranks over that of the surfaces, 1 in the
  !>            plane. Where d is too coarse for elements to follow a surface, facets are missing,
  !>            and elements connect its two sides there
  subroutine placement_crack_facet_count(self, count, covered, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int64_t), intent(out) :: count
    real(c_double), intent(out), optional :: covered
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    real(c_double) :: share
    count = 0
    share = 0
    call conclude('placement%crack_facet_count', &
                  c_placement_get_crack_facets(self%c, 0_c_int64_t, count, share, c_null_ptr, &
                                               c_null_ptr, c_null_ptr), stat, errmsg)
    if (present(covered)) covered = share
  end subroutine

  !> Copies both sides of the facets of cracks, edges in the plane and triangles in space. The nodes
  !> of the sides coincide in pairs and are different except at tips. Collective. Errors: as
  !> get_crack_nodes.
  !>   front  optional, (2 or 3, count): local indices, on the left of a curve from the first to the
  !>          second node, or in front of a surface, from where the corners are counter-clockwise
  !>   back   optional, likewise: the same nodes on the other side
  !>   tags   optional, (count)
  subroutine placement_get_crack_facets(self, front, back, tags, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int64_t), intent(inout), optional :: front(:,:), back(:,:)
    integer(c_int32_t), intent(inout), optional :: tags(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    type(c_ptr) :: a_front, a_back, a_tags
    integer(c_int64_t) :: room(3), count, f
    real(c_double) :: covered
    integer(c_int) :: status
    integer :: dim
    dim = dimension_filled(self)
    call given%place_int64_columns('front', front, dim, a_front, room(1))
    call given%place_int64_columns('back', back, dim, a_back, room(2))
    call given%place_int32('tags', tags, a_tags, room(3))
    status = c_placement_get_crack_facets(self%c, given%capacity(minval(room)), count, covered, &
                                          a_front, a_back, a_tags)
    call conclude('placement%get_crack_facets', status, stat, errmsg, given)
    if (status < 0) return
    do f = 1, count
      if (present(front)) call count_from_one(front(:, f))
      if (present(back)) call count_from_one(back(:, f))
    end do
  end subroutine

  !> Returns the dimension of what the nodes fill, which is 2 on a sphere.
  function dimension_filled(self) result(dim)
    class(pnpbs_placement), intent(in) :: self
    integer :: dim
    integer(c_int32_t) :: coordinates
    integer(c_int) :: status
    real(c_double) :: radius
    coordinates = 2
    radius = 0
    status = c_placement_dimension(self%c, coordinates)
    status = c_placement_sphere_radius(self%c, radius)
    dim = merge(2, int(coordinates), radius > 0)
  end function

  !> Returns the number of edges that get_edges returns. Collective.
  !>   straight  optional: edges of all ranks that are straight lest an element folds
  subroutine placement_edge_count(self, count, straight, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int64_t), intent(out) :: count
    integer(c_int64_t), intent(out), optional :: straight
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: lines
    count = 0
    lines = 0
    call conclude('placement%edge_count', &
                  c_placement_get_edges(self%c, 0_c_int64_t, count, lines, c_null_ptr, &
                                        c_null_ptr, c_null_ptr), stat, errmsg)
    if (present(straight)) straight = lines
  end subroutine

  !> Copies the edges of the elements of this rank, and of its facets, with a mid node on each, for
  !> elements of second order. Mid nodes on boundary and inner curves and surfaces lie on these,
  !> and on spheres all of them do. Where an element would fold, its edges are straight. Edges,
  !> numbers and mid nodes are the same for any number of ranks, several of which may have an edge.
  !> Collective.
  !>   ends       optional, (2, count): local indices, ascending
  !>   numbers    optional, (count): 0, 1, ... over all ranks, in the order of the ids of the ends
  !>   midpoints  optional, (dim, count): positions of the mid nodes
  subroutine placement_get_edges(self, ends, numbers, midpoints, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int64_t), intent(inout), optional :: ends(:,:)
    integer(c_int64_t), intent(inout), optional :: numbers(:)
    real(c_double), intent(inout), optional :: midpoints(:,:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    type(c_ptr) :: a_ends, a_numbers, a_midpoints
    integer(c_int64_t) :: room(3), count, straight, e
    integer :: dim
    integer(c_int) :: status
    dim = dimension_of(self, given)
    call given%place_int64_columns('ends', ends, 2, a_ends, room(1))
    call given%place_int64('numbers', numbers, a_numbers, room(2))
    call given%place_real_columns('midpoints', midpoints, dim, a_midpoints, room(3))
    status = c_placement_get_edges(self%c, given%capacity(minval(room)), count, straight, &
                                   a_ends, a_numbers, a_midpoints)
    call conclude('placement%get_edges', status, stat, errmsg, given)
    if (status < 0 .or. .not. present(ends)) return
    do e = 1, count
      call count_from_one(ends(:, e))
    end do
  end subroutine

  !> Finds the edges of elements or facets among those of get_edges. A triangle with the
  !> corners 1, 2, 3 has 12, 23 and 13, a tetrahedron also 14, 24 and 34. Collective.
  !>   cells  (corners, n): local indices, as other procedures return them
  !>   edges  (corners * (corners - 1) / 2, n): indices of edges; 0 for those that this rank does
  !>          not have
  subroutine placement_find_edges(self, cells, edges, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int64_t), intent(in) :: cells(:,:)
    integer(c_int64_t), intent(inout) :: edges(:,:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    type(c_ptr) :: a_edges ! only checked
    integer(c_int64_t) :: room, n
    integer :: corners
    integer(c_int) :: status
    corners = size(cells, 1)
    n = size(cells, 2, c_int64_t)
    call given%place_int64_columns('edges', edges, corners * (corners - 1) / 2, a_edges, room)
    call given%require('edges', room, n)
    status = c_placement_find_edges(self%c, given%capacity(n), int(corners, c_int32_t), cells - 1, &
                                    edges)
    call conclude('placement%find_edges', status, stat, errmsg, given)
    if (status >= 0) edges = edges + 1
  end subroutine

  !> Returns the number of triangles that get_boundary_triangles returns, in space. Collective.
  subroutine placement_boundary_triangle_count(self, count, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int64_t), intent(out) :: count
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    count = 0
    call conclude('placement%boundary_triangle_count', &
                  c_placement_get_boundary_triangles(self%c, 0_c_int64_t, count, c_null_ptr, &
                                                     c_null_ptr), stat, errmsg)
  end subroutine

  !> Copies the boundary triangles of a placement in space, which are the faces of only one
  !> tetrahedron, counter-clockwise as seen from outside. On surfaces alone, they are the triangles
  !> between the nodes. On several ranks a triangle belongs to the rank that owns its node with the
  !> lowest id. Collective.
  !>   triangles  optional, (3, count) local indices
  !>   tags       optional, (count): tag of the surface there
  subroutine placement_get_boundary_triangles(self, triangles, tags, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int64_t), intent(inout), optional :: triangles(:,:)
    integer(c_int32_t), intent(inout), optional :: tags(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    type(c_ptr) :: a_triangles, a_tags
    integer(c_int64_t) :: room(2), count, t
    integer(c_int) :: status
    call given%place_int64_columns('triangles', triangles, 3, a_triangles, room(1))
    call given%place_int32('tags', tags, a_tags, room(2))
    status = c_placement_get_boundary_triangles(self%c, given%capacity(minval(room)), count, &
                                                a_triangles, a_tags)
    call conclude('placement%get_boundary_triangles', status, stat, errmsg, given)
    if (status < 0 .or. .not. present(triangles)) return
    do t = 1, count
      call count_from_one(triangles(:, t))
    end do
  end subroutine

  !> Returns the number of boundary edges that get_boundary_edges returns, in the plane or on a
  !> sphere. Local.
  subroutine placement_boundary_edge_count(self, count, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int64_t), intent(out) :: count
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    count = 0
    call conclude('placement%boundary_edge_count', &
                  c_placement_get_boundary_edges(self%c, 0_c_int64_t, count, c_null_ptr, &
                                                 c_null_ptr), stat, errmsg)
  end subroutine

  !> Copies the boundary edges of a placement in the plane or on a sphere: consecutive nodes on
  !> boundary and inner curves. On several ranks an edge belongs to the rank that owns its first
  !> node; the other end may be a ghost. Local.
  !>   edges  optional, (2, count) local indices
  !>   tags   optional, (count)
  subroutine placement_get_boundary_edges(self, edges, tags, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int64_t), intent(inout), optional :: edges(:,:)
    integer(c_int32_t), intent(inout), optional :: tags(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    type(c_ptr) :: a_edges, a_tags
    integer(c_int64_t) :: room(2), count, e
    integer(c_int) :: status
    call given%place_int64_columns('edges', edges, 2, a_edges, room(1))
    call given%place_int32('tags', tags, a_tags, room(2))
    status = c_placement_get_boundary_edges(self%c, given%capacity(minval(room)), count, a_edges, &
                                            a_tags)
    call conclude('placement%get_boundary_edges', status, stat, errmsg, given)
    if (status < 0 .or. .not. present(edges)) return
    do e = 1, count
      call count_from_one(edges(:, e))
    end do
  end subroutine

  !> Checks the invariants of the results. Ids are unique, no two nodes coincide, all lie inside or
  !> on the boundary, and all nodes of the boundary's curves or feature edges are present. Adjacency
  !> lists are symmetric. The triangles or tetrahedra of the stars are one conforming triangulation
  !> of the domain, each in the stars of all its corners, with every boundary edge, and their areas
  !> or volumes add up to those that the boundary encloses. In space the boundary triangles are
  !> closed, and cut off no more of the domain than chords do. The check takes about as long as
  !> building lists and stars, and no rank holds more than its share. Collective. stat: PNPBS_OK;
  !> PNPBS_NOT_CONFORMING where run returns it, too. Errors: PNPBS_ERROR_INTERNAL if anything else
  !> is wrong, with ids and coordinates; PNPBS_ERROR_STATE without nodes.
  subroutine placement_check(self, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('placement%check', c_placement_check(self%c), stat, errmsg)
  end subroutine

  !> get(key, value): returns a statistic by key (see pnpbs_statistic_info). Collective (some are
  !> computed on request). Errors: PNPBS_ERROR_KEY with the nearest known name, or if the type
  !> differs; PNPBS_ERROR_ARGUMENT if the key differs between ranks.
  !>   value  integer(c_int64_t), real(c_double), or character(len=:), allocatable
  subroutine placement_get_int64(self, key, value, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    character(len=*), intent(in) :: key
    integer(c_int64_t), intent(out) :: value
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    value = 0
    call conclude('placement%get', c_placement_get_int64(self%c, c_text(key), value), stat, errmsg)
  end subroutine

  subroutine placement_get_real(self, key, value, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    character(len=*), intent(in) :: key
    real(c_double), intent(out) :: value
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    value = 0
    call conclude('placement%get', c_placement_get_double(self%c, c_text(key), value), stat, errmsg)
  end subroutine

  subroutine placement_get_text(self, key, value, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    character(len=*), intent(in) :: key
    character(len=:), allocatable, intent(out) :: value
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(c_ptr) :: text
    integer(c_int) :: status
    status = c_placement_get_string(self%c, c_text(key), text)
    value = ''
    call conclude('placement%get', status, stat, errmsg)
    if (status >= 0) value = text_of(text)
  end subroutine

  !> Returns the number of bands that get_edge_bands returns: 8 at most. Collective.
  subroutine placement_edge_band_count(self, count, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int64_t), intent(out) :: count
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    count = 0
    call conclude('placement%edge_band_count', &
                  c_placement_get_edge_bands(self%c, 0_c_int64_t, count, c_null_ptr, c_null_ptr, &
                                             c_null_ptr, c_null_ptr, c_null_ptr), stat, errmsg)
  end subroutine

  !> Measures how well the edges of the triangles or tetrahedra follow the spacing, by bands of d.
  !> There are eight, equal in log d between the smallest and the largest d at the nodes, or one if
  !> the largest is less than 1.1 times the smallest. Bands without edges are left out. The d of an
  !> edge is the mean of d at its ends. Edges between two boundary nodes are not counted, because
  !> the corners of the domain determine their positions. The result includes all ranks and is the
  !> same on each. Collective.
  !>   d_from, d_to  optional, (count): lower and upper end of each band, increasing
  !>   edges         optional, (count): number of edges
  !>   mean          optional, (count): mean of edge length over d
  !>   deviation     optional, (count): standard deviation of edge length over d
  subroutine placement_get_edge_bands(self, d_from, d_to, edges, mean, deviation, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    real(c_double), intent(inout), optional :: d_from(:), d_to(:), mean(:), deviation(:)
    integer(c_int64_t), intent(inout), optional :: edges(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    type(c_ptr) :: a_from, a_to, a_edges, a_mean, a_deviation
    integer(c_int64_t) :: room(5), count
    call given%place_real('d_from', d_from, a_from, room(1))
    call given%place_real('d_to', d_to, a_to, room(2))
    call given%place_int64('edges', edges, a_edges, room(3))
    call given%place_real('mean', mean, a_mean, room(4))
    call given%place_real('deviation', deviation, a_deviation, room(5))
    call conclude('placement%get_edge_bands', &
                  c_placement_get_edge_bands(self%c, given%capacity(minval(room)), count, a_from, &
                                             a_to, a_edges, a_mean, a_deviation), stat, errmsg, &
                  given)
  end subroutine

  !> Returns the number of regions that get_regions returns. Collective.
  subroutine placement_region_count(self, count, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int64_t), intent(out) :: count
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    count = 0
    call conclude('placement%region_count', &
                  c_placement_get_regions(self%c, 0_c_int64_t, count, c_null_ptr, c_null_ptr, &
                                          c_null_ptr, c_null_ptr), stat, errmsg)
  end subroutine

  !> Measures the regions of the domain by the tags of their elements (get_element_tags), also the
  !> elements without a tag if there are any. The result includes all ranks and is the same on each,
  !> with the same bits for any number of them. Collective. Errors: PNPBS_ERROR_CAPACITY;
  !> PNPBS_ERROR_ARGUMENT on surfaces alone.
  !>   tags      optional, (count), increasing
  !>   nodes     optional, (count): number of nodes of the elements; those of an interface are in
  !>             several regions
  !>   elements  optional, (count): number of elements
  !>   measures  optional, (count): volume of the elements, in the plane area
  subroutine placement_get_regions(self, tags, nodes, elements, measures, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int32_t), intent(inout), optional :: tags(:)
    integer(c_int64_t), intent(inout), optional :: nodes(:), elements(:)
    real(c_double), intent(inout), optional :: measures(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    type(c_ptr) :: a_tags, a_nodes, a_elements, a_measures
    integer(c_int64_t) :: room(4), count
    call given%place_int32('tags', tags, a_tags, room(1))
    call given%place_int64('nodes', nodes, a_nodes, room(2))
    call given%place_int64('elements', elements, a_elements, room(3))
    call given%place_real('measures', measures, a_measures, room(4))
    call conclude('placement%get_regions', &
                  c_placement_get_regions(self%c, given%capacity(minval(room)), count, a_tags, &
                                          a_nodes, a_elements, a_measures), stat, errmsg, given)
  end subroutine

  !> Returns the number of bands that get_cell_bands returns: 8 at most. Collective.
  subroutine placement_cell_band_count(self, count, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int64_t), intent(out) :: count
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    count = 0
    call conclude('placement%cell_band_count', &
                  c_placement_get_cell_bands(self%c, c_text('edge_ratio'), 0_c_int64_t, count, &
                                             c_null_ptr, c_null_ptr, c_null_ptr, c_null_ptr, &
                                             c_null_ptr), stat, errmsg)
  end subroutine

  !> Measures the Voronoi cells of the nodes as finite volumes need them, by bands of d, in the
  !> plane and on spheres; elsewhere there are no bands. A cell is the polygon of the circumcentres
  !> of the triangles around an inner node that is not fixed. On spheres, lengths and areas are
  !> along the sphere. The ends of the bands are those of get_edge_bands. Bands with neither a cell
  !> nor an edge are left out, so the bands are the same for all measures. The d of a cell is that
  !> of its node; the d of an edge is the mean at its ends. The result includes all ranks and is the
  !> same on each. Collective.
  !>   measure       'edge_ratio': the shortest over the longest edge of each cell; 'area_ratio':
  !>                 the smaller over the larger area of the two cells at each edge; 'dual_offset':
  !>                 for each edge between two such nodes, the distance of its midpoint from that of
  !>                 the Voronoi edge across it, over its length
  !>   d_from, d_to  optional, (count): lower and upper end of each band, increasing
  !>   number        optional, (count): number of cells or edges measured
  !>   mean          optional, (count): mean of the measure; mean and worst are 0 if number is 0
  !>   worst         optional, (count): the smallest ratio, or the largest offset
  subroutine placement_get_cell_bands(self, measure, d_from, d_to, number, mean, worst, stat, &
                                      errmsg)
    class(pnpbs_placement), intent(in) :: self
    character(len=*), intent(in) :: measure
    real(c_double), intent(inout), optional :: d_from(:), d_to(:), mean(:), worst(:)
    integer(c_int64_t), intent(inout), optional :: number(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    type(c_ptr) :: a_from, a_to, a_number, a_mean, a_worst
    integer(c_int64_t) :: room(5), count
    call given%place_real('d_from', d_from, a_from, room(1))
    call given%place_real('d_to', d_to, a_to, room(2))
    call given%place_int64('number', number, a_number, room(3))
    call given%place_real('mean', mean, a_mean, room(4))
    call given%place_real('worst', worst, a_worst, room(5))
    call conclude('placement%get_cell_bands', &
                  c_placement_get_cell_bands(self%c, c_text(measure), &
                                             given%capacity(minval(room)), count, a_from, a_to, &
                                             a_number, a_mean, a_worst), stat, errmsg, given)
  end subroutine

  !> Returns the number of warnings about domain and spacing, collected at initialise (a feature
  !> smaller than the spacing, an unused vertex, ...), and about nodes that do not follow the
  !> spacing, from the last run. Local.
  subroutine placement_warning_count(self, count, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int32_t), intent(out) :: count
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    count = 0
    call conclude('placement%warning_count', c_placement_warning_count(self%c, count), stat, errmsg)
  end subroutine

  !> Returns one of the warnings. Local.
  !>   index  1 .. count
  subroutine placement_get_warning(self, index, text, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int32_t), intent(in) :: index
    character(len=:), allocatable, intent(out) :: text
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(c_ptr) :: c
    integer(c_int) :: status
    status = c_placement_get_warning(self%c, index - 1_c_int32_t, c)
    text = ''
    call conclude('placement%get_warning', status, stat, errmsg)
    if (status >= 0) text = text_of(c)
  end subroutine

  !> Returns one of the warnings as data. Local.
  !>   index  1 .. count of warnings
  !>   code   one of PNPBS_WARNING_...
  !>   count  number of nodes, edges, triangles or points that the warning is about; 0 if it is not
  !>          known
  !>   value  a number that the warning is about; NaN if there is none
  !>   point  (3) coordinates of the first point that the text names; the third is NaN in the plane;
  !>          all are NaN if there is none
  subroutine placement_get_warning_data(self, index, code, count, value, point, stat, errmsg)
    use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
    class(pnpbs_placement), intent(in) :: self
    integer(c_int32_t), intent(in) :: index
    integer(c_int32_t), intent(out) :: code
    integer(c_int64_t), intent(out) :: count
    real(c_double), intent(out) :: value, point(3)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    real(c_double), target :: x(3)
    code = PNPBS_WARNING_UNKNOWN
    count = 0
    value = ieee_value(value, ieee_quiet_nan)
    x = value
    point = value
    call conclude('placement%get_warning_data', &
                  c_placement_get_warning_data(self%c, index - 1_c_int32_t, code, count, value, &
                                               c_loc(x)), stat, errmsg)
    point = x
  end subroutine

  ! ------------------------------------------------------------ transfer ----------------------

  !> Creates a transfer of a field to later sets of nodes. It holds copies of the values at the
  !> current nodes of the placement, of these nodes, and of their triangles or tetrahedra, each rank
  !> its own. The nodes may then move, be replaced or change their ranks, and the placement may be
  !> destroyed. The field is linear on each triangle or tetrahedron. Beyond their boundary, next to
  !> curved boundaries, it is extrapolated from the element at the nearest point of that boundary.
  !> Linear fields are preserved, and others change by a term of second order in d. On surfaces
  !> alone it is linear on each triangle between their nodes, and elsewhere equal to the value at
  !> the nearest point of these triangles. Collective. Errors: PNPBS_ERROR_STATE without nodes;
  !> PNPBS_ERROR_ARGUMENT for another number of values, or one that is not finite: the message names
  !> the rank, the component (from 0) and the id of the node.
  !>   placement  the placement whose nodes have the values
  !>   values     (nodes), or (components, nodes), in the order of get_nodes
  subroutine transfer_create(self, placement, values, stat, errmsg)
    class(pnpbs_transfer), intent(inout) :: self
    type(pnpbs_placement), intent(in) :: placement
    real(c_double), intent(in) :: values(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('transfer%create', &
                  c_transfer_create(placement%c, size(values, kind=c_int64_t), 1_c_int32_t, &
                                    values, self%c), stat, errmsg)
  end subroutine

  subroutine transfer_create_columns(self, placement, values, stat, errmsg)
    class(pnpbs_transfer), intent(inout) :: self
    type(pnpbs_placement), intent(in) :: placement
    real(c_double), intent(in) :: values(:,:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('transfer%create', &
                  c_transfer_create(placement%c, size(values, 2, c_int64_t), &
                                    size(values, 1, c_int32_t), values, self%c), stat, errmsg)
  end subroutine

  !> Creates a transfer as create does, with second order. At each node a quadratic polynomial
  !> passes through its value and is fitted by least squares to those of its neighbours and of their
  !> neighbours. Within an element the polynomials of its corners are weighted as in the linear
  !> field. Quadratic fields are preserved, and smooth ones change by a term of third order in d.
  !> Next to jumps the field may leave the range of the values there. Where a node has too few
  !> neighbours, its part is linear (order returns their number), as it is everywhere on surfaces
  !> alone. Collective.
  !>   placement  the placement whose nodes have the values
  !>   values     (nodes), or (components, nodes), in the order of get_nodes
  subroutine transfer_create_second_order(self, placement, values, stat, errmsg)
    class(pnpbs_transfer), intent(inout) :: self
    type(pnpbs_placement), intent(in) :: placement
    real(c_double), intent(in) :: values(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('transfer%create_second_order', &
                  c_transfer_create_second_order(placement%c, size(values, kind=c_int64_t), &
                                                 1_c_int32_t, values, self%c), stat, errmsg)
  end subroutine

  subroutine transfer_create_second_order_columns(self, placement, values, stat, errmsg)
    class(pnpbs_transfer), intent(inout) :: self
    type(pnpbs_placement), intent(in) :: placement
    real(c_double), intent(in) :: values(:,:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('transfer%create_second_order', &
                  c_transfer_create_second_order(placement%c, size(values, 2, c_int64_t), &
                                                 size(values, 1, c_int32_t), values, self%c), &
                  stat, errmsg)
  end subroutine

  !> Returns the order of the field. Local.
  !>   order         1 or 2
  !>   linear_nodes  optional: number of nodes on all ranks without a quadratic polynomial; -1 with
  !>                 order 1
  subroutine transfer_order(self, order, linear_nodes, stat, errmsg)
    class(pnpbs_transfer), intent(in) :: self
    integer(c_int32_t), intent(out) :: order
    integer(c_int64_t), intent(out), optional :: linear_nodes
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: found
    order = 0
    found = 0
    call conclude('transfer%order', c_transfer_order(self%c, order, found), stat, errmsg)
    if (present(linear_nodes)) linear_nodes = found
  end subroutine

  !> Destroys the transfer, if it exists. Local.
  subroutine transfer_destroy(self, stat, errmsg)
    class(pnpbs_transfer), intent(inout) :: self
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('transfer%destroy', c_transfer_destroy(self%c), stat, errmsg)
  end subroutine

  !> Returns the shape of the arrays of a transfer. Local; all are optional.
  !>   dim         2: in the plane, 3: in space and on a sphere
  !>   components  numbers at each node
  subroutine transfer_sizes(self, dim, components, stat, errmsg)
    class(pnpbs_transfer), intent(in) :: self
    integer(c_int32_t), intent(out), optional :: dim, components
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: found_dim, found_components
    found_dim = 0
    found_components = 0
    call conclude('transfer%sizes', &
                  c_transfer_sizes(self%c, found_dim, found_components), stat, errmsg)
    if (present(dim)) dim = found_dim
    if (present(components)) components = found_components
  end subroutine

  !> Evaluates the field at the current nodes of a placement. The bits do not depend on the number
  !> of ranks and threads, at creation and now. A node at the position of an earlier one has its
  !> value unchanged. The placement may be another one of the same context and dimension.
  !> Collective. Errors: PNPBS_ERROR_CAPACITY; PNPBS_ERROR_STATE without nodes; PNPBS_ERROR_ARGUMENT
  !> for a placement of another context or dimension, or not on the same sphere.
  !>   values    (nodes), or (components, nodes), in the order of get_nodes; use update_ghosts for
  !>             values at ghosts
  !>   conserve  optional: if true, one number per component is added everywhere, so that the
  !>             integral of the field on the current triangles or tetrahedra (on surfaces alone,
  !>             triangles) equals that on the previous ones, to rounding. If both fill the same
  !>             domain, the number is of second order in d, and zero up to rounding for a linear
  !>             field. Next to curved boundaries it also compensates for the difference of the
  !>             areas or volumes. Values may leave their previous range. On a sphere the integral
  !>             is the sum, over the triangles, of the area along the sphere times the mean of the
  !>             values at the corners
  subroutine transfer_at_nodes(self, placement, values, conserve, stat, errmsg)
    class(pnpbs_transfer), intent(in) :: self
    type(pnpbs_placement), intent(in) :: placement
    real(c_double), intent(inout) :: values(:)
    logical, intent(in), optional :: conserve
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    call check_components(self, 1, given)
    call conclude('transfer%at_nodes', &
                  c_transfer_at_nodes(self%c, placement%c, flag_of(conserve), &
                                      given%capacity(size(values, kind=c_int64_t)), values), &
                  stat, errmsg, given)
  end subroutine

  subroutine transfer_at_nodes_columns(self, placement, values, conserve, stat, errmsg)
    class(pnpbs_transfer), intent(in) :: self
    type(pnpbs_placement), intent(in) :: placement
    real(c_double), intent(inout) :: values(:,:)
    logical, intent(in), optional :: conserve
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    call check_components(self, size(values, 1), given)
    call conclude('transfer%at_nodes', &
                  c_transfer_at_nodes(self%c, placement%c, flag_of(conserve), &
                                      given%capacity(size(values, 2, c_int64_t)), values), &
                  stat, errmsg, given)
  end subroutine

  !> Evaluates the field at points; each rank passes its own points, or none. Collective. Errors:
  !> PNPBS_ERROR_ARGUMENT for coordinates that are not finite.
  !>   coordinates  (dim, n)
  !>   values       (n), or (components, n)
  subroutine transfer_at_points(self, coordinates, values, stat, errmsg)
    class(pnpbs_transfer), intent(in) :: self
    real(c_double), intent(in) :: coordinates(:,:)
    real(c_double), intent(inout) :: values(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    integer(c_int64_t) :: n
    n = size(coordinates, 2, c_int64_t)
    call check_components(self, 1, given)
    call check_points(self, size(coordinates, 1), size(values, kind=c_int64_t), n, given)
    call conclude('transfer%at_points', &
                  c_transfer_at_points(self%c, given%capacity(n), coordinates, values), stat, &
                  errmsg, given)
  end subroutine

  subroutine transfer_at_points_columns(self, coordinates, values, stat, errmsg)
    class(pnpbs_transfer), intent(in) :: self
    real(c_double), intent(in) :: coordinates(:,:)
    real(c_double), intent(inout) :: values(:,:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    integer(c_int64_t) :: n
    n = size(coordinates, 2, c_int64_t)
    call check_components(self, size(values, 1), given)
    call check_points(self, size(coordinates, 1), size(values, 2, c_int64_t), n, given)
    call conclude('transfer%at_points', &
                  c_transfer_at_points(self%c, given%capacity(n), coordinates, values), stat, &
                  errmsg, given)
  end subroutine

  ! Rejects values with another number of components than the field has.
  subroutine check_components(self, components, given)
    class(pnpbs_transfer), intent(in) :: self
    integer, intent(in) :: components
    type(arguments), intent(inout) :: given
    integer(c_int32_t) :: dim, right
    if (c_transfer_sizes(self%c, dim, right) < 0) return ! the following call reports the error
    call given%check_rows('values', components, int(right))
  end subroutine

  ! Rejects points of another dimension, and values without room for all of them.
  subroutine check_points(self, rows, room, points, given)
    class(pnpbs_transfer), intent(in) :: self
    integer, intent(in) :: rows
    integer(c_int64_t), intent(in) :: room, points
    type(arguments), intent(inout) :: given
    integer(c_int32_t) :: right, components
    if (c_transfer_sizes(self%c, right, components) < 0) return
    call given%check_rows('coordinates', rows, int(right))
    call given%require('values', room, points)
  end subroutine

  function flag_of(choice) result(flag)
    logical, intent(in), optional :: choice
    integer(c_int32_t) :: flag
    flag = 0
    if (present(choice)) flag = merge(1_c_int32_t, 0_c_int32_t, choice)
  end function

  !> Returns the handle as an integer, for code without derived types, or 0 if there is no object.
  !> Local.
  function transfer_handle(self) result(handle)
    class(pnpbs_transfer), intent(in) :: self
    integer(c_int64_t) :: handle
    handle = integer_of(self%c)
  end function

  !> Sets the transfer to the object with the given handle, without checks. Local.
  subroutine transfer_from_handle(self, handle)
    class(pnpbs_transfer), intent(inout) :: self
    integer(c_int64_t), intent(in) :: handle
    self%c = pointer_of(handle)
  end subroutine

  ! ------------------------------------------------------------ distributed mesh --------------

  !> Creates a distributed mesh of the current nodes. On each rank it has the nodes, elements and
  !> facets that the rank owns, and layers of ghost elements with their nodes, in arrays that
  !> solvers need. No rank holds more than its part. Elements are triangles in the plane, tetrahedra
  !> in space, and triangles on surfaces alone. All have a positive orientation; on surfaces alone
  !> they are counter-clockwise as seen from the side to which the normal points. A node belongs to
  !> the rank that owns it in the placement, and an element to the owner of its node with the lowest
  !> id. Both have numbers from 0, as in C, which are contiguous by rank: within a rank, nodes are
  !> in the order of their ids (as by placement%get_numbering) and elements in the order of the ids
  !> of their corners. Local indices count from 1, and are integer(c_int32_t): first what this rank
  !> owns, in the order of the numbers, then the ghosts, also in the order of numbers. The mesh is a
  !> copy: nodes may move afterwards, and the placement may be destroyed. Collective. Errors:
  !> PNPBS_ERROR_STATE without nodes; PNPBS_ERROR_ARGUMENT for ghost_layers out of 0 .. 16 or not
  !> the same on all ranks.
  !>   placement     the placement whose nodes and elements the mesh has
  !>   ghost_layers  optional. With 0, the default, this rank has only the elements that it owns.
  !>                 With 1 it also has the elements of other ranks that share a node with these
  !>                 elements or contain a node that it owns, and therefore all elements at its
  !>                 nodes. Each further layer adds the elements that share a node with the previous
  !>                 layer
  subroutine mesh_create(self, placement, ghost_layers, stat, errmsg)
    class(pnpbs_mesh), intent(inout) :: self
    type(pnpbs_placement), intent(in) :: placement
    integer(c_int32_t), intent(in), optional :: ghost_layers
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: layers
    layers = 0
    if (present(ghost_layers)) layers = ghost_layers
    call conclude('mesh%create', c_mesh_create(placement%c, layers, self%c), stat, errmsg)
  end subroutine

  !> Destroys the mesh, if it exists. Local.
  subroutine mesh_destroy(self, stat, errmsg)
    class(pnpbs_mesh), intent(inout) :: self
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('mesh%destroy', c_mesh_destroy(self%c), stat, errmsg)
  end subroutine

  !> Returns the sizes of the part of this rank. Local; all are optional.
  !>   dim             number of coordinates of a node, 2 or 3
  !>   corners         number of nodes of an element, 3 or 4; a facet has one less
  !>   owned_nodes     nodes that this rank owns
  !>   nodes           owned nodes, and nodes of other ranks in the elements on this rank
  !>   owned_elements  elements that this rank owns
  !>   elements        owned elements and ghost elements
  !>   facets          facets of these elements (see get_facets)
  subroutine mesh_sizes(self, dim, corners, owned_nodes, nodes, owned_elements, elements, facets, &
                        stat, errmsg)
    class(pnpbs_mesh), intent(in) :: self
    integer(c_int32_t), intent(out), optional :: dim, corners
    integer(c_int64_t), intent(out), optional :: owned_nodes, nodes, owned_elements, elements
    integer(c_int64_t), intent(out), optional :: facets
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: rows(2)
    integer(c_int64_t) :: counts(5)
    rows = 0
    counts = 0
    call conclude('mesh%sizes', &
                  c_mesh_sizes(self%c, rows(1), rows(2), counts(1), counts(2), counts(3), &
                               counts(4), counts(5)), stat, errmsg)
    if (present(dim)) dim = rows(1)
    if (present(corners)) corners = rows(2)
    if (present(owned_nodes)) owned_nodes = counts(1)
    if (present(nodes)) nodes = counts(2)
    if (present(owned_elements)) owned_elements = counts(3)
    if (present(elements)) elements = counts(4)
    if (present(facets)) facets = counts(5)
  end subroutine

  !> Returns the first numbers of this rank, and the counts over all ranks. Numbers count from 0, as
  !> in C. Local; all are optional.
  !>   first_node     this rank owns the nodes first_node .. first_node + owned_nodes - 1; 0 on
  !>                  rank 0
  !>   all_nodes      nodes of all ranks
  !>   first_element  likewise, for elements
  !>   all_elements   elements of all ranks, each counted once
  subroutine mesh_numbering(self, first_node, all_nodes, first_element, all_elements, stat, errmsg)
    class(pnpbs_mesh), intent(in) :: self
    integer(c_int64_t), intent(out), optional :: first_node, all_nodes
    integer(c_int64_t), intent(out), optional :: first_element, all_elements
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: found(4)
    found = 0
    call conclude('mesh%numbering', &
                  c_mesh_numbering(self%c, found(1), found(2), found(3), found(4)), stat, errmsg)
    if (present(first_node)) first_node = found(1)
    if (present(all_nodes)) all_nodes = found(2)
    if (present(first_element)) first_element = found(3)
    if (present(all_elements)) all_elements = found(4)
  end subroutine

  !> Copies the nodes of this rank; all arrays are optional. Local.
  !>   coordinates  (dim, nodes)
  !>   numbers      (nodes) from 0
  !>   ids          (nodes) ids, which do not depend on the ranks
  !>   owners       (nodes) the rank that owns each node
  !>   tags         (nodes) as in placement%get_nodes
  subroutine mesh_get_nodes(self, coordinates, numbers, ids, owners, tags, stat, errmsg)
    class(pnpbs_mesh), intent(in) :: self
    real(c_double), intent(inout), optional :: coordinates(:,:)
    integer(c_int64_t), intent(inout), optional :: numbers(:), ids(:)
    integer(c_int32_t), intent(inout), optional :: owners(:), tags(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    type(c_ptr) :: a_xyz, a_numbers, a_ids, a_owners, a_tags
    integer(c_int64_t) :: room(5)
    integer(c_int32_t) :: dim
    integer(c_int) :: status
    call self%sizes(dim=dim, stat=status)
    if (status < 0) call given%refuse(status, pnpbs_last_error())
    call given%place_real_columns('coordinates', coordinates, int(dim), a_xyz, room(1))
    call given%place_int64('numbers', numbers, a_numbers, room(2))
    call given%place_int64('ids', ids, a_ids, room(3))
    call given%place_int32('owners', owners, a_owners, room(4))
    call given%place_int32('tags', tags, a_tags, room(5))
    status = c_mesh_get_nodes(self%c, given%capacity(minval(room)), a_xyz, a_numbers, a_ids, &
                              a_owners, a_tags)
    call conclude('mesh%get_nodes', status, stat, errmsg, given)
  end subroutine

  !> Copies the elements of this rank; all arrays are optional. Local.
  !>   nodes    (corners, elements) local indices of the nodes at the corners
  !>   numbers  (elements) from 0
  !>   owners   (elements) the rank that owns each element
  !>   tags     (elements) tag of the region (domain%add_region), or 0 if the region has none; on
  !>            surfaces alone tag of the surface
  subroutine mesh_get_elements(self, nodes, numbers, owners, tags, stat, errmsg)
    class(pnpbs_mesh), intent(in) :: self
    integer(c_int32_t), intent(inout), optional :: nodes(:,:), owners(:), tags(:)
    integer(c_int64_t), intent(inout), optional :: numbers(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    type(c_ptr) :: a_nodes, a_numbers, a_owners, a_tags
    integer(c_int64_t) :: room(4), count, e
    integer(c_int32_t) :: corners
    integer(c_int) :: status
    call self%sizes(corners=corners, elements=count, stat=status)
    if (status < 0) call given%refuse(status, pnpbs_last_error())
    call given%place_int32_columns('nodes', nodes, int(corners), a_nodes, room(1))
    call given%place_int64('numbers', numbers, a_numbers, room(2))
    call given%place_int32('owners', owners, a_owners, room(3))
    call given%place_int32('tags', tags, a_tags, room(4))
    status = c_mesh_get_elements(self%c, given%capacity(minval(room)), a_nodes, a_numbers, &
                                 a_owners, a_tags)
    call conclude('mesh%get_elements', status, stat, errmsg, given)
    if (status < 0 .or. .not. present(nodes)) return
    do e = 1, count
      call count_from_one(nodes(:, e))
    end do
  end subroutine

  !> Copies the numbers of the nodes at the corners of the elements of this rank, as integers of
  !> eight or four bytes. Local. Errors also: PNPBS_ERROR_CAPACITY for four bytes if the mesh has
  !> more than 2**31 - 1 nodes over all ranks.
  !>   numbers  (corners, elements) from 0; integer(c_int64_t) or integer(c_int32_t)
  subroutine mesh_get_connectivity(self, numbers, stat, errmsg)
    class(pnpbs_mesh), intent(in) :: self
    integer(c_int64_t), intent(inout) :: numbers(:,:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    integer(c_int) :: status
    call check_corners(self, size(numbers, 1), given)
    status = c_mesh_get_connectivity(self%c, given%capacity(size(numbers, 2, c_int64_t)), numbers)
    call conclude('mesh%get_connectivity', status, stat, errmsg, given)
  end subroutine

  subroutine mesh_get_connectivity_int32(self, numbers, stat, errmsg)
    class(pnpbs_mesh), intent(in) :: self
    integer(c_int32_t), intent(inout) :: numbers(:,:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    integer(c_int) :: status
    call check_corners(self, size(numbers, 1), given)
    status = c_mesh_get_connectivity_int32(self%c, &
                                           given%capacity(size(numbers, 2, c_int64_t)), numbers)
    call conclude('mesh%get_connectivity', status, stat, errmsg, given)
  end subroutine

  ! Rejects numbers of elements with another number of corners.
  subroutine check_corners(self, rows, given)
    class(pnpbs_mesh), intent(in) :: self
    integer, intent(in) :: rows
    type(arguments), intent(inout) :: given
    integer(c_int32_t) :: corners
    integer(c_int) :: status
    call self%sizes(corners=corners, stat=status)
    if (status < 0) call given%refuse(status, pnpbs_last_error())
    call given%check_rows('numbers', rows, int(corners))
  end subroutine

  !> Copies the facets of the elements of this rank. In the plane, facets are edges of triangles on
  !> the boundary or on inner curves. In space, they are triangles of tetrahedra on the boundary or
  !> on inner surfaces. On surfaces alone, they are the edges of only one triangle. Each facet
  !> occurs once on a rank. It belongs to the owner of its element with the lowest number. All
  !> arrays are optional. Local.
  !>   nodes     (corners - 1, facets) local indices. In space they are counter-clockwise as seen
  !>             from outside, or oriented as the inner surface; in the plane they are in the
  !>             direction of the curve
  !>   tags      (facets) tag of the curve or surface; on surfaces alone tag of the surface
  !>   elements  (2, facets) local indices of the elements at each facet; the second is 0 if it does
  !>             not exist or is not on this rank
  !>   opposite  (facets) index, 1 .. corners, of the corner of the first element that is not a
  !>             corner of the facet
  !>   inner     (facets), logical or integer(c_int8_t): true or 1 if elements lie on both sides, on
  !>             any ranks; false or 0 on the boundary
  !>   owners    (facets) the rank to which each facet belongs
  subroutine mesh_get_facets(self, nodes, tags, elements, opposite, inner, owners, stat, errmsg)
    class(pnpbs_mesh), intent(in) :: self
    integer(c_int32_t), intent(inout), optional :: nodes(:,:), tags(:), elements(:,:), opposite(:)
    integer(c_int8_t), intent(inout), optional :: inner(:)
    integer(c_int32_t), intent(inout), optional :: owners(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    type(c_ptr) :: a_nodes, a_tags, a_elements, a_opposite, a_inner, a_owners
    integer(c_int64_t) :: room(6), count, f
    integer(c_int32_t) :: corners
    integer(c_int) :: status
    call self%sizes(corners=corners, facets=count, stat=status)
    if (status < 0) call given%refuse(status, pnpbs_last_error())
    call given%place_int32_columns('nodes', nodes, int(corners) - 1, a_nodes, room(1))
    call given%place_int32('tags', tags, a_tags, room(2))
    call given%place_int32_columns('elements', elements, 2, a_elements, room(3))
    call given%place_int32('opposite', opposite, a_opposite, room(4))
    call given%place_int8('inner', inner, a_inner, room(5))
    call given%place_int32('owners', owners, a_owners, room(6))
    status = c_mesh_get_facets(self%c, given%capacity(minval(room)), a_nodes, a_tags, a_elements, &
                               a_opposite, a_inner, a_owners)
    call conclude('mesh%get_facets', status, stat, errmsg, given)
    if (status < 0) return
    if (present(opposite)) call count_from_one(opposite(:count))
    do f = 1, count
      if (present(nodes)) call count_from_one(nodes(:, f))
      if (present(elements)) call count_from_one(elements(:, f))
    end do
  end subroutine

  subroutine mesh_get_facets_logical(self, nodes, tags, elements, opposite, inner, owners, stat, &
                                     errmsg)
    class(pnpbs_mesh), intent(in) :: self
    integer(c_int32_t), intent(inout), optional :: nodes(:,:), tags(:), elements(:,:), opposite(:)
    logical, intent(inout) :: inner(:)
    integer(c_int32_t), intent(inout), optional :: owners(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int8_t), allocatable :: flags(:)
    integer(c_int8_t), parameter :: not_set = -1
    allocate (flags(size(inner)), source=not_set)
    call self%get_facets(nodes, tags, elements, opposite, flags, owners, stat, errmsg)
    where (flags /= not_set) inner = flags /= 0
  end subroutine

  !> Returns the sizes of the arrays of get_sharing. Local; all are optional.
  !>   nodes    number of nodes that this rank shares
  !>   entries  number of sharing ranks, summed over these nodes
  subroutine mesh_sharing_sizes(self, nodes, entries, stat, errmsg)
    class(pnpbs_mesh), intent(in) :: self
    integer(c_int64_t), intent(out), optional :: nodes, entries
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: found(2)
    found = 0
    call conclude('mesh%sharing_sizes', &
                  c_mesh_sharing_sizes(self%c, found(1), found(2)), stat, errmsg)
    if (present(nodes)) nodes = found(1)
    if (present(entries)) entries = found(2)
  end subroutine

  !> Copies the ranks that share nodes with this one: node shared(k) is shared with ranks(offsets(k)
  !> : offsets(k+1)-1). A node is shared by its owner and the ranks that own an element at it.
  !> Local.
  !>   shared   (nodes) local indices of the nodes, in the order of numbers
  !>   offsets  (nodes + 1)
  !>   ranks    (entries) other ranks, counted from 0 as in MPI, in increasing order for each node
  subroutine mesh_get_sharing(self, shared, offsets, ranks, stat, errmsg)
    class(pnpbs_mesh), intent(in) :: self
    integer(c_int32_t), intent(inout) :: shared(:), ranks(:)
    integer(c_int64_t), intent(inout) :: offsets(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    integer(c_int64_t) :: nodes, entries
    integer(c_int) :: status
    call self%sharing_sizes(nodes, entries, stat=status)
    if (status < 0) call given%refuse(status, pnpbs_last_error())
    call given%require('shared', size(shared, kind=c_int64_t), nodes)
    call given%require('offsets', size(offsets, kind=c_int64_t), nodes + 1)
    call given%require('ranks', size(ranks, kind=c_int64_t), entries)
    status = c_mesh_get_sharing(self%c, given%capacity(nodes), entries, shared, offsets, ranks)
    call conclude('mesh%get_sharing', status, stat, errmsg, given)
    if (status < 0) return
    call count_from_one(shared(:nodes))
    call count_from_one(offsets(:nodes + 1))
  end subroutine

  !> Writes the mesh into files of Gmsh's format 4.1, partitioned as Gmsh does it: rank r writes
  !> prefix_<r + 1>.msh, which is partition r + 1. A file has the nodes, elements and ghost elements
  !> of the rank and the facets that it owns. Nodes and elements have their numbers plus 1, and
  !> facets are numbered after all elements, so all files use the same numbers. Tags are physical
  !> groups, named as by placement%write; the inside is a group, too. Programs that read ghost
  !> elements, such as deal.II, need a mesh of one ghost layer. All files appear when all are
  !> complete; after an error, existing files are unchanged. Files of an earlier mesh on more ranks
  !> remain. Collective. Errors: PNPBS_ERROR_ARGUMENT for a prefix that is empty or not the same on
  !> all ranks; PNPBS_ERROR_FILE on all ranks if one cannot write, with a message that names its
  !> file.
  !>   prefix  folder and beginning of the names of the files; trailing blanks are ignored
  subroutine mesh_write(self, prefix, stat, errmsg)
    class(pnpbs_mesh), intent(in) :: self
    character(len=*), intent(in) :: prefix
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('mesh%write', c_mesh_write(self%c, c_text(prefix)), stat, errmsg)
  end subroutine

  !> Returns the handle as an integer, for code without derived types, or 0 if there is no object.
  !> Local.
  function mesh_handle(self) result(handle)
    class(pnpbs_mesh), intent(in) :: self
    integer(c_int64_t) :: handle
    handle = integer_of(self%c)
  end function

  !> Sets the mesh to the object with the given handle, without checks. Local.
  subroutine mesh_from_handle(self, handle)
    class(pnpbs_mesh), intent(inout) :: self
    integer(c_int64_t), intent(in) :: handle
    self%c = pointer_of(handle)
  end subroutine

  ! ------------------------------------------------------------ Voronoi cells -----------------

  !> Creates the Voronoi cells of the current nodes: for each node the part of the elements of the
  !> placement that is closer to it than to any other node, with its volume, its faces to neighbours
  !> and its share of the boundary. In the plane and on surfaces, volumes are areas, and areas of
  !> faces are lengths. On surfaces alone distances are straight. On spheres lengths, areas and
  !> distances are along the sphere. Each element is divided among the corners of all elements that
  !> touch it, so a cell does not extend through a gap without elements. The volumes add up to that
  !> of the elements, up to rounding; on spheres, to the area of the triangles along the sphere. The
  !> bits do not depend on the number of ranks and threads. The cells are copies: nodes may move
  !> afterwards, and the placement may be destroyed. Collective. Errors: PNPBS_ERROR_STATE without
  !> nodes.
  !>   placement  the placement whose nodes have the cells
  subroutine voronoi_create(self, placement, stat, errmsg)
    class(pnpbs_voronoi), intent(inout) :: self
    type(pnpbs_placement), intent(in) :: placement
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('voronoi%create', c_voronoi_create(placement%c, self%c), stat, errmsg)
  end subroutine

  !> Destroys the cells, if they exist. Local.
  subroutine voronoi_destroy(self, stat, errmsg)
    class(pnpbs_voronoi), intent(inout) :: self
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('voronoi%destroy', c_voronoi_destroy(self%c), stat, errmsg)
  end subroutine

  !> Returns the sizes of the cells of this rank. Local; all are optional.
  !>   dim    number of coordinates of a node, 2 or 3
  !>   nodes  nodes that this rank owns, each of which has a cell
  !>   faces  faces of these cells; a face between two of them is counted twice
  subroutine voronoi_sizes(self, dim, nodes, faces, stat, errmsg)
    class(pnpbs_voronoi), intent(in) :: self
    integer(c_int32_t), intent(out), optional :: dim
    integer(c_int64_t), intent(out), optional :: nodes, faces
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: columns
    integer(c_int64_t) :: counts(2)
    columns = 0
    counts = 0
    call conclude('voronoi%sizes', c_voronoi_sizes(self%c, columns, counts(1), counts(2)), stat, &
                  errmsg)
    if (present(dim)) dim = columns
    if (present(nodes)) nodes = counts(1)
    if (present(faces)) faces = counts(2)
  end subroutine

  !> Copies the volumes of the cells and their shares of the boundary; both are optional. Nodes are
  !> in the order of placement%get_nodes. In the plane and in bodies, the areas of the faces of a
  !> cell times their normals and its share of the boundary add up to 0. Local.
  !>   volumes   (nodes)
  !>   boundary  (dim, nodes) the outward normal integrated over the part of the boundary that is
  !>             closest to the node. Where the boundary is flat, its length is the area of this
  !>             part. It is 0 for nodes away from the boundary
  subroutine voronoi_get_cells(self, volumes, boundary, stat, errmsg)
    class(pnpbs_voronoi), intent(in) :: self
    real(c_double), intent(inout), optional :: volumes(:), boundary(:,:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    type(c_ptr) :: a_volumes, a_boundary
    integer(c_int64_t) :: room(2)
    integer(c_int32_t) :: dim
    integer(c_int) :: status
    call self%sizes(dim=dim, stat=status)
    if (status < 0) call given%refuse(status, pnpbs_last_error())
    call given%place_real('volumes', volumes, a_volumes, room(1))
    call given%place_real_columns('boundary', boundary, int(dim), a_boundary, room(2))
    status = c_voronoi_get_cells(self%c, given%capacity(minval(room)), a_volumes, a_boundary)
    call conclude('voronoi%get_cells', status, stat, errmsg, given)
  end subroutine

  !> Copies the faces of the cells in compressed rows: those of local node i are offsets(i) to
  !> offsets(i+1)-1, in the order of the ids of the neighbours. Both cells at a face have the same
  !> area and distance to the last bit. All arrays but offsets are optional. Local.
  !>   offsets    (nodes + 1)
  !>   ids        (faces) id of the neighbour
  !>   numbers    (faces) number of the neighbour, from 0, as in placement%get_numbering
  !>   areas      (faces)
  !>   distances  (faces) distance from the node to the neighbour
  !>   normals    (dim, faces) unit vector from the node to the neighbour
  subroutine voronoi_get_faces(self, offsets, ids, numbers, areas, distances, normals, stat, errmsg)
    class(pnpbs_voronoi), intent(in) :: self
    integer(c_int64_t), intent(inout) :: offsets(:)
    integer(c_int64_t), intent(inout), optional :: ids(:), numbers(:)
    real(c_double), intent(inout), optional :: areas(:), distances(:), normals(:,:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    type(c_ptr) :: a_offsets, a_ids, a_numbers, a_areas, a_distances, a_normals
    integer(c_int64_t) :: room(5), rows, nodes
    integer(c_int32_t) :: dim
    integer(c_int) :: status
    call self%sizes(dim, nodes, stat=status)
    if (status < 0) call given%refuse(status, pnpbs_last_error())
    call given%require('offsets', size(offsets, kind=c_int64_t), nodes + 1)
    call given%place_int64('offsets', offsets, a_offsets, rows)
    call given%place_int64('ids', ids, a_ids, room(1))
    call given%place_int64('numbers', numbers, a_numbers, room(2))
    call given%place_real('areas', areas, a_areas, room(3))
    call given%place_real('distances', distances, a_distances, room(4))
    call given%place_real_columns('normals', normals, int(dim), a_normals, room(5))
    status = c_voronoi_get_faces(self%c, given%capacity(rows - 1), minval(room), a_offsets, &
                                 a_ids, a_numbers, a_areas, a_distances, a_normals)
    call conclude('voronoi%get_faces', status, stat, errmsg, given)
    if (status >= 0) call count_from_one(offsets(:nodes + 1))
  end subroutine

  !> Returns the handle as an integer, for code without derived types, or 0 if there is no object.
  !> Local.
  function voronoi_handle(self) result(handle)
    class(pnpbs_voronoi), intent(in) :: self
    integer(c_int64_t) :: handle
    handle = integer_of(self%c)
  end function

  !> Sets the cells to the object with the given handle, without checks. Local.
  subroutine voronoi_from_handle(self, handle)
    class(pnpbs_voronoi), intent(inout) :: self
    integer(c_int64_t), intent(in) :: handle
    self%c = pointer_of(handle)
  end subroutine

  ! ------------------------------------------------------------ particles ---------------------

  !> Creates particles that fill a body. Each represents a piece of matter of about d^2, or d^3 in
  !> space. The nodes of the placement, which lie in the offset that domain%add_offset makes of the
  !> body, become the particles. Where two are closer than 0.5 times the mean of their d, as at
  !> creases and in thin places, one of them is left out. Then pairs closer than 0.85 times that
  !> mean in space, or 0.9 times in the plane, are pushed apart by at most 0.3 d, as far as the wall
  !> and other particles allow. Of pairs that are still closer than 0.611 in space, or 0.651 in the
  !> plane, one is left out. All others keep their positions. The volume of a particle is that of
  !> its Voronoi cell within the elements (voronoi%create). At the wall, and next to particles that
  !> have moved or are left out, it is the volume of the part of the body that is visible from the
  !> particle, up to halfway to others, times one factor, so that all volumes add up to the measure
  !> of the body. The bits do not depend on the number of ranks and threads. The particles are a
  !> copy, and the placement does not change. Collective. Errors: PNPBS_ERROR_STATE without nodes;
  !> PNPBS_ERROR_ARGUMENT for a placement on surfaces alone, or a body without inside;
  !> PNPBS_ERROR_DOMAIN as in domain%check, if a node is not strictly inside the body, or if the
  !> factor is not between 0.8 and 1.25, because the nodes do not fill the body then.
  !>   placement  the placement whose nodes become particles
  !>   body       a domain with the dimension and on the context of the placement
  subroutine particles_create(self, placement, body, stat, errmsg)
    class(pnpbs_particles), intent(inout) :: self
    type(pnpbs_placement), intent(in) :: placement
    type(pnpbs_domain), intent(in) :: body
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('particles%create', c_particles_create(placement%c, body%c, self%c), stat, errmsg)
  end subroutine

  !> Destroys the particles, if they exist. Local.
  subroutine particles_destroy(self, stat, errmsg)
    class(pnpbs_particles), intent(inout) :: self
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('particles%destroy', c_particles_destroy(self%c), stat, errmsg)
  end subroutine

  !> Returns the numbers of particles. Local; all are optional.
  !>   dim    number of coordinates of a particle, 2 or 3
  !>   count  number of particles of this rank
  !>   all    number of particles of all ranks
  subroutine particles_sizes(self, dim, count, all, stat, errmsg)
    class(pnpbs_particles), intent(in) :: self
    integer(c_int32_t), intent(out), optional :: dim
    integer(c_int64_t), intent(out), optional :: count, all
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: columns
    integer(c_int64_t) :: counts(2)
    columns = 0
    counts = 0
    call conclude('particles%sizes', c_particles_sizes(self%c, columns, counts(1), counts(2)), &
                  stat, errmsg)
    if (present(dim)) dim = columns
    if (present(count)) count = counts(1)
    if (present(all)) all = counts(2)
  end subroutine

  !> Returns statistics over all ranks. Local; all are optional.
  !>   left_out  number of nodes left out because others are too close
  !>   moved     number of particles that were pushed away from the positions of their nodes
  !>   closest   the least distance of two particles over the mean of their d; infinity if no two
  !>             are closer than that mean
  subroutine particles_figures(self, left_out, moved, closest, stat, errmsg)
    class(pnpbs_particles), intent(in) :: self
    integer(c_int64_t), intent(out), optional :: left_out, moved
    real(c_double), intent(out), optional :: closest
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: counts(2)
    real(c_double) :: least
    counts = 0
    least = 0
    call conclude('particles%figures', c_particles_figures(self%c, counts(1), counts(2), least), &
                  stat, errmsg)
    if (present(left_out)) left_out = counts(1)
    if (present(moved)) moved = counts(2)
    if (present(closest)) closest = least
  end subroutine

  !> Copies the particles of this rank, in the order of their ids; all arrays are optional. Local.
  !>   x        (dim, count) coordinates
  !>   volumes  (count) volumes, or areas in the plane; over all ranks they add up to that of the
  !>            body
  !>   spacing  (count) d of the nodes from which the particles were made
  !>   ids      (count) ids of these nodes; some numbers may be missing
  !>   tags     (count) tags of these nodes: the outermost ones have that of the offset, all others
  !>            0
  subroutine particles_get(self, x, volumes, spacing, ids, tags, stat, errmsg)
    class(pnpbs_particles), intent(in) :: self
    real(c_double), intent(inout), optional :: x(:,:), volumes(:), spacing(:)
    integer(c_int64_t), intent(inout), optional :: ids(:)
    integer(c_int32_t), intent(inout), optional :: tags(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    type(c_ptr) :: a_x, a_volumes, a_spacing, a_ids, a_tags
    integer(c_int64_t) :: room(5)
    integer(c_int32_t) :: dim
    integer(c_int) :: status
    call self%sizes(dim=dim, stat=status)
    if (status < 0) call given%refuse(status, pnpbs_last_error())
    call given%place_real_columns('x', x, int(dim), a_x, room(1))
    call given%place_real('volumes', volumes, a_volumes, room(2))
    call given%place_real('spacing', spacing, a_spacing, room(3))
    call given%place_int64('ids', ids, a_ids, room(4))
    call given%place_int32('tags', tags, a_tags, room(5))
    status = c_particles_get(self%c, given%capacity(minval(room)), a_x, a_volumes, a_spacing, &
                             a_ids, a_tags)
    call conclude('particles%get', status, stat, errmsg, given)
  end subroutine

  !> Adds a field of the caller to files of particles that are written afterwards, in the formats
  !> that placement%add_output_field names. A name can be used once. The values are copied. Local.
  !> Errors: PNPBS_ERROR_ARGUMENT.
  !>   name    as in placement%add_output_field; none of id, tag, spacing, volume, quality and
  !>           vtkGhostType
  !>   values  (n), or (components, n): values at the particles of this rank, in the order of get
  subroutine particles_add_output_field(self, name, values, stat, errmsg)
    class(pnpbs_particles), intent(in) :: self
    character(len=*), intent(in) :: name
    real(c_double), intent(in) :: values(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('particles%add_output_field', &
                  c_particles_add_output_field(self%c, c_text(name), size(values, kind=c_int64_t), &
                                               1_c_int32_t, values), stat, errmsg)
  end subroutine

  subroutine particles_add_output_field_columns(self, name, values, stat, errmsg)
    class(pnpbs_particles), intent(in) :: self
    character(len=*), intent(in) :: name
    real(c_double), intent(in) :: values(:,:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('particles%add_output_field', &
                  c_particles_add_output_field(self%c, c_text(name), size(values, 2, c_int64_t), &
                                               size(values, 1, c_int32_t), values), stat, errmsg)
  end subroutine

  !> Writes the particles of all ranks into one file, in the format of its extension, as
  !> placement%write writes nodes without elements. The file has id, tag and spacing, and, in
  !> formats with fields, the field `volume` and the added fields. Formats of elements alone and
  !> .pvtu are PNPBS_ERROR_ARGUMENT. The bytes of the file do not depend on the number of ranks and
  !> threads. While the placement exists, its monitor is called and can stop the call. Collective.
  !> stat: PNPBS_OK, PNPBS_STOPPED. Errors: as in placement%write.
  !>   path  trailing blanks are ignored
  subroutine particles_write(self, path, stat, errmsg)
    class(pnpbs_particles), intent(in) :: self
    character(len=*), intent(in) :: path
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(texts), target :: paths
    call paths%put([path])
    call conclude('particles%write', &
                  c_particles_write(self%c, 1_c_int32_t, paths%addresses, c_null_ptr), stat, errmsg)
  end subroutine

  !> Writes several files, which appear together when all of them are complete. Otherwise the
  !> procedure is like write. Collective.
  !>   paths    (n)
  !>   formats  optional, (n): names of formats (pnpbs_format_info), ' ' for that of the extension
  subroutine particles_write_files(self, paths, formats, stat, errmsg)
    class(pnpbs_particles), intent(in) :: self
    character(len=*), intent(in) :: paths(:)
    character(len=*), intent(in), optional :: formats(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    type(texts), target :: c_paths, c_formats
    type(c_ptr) :: a_formats
    integer(c_int64_t) :: n
    integer(c_int) :: status
    n = size(paths, kind=c_int64_t)
    call c_paths%put(paths)
    call given%place_formats(formats, n, c_formats, a_formats)
    status = c_particles_write(self%c, int(given%capacity(n), c_int32_t), c_paths%addresses, &
                               a_formats)
    call conclude('particles%write_files', status, stat, errmsg, given)
  end subroutine

  !> Returns the handle as an integer, for code without derived types, or 0 if there is no object.
  !> Local.
  function particles_handle(self) result(handle)
    class(pnpbs_particles), intent(in) :: self
    integer(c_int64_t) :: handle
    handle = integer_of(self%c)
  end function

  !> Sets the particles to the object with the given handle, without checks. Local.
  subroutine particles_from_handle(self, handle)
    class(pnpbs_particles), intent(inout) :: self
    integer(c_int64_t), intent(in) :: handle
    self%c = pointer_of(handle)
  end subroutine

  ! ------------------------------------------------------------ placement: files --------------

  !> Writes the nodes of all ranks into one file, at the same time, in the format of its extension:
  !> .vtu, .pvtu, .vtkhdf, .xdmf, .msh, .msh2, .node, .ele, .face, .gr3, .2dm, .ugrid, .csv,
  !> .peridigm, .lammps, .hdf5, .mpas, .graph (see pnpbs_placement_write in pnpbs.h). A file appears
  !> under its name only when it is complete; after an error, an existing file is unchanged. The
  !> folder and path must be the same for all ranks. The monitor, if there is one, is called from
  !> time to time. Collective. stat: PNPBS_OK, PNPBS_STOPPED. Errors: PNPBS_ERROR_FILE naming the
  !> file, PNPBS_ERROR_STATE if there are no nodes yet, PNPBS_ERROR_ARGUMENT.
  !>   path      trailing blanks are ignored
  !>   elements  optional: whether to write triangles or tetrahedra (and the boundary) as well;
  !>             default: .false.
  !>   order     optional: 2 writes elements of second order into .msh, .msh2, .vtu and .vtkhdf, with
  !>             the mid nodes of get_edges, whatever elements is
  subroutine placement_write(self, path, elements, stat, errmsg, order)
    class(pnpbs_placement), intent(in) :: self
    character(len=*), intent(in) :: path
    logical, intent(in), optional :: elements
    integer, intent(in), optional :: order
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: with_elements
    with_elements = 0
    if (present(elements)) with_elements = flag(elements)
    if (present(order)) then
      if (order == 2) with_elements = 2
    end if
    call conclude('placement%write', &
                  c_placement_write(self%c, c_text(path), with_elements), stat, errmsg)
  end subroutine

  !> Writes several files, which appear together when all of them are complete. Otherwise the
  !> procedure is like write. Collective.
  !>   paths     (n)
  !>   formats   optional, (n): names of formats (pnpbs_format_info), ' ' for that of the extension
  !>   elements  optional, (n); default: .false.
  !>   order     optional: 2 makes the elements of these files those of second order
  subroutine placement_write_files(self, paths, formats, elements, stat, errmsg, order)
    class(pnpbs_placement), intent(in) :: self
    character(len=*), intent(in) :: paths(:)
    character(len=*), intent(in), optional :: formats(:)
    logical, intent(in), optional :: elements(:)
    integer, intent(in), optional :: order
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(arguments) :: given
    type(texts), target :: c_paths, c_formats
    integer(c_int32_t), target :: with_elements(size(paths) + 1)
    type(c_ptr) :: a_formats
    integer(c_int64_t) :: n
    integer(c_int) :: status
    integer :: k
    n = size(paths, kind=c_int64_t)
    call c_paths%put(paths)
    call given%place_formats(formats, n, c_formats, a_formats)
    if (present(elements)) call given%require('elements', size(elements, kind=c_int64_t), n)
    with_elements = 0
    if (present(elements) .and. .not. given%is_wrong()) then
      do k = 1, size(paths)
        with_elements(k) = flag(elements(k))
      end do
      if (present(order)) with_elements = with_elements * merge(2, 1, order == 2)
    end if
    status = c_placement_write_files(self%c, int(given%capacity(n), c_int32_t), &
                                     c_paths%addresses, a_formats, c_loc(with_elements(1)))
    call conclude('placement%write_files', status, stat, errmsg, given)
  end subroutine

  !> Adds a field of the caller to files that are written afterwards. The field appears next to id,
  !> tag and spacing in .vtu, .pvtu, .vtkhdf and .xdmf, in .msh and .msh2 as $NodeData, and in .csv
  !> as a column "name", or "name:0", "name:1" and so on. Other formats omit it. The values are
  !> copied. They belong to the current nodes: once these have moved or changed their ranks, writing
  !> is PNPBS_ERROR_STATE until clear_output_fields is called. When files are written, all ranks
  !> must have added the same fields in the same order. Local. Errors: PNPBS_ERROR_ARGUMENT for a
  !> name that is in use, more than 9 components, or too few values; PNPBS_ERROR_STATE without
  !> nodes.
  !>   name    1 to 63 letters, digits, '_' and '-'; none of id, tag, spacing, quality and
  !>           vtkGhostType; trailing blanks are ignored
  !>   values  (n), or (components, n): values at the nodes of this rank; values at its ghosts may
  !>           follow and are ignored
  subroutine placement_add_output_field(self, name, values, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    character(len=*), intent(in) :: name
    real(c_double), intent(in) :: values(:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('placement%add_output_field', &
                  c_placement_add_output_field(self%c, c_text(name), size(values, kind=c_int64_t), &
                                               1_c_int32_t, values), stat, errmsg)
  end subroutine

  subroutine placement_add_output_field_columns(self, name, values, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    character(len=*), intent(in) :: name
    real(c_double), intent(in) :: values(:,:)
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('placement%add_output_field', &
                  c_placement_add_output_field(self%c, c_text(name), size(values, 2, c_int64_t), &
                                               size(values, 1, c_int32_t), values), stat, errmsg)
  end subroutine

  !> Removes the fields that add_output_field has added. Local.
  subroutine placement_clear_output_fields(self, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('placement%clear_output_fields', c_placement_clear_output_fields(self%c), stat, &
                  errmsg)
  end subroutine

  !> Writes a checkpoint: a file from which read_checkpoint continues, in another process and on any
  !> number of ranks, bit for bit as if there was no interruption. The format is VTKHDF, which
  !> ParaView opens, so name the file .vtkhdf. It replaces an existing file when it is complete. A
  !> monitor may call this procedure, on all ranks, in its calls between two steps (see
  !> pnpbs_placement_write_checkpoint in pnpbs.h). Collective. Errors: PNPBS_ERROR_STATE,
  !> PNPBS_ERROR_FILE naming the file, PNPBS_ERROR_UNSUPPORTED if the library was built without
  !> HDF5, PNPBS_ERROR_ARGUMENT.
  !>   path  trailing blanks are ignored
  subroutine placement_write_checkpoint(self, path, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    character(len=*), intent(in) :: path
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('placement%write_checkpoint', &
                  c_placement_write_checkpoint(self%c, c_text(path)), stat, errmsg)
  end subroutine

  !> Restores a placement from a checkpoint. The placement must have the domain, options and spacing
  !> of the first run, except a spacing given by values at nodes, which the file contains. The next
  !> run or step does what it would have done where the checkpoint was written. After an error the
  !> placement is unchanged. Collective. Errors: PNPBS_ERROR_FILE naming the file if it is damaged
  !> or not a checkpoint, PNPBS_ERROR_DOMAIN, PNPBS_ERROR_SPACING or PNPBS_ERROR_ARGUMENT if it is
  !> of another run, PNPBS_ERROR_UNSUPPORTED.
  !>   path  trailing blanks are ignored
  subroutine placement_read_checkpoint(self, path, stat, errmsg)
    class(pnpbs_placement), intent(in) :: self
    character(len=*), intent(in) :: path
    class(*), intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call conclude('placement%read_checkpoint', &
                  c_placement_read_checkpoint(self%c, c_text(path)), stat, errmsg)
  end subroutine

  !> Returns the handle as an integer, or 0 if there is no placement. Local.
  function placement_handle(self) result(handle)
    class(pnpbs_placement), intent(in) :: self
    integer(c_int64_t) :: handle
    handle = integer_of(self%c)
  end function

  !> Sets the placement to the object with the given handle, without checks. Local.
  subroutine placement_from_handle(self, handle)
    class(pnpbs_placement), intent(inout) :: self
    integer(c_int64_t), intent(in) :: handle
    self%c = pointer_of(handle)
  end subroutine

  ! ------------------------------------------------------------ small helpers -----------------

  function pointer_or_null(user) result(pointer)
    type(c_ptr), intent(in), optional :: user
    type(c_ptr) :: pointer
    pointer = c_null_ptr
    if (present(user)) pointer = user
  end function

  function flag(condition)
    logical, intent(in) :: condition
    integer(c_int32_t) :: flag
    flag = merge(1_c_int32_t, 0_c_int32_t, condition)
  end function

  function tag_or_one(tag) result(value)
    integer(c_int32_t), intent(in), optional :: tag
    integer(c_int32_t) :: value
    value = 1
    if (present(tag)) value = tag
  end function

  function role_or_boundary(role) result(value)
    integer(c_int32_t), intent(in), optional :: role
    integer(c_int32_t) :: value
    value = PNPBS_BOUNDARY
    if (present(role)) value = role
  end function

  function angle_or_40(feature_angle) result(value)
    real(c_double), intent(in), optional :: feature_angle
    real(c_double) :: value
    value = 40
    if (present(feature_angle)) value = feature_angle
  end function

  ! Returns the dimension of a domain or placement. The error of a dead handle has priority over
  ! errors in arrays.
  function dimension_of(object, given) result(dim)
    class(*), intent(in) :: object
    type(arguments), intent(inout) :: given
    integer :: dim
    integer(c_int32_t) :: found
    integer(c_int) :: status
    status = PNPBS_OK
    found = 0
    select type (object)
    class is (pnpbs_domain)
      status = c_domain_dimension(object%c, found)
    class is (pnpbs_placement)
      status = c_placement_dimension(object%c, found)
    end select
    if (status < 0) call given%refuse(status, pnpbs_last_error())
    dim = found
  end function

  ! Returns the dimension of elements of a background mesh: 2 for triangles, also on a sphere.
  function extent_of_elements(placement, given) result(extent)
    class(pnpbs_placement), intent(in) :: placement
    type(arguments), intent(inout) :: given
    integer :: extent
    real(c_double) :: radius
    extent = dimension_of(placement, given)
    if (c_placement_sphere_radius(placement%c, radius) /= PNPBS_OK) return
    if (radius > 0) extent = 2
  end function

  ! Returns the number of nodes, or 0 if the placement is dead; the following call reports that
  ! error.
  function nodes_of(placement) result(nodes)
    type(c_ptr), intent(in) :: placement
    integer(c_int64_t) :: nodes
    nodes = 0
    if (c_placement_count(placement, nodes) /= PNPBS_OK) nodes = 0
  end function
end module pnpbs
