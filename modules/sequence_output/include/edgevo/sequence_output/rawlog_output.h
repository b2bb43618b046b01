// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A source as a rawlog with its images and ground truth: the output of import, relight and simulate.
#include <functional>
#include <string>

#include "edgevo/core/image_source.h"

namespace edgevo {

/// Whether `path` is a rawlog by its extension, not a folder.
bool names_rawlog(const std::string& path);

/// Checks that a sequence may be written to `out`: a folder, or OUT.rawlog with its images next to it.
/// Throws InputError if `out` lies in its own source or around it, or if something exists there already,
/// unless `force` is set. `source` may be empty.
void check_sequence_output(const std::string& source, const std::string& out, bool force);

/// Writes the rawlog, its images and, unless it is empty, the text `ground_truth_tum` as a file next to it;
/// makes the parent folder. `on_frame_done` is called with the number of frames written so far. Returns the
/// number of frames. Throws InputError.
int write_rawlog(ImageSource& source, const std::string& rawlog, const std::string& ground_truth_tum,
                 const std::function<void(int)>& on_frame_done);

/// One line for the user: "out.rawlog: 50 frames, images in out_Images, ground truth next to it".
std::string describe_rawlog(const std::string& rawlog, int frames, bool has_ground_truth,
                            const Camera& camera);

}  // namespace edgevo
