// SPDX-License-Identifier: BSD-3-Clause
#include "rate.h"

#include <cmath>

#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"

namespace edgevo {
namespace {

bool is_plausible(double fps) { return std::isfinite(fps) && fps >= kSlowestRate && fps <= kFastestRate; }

}  // namespace

Rate choose_rate(double given, double own) {
  if (given != 0) {
    if (!is_plausible(given))
      throw InputError("--fps", "is not a rate between 0.001 and 100000", "give frames a second");
    return {given, fixed(given, 3) + " frames a second, as given by --fps"};
  }
  if (is_plausible(own)) return {own, fixed(own, 3) + " frames a second, as the file says"};
  return {kUsualRate, "",
          InputDecision{"rate", "30 frames a second assumed", "no times were found; --fps sets another", ""}};
}

}  // namespace edgevo
