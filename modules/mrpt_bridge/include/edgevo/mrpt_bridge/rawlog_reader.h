// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The observations of a rawlog, one by one, in constant memory.
//
// Both formats read the same: observations alone, or alternating actions and sensory frames (the observations
// of a sensory frame are returned one by one, actions are skipped). Three ends are distinguished, which
// MRPT's own readers do not do:
//   the true end                 next() returns null
//   a file cut short             next() throws InputError once everything before the cut has been returned
//   an unregistered class         as for a cut, naming the class (a plug-in's, or one of a newer MRPT)
// All classes of mrpt-obs and mrpt-maps are known, point clouds included.
// Images stored externally are not touched: see rawlog_source.h.
// Cost: inflating and deserialising, about 600 embedded 1248x375 images a second.
// Threads: one reader, one thread.
#include <mrpt/obs/CObservation.h>

#include <deque>
#include <memory>
#include <string>

namespace edgevo {

class GzInputArchive;

/// Reads one rawlog from beginning to end.
class RawlogReader {
 public:
  /// Throws InputError if the file cannot be opened.
  explicit RawlogReader(const std::string& path);
  ~RawlogReader();

  /// The next observation in the order of the file; null at the end. Throws InputError as above; the reader
  /// is then at its end.
  mrpt::obs::CObservation::Ptr next();
  /// Number of bytes of the (compressed) file consumed so far.
  int64_t position() const;
  /// Number of objects (observations, actions, sensory frames) read so far.
  int objects_read() const { return objects_; }

 private:
  bool read_object();

  std::string path_;
  std::unique_ptr<GzInputArchive> archive_;
  std::deque<mrpt::obs::CObservation::Ptr> pending_;
  int objects_ = 0;
  bool done_ = false;
};

}  // namespace edgevo
