#pragma once
// A source as a rawlog with all that belongs beside it: what import, relight and simulate write.
#include <functional>
#include <string>

#include "edgevo/core/image_source.h"

namespace edgevo {

/// "x.rawlog": the user wants a rawlog, not a folder.
bool names_rawlog(const std::string& path);

/// Throws InputError when a sequence is not to be written to `out`, a folder or OUT.rawlog with its images
/// beside it: it lies in its own source or around it, or, unless `force`, something is there already.
/// `source` may be empty.
void check_sequence_output(const std::string& source, const std::string& out, bool force);

/// Writes the rawlog, its images and, unless it is empty, `ground_truth_tum` beside it; makes the folder it
/// goes to. Returns the number of frames, of which `on_frame_done` is told as they go. Throws InputError.
int write_rawlog(ImageSource& source, const std::string& rawlog, const std::string& ground_truth_tum,
                 const std::function<void(int)>& on_frame_done);

/// "out.rawlog: 50 frames, images in out_Images, ground truth beside it".
std::string describe_rawlog(const std::string& rawlog, int frames, bool has_ground_truth);

}  // namespace edgevo
