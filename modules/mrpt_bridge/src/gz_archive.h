// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// An MRPT archive read from a gz file, with complete error reporting.
//
// MRPT's own streams report the end of a file, a truncated file and damaged data alike; here they are
// distinguished. An uncompressed file is read as it is, as by zlib and MRPT.
#include <mrpt/serialization/CArchive.h>
#include <zlib.h>

#include <cstdint>
#include <string>

namespace edgevo {

class GzInputArchive : public mrpt::serialization::CArchive {
 public:
  /// Throws InputError if the file cannot be opened.
  explicit GzInputArchive(const std::string& path);
  ~GzInputArchive() override;
  GzInputArchive(const GzInputArchive&) = delete;
  GzInputArchive& operator=(const GzInputArchive&) = delete;

  /// True if no byte is left; damage() then says whether that is the true end.
  bool at_end();
  /// True if a read requested more bytes than there were.
  bool ran_short() const { return ran_short_; }
  /// Why the stream ended early, in words: cut short or damaged; empty if it did not.
  std::string damage() const;
  /// Number of bytes of the (compressed) file consumed so far.
  int64_t position() const { return gzoffset(file_); }

 protected:
  /// Reads all `size` bytes; else throws std::runtime_error and sets ran_short().
  size_t read(void* buffer, size_t size) override;
  size_t write(const void* buffer, size_t size) override;

 private:
  gzFile file_ = nullptr;
  bool ran_short_ = false;
};

/// Reads at most `limit` bytes of the compressed file and lets zlib verify its checksum. Returns a
/// description of the damage, empty if there is none; truncation alone does not count as damage.
std::string gz_checksum_damage(const std::string& path, int64_t limit);

}  // namespace edgevo
