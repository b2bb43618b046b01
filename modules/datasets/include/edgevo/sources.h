// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Images and cameras from files, in one header, for the odometry of edgevo/edgevo.h. An example:
// share/examples/poses. Link edgevo::datasets.
//
//   ImageSource, open_source  a recording, a folder of images, a video or a live camera, by its path
//   read_camera_file          the camera that takes the images, from a calibration file
//
// Both throw InputError for input that cannot be used: what, where, what to do.
#include "edgevo/core/error.h"
#include "edgevo/core/image_source.h"
#include "edgevo/datasets/camera_file.h"
#include "edgevo/datasets/open_source.h"
