// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Images with transparent parts: cut-out robots, rectified images whose borders show nothing.
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/input_decision.h"

namespace edgevo {

/// That the transparency of images is not read, and what to do; nothing if the first is no PNG with
/// transparent parts. Cost: one is decoded once more.
std::optional<InputDecision> transparency_of(const std::vector<std::string>& images);

}  // namespace edgevo
