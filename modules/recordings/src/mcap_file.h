// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// MCAP files (mcap.dev/spec): records of an operation code, a length and contents, between two magic numbers.
//
//   data section     schemas, channels, messages, or chunks that hold these and have an index behind them
//   summary section  schemas and channels again, indices of the chunks, statistics; may be missing
//   footer           where the summary begins
// The checksums of chunks and summary are checked; that of the data section is not, since it is not read
// whole.
#include <memory>
#include <string>

#include "edgevo/recordings/recording.h"

namespace edgevo {

/// Opens a file. Throws InputError as open_recording().
std::unique_ptr<Recording> open_mcap(const std::string& path);

}  // namespace edgevo
