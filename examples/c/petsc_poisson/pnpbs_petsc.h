/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Converts a distributed mesh of PNPBS into a DMPlex of PETSc. The header is self-contained: copy
 * it next to your program. It requires PETSc 3.18 or later with real scalars in double precision.
 */
#ifndef PNPBS_PETSC_H
#define PNPBS_PETSC_H

#include <petscdmplex.h>
#include <petscsf.h>
#include <pnpbs/pnpbs.h>

/* Raises a PETSc error if a call of PNPBS fails. */
#define PnpbsCall(call)                                                                \
  do {                                                                                 \
    const pnpbs_status pnpbs_status_of_call = (call);                                  \
    PetscCheck(pnpbs_status_of_call >= 0, PETSC_COMM_SELF, PETSC_ERR_LIB, "PNPBS: %s", \
               pnpbs_last_error(NULL));                                                \
  } while (0)

/* Copies the connectivity of the mesh as PetscInt, which has 32 or 64 bits. */
static inline pnpbs_status pnpbs_petsc_connectivity(pnpbs_mesh mesh, int64_t capacity,
                                                    PetscInt *numbers) {
#if defined(PETSC_USE_64BIT_INDICES)
  return pnpbs_mesh_get_connectivity(mesh, capacity, (int64_t *)numbers);
#else
  return pnpbs_mesh_get_connectivity_int32(mesh, capacity, numbers);
#endif
}

/* Finds the face of the plex whose corners have the node numbers `nodes`. numbers[v] is the number
 * of the node at vertex v; it increases with v. */
static inline PetscErrorCode pnpbs_petsc_face(DM dm, PetscInt corners, const PetscInt nodes[],
                                              PetscInt vertices, const PetscInt numbers[],
                                              PetscInt *face) {
  PetscInt points[3], first, found, k;
  const PetscInt *join;

  PetscFunctionBegin;
  PetscCall(DMPlexGetDepthStratum(dm, 0, &first, NULL));
  for (k = 0; k < corners; ++k) {
    PetscCall(PetscFindInt(nodes[k], vertices, numbers, &points[k]));
    points[k] += first;
  }
  PetscCall(DMPlexGetFullJoin(dm, corners, points, &found, &join));
  PetscCheck(found == 1, PETSC_COMM_SELF, PETSC_ERR_PLIB,
             "a facet of the mesh is no face of the plex");
  *face = join[0];
  PetscCall(DMPlexRestoreJoin(dm, corners, points, &found, &join));
  PetscFunctionReturn(0);
}

/* Adds the labels "Face Sets" and "marker" to the facets of the elements that this rank owns. */
static inline PetscErrorCode pnpbs_petsc_label_facets(pnpbs_mesh mesh, DM dm, PetscInt vertices,
                                                      const PetscInt numbers[]) {
  int32_t corners = 0, *nodes, *tags, *elements;
  int64_t all_nodes = 0, owned = 0, facets = 0, *node_numbers, f;
  int8_t *inner;

  PetscFunctionBegin;
  PnpbsCall(pnpbs_mesh_sizes(mesh, NULL, &corners, NULL, &all_nodes, &owned, NULL, &facets));
  PetscCall(PetscMalloc5(all_nodes, &node_numbers, (corners - 1) * facets, &nodes, facets, &tags,
                         2 * facets, &elements, facets, &inner));
  PnpbsCall(pnpbs_mesh_get_nodes(mesh, all_nodes, NULL, node_numbers, NULL, NULL, NULL));
  PnpbsCall(pnpbs_mesh_get_facets(mesh, facets, nodes, tags, elements, NULL, inner, NULL));
  PetscCall(DMCreateLabel(dm, "Face Sets"));
  PetscCall(DMCreateLabel(dm, "marker"));
  for (f = 0; f < facets; ++f) {
    const int32_t first = elements[2 * f], second = elements[2 * f + 1];
    PetscInt corner_numbers[3], face = -1;
    int32_t k;
    if (first >= owned && (second < 0 || second >= owned))
      continue; /* only ghost elements have this facet */
    for (k = 0; k < corners - 1; ++k)
      corner_numbers[k] = (PetscInt)node_numbers[nodes[(corners - 1) * f + k]];
    PetscCall(pnpbs_petsc_face(dm, corners - 1, corner_numbers, vertices, numbers, &face));
    PetscCall(DMSetLabelValue(dm, "Face Sets", face, tags[f]));
    if (!inner[f]) PetscCall(DMSetLabelValue(dm, "marker", face, 1));
  }
  PetscCall(PetscFree5(node_numbers, nodes, tags, elements, inner));
  PetscFunctionReturn(0);
}

/* Fills numbers[v] with the number of the node at each vertex v of the plex, as sent by the owners
 * of the nodes. Collective. */
static inline PetscErrorCode pnpbs_petsc_numbers(pnpbs_mesh mesh, PetscSF nodes,
                                                 PetscInt numbers[]) {
  int64_t first = 0, owned = 0, i;
  PetscInt *own;

  PetscFunctionBegin;
  PnpbsCall(pnpbs_mesh_sizes(mesh, NULL, NULL, &owned, NULL, NULL, NULL, NULL));
  PnpbsCall(pnpbs_mesh_numbering(mesh, &first, NULL, NULL, NULL));
  PetscCall(PetscMalloc1(owned, &own));
  for (i = 0; i < owned; ++i) own[i] = (PetscInt)(first + i);
  PetscCall(PetscSFBcastBegin(nodes, MPIU_INT, own, numbers, MPI_REPLACE));
  PetscCall(PetscSFBcastEnd(nodes, MPIU_INT, own, numbers, MPI_REPLACE));
  PetscCall(PetscFree(own));
  PetscFunctionReturn(0);
}

/** Creates a plex whose cells on each rank are the elements that the rank owns. Nothing is
 * gathered, read from a file or partitioned. The plex is interpolated: it has all faces and edges.
 * The label "Face Sets" holds the tags of boundary and inner facets, "marker" is 1 on the boundary,
 * and "Cell Sets" holds the tags of cells: those of regions, on surfaces alone those of the
 * surfaces. Cells with the tag 0 have no value in "Cell Sets". Collective.
 *  @param[in] mesh    a mesh with any number of ghost layers. Ghost elements are omitted; call
 *                     DMPlexDistributeOverlap for ghost cells
 *  @param[in] comm    the communicator of the mesh's context
 *  @param[out] dm     the plex; destroy it with DMDestroy
 *  @param[out] nodes  relates the nodes of the placement to the vertices of the plex. Its roots are
 *                     the nodes that this rank owns, in the order of pnpbs_placement_get_nodes; its
 *                     leaves are the vertices on this rank, in the order of the plex. PetscSFBcast
 *                     sends a field from the nodes to the vertices, PetscSFReduce sends it back.
 *                     Destroy it with PetscSFDestroy; may be NULL */
static inline PetscErrorCode pnpbs_petsc_plex(pnpbs_mesh mesh, MPI_Comm comm, DM *dm,
                                              PetscSF *nodes) {
  int32_t dim = 0, corners = 0, *tags;
  int64_t owned_nodes = 0, local_nodes = 0, owned = 0, elements = 0, all_nodes = 0, e;
  PetscInt *cells, *numbers, first, end;
  PetscReal *x;
  PetscSF sf;

  PetscFunctionBegin;
  PnpbsCall(
      pnpbs_mesh_sizes(mesh, &dim, &corners, &owned_nodes, &local_nodes, &owned, &elements, NULL));
  PnpbsCall(pnpbs_mesh_numbering(mesh, NULL, &all_nodes, NULL, NULL));
  PetscCall(PetscMalloc3(corners * elements, &cells, dim * local_nodes, &x, elements, &tags));
  PnpbsCall(pnpbs_petsc_connectivity(mesh, elements, cells));
  PnpbsCall(pnpbs_mesh_get_nodes(mesh, local_nodes, x, NULL, NULL, NULL, NULL));
  PnpbsCall(pnpbs_mesh_get_elements(mesh, elements, NULL, NULL, NULL, tags));
  /* PETSc orients tetrahedra in the opposite direction. */
  for (e = 0; corners == 4 && e < owned; ++e)
    PetscCall(DMPlexInvertCell(DM_POLYTOPE_TETRAHEDRON, cells + 4 * e));
  PetscCall(DMPlexCreateFromCellListParallelPetsc(
      comm, corners - 1, (PetscInt)owned, (PetscInt)owned_nodes, (PetscInt)all_nodes, corners,
      PETSC_TRUE, cells, dim, x, &sf, NULL, dm));
  PetscCall(DMPlexGetDepthStratum(*dm, 0, &first, &end));
  PetscCall(PetscMalloc1(end - first, &numbers));
  PetscCall(pnpbs_petsc_numbers(mesh, sf, numbers));
  PetscCall(pnpbs_petsc_label_facets(mesh, *dm, end - first, numbers));
  PetscCall(DMCreateLabel(*dm, "Cell Sets"));
  for (e = 0; e < owned; ++e)
    if (tags[e] != 0) PetscCall(DMSetLabelValue(*dm, "Cell Sets", (PetscInt)e, tags[e]));
  PetscCall(PetscFree(numbers));
  PetscCall(PetscFree3(cells, x, tags));
  if (nodes)
    *nodes = sf;
  else
    PetscCall(PetscSFDestroy(&sf));
  PetscFunctionReturn(0);
}

#endif
