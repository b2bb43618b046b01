#pragma once
// A run in metres, once somebody knows how long its unit is.
#include <string>

#include "edgevo/core/records.h"

namespace edgevo {

/// Multiplies every length of `run` by `factor` (metres per unit of the run, > 0): poses, covariances, keyframes; inverse depths
/// are divided. `source` becomes Run::scale_source. Throws InputError for a factor that is not positive and finite.
void scale_run(double factor, const std::string& source, Run* run);

/// Reads "none" or "factor=2.5" as --scale gives it and applies it. Throws InputError for anything else.
void apply_scale_option(const std::string& option, Run* run);
/// The same checks without a run, so that a wrong option is told before the work.
void check_scale_option(const std::string& option);

}  // namespace edgevo
