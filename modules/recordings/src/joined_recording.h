// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Several files of one recording, one after the other.
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "edgevo/recordings/recording.h"

namespace edgevo {

/// What is known of the recording from elsewhere.
struct JoinedFacts {
  /// Kind in words.
  std::string kind;
  /// What is missing; empty: nothing.
  std::string missing;
  /// Number of messages by topic, for files that do not say.
  std::map<std::string, int64_t> messages;
  /// Whether each message is compressed by itself, by Zstandard.
  bool has_packed_messages = false;
};

/// Joins the files of a split recording: topics by their names and types, messages file by file.
std::unique_ptr<Recording> join_recordings(std::vector<std::unique_ptr<Recording>> parts,
                                           const JoinedFacts& facts);

}  // namespace edgevo
