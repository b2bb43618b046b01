// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Ctrl-C. rawlog-grabber (MRPT 2.5.8) does not handle it and is killed with an unfinished rawlog; a sensor
// can end it cleanly, as at the end of a video.

namespace edgevo {

/// Starts listening and clears an earlier request: the first Ctrl-C (SIGINT) or SIGTERM is recorded; a second
/// one kills as usual. A handler of the program itself is left in place.
void listen_for_stop();

/// True after one of these signals.
bool stop_requested();

}  // namespace edgevo
