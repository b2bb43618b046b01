// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Writes a rawlog and checks every write and the close: MRPT's own stream ignores a full disk.
//
// The file is a gz stream of serialised objects, which every MRPT tool reads. Write observations in the order
// of their times. The bytes depend on the objects alone, so two equal runs give equal files.
#include <mrpt/serialization/CSerializable.h>

#include <memory>
#include <string>

namespace edgevo {

class ObjectFile;

/// Writes one rawlog.
class RawlogWriter {
 public:
  /// Overwrites `path`. Throws InputError if it cannot be opened.
  explicit RawlogWriter(const std::string& path);
  /// Closes the file and ignores errors; call close() to have them reported.
  ~RawlogWriter();

  /// Appends an object. Throws InputError (disk full); what was written before remains readable up to the
  /// cut.
  void write(const mrpt::serialization::CSerializable& object);
  /// Closes the file; nothing may be written afterwards. Throws InputError.
  void close();

 private:
  std::unique_ptr<ObjectFile> file_;
};

/// Common prefix of the files that belong to a rawlog (x_Images, ...): "/a/b/x.rawlog" -> "/a/b/x".
std::string rawlog_stem(const std::string& rawlog_path);

}  // namespace edgevo
