// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <utility>
#include <vector>

namespace edgevo {

/// CPU time in milliseconds by stage.
using StageTimes = std::vector<std::pair<std::string, double>>;

}  // namespace edgevo
