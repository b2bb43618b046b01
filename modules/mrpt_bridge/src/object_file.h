// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Writes MRPT objects to a gzip file (.rawlog, .simplemap, .3Dscene), every write checked.
//
// mrpt::io::CFileGZOutputStream ignores the result of its close, which is where a full disk shows. Objects
// are serialised to memory first, so that an InputError never passes through MRPT's code, which would rewrite
// it. A quarter of a megabyte becomes one member of the file, which gzip allows any number of, compressed in
// one call (libdeflate): half of the work of zlib.
#include <libdeflate.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CSerializable.h>

#include <memory>
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
  void write_member();

  OutputFile file_;
  mrpt::io::CMemoryStream memory_;  // objects that are not in the file yet
  std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> gzip_;
  std::string member_;
  bool is_open_ = true;
};

}  // namespace edgevo
