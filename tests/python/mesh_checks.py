# SPDX-License-Identifier: BSD-3-Clause
"""Checks of a distributed mesh that hold on every rank."""
import numpy as np


def measures(mesh):
    """Returns the areas of triangles in the plane, or the volumes of tetrahedra."""
    corners = mesh.coordinates[mesh.elements]
    sides = corners[:, 1:] - corners[:, :1]
    return np.linalg.det(sides) / (2 if mesh.dim == 2 else 6)


def check_order(case, numbers, owners, first, owned, rank):
    """Checks that owned items come first, numbered from `first`, followed by those of other ranks
    in the order of their numbers."""
    np.testing.assert_array_equal(numbers[:owned], first + np.arange(owned))
    np.testing.assert_array_equal(owners == rank, np.arange(len(owners)) < owned)
    case.assertTrue((np.diff(numbers[owned:]) > 0).all())


def check_mesh(case, mesh, rank):
    n, (m, corners), f = len(mesh.numbers), mesh.elements.shape, len(mesh.facets)
    case.assertEqual(mesh.coordinates.shape, (n, mesh.dim))
    case.assertEqual([len(mesh.ids), len(mesh.owners), len(mesh.tags)], [n] * 3)
    case.assertEqual(len(set(mesh.ids)), n)
    check_order(case, mesh.numbers, mesh.owners, mesh.first_node, mesh.owned_nodes, rank)
    case.assertEqual(len(mesh.element_tags), m)
    check_order(case, mesh.element_numbers, mesh.element_owners, mesh.first_element,
                mesh.owned_elements, rank)
    np.testing.assert_array_equal(mesh.connectivity, mesh.numbers[mesh.elements])
    if corners == mesh.dim + 1:
        case.assertTrue((measures(mesh) > 0).all())

    case.assertEqual((mesh.facets.shape, mesh.facet_elements.shape), ((f, corners - 1), (f, 2)))
    case.assertEqual([len(mesh.facet_tags), len(mesh.facet_owners)], [f] * 2)
    for k, (first, second) in enumerate(mesh.facet_elements):
        facet, opposite = set(mesh.facets[k]), mesh.elements[first, mesh.facet_opposite[k]]
        case.assertEqual(facet, set(mesh.elements[first]) - {opposite})
        if second >= 0:
            case.assertTrue(mesh.facet_inner[k] and facet < set(mesh.elements[second]))
    case.assertEqual(len(mesh.sharing_ranks), len(mesh.shared_nodes))
    case.assertTrue((np.diff(mesh.numbers[mesh.shared_nodes]) > 0).all())
    for sharing in mesh.sharing_ranks:
        case.assertTrue(len(sharing) and rank not in sharing and (np.diff(sharing) > 0).all())
