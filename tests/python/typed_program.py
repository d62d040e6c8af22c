# SPDX-License-Identifier: BSD-3-Clause
"""A typed program of a user, for check_types.py: it must pass mypy unchanged, each `type: ignore`
must be needed, and it must run."""
import importlib.util
import math
import pathlib
import tempfile
from typing import Any, Dict, List, Optional, Tuple

import numpy as np
import pnpbs
from numpy.typing import NDArray

Doubles = NDArray[np.float64]


def spacing(x: Doubles) -> Doubles:
    return 0.15 + 0.05 * x[:, 0]


def circle(t: Doubles) -> Doubles:
    return np.stack([np.cos(t), np.sin(t)], axis=1)


def outside_ball(x: Doubles) -> Doubles:
    values: Doubles = np.linalg.norm(x, axis=1) - 1
    return values


class Watch:
    def __init__(self) -> None:
        self.turns = 0

    def __call__(self, fraction: float, step: int, nodes: int, max_speed: float) -> Optional[bool]:
        self.turns += 1
        return False


def in_the_plane(context: pnpbs.Context) -> Tuple[pnpbs.Domain, pnpbs.Placement]:
    domain = pnpbs.Domain(context).add_curve(circle, 0, 2 * math.pi, tag=3).add_fixed_nodes([(0, 0)])
    domain.set_tag_name(1, 3, "rim").add_region((0.5, 0), 5).check()
    names: Dict[Tuple[int, int], str] = domain.tag_names()
    assert names == {(1, 3): "rim"}
    low, high = domain.bounds()
    assert isinstance(low + high, np.ndarray) and domain.measure() > 3
    inset = pnpbs.Domain(context).add_offset(domain, -math.inf, -0.42, spacing, 0.05)
    placed = pnpbs.Placement(inset).set_spacing(lambda x: 1.076 * spacing(x))
    placed.run()
    particles: pnpbs.Particles = pnpbs.Particles(placed, domain)
    volumes: Doubles = particles.add_output_field("mass", 2 * particles.volumes).volumes
    assert math.isclose(volumes.sum(), domain.measure()) and len(placed.voronoi().volumes)
    count: int = particles.count + particles.left_out + particles.moved
    assert count >= len(particles) and particles.closest > 0.6
    watch = Watch()
    placement = pnpbs.Placement(domain, steps=30, method="paper")
    outcome: pnpbs.Status = placement.set_spacing(spacing).set_monitor(watch).run(progress=False)
    assert outcome in (pnpbs.Status.OK, pnpbs.Status.NOT_CONVERGED) and watch.turns > 0
    return domain, placement


def results(placement: pnpbs.Placement) -> None:
    nodes: pnpbs.Nodes = placement.nodes()
    points: Doubles = nodes.points
    ids: NDArray[np.int64] = nodes.ids
    tags: NDArray[np.int32] = nodes.tags
    lists: pnpbs.CompressedRows[np.int64] = placement.adjacency()
    first: NDArray[np.int64] = lists[0]
    some: List[NDArray[np.int64]] = lists[1:3]
    is_triangle: NDArray[np.bool_] = placement.stars().triangle[0]
    triangles: NDArray[np.int64] = placement.triangles()
    regions: NDArray[np.int32] = placement.element_tags()
    assert len(points) == len(ids) == len(tags) == len(lists) == placement.node_count
    assert len(first) and len(some) == 2 and len(is_triangle) and len(triangles)
    assert (regions == 5).all() and len(regions) == len(triangles)
    field = pnpbs.Transfer(placement, points[:, 0], order=2)
    x: Doubles = field.at_nodes(placement, conserve=True)
    assert math.isclose(placement.sum(x), placement.sum(points[:, 0]), abs_tol=1e-9)
    mesh: pnpbs.DistributedMesh = placement.mesh(ghost_layers=1)
    corners: NDArray[np.int32] = mesh.elements[0]
    connectivity: NDArray[np.int64] = mesh.connectivity
    is_inner: NDArray[np.bool_] = mesh.facet_inner
    sharing: pnpbs.CompressedRows[np.int32] = mesh.sharing_ranks
    assert len(corners) == mesh.dim + 1 and len(connectivity) == mesh.all_elements
    assert len(is_inner) == len(mesh.facets) and len(sharing) == 0
    if importlib.util.find_spec("matplotlib"):
        ax = mesh.plot()
        assert placement.plot(ax=ax) is ax
    everything: Dict[str, Any] = placement.statistics()
    warnings: List[str] = placement.warnings()
    assert everything["nodes"] == len(points) and not warnings
    data: List[pnpbs.WarningData] = placement.warning_data()
    assert not any(one.code == pnpbs.WarningCode.GROWTH and one.value for one in data)
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "nodes.vtu"
        assert placement.write(path, str(path.with_suffix(".csv"))) == pnpbs.Status.OK


def in_space(context: pnpbs.Context) -> None:
    with pnpbs.Domain(context, dim=3) as body:
        body.add_level_set(outside_ball, (-2, -2, -2), [2, 2, 2], 0.2).add_hole(np.zeros(3))
        body.set_role(7, "inner")
    with pnpbs.Domain(context, dim=3).add_box((0, 0, 0), (1, 1, 1)) as box:
        inset = pnpbs.Domain(context, dim=3).add_offset(box, -math.inf, -0.46, 0.4)
        walls = pnpbs.Domain(context, dim=3).add_offset(box, 0.1, 0.6, tag=2)
        assert inset.measure() < 1 < walls.measure()
    ring: Doubles = pnpbs.sphere_points(2, [(0, -70), (120, -70), (-120, -70)])
    places: Doubles = pnpbs.sphere_degrees(ring)
    with pnpbs.Domain.on_sphere(context, 2, (0, 0, -1)).add_polyline(ring) as sea:
        assert sea.dim == places.shape[1] + 1 and sea.measure() < 16 * math.pi
    option: pnpbs.OptionRow = pnpbs.option_table()[0]
    assert option.name and sum(pnpbs.library_version()) > 0


def mistakes(context: pnpbs.Context, domain: pnpbs.Domain, placement: pnpbs.Placement) -> None:
    """A type checker must reject each of these calls."""
    domain.add_arc((0, 0), "wide")  # type: ignore[arg-type]
    domain.set_role(1, "outer")  # type: ignore[arg-type]
    placement.set_spacing(lambda: 0.1)  # type: ignore[arg-type, misc]
    placement.set_monitor(lambda fraction: True)  # type: ignore[arg-type, misc]
    placement.run().message  # type: ignore[attr-defined]
    pnpbs.Placement(context)  # type: ignore[arg-type]
    number: str = placement.node_count  # type: ignore[assignment]
    placement.run(progress="bar")  # type: ignore[arg-type]
    placement.mesh().dim = 3  # type: ignore[misc]
    domain.add_offset(0.1, 0, 1)  # type: ignore[arg-type]
    domain.add_region((0, 0), "steel")  # type: ignore[arg-type]
    placement.voronoi(placement)  # type: ignore[call-arg]
    pnpbs.Particles(placement, placement)  # type: ignore[arg-type]
    pnpbs.Status.FINE  # type: ignore[attr-defined]


def main() -> None:
    with pnpbs.Context(threads=1) as context:
        _, placement = in_the_plane(context)
        results(placement)
        in_space(context)
    try:
        placement.run()
    except pnpbs.PNPBSError as error:
        status: pnpbs.Status = error.status
        assert status is pnpbs.Status.ERROR_HANDLE


if __name__ == "__main__":
    main()
