#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# From a coastline to the grid of SCHISM or ADCIRC: a GeoJSON file with far more vertices than the
# model needs, an island, a rock that is smaller than d, and a grid of depths. The sea is open where
# it is cut off in deep water. usage: coastal_model.sh [FOLDER for its files]
set -eu
cd "${1:-.}"

# The southern coast has 4000 vertices about 30 m apart. The other sides have one each 0.05 degrees.
awk 'BEGIN {
  pi = atan2(0, -1)
  printf "{\"type\": \"FeatureCollection\", \"features\": [{\"type\": \"Feature\", \"properties\": {\"kind\": \"coast\"}, \"geometry\": "
  printf "{\"type\": \"Polygon\", \"coordinates\": [["
  for (i = 0; i < 4000; ++i)
    printf "[%.6f, %.6f], ", 18 + i / 2000, 54.4 + 0.05 * sin(i * pi / 500) + 0.0002 * sin(i * pi / 4)
  for (i = 0; i < 12; ++i) printf "[20, %.2f], ", 54.4 + i / 20
  for (i = 0; i < 40; ++i) printf "[%.2f, 55], ", 20 - i / 20
  for (i = 0; i < 12; ++i) printf "[18, %.2f], ", 55 - i / 20
  printf "[18, 54.4]]"
  island(19, 54.7, 0.05)
  island(18.6, 54.8, 0.002)
  print "]}}]}"
}
function island(x, y, r, i) {
  printf ", ["
  for (i = 0; i < 100; ++i) printf "[%.6f, %.6f], ", x + r * cos(i * pi / 50), y + r * sin(i * pi / 50)
  printf "[%.6f, %.6f]]", x + r, y
}' > coast.geojson

# The depth increases from 5 m at the southern coast to 105 m.
awk 'BEGIN {
  printf "ncols 22\nnrows 10\nxllcorner 17.9\nyllcorner 54.3\ncellsize 0.1\n"
  for (row = 9; row >= 0; --row)
    for (column = 0; column < 22; ++column)
      printf "%.1f%s", 5 + (row - 0.5) / 0.06, column < 21 ? " " : "\n"
}' > depth.asc
echo 'GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]]' > depth.prj

pnpbs --domain coast.geojson --unit m --tag-field kind --simplify 0.25,1 --corner-angle 45 \
  --spacing 'min(4000, 1000 + 0.15*dist(coast))' --spacing-grid depth=depth.asc \
  --open-boundary 'depth > 60' --field depth=depth --set split_elements_on_boundary=1 \
  --output hgrid.gr3 --quiet
# The sea between two parallels, without the island; the waves of the coast cancel.
awk 'NR == 2 { elements = $1; nodes = $2 }
NR > 2 && NR <= 2 + nodes { x[$1] = $2; y[$1] = $3; if ($4 > deepest) deepest = $4 }
NR > 2 + nodes && NR <= 2 + nodes + elements {
  area += ((x[$4] - x[$3]) * (y[$5] - y[$3]) - (y[$4] - y[$3]) * (x[$5] - x[$3])) / 2e6
}
/Number of open boundaries/ { open = $1 }
/Number of nodes for land boundary/ { islands += $2 }
END {
  degree = atan2(0, -1) / 180
  wanted = 6371^2 * (2 * degree * (sin(55 * degree) - sin(54.4 * degree)) \
                     - 180 * degree * (0.05 * degree)^2 * cos(54.7 * degree))
  printf "area in square km: %.0f, expected about %.0f\n", area, wanted
  printf "open boundaries: %d, expected 1\nislands: %d, expected 1\n", open, islands
  printf "depth of the deepest node: %.1f, expected about 105\n", deepest
  printf "nodes: %d, expected at most 3000\n", nodes
}' hgrid.gr3
