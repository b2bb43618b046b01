// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "edgevo/benchmark/bench_host.h"

namespace edgevo::app {

/// Version, signals and progress display of this program, for the benchmark runner.
BenchHost bench_host();

}  // namespace edgevo::app
