#pragma once
// A rawlog being written, with every write and the close checked: MRPT's own stream swallows a full disk.
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
  /// Closes; a failure here goes unheard, so call close().
  ~RawlogWriter();

  /// Throws InputError (disk full); what was written before stays a readable rawlog up to the cut.
  void write(const mrpt::serialization::CSerializable& object);
  /// Throws InputError. Nothing may be written afterwards.
  void close();

 private:
  std::unique_ptr<ObjectFile> file_;
};

/// "/a/b/x.rawlog" -> "/a/b/x": what the names of the files beside a rawlog begin with (x_Images, ...).
std::string rawlog_stem(const std::string& rawlog_path);

}  // namespace edgevo
