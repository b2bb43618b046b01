// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Objects that work without the GIL are for one call at a time: a second thread, or a callback of the first
// call, is refused instead of waiting.
#include <pybind11/pybind11.h>

#include <atomic>
#include <string>

namespace edgevo::python {

/// Whether a call is in progress.
class InUse {
 public:
  /// Marks the object during a call.
  class Call {
   public:
    /// Throws RuntimeError if another call is in progress; `where` is the one that begins.
    Call(InUse& object, const std::string& where) : object_(object) {
      if (object_.is_busy_.exchange(true))
        throw std::runtime_error(where + ": another call is in progress; make one call at a time");
    }
    ~Call() { object_.is_busy_ = false; }
    Call(const Call&) = delete;
    Call& operator=(const Call&) = delete;

   private:
    InUse& object_;
  };

 private:
  std::atomic<bool> is_busy_{false};
};

}  // namespace edgevo::python
