# SPDX-License-Identifier: BSD-3-Clause
# Builds the shared library once more for higher levels of x86-64 processors. The portable library
# uses vectors of two doubles. Since version 2.33, glibc's loader searches beside each library in
# folders for the processor levels of the x86-64 psABI (ld.so(8), "glibc-hwcaps"), and loads the
# best one that the machine supports.
# Sets PNPBS_LEVELS, PNPBS_LEVELS_FOLDER and PNPBS_LEVEL_LIBRARIES (targets).
include(CheckCXXCompilerFlag)
include(CheckSymbolExists)

set(PNPBS_PROCESSOR_LEVELS
    AUTO
    CACHE STRING "Levels of x86-64 to build the shared library for besides PNPBS_ARCH, e.g. \
x86-64-v3;x86-64-v4. AUTO: x86-64-v3 in an optimised build with glibc that names no processor")
set(PNPBS_LEVELS_FOLDER glibc-hwcaps)
set(PNPBS_LEVELS "")
set(PNPBS_LEVEL_LIBRARIES "")

# Decides whether AUTO means x86-64-v3. It does not if flags of the environment select a processor,
# as those of Spack do.
function(pnpbs_wants_v3 wanted)
  set(${wanted} FALSE PARENT_SCOPE)
  if(PNPBS_ARCH OR PNPBS_SANITIZE OR CMAKE_CXX_FLAGS MATCHES "-march=")
    return()
  endif()
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$" AND CMAKE_BUILD_TYPE MATCHES "^Rel")
    check_symbol_exists(__GLIBC__ features.h PNPBS_HAVE_GLIBC)
    check_cxx_compiler_flag(-march=x86-64-v3 PNPBS_HAVE_X86_64_V3)
    if(PNPBS_HAVE_GLIBC AND PNPBS_HAVE_X86_64_V3)
      set(${wanted} TRUE PARENT_SCOPE)
    endif()
  endif()
endfunction()

if(PNPBS_PROCESSOR_LEVELS STREQUAL "AUTO")
  pnpbs_wants_v3(wanted)
  if(wanted)
    set(PNPBS_LEVELS x86-64-v3)
  endif()
elseif(PNPBS_PROCESSOR_LEVELS)
  set(PNPBS_LEVELS "${PNPBS_PROCESSOR_LEVELS}")
endif()
foreach(level IN LISTS PNPBS_LEVELS)
  if(NOT level MATCHES "^x86-64-v[234]$")
    message(FATAL_ERROR "PNPBS_PROCESSOR_LEVELS: '${level}' is none of x86-64-v2, x86-64-v3, x86-64-v4 "
                        "(nor is the whole AUTO or OFF).")
  endif()
  list(APPEND PNPBS_LEVEL_LIBRARIES pnpbs_${level})
endforeach()
