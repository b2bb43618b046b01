#pragma once
// One image of a source that cannot be used, while those behind it may be.
#include <string>

#include "edgevo/core/error.h"
#include "edgevo/core/timestamp.h"

namespace edgevo {

/// What ImageSource::next() throws for an image that is missing, does not decode or has another size than the
/// camera's. Whoever catches it may call next() again: the frame behind it comes. Uncaught it is an
/// InputError.
class BadFrame : public InputError {
 public:
  /// `index` and `time` of the frame in its source; `why` as an InputError says it.
  BadFrame(int index, Timestamp time, const InputError& why) : InputError(why), index_(index), time_(time) {}
  int index() const { return index_; }  ///< in the source
  Timestamp time() const { return time_; }  ///< of the frame

 private:
  int index_;
  Timestamp time_;
};

}  // namespace edgevo
