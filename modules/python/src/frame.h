// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>

#include "edgevo/core/image.h"

namespace edgevo::python {

/// A frame of a source, as Python holds it: what it points to never changes.
struct PyFrame {
  /// The frame, not null.
  std::shared_ptr<const Frame> frame;
};

}  // namespace edgevo::python
