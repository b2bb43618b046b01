// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Priorities of the threads of a run.
#include <string>

namespace edgevo {

/// Lowers the calling thread below those that a pose waits for: what it does may come late. On Linux a thread
/// has a nice level of its own; where it cannot be set, the thread keeps the normal one.
void lower_thread_priority();

/// Gives the calling thread, not those that it starts, the real-time scheduling of the system (SCHED_FIFO) at
/// `priority`, 1 to 99: it then waits for no ordinary thread. Returns why that is not allowed; empty: done.
std::string raise_thread_priority(int priority);

}  // namespace edgevo
