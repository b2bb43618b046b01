#pragma once

namespace edgevo::app {

/// From here on SIGINT and SIGTERM (job schedulers end a run by it) no longer end the program: they are
/// waited for by interrupted().
void listen_to_signals();
/// Such a signal has come.
bool interrupted();

}  // namespace edgevo::app
