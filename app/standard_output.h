// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace edgevo::app {

/// Brings standard output to its end. Returns `code`, or 2 if something that was printed is lost (a full
/// disk, /dev/full), which is then said in one line. Call before leaving main().
int end_of_output(int code);

}  // namespace edgevo::app
