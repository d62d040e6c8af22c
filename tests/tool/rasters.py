# SPDX-License-Identifier: BSD-3-Clause
"""Writers of grids in formats that GDAL reads, GeoTIFF and NetCDF. They do not use GDAL."""

import struct

import numpy as np
from scipy.io import netcdf_file

GEOGRAPHIC, PROJECTED = 2, 1


def write_geotiff(path, values, west, north, step, epsg, no_data=None):
    """Writes values[row][column], beginning with the northern row. `west` and `north` are the
    coordinates of the corner of the first cell. `epsg` is the code of a geographic system, such as
    4326, or of a projected one."""
    rows, columns = values.shape
    data = np.asarray(values, "<f4").tobytes()
    kind = GEOGRAPHIC if 4000 <= epsg < 5000 else PROJECTED
    key = 2048 if kind == GEOGRAPHIC else 3072
    keys = [1, 1, 0, 3, 1024, 0, 1, kind, 1025, 0, 1, 1, key, 0, 1, epsg]
    entries = [(256, 3, [columns]), (257, 3, [rows]), (258, 3, [32]), (259, 3, [1]), (262, 3, [1]),
               (273, 4, [8]), (277, 3, [1]), (278, 3, [rows]), (279, 4, [len(data)]), (339, 3, [3]),
               (33550, 12, [step, step, 0.0]), (33922, 12, [0.0, 0.0, 0.0, west, north, 0.0]),
               (34735, 3, keys)]
    if no_data is not None:
        entries.append((42113, 2, list(f"{no_data:g}\0".encode())))
    codes = {2: "B", 3: "H", 4: "I", 12: "d"}
    directory, extra = b"", b""
    begin = 8 + len(data)
    behind = begin + 2 + 12 * len(entries) + 4
    for tag, kind, numbers in entries:
        packed = struct.pack("<" + codes[kind] * len(numbers), *numbers)
        if len(packed) > 4:
            place = struct.pack("<I", behind + len(extra))
            extra += packed + b"\0" * (len(packed) % 2)
        else:
            place = packed.ljust(4, b"\0")
        directory += struct.pack("<HHI", tag, kind, len(numbers)) + place
    path.write_bytes(struct.pack("<2sHI", b"II", 42, begin) + data +
                     struct.pack("<H", len(entries)) + directory + b"\0\0\0\0" + extra)


def write_netcdf(path, longitudes, latitudes, **variables):
    """Writes variables as arrays [latitude][longitude], by the conventions for climate and
    forecast."""
    with netcdf_file(path, "w") as file:
        file.Conventions = "CF-1.6"
        for name, unit, numbers in (("lat", "degrees_north", latitudes),
                                    ("lon", "degrees_east", longitudes)):
            file.createDimension(name, len(numbers))
            axis = file.createVariable(name, "f8", (name,))
            axis.units = unit
            axis.standard_name = "latitude" if name == "lat" else "longitude"
            axis[:] = numbers
        for name, values in variables.items():
            variable = file.createVariable(name, "f4", ("lat", "lon"))
            variable[:] = values
