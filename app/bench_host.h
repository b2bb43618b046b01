#pragma once
#include "edgevo/benchmark/bench_host.h"

namespace edgevo::app {

/// This program, as a benchmark sees it.
BenchHost bench_host();

}  // namespace edgevo::app
