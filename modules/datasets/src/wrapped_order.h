// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Order of images whose numbers begin again: a counter after 9999, a clock at midnight or at the end of
// summer time. Sorted by their names, the second half comes first.
#include <optional>
#include <vector>

#include "sequence.h"

namespace edgevo {

/// Index of the first image of a sequence whose sorted `numbers` begin again after `period`: then the halves,
/// exchanged, follow each other with a step like the others. nullopt: they do not begin again. Cost: none.
std::optional<size_t> begin_before_wrap(const std::vector<double>& numbers, double period);

/// Puts images and times in the order of the times, which are a clock that goes on after `period_s` (0: it
/// does not). What was moved is added to the decisions.
void order_by_times(double period_s, Sequence* sequence);

/// The same of images that only count, if those around the jump are less alike than the last and the first.
void order_by_counter(Sequence* sequence);

}  // namespace edgevo
