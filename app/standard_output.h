// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace edgevo::app {

/// Prints each line to standard output as it ends, so that in a log which takes standard error, too, the
/// lines are in their order. Call first in main().
void print_line_by_line();

/// Brings standard output to its end. Returns `code`, or 2 if something that was printed is lost (a full
/// disk, /dev/full), which is then said in one line. Call before leaving main().
int end_of_output(int code);

}  // namespace edgevo::app
