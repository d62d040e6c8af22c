// SPDX-License-Identifier: BSD-3-Clause
// What GDAL has to say on this thread goes here instead of standard error, while this lives.
#pragma once

#include <cpl_error.h>

#include <string>

namespace pnpbs::geo {

class GdalMessages {
 public:
  GdalMessages() { CPLPushErrorHandlerEx(take, this); }
  GdalMessages(const GdalMessages&) = delete;
  GdalMessages& operator=(const GdalMessages&) = delete;
  ~GdalMessages() { CPLPopErrorHandler(); }

  bool failed() const { return !failure_.empty(); }
  const std::string& failure() const { return failure_; }  // the first one, "" if there was none
  const std::string& warning() const { return warning_; }  // likewise
  void forget() { failure_ = warning_ = ""; }

 private:
  static void CPL_STDCALL take(CPLErr grade, CPLErrorNum, const char* message) {
    GdalMessages& self = *static_cast<GdalMessages*>(CPLGetErrorHandlerUserData());
    if (grade >= CE_Failure && self.failure_.empty()) self.failure_ = message;
    if (grade == CE_Warning && self.warning_.empty()) self.warning_ = message;
  }

  std::string failure_, warning_;
};

}  // namespace pnpbs::geo
