// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Writes MRPT objects to a gzip file (.rawlog, .simplemap, .3Dscene), every write checked.
//
// mrpt::io::CFileGZOutputStream ignores the result of its close, which is where a full disk shows. Each
// object is serialised to memory first, so that an InputError never passes through MRPT's code, which would
// rewrite it.
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CSerializable.h>
#include <zlib.h>

#include <string>

#include "edgevo/core/output_file.h"

namespace edgevo {

class ObjectFile {
 public:
  /// Opens the file. Throws InputError, as all members do.
  explicit ObjectFile(const std::string& path);
  /// Closes the file if it is open and ignores errors.
  ~ObjectFile();
  ObjectFile(const ObjectFile&) = delete;
  ObjectFile& operator=(const ObjectFile&) = delete;

  void write(const mrpt::serialization::CSerializable& object);
  /// Closes the file; nothing may be written afterwards.
  void close();

 private:
  void deflate_bytes(const void* bytes, size_t count, int flush);

  OutputFile file_;
  mrpt::io::CMemoryStream memory_;
  z_stream gzip_{};
  bool is_open_ = true;
};

}  // namespace edgevo
