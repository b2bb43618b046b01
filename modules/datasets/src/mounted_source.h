// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A source whose camera has a mount that the user gave.
#include <memory>
#include <string>

#include "edgevo/core/camera_mount.h"
#include "edgevo/core/image_source.h"

namespace edgevo {

/// `inner` with the mount `mount` in place of its own, which is then said; `given_by` names where it is from
/// ("--mount").
std::unique_ptr<ImageSource> mount_source(std::unique_ptr<ImageSource> inner, const CameraMount& mount,
                                          const std::string& given_by);

}  // namespace edgevo
