// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Doubts about a sequence whose images and times come from a list: do the names show another?
#include <string>
#include <vector>

#include "edgevo/core/input_decision.h"
#include "edgevo/core/timestamp.h"

namespace edgevo {

/// Adds to `decisions` what contradicts the order of `images`, each with its time: numbered names that fall
/// from one image to the next, and times in the names that differ from those that are listed. A list with one
/// of both shuffled is as readable as any.
void doubt_listed_order(const std::vector<std::string>& images, const std::vector<Timestamp>& times,
                        std::vector<InputDecision>* decisions);

}  // namespace edgevo
