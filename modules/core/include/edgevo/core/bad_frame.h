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
  BadFrame(int index, Timestamp time, const InputError& why) : InputError(why), index_(index), time_(time) {}
  int index() const { return index_; }  ///< in the source
  Timestamp time() const { return time_; }

 private:
  int index_;
  Timestamp time_;
};

}  // namespace edgevo
