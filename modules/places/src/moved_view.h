// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "edgevo/core/rectification.h"
#include "edgevo/map/map_event.h"
#include "edgevo/places/remembered_view.h"

namespace edgevo {

/// A remembered view after a correction of the camera. Descriptors and signature stay.
RememberedView moved_view(const Rectification& rectification, const LensChange& lens,
                          const ImageMotion& motion, const RememberedView& view);

}  // namespace edgevo
