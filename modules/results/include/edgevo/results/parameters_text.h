// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The list of parameters that `edgevo help parameters` prints.
#include <string>
#include <vector>

#include "edgevo/core/params.h"

namespace edgevo {

/// The basic parameters, each with its default, range and description; with `all` also the advanced and the
/// experimental ones, by level.
std::string parameters_text(const std::vector<ParamDescription>& params, bool all);

}  // namespace edgevo
