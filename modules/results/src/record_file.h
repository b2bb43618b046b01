// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The records of a recovery log, or of its window file, read one by one.
#include <cstdio>
#include <memory>
#include <string>

#include "recovery_format.h"

namespace edgevo {

/// A record with a valid checksum.
struct RecoveryRecord {
  RecoveryKind kind = kHeaderRecord;
  std::string content;
};

/// A file of records.
class RecordFile {
 public:
  /// A file that is not there has no records.
  explicit RecordFile(const std::string& path);

  /// Whether the first line is that of a recovery log of another version.
  bool is_of_another_version() const;
  /// Reads the next record. Returns false if it is incomplete, and from then on.
  bool next(RecoveryRecord* record);

 private:
  bool read(size_t size, std::string* bytes);

  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  std::string first_line_;
  bool is_whole_ = false;
};

}  // namespace edgevo
