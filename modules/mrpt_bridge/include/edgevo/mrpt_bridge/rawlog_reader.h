#pragma once
// The observations of a rawlog, one after the other, with constant memory.
//
// Both formats read the same: observations alone, or actions and sensory frames in turns (the observations of
// a sensory frame come out one by one, actions are passed over). Three ends are told apart, which MRPT's own
// readers do not:
//   the true end                 next() returns null
//   a file cut short             next() throws InputError once everything before the cut has been handed out
//   a class nobody registered    likewise, naming the class (a plug-in's, or one of a newer MRPT)
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

/// Reads one rawlog from its beginning to its end.
class RawlogReader {
 public:
  /// Throws InputError if the file cannot be opened.
  explicit RawlogReader(const std::string& path);
  ~RawlogReader();

  /// The next observation in the order of the file; null at the end. Throws InputError as above; after a
  /// throw the reader is at its end.
  mrpt::obs::CObservation::Ptr next();
  /// Bytes of the (compressed) file consumed so far.
  int64_t position() const;
  /// Objects (observations, actions, sensory frames) read so far.
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
