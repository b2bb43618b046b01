// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A single unusable image of a source; the frames after it may be fine.
#include <string>

#include "edgevo/core/error.h"
#include "edgevo/core/timestamp.h"

namespace edgevo {

/// Thrown by ImageSource::next() for an image that is missing, does not decode or differs in size from the
/// camera model. After catching it, next() may be called again and returns the following frame. Uncaught, it
/// is an InputError.
class BadFrame : public InputError {
 public:
  /// `index` and `time` of the frame in its source; `why` states the cause.
  BadFrame(int index, Timestamp time, const InputError& why) : InputError(why), index_(index), time_(time) {}
  /// Index of the frame in its source.
  int index() const { return index_; }
  /// Time of the frame.
  Timestamp time() const { return time_; }

 private:
  int index_;
  Timestamp time_;
};

}  // namespace edgevo
