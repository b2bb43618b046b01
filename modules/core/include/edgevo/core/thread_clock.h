// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// CPU time of the calling thread, unaffected by other threads and programs.

namespace edgevo {

/// CPU time that the calling thread has used so far, milliseconds. Cost: under a microsecond.
double thread_cpu_ms();

}  // namespace edgevo
