// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace edgevo::app {

/// Handles SIGINT and SIGTERM (sent by job schedulers): from now on they no longer end the program but set
/// interrupted().
void listen_to_signals();
/// Whether such a signal was received.
bool interrupted();

}  // namespace edgevo::app
