// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The records of a recovery log, or of its window file, read one by one.
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

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
  /// The whole records beyond the one that could not be read: none if the file was merely cut off. Reads the
  /// rest of the file into memory.
  std::vector<RecoveryRecord> beyond_damage();

 private:
  bool read(size_t size, std::string* bytes);
  bool read_some(std::string* bytes);

  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  std::string first_line_;
  bool is_whole_ = false;
  long begin_ = 0;  // of the newest record, bytes
};

}  // namespace edgevo
