#pragma once
// What a stage of the work costs: processor time, which other threads and other programs do not add to.

namespace edgevo {

/// Processor time that the calling thread has used so far, milliseconds. Cost: under a microsecond.
double thread_cpu_ms();

}  // namespace edgevo
