# SPDX-License-Identifier: BSD-3-Clause
"""Domains for the tests that pass meshes to other packages."""
import numpy as np
import pnpbs


def square(context):
    domain = pnpbs.Domain(context).add_polyline([(0, 0), (1, 0), (1, 1), (0, 1)], tags=1)
    return domain.add_arc((0.3, 0.35), 0.2, tag=2)


def box(context):
    domain = pnpbs.Domain(context, dim=3).add_box((0, 0, 0), (1, 1, 1), tag=1)
    return domain.add_ball((0.3, 0.35, 0.5), 0.2, tag=2)


def of_file(context, path):
    """Returns the domain in a file, and the centre of its bounding box."""
    if path.endswith(".poly"):
        domain = pnpbs.Domain(context).read_poly(path)
    else:
        domain = pnpbs.Domain(context, dim=3).read_surface(path)
    low, high = domain.bounds()
    return domain, (np.asarray(low) + high) / 2


CORNERS = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1),
                    (0, 1, 1)])
SIDES = [(0, 2, 1), (0, 3, 2), (4, 5, 6), (4, 6, 7), (0, 1, 5), (0, 5, 4), (2, 3, 7), (2, 7, 6),
         (1, 2, 6), (1, 6, 5), (0, 4, 7), (0, 7, 3)]


def blocks(context, dim):
    """Returns a square or box with the tag 1 that contains two blocks of the sizes 0.3 and 0.6
    along the axes. The curves or surfaces around the blocks have the tag 7."""
    domain = pnpbs.Domain(context, dim=dim)
    if dim == 2:
        domain.add_polyline(CORNERS[:4, :2], tags=1)
    else:
        domain.add_box((0, 0, 0), (1, 1, 1), tag=1)
    for low in (0.1, 0.2, 0.2), (0.6, 0.2, 0.2):
        corners = low + CORNERS * (0.3, 0.6, 0.6)
        if dim == 2:
            domain.add_polyline(corners[:4, :2], role="inner", tags=7)
        else:
            domain.add_surface(corners, SIDES, role="inner", tags=[7] * len(SIDES))
    return domain


def blocks_with_regions(context, dim):
    """Returns the blocks as regions: the first has the tag 7, the other one 20, and the rest has
    none."""
    domain = blocks(context, dim)
    return domain.add_region((0.2, 0.5, 0.5)[:dim], 7).add_region((0.8, 0.5, 0.5)[:dim], 20)


def surfaces_of_a_box(context):
    return pnpbs.Domain(context, dim=3).add_box((0, 0, 0), (1, 1, 1), tag=5).set_filled(False)


def placed(domain, d, steps=10):
    placement = pnpbs.Placement(domain, steps=steps).set_spacing(d)
    placement.run()
    return placement
