# SPDX-License-Identifier: BSD-3-Clause
# Finds GDAL. Its OGR reads GeoJSON, shapefiles and other formats, and projects with PROJ. Only
# libpnpbs_geo, a separate library, is linked with it. Sets PNPBS_HAVE_GEO.

set(PNPBS_ENABLE_GEO
    AUTO
    CACHE STRING "Build libpnpbs_geo, which reads GeoJSON and shapefiles by GDAL: AUTO, ON or OFF")
set_property(CACHE PNPBS_ENABLE_GEO PROPERTY STRINGS AUTO ON OFF)

set(PNPBS_HAVE_GEO 0)
if(NOT PNPBS_ENABLE_GEO)
  return()
endif()
# With sanitizers only on request: memory that GDAL and PROJ keep until the end looks like leaks.
if(PNPBS_ENABLE_GEO STREQUAL "AUTO" AND PNPBS_SANITIZE)
  return()
endif()

# Version 3.2 introduced OSRDemoteTo2D and the axis order of geographic systems.
find_package(GDAL 3.2 QUIET)
if(GDAL_FOUND)
  set(PNPBS_HAVE_GEO 1)
  message(STATUS "GDAL: ${GDAL_VERSION}, for libpnpbs_geo")
elseif(NOT PNPBS_ENABLE_GEO STREQUAL "AUTO")
  message(FATAL_ERROR "No GDAL from 3.2 on was found. Install it (Debian: libgdal-dev), name one "
                      "with -DCMAKE_PREFIX_PATH=<prefix>, or build without it: "
                      "-DPNPBS_ENABLE_GEO=OFF.")
else()
  message(STATUS "GDAL: none found; GeoJSON and shapefiles will not be read")
endif()
