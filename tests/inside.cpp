// SPDX-License-Identifier: BSD-3-Clause
// Nothing: its precompiled header is what tests of the inside use (CMakeLists.txt).
