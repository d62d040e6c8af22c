// SPDX-License-Identifier: BSD-3-Clause
// Preparation of GDAL and PROJ before their first use.
#pragma once

namespace pnpbs::geo {

// Registers GDAL's formats, once per process. If the folders gdal-data and proj-data stand beside
// this library, as in a wheel that brings GDAL along, GDAL and PROJ read their tables there.
void set_up_gdal();

}  // namespace pnpbs::geo
