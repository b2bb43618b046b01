// SPDX-License-Identifier: BSD-3-Clause
// Which images are used, and what becomes of a frame whose image is not.
#include <utility>

#include "edgevo/core/trace.h"
#include "odometry_impl.h"

namespace edgevo {
namespace {

// Why an image is not used; null: it is. A torn one shows half a view, which a map cannot begin with.
const char* why_unused(ImageFault fault, bool has_pose) {
  if (fault == ImageFault::kBlank) return "blank: the image shows noise alone";
  if (fault == ImageFault::kRepeated) return "the image before, once more";
  if (fault == ImageFault::kTorn && !has_pose) return "torn: a part is of an earlier image";
  return nullptr;
}

}  // namespace

FrameRecord Odometry::Impl::process(const Frame& frame) {
  const TraceScope traced("frame", frame.index);
  const std::string where = "Odometry::process(), frame " + std::to_string(frame.index);
  require_open(where);
  // What throws leaves everything as it was.
  FrameOrder next = order;
  next.take(frame, where);
  check_image_size(frame.image, camera, where);
  check_pixels(frame.image, where);
  const ImageExposure exposure = exposures.add(frame.image);
  if (const char* why = why_unused(exposure.fault, state.has_pose()))
    return pass_over(frame, why, exposure.fault);
  order = next;
  const ImageFault pattern = exposure.fault == ImageFault::kTorn ? exposures.pattern() : exposure.fault;
  const bool is_mosaic = pattern == ImageFault::kMosaic;
  if (!is_mosaic && pattern != ImageFault::kInterlaced) return use(frame, exposure);
  if (std::exchange(reported_pattern, pattern) != pattern)
    report(frame, is_mosaic ? "the image is a mosaic of colours: it is smoothed to gray"
                            : "the image is interlaced: every second row of it is used");
  Frame usable = frame;
  usable.image = is_mosaic ? without_mosaic(frame.image) : first_field(frame.image);
  return use(usable, exposure);
}

// A servo sees at once that there is no pose.
FrameRecord Odometry::Impl::pass_over(const Frame& frame, const std::string& why, ImageFault fault) {
  const FrameRecord record = skip(frame, why, fault);
  if (!record.T_world_cam_live) newest_pose = {};
  record_newest_pose(record);
  return record;
}

FrameRecord Odometry::Impl::skip(const Frame& frame, const std::string& why, ImageFault fault) {
  const std::string where = "Odometry::skip(), frame " + std::to_string(frame.index);
  require_open(where);
  const bool has_time = order.has_own_time(frame);
  const Timestamp time = order.take_skipped(frame, where);
  publish_camera();
  const Frame without_image{frame.index, time, {}, {}};
  FrameRecord& record =
      fault == ImageFault::kRepeated ? frames.repeat_frame(without_image) : frames.begin_frame(without_image);
  history.interrupt();
  zoom_change.interrupt();
  record.evidence.fault = fault;
  if (record.T_world_cam_live)
    record.note = why;
  else
    assign_skipped(state.when_skipped(), why, &record);
  frames.publish();
  if (has_time && !waits_for_map()) front_end.begin_frame(frame.time);
  frames.run();
  return record;
}

}  // namespace edgevo
