#pragma once
// An MRPT archive read from a gz file, which never loses an error.
//
// MRPT's own streams report the end of a file, a file cut short and damaged data alike; here they are three
// things. A file that is not compressed reads as it is, as zlib and MRPT have it.
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

  /// No byte is left; damage() then tells whether that is the true end.
  bool at_end();
  /// A read asked for bytes that were not there.
  bool ran_short() const { return ran_short_; }
  /// Empty, or in words why the stream ended: cut short or damaged.
  std::string damage() const;
  /// Bytes of the file (compressed) consumed so far.
  int64_t position() const { return gzoffset(file_); }

 protected:
  /// All `size` bytes, else throws std::runtime_error and sets ran_short().
  size_t read(void* buffer, size_t size) override;
  size_t write(const void* buffer, size_t size) override;

 private:
  gzFile file_ = nullptr;
  bool ran_short_ = false;
};

/// Reads the compressed file through, at most `limit` bytes of it, and lets zlib compare its checksum.
/// Returns what is wrong with its data, empty if nothing; a file cut short is not wrong as far as it goes.
std::string gz_checksum_damage(const std::string& path, int64_t limit);

}  // namespace edgevo
