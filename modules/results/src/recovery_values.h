// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Header and events of a recovery log as the contents of its records and back.
#include <optional>
#include <string>

#include "edgevo/results/recovery_log.h"
#include "recovery_format.h"

namespace edgevo {

/// The kind of record that an event is written as.
RecoveryKind kind_of(const MapEvent& event);
/// The content of the record.
std::string bytes_of(const RecoveryHeader& header);
/// As above. MapMoved::prior is omitted.
std::string bytes_of(const MapEvent& event);

/// The header back; nothing if it is incomplete.
std::optional<RecoveryHeader> read_header(const std::string& content);
/// The event back; nothing if it is incomplete or `kind` is not that of an event.
std::optional<MapEvent> read_event(RecoveryKind kind, const std::string& content);

}  // namespace edgevo
