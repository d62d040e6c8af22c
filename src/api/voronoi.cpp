// SPDX-License-Identifier: BSD-3-Clause
// C interface: Voronoi cells.
#include "api/copy_out.hpp"
#include "api/placement_calls.hpp"
#include "voronoi/voronoi_cells.hpp"

using namespace pnpbs;
using namespace pnpbs::api;

pnpbs_status pnpbs_voronoi_create(pnpbs_placement placement, pnpbs_voronoi* voronoi) {
  return collective_create(placement, voronoi, "voronoi", voronois, [](PlacementObject& object) {
    require_not_periodic(object.placement->results(), "there are no Voronoi cells");
    auto made = std::make_shared<VoronoiObject>();
    made->context = object.context;
    made->cells = make_voronoi_cells(object.placement->results());
    return made;
  });
}

pnpbs_status pnpbs_voronoi_destroy(pnpbs_voronoi* voronoi) { return destroy(voronoi, voronois); }

pnpbs_status pnpbs_voronoi_sizes(pnpbs_voronoi voronoi, int32_t* dim, int64_t* nodes,
                                 int64_t* faces) {
  return guarded(voronoi, [&](VoronoiObject& object) {
    const VoronoiCells& cells = *object.cells;
    if (dim) *dim = cells.dimension;
    if (nodes) *nodes = static_cast<std::int64_t>(cells.volumes.size());
    if (faces) *faces = static_cast<std::int64_t>(cells.areas.size());
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_voronoi_get_cells(pnpbs_voronoi voronoi, int64_t capacity, double* volumes,
                                     double* boundary) {
  return guarded(voronoi, [&](VoronoiObject& object) {
    const VoronoiCells& cells = *object.cells;
    require_capacity(capacity, static_cast<std::int64_t>(cells.volumes.size()));
    copy_out(cells.volumes, volumes);
    copy_out(cells.boundary, boundary);
    return PNPBS_OK;
  });
}

pnpbs_status pnpbs_voronoi_get_faces(pnpbs_voronoi voronoi, int64_t nodes, int64_t faces,
                                     int64_t* offsets, int64_t* ids, int64_t* numbers,
                                     double* areas, double* distances, double* normals) {
  return guarded(voronoi, [&](VoronoiObject& object) {
    const VoronoiCells& cells = *object.cells;
    require_capacity(nodes, static_cast<std::int64_t>(cells.volumes.size()), "nodes");
    require_capacity(faces, static_cast<std::int64_t>(cells.areas.size()), "faces");
    copy_out(cells.offsets, offsets);
    copy_out(cells.ids, ids);
    copy_out(cells.numbers, numbers);
    copy_out(cells.areas, areas);
    copy_out(cells.distances, distances);
    copy_out(cells.normals, normals);
    return PNPBS_OK;
  });
}
