// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Layout of the recovery log: a first line, then records of kind, size, content and checksum.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "edgevo/results/recovery_log.h"

namespace edgevo {

/// First line of the file. Its number is the version of the layout.
constexpr std::string_view kRecoveryFirstLine = "edgevo recovery log 16\n";
/// Name of the window file while it is being written, before it replaces kRunWindow.
constexpr const char* kNextRunWindow = "unfinished_window.bin.new";

/// Kind of a record: the header, which is the first record, or an event.
using RecoveryKind = uint8_t;
/// The header.
constexpr RecoveryKind kHeaderRecord = 0;
/// The first kind of event; the others follow in the order of MapEvent.
constexpr RecoveryKind kFirstEventRecord = 1;

/// Checksum of `bytes`, continued from the checksum `sum` of the bytes before (0: none).
uint32_t recovery_checksum(uint32_t sum, std::string_view bytes);

/// The bytes of one record: kind, size, content and checksum.
std::string recovery_record(RecoveryKind kind, const std::string& content);

/// Path of the recovery log of a run.
std::string recovery_log_path(const std::string& folder);
/// Names of the files that belong to a recovery log; the log itself is the last.
const std::vector<std::string>& recovery_files();
/// Removes the recovery_files() of a run.
void remove_recovery_log(const std::string& folder);

}  // namespace edgevo
