# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of nodes and meshes, with Matplotlib in the plane and with PyVista in space, or
Matplotlib if PyVista is not installed. Each tag has a colour of its own."""

from __future__ import annotations

import importlib
import importlib.util
from typing import TYPE_CHECKING, Any, Iterator, List, Tuple

import numpy as np
from numpy.typing import NDArray

from ._types import Doubles, Int32s

if TYPE_CHECKING:
    from .mesh_arrays import MeshArrays

_GREY = "#999999"
# The first ten colours of Matplotlib.
_COLOURS = ("#1f77b4", "#ff7f0e", "#2ca02c", "#d62728", "#9467bd", "#8c564b", "#e377c2", "#7f7f7f",
            "#bcbd22", "#17becf")
# A longer legend covers the picture.
_MAX_LEGEND = 12


def plot_nodes(points: Doubles, tags: Int32s, ax: Any) -> Any:
    """Draws nodes coloured by tag on `ax`, or on a new canvas if it is None, and returns the
    canvas."""
    ax = _canvas(points.shape[1], ax)
    for label, colour, here in _by_tag(tags):
        if _is_plotter(ax):
            ax.add_points(points[here], color=colour, label=label, point_size=5,
                          render_points_as_spheres=True)
        else:
            ax.plot(*points[here].T, ".", color=colour, label=label, markersize=3)
    return _finished(ax, points, tags)


def plot_mesh(mesh: MeshArrays, facets_here: NDArray[np.bool_], ax: Any) -> Any:
    """Draws what this rank owns of a mesh on `ax`, or on a new canvas if it is None, and returns
    the canvas. In the plane these are triangles and facets. In space these are the facets of
    bodies, or the triangles of surfaces alone. `facets_here` marks the owned facets."""
    elements = mesh.elements[:mesh.owned_elements]
    facets, tags = mesh.facets[facets_here], mesh.facet_tags[facets_here]
    ax = _canvas(mesh.dim, ax)
    if mesh.dim == 2:
        if len(elements):
            ax.triplot(*mesh.coordinates.T, elements, color=_GREY, linewidth=0.5)
        _add_lines(ax, mesh.coordinates[facets], tags)
    elif elements.shape[1] == 4:
        _add_triangles(ax, mesh.coordinates, facets, tags)
    else:
        facets, tags = elements, mesh.element_tags[:mesh.owned_elements]
        _add_triangles(ax, mesh.coordinates, facets, tags)
    return _finished(ax, mesh.coordinates, tags)


def _add_lines(ax: Any, ends: Doubles, tags: Int32s) -> None:
    collections = importlib.import_module("matplotlib.collections")
    for label, colour, here in _by_tag(tags):
        ax.add_collection(collections.LineCollection(ends[here], colors=[colour], label=label))


def _add_triangles(ax: Any, points: Doubles, corners: Int32s, tags: Int32s) -> None:
    for label, colour, here in _by_tag(tags):
        if _is_plotter(ax):
            pyvista = importlib.import_module("pyvista")
            surface = pyvista.PolyData.from_regular_faces(points, corners[here])
            ax.add_mesh(surface, color=colour, label=label, show_edges=True)
        else:
            art3d = importlib.import_module("mpl_toolkits.mplot3d.art3d")
            ax.add_collection3d(art3d.Poly3DCollection(
                points[corners[here]], facecolors=[colour], edgecolors="0.3", linewidths=0.3,
                label=label))


def _by_tag(tags: Int32s) -> Iterator[Tuple[str, str, NDArray[np.bool_]]]:
    """Yields label, colour and mask of each tag. The tag 0, which means no tag, comes last and is
    grey."""
    numbers: List[int] = np.unique(tags).tolist()
    for k, tag in enumerate(sorted(numbers, key=lambda tag: (tag == 0, tag))):
        yield (f"tag {tag}" if tag else "no tag", _COLOURS[k % len(_COLOURS)] if tag else _GREY,
               np.equal(tags, tag))


def _is_plotter(ax: Any) -> bool:
    """Returns whether the canvas is a plotter of PyVista."""
    return hasattr(ax, "add_mesh")


def _canvas(dim: int, ax: Any) -> Any:
    """Returns `ax`, or a new canvas if it is None."""
    if ax is not None:
        return ax
    if dim == 3 and importlib.util.find_spec("pyvista"):
        return importlib.import_module("pyvista").Plotter()
    pyplot = importlib.import_module("matplotlib.pyplot")
    return pyplot.figure().add_subplot(projection="3d" if dim == 3 else None)


def _finished(ax: Any, points: Doubles, tags: Int32s) -> Any:
    """Sets equal scales, adds a legend if it is short, and returns the canvas."""
    has_legend = 0 < len(np.unique(tags)) <= _MAX_LEGEND
    if _is_plotter(ax):
        if has_legend:
            ax.add_legend()
        return ax
    if points.shape[1] == 2:
        ax.set_aspect("equal")
        ax.autoscale_view()
    elif len(points):
        ax.auto_scale_xyz(*points.T)
        ax.set_aspect("equal")
    if has_legend:
        handles, labels = ax.get_legend_handles_labels()
        once = dict(zip(labels, handles))
        ax.legend(once.values(), once.keys(), fontsize="small", markerscale=3)
    return ax
