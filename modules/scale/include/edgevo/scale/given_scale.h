// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Scales a run to metres by a known factor.
#include <string>

#include "edgevo/core/records.h"

namespace edgevo {

/// Multiplies every length of `run` by `factor` (metres per unit of the run, > 0): poses, covariances,
/// keyframes; inverse depths are divided. `source` becomes Run::scale_source. Throws InputError for a factor
/// that is not positive and finite.
void scale_run(double factor, const std::string& source, Run* run);

}  // namespace edgevo
