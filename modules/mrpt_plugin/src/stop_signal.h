#pragma once
// Ctrl-C. rawlog-grabber (MRPT 2.5.8) does not heed it and is killed with an unfinished rawlog; a sensor can
// end it in an orderly way, as at the end of a video.

namespace edgevo {

/// From now on the first Ctrl-C (SIGINT) or SIGTERM is remembered; a second one kills as ever. Where the
/// program has its own handler, that is left alone. Forgets an earlier one.
void listen_for_stop();

/// One of them came.
bool stop_requested();

}  // namespace edgevo
