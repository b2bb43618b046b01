// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A file of a ROS 2 bag in SQLite: tables `topics` and `messages`.
//
// Messages come in the order of their times; of a file that was cut off in the order of their numbers, up to
// the first that is not whole.
#include <memory>
#include <string>

#include "edgevo/recordings/recording.h"

namespace edgevo {

/// Opens a file. Throws InputError as open_recording().
std::unique_ptr<Recording> open_sqlite_bag(const std::string& path);

}  // namespace edgevo
