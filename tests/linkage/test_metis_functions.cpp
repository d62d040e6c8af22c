// SPDX-License-Identifier: BSD-3-Clause
// Loads METIS where no suitable one exists, and expects an error that contains a text.
// usage: test_metis_functions <text>
#include <cstdio>
#include <cstring>

#include "base/error.hpp"
#include "partition/metis_functions.hpp"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  for (int turn = 0; turn < 2; ++turn) {  // the second time, as in the next run on this rank
    try {
      pnpbs::metis();
      std::puts("no error");
      return 1;
    } catch (const pnpbs::Error& error) {
      std::puts(error.what());
      if (error.kind() != pnpbs::ErrorKind::unsupported || !std::strstr(error.what(), argv[1]))
        return 1;
    }
  }
  return 0;
}
