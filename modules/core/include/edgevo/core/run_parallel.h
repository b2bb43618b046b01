#pragma once
// A loop whose turns do not depend on each other, on some threads.
#include <functional>

namespace edgevo {

/// Runs job(i) for begin <= i < end on up to `threads` threads, the caller's included; turns begin in
/// ascending order. The first exception ends the loop and is thrown on.
void run_parallel(int begin, int end, int threads, const std::function<void(int)>& job);

}  // namespace edgevo
