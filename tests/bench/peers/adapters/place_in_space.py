# SPDX-License-Identifier: BSD-3-Clause
"""Common parts of the scripts that run a Python package in space. Their arguments are JOB.npz
OUT.npz, and write_job() writes the body and the spacing of the job."""
import json
import sys
import time

import numpy as np


def write_job(case, path, **settings):
    body = case.body
    corners = [len(polygon) for polygon in body.polygons]
    words = {"kind": body.kind, "constant": case.constant, "slope": case.slope,
             "centre": list(case.centre), **settings}
    np.savez(path, vertices=body.vertices, corners=corners, polygons=np.concatenate(body.polygons),
             words=json.dumps(words))


class Job:
    def __init__(self):
        found = np.load(sys.argv[1])
        self.vertices = found["vertices"]
        ends = np.cumsum(found["corners"])
        self.polygons = [part.tolist() for part in np.split(found["polygons"], ends[:-1])]
        self.words = json.loads(str(found["words"]))

    def __getattr__(self, name):
        return self.words[name]

    def spacing(self, points):
        away = np.linalg.norm(points - np.array(self.centre), axis=1)
        return self.constant + self.slope * away

    def begin(self):
        self.started = time.perf_counter()

    def finish(self, points, tetrahedra):
        """Ends the measured time and writes the result. The time of writing does not count."""
        seconds = time.perf_counter() - self.started
        np.savez(sys.argv[2], points=np.asarray(points), tetrahedra=np.asarray(tetrahedra))
        print(f"seconds {seconds:.6f}")
