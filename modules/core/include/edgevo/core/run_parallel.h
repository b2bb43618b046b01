// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A loop with independent iterations on several threads.
#include <functional>

namespace edgevo {

/// Runs job(i) for begin <= i < end on up to `threads` threads, including the caller's; iterations
/// start in ascending order. The first exception ends the loop and is rethrown.
void run_parallel(int begin, int end, int threads, const std::function<void(int)>& job);

}  // namespace edgevo
