// SPDX-License-Identifier: BSD-3-Clause
// This file is empty. Internal tests use its precompiled header (CMakeLists.txt).
