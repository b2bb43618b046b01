// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A single unusable frame of a source; the frames after it may be fine.
#include <string>

#include "edgevo/core/error.h"
#include "edgevo/core/timestamp.h"

namespace edgevo {

/// Thrown by ImageSource::next() for an image that is missing, does not decode or differs in size from the
/// camera model, and for a time that cannot be right (time_order.h). After catching it, next() may be called
/// again and returns the following frame. Uncaught, it is an InputError.
class BadFrame : public InputError {
 public:
  /// What is wrong with the frame.
  enum class What { kImage, kTime };
  /// `index` and `time` of the frame in its source; `why` states the cause.
  BadFrame(int index, Timestamp time, const InputError& why, What what = What::kImage)
      : InputError(why), index_(index), time_(time), what_(what) {}
  /// Index of the frame in its source.
  int index() const { return index_; }
  /// Time of the frame, not before the frames before it; if its own is at fault, that of the last good frame.
  Timestamp time() const { return time_; }
  /// What is wrong with the frame.
  What what_is_bad() const { return what_; }

 private:
  int index_;
  Timestamp time_;
  What what_;
};

}  // namespace edgevo
