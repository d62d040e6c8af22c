// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/types.hpp"

template <int Dim>
pnpbs::Box<Dim> unit_box() {
  pnpbs::Box<Dim> box;
  box.low.fill(0);
  box.high.fill(1);
  return box;
}
