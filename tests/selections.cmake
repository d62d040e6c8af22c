# SPDX-License-Identifier: BSD-3-Clause
# The tests that the configurations of scripts/test.sh select, as regular expressions of their names. A
# test's selections are labels of ctest, and the target pnpbs-<selection>-tests builds what they run.

# The tests that find most faults in the shortest time. They cover every module, every language, one
# and several ranks, the documentation's commands, the record of the binary interface, the exported
# symbols, and an installed copy.
set(PNPBS_TESTS_OF_quick
    # kernels and data structures
    available_memory best_round boundary_topology cell_quality cholesky defects sized_tree domain_rule
    element_labels exact_sum execution first_row fixed_point forces initial_fill lawson_flips neighbors
    nodal_spacing output_files population population_contest repair resolved_spacing result_check schemes
    settings sizing_field slivers spacing speeds sphere sphere_cells surface_moves sweep tetrahedron_quality trees
    visibility volume_domain volume_fill volume_lattice volume_population volume_star volume_stars
    # geometry and its files
    arrangement boundary boundary_tag curve_solids features msh plane_domain plane_sweep poly_reader polygons predicates simplify
    space_ties surface surface_checks surface_readers surface_walk triangle_contacts
    # the interface
    api_adapting api_arguments api_arithmetic api_boundary api_callbacks api_checkpoints api_contexts
    api_files api_groups api_handles api_level_sets api_messages api_neighbours api_regions api_shape api_small
    api_sphere api_surfaces api_tables
    geo_reading geo_projecting geo_raster_values
    # ranks
    parallel_adapt parallel_adapting parallel_assembly parallel_background parallel_distributed_mesh
    parallel_exchange parallel_faults_1 parallel_faults_3 parallel_fields parallel_files
    parallel_long_lists parallel_memory_2 parallel_mesh_files parallel_node_hashes parallel_periodic
    parallel_redundancy
    parallel_restart parallel_soak_3 parallel_sparse_exchange parallel_sphere_fields parallel_star_questions
    parallel_transfer parallel_tree_part parallel_volume_halo parallel_volume_partition
    parallel_voronoi_cells parallel_wide_sums
    # the command
    command_colors command_density command_files command_grids command_groups
    command_input command_mpas command_regions command_shape_spacing command_stopping volume_files
    # languages
    fortran_library fortran_domain fortran_placement fortran_ranks_3
    python_declarations python_package python_periodic python_ranks_3
    julia_ccalls julia_package
    # as a library, installed, documented
    linkage_abi linkage_abi_geo linkage_bad_environment linkage_dlopen linkage_exceptions linkage_exports
    linkage_exports_geo linkage_host_kokkos linkage_host_metis linkage_metis_missing linkage_repeat
    linkage_signatures linkage_signatures_geo
    install_check_lines install_tree install_contents install_headers install_pkg_config
    install_c_smallest install_fortran_smallest
    docs_comments docs_constants docs_floors docs_install docs_links docs_map docs_peers
    docs_page_meshio docs_page_mpi docs_page_place_nodes docs_page_readme
    packaging_recipes)

# The tests of what a build without MPI, on a shared Kokkos and with the static library, can change.
set(PNPBS_TESTS_OF_no-mpi linkage_.* install_.* api_arguments api_contexts api_files api_first_contexts
                          api_handles api_small api_threads geo_reading fortran_library
                          fortran_placement fortran_stop julia_installed python_package python_wheel)

# The tests that run sanitized in continuous integration: every folder of the library, one and several
# ranks, the command, and malformed input, in the shortest runs. The configuration sanitize-all runs
# all.
set(PNPBS_TESTS_OF_sanitize
    api_adapting api_arguments api_boundary api_callbacks api_checkpoints api_contexts api_ending api_files
    api_first_contexts api_groups api_handles api_level_sets api_levels api_messages api_neighbours api_regions
    api_small api_sphere api_sphere_again api_surfaces api_tables
    parallel_adapt parallel_assembly parallel_background parallel_distributed_mesh parallel_exchange
    parallel_faults_3 parallel_fields parallel_files parallel_ghost_stars parallel_growth_limit parallel_periodic
    parallel_kept_stars parallel_long_lists parallel_memory_3 parallel_mesh_files parallel_partition_numbers
    parallel_soak_3 parallel_sparse_exchange parallel_sphere_fields parallel_star_questions
    parallel_surface_fill parallel_transfer parallel_tree_part parallel_unknown_uses_found
    parallel_volume_conformity_3 parallel_volume_halo parallel_volume_nodes parallel_volume_partition
    parallel_voronoi_cells parallel_wide_sums
    linkage_.* mutate_.* volume_files
    command_bodies_cut_open command_elements_on_boundary command_grids command_groups
    command_hdf5_files command_input command_mpas command_node_fields command_node_volumes
    command_polygon_regions command_ranks_failing command_rasters command_regions command_simplify
    command_spacing_files command_stopping command_terminal)

# Long searches with a new seed each day, studies of many runs, and long tests of what shorter ones
# cover too: recorded node sets on all numbers of ranks are those of parallel_node_hashes.
set(PNPBS_TESTS_OF_nightly
    parallel_hunt.* parallel_invariance parallel_mpi_errors_2 parallel_soak_8 parallel_volume_conformity
    parallel_volume_invariance api_closing linkage_signatures_can_fail
    bench_bodies bench_compare bench_compare_bodies bench_loose_pieces bench_random_bodies bench_sliding
    bench_space_scaling bench_spheres bench_studies command_many_random_solids)
