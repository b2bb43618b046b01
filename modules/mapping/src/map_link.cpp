// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mapping/map_link.h"

#include <utility>

#include "edgevo/core/trace.h"

namespace edgevo {
MapLink::MapLink(const Rectification& rectification, const EdgeParams& edges, const MapperParams& params,
                 const MapLinkOptions& options, std::shared_ptr<MapLog> log)
    : longest_wait_(options.on_schedule ? std::chrono::milliseconds(50) : std::chrono::hours(1)),
      log_(std::move(log)),
      rebuilder_(PyramidBuilder::for_rebuilding(rectification, edges, options.detectors)),
      mapper_(rectification, params,
              {options.seed,
               // In realtime mapping must not pause for long.
               options.realtime,
               [this](const FramePyramid& old, const ImageMotion& motion, const ImageCorrection& now) {
                 return rebuild(old, motion, now);
               },
               log_, options.move_map, options.forget, options.camera}),
      // Called in the mapping thread. What mapping learns about a frame leaves with this event.
      thread_(&mapper_, options.realtime, [this](const TrackedFrame& frame, const MapUpdate& update) {
        log_->append(FrameMapped{frame.frame_index, update.times, update.adjustment});
      }) {}

std::shared_ptr<const FramePyramid> MapLink::rebuild(const FramePyramid& old, const ImageMotion& motion,
                                                     const ImageCorrection& now) {
  const TraceScope traced("image of a keyframe");
  const std::lock_guard<std::mutex> lock(rebuilding_);
  rebuilder_.set_correction(now);
  return rebuilder_.rebuild(old, motion);
}

void MapLink::rectify_rows(BootstrapResult* views) {
  // By which the corners were straightened.
  const ImageCorrection now = views->views.back().pyramid->correction;
  for (BootstrapView& v : views->views)
    if (v.pyramid && v.motion.is_known() && !v.is_straight) v.pyramid = rebuild(*v.pyramid, v.motion, now);
}

Reasons MapLink::make_map(const BootstrapResult& views) {
  thread_.wait_idle();
  close_segment();
  Reasons problem = mapper_.initialise(views);
  thread_.refresh();
  return problem;
}

void MapLink::begin_segment(int segment) {
  mapper_.begin_segment(segment);
  thread_.refresh();
}

void MapLink::correct(PyramidBuilder* builder, const ImageCorrection& correction) {
  const std::unique_lock<std::mutex> lock(rebuilding_, std::try_to_lock);  // or it prepares another one
  if (lock.owns_lock() && rebuilder_.correction() == correction)
    builder->share_correction(rebuilder_);
  else
    builder->set_correction(correction);
}

void MapLink::submit(TrackedFrame frame) {
  if (shedding_ >= Shedding::kDepths && !frame.is_needed() && frame.return_to < 0)
    ++depths_shed_;
  else
    thread_.submit(std::move(frame));
}

void MapLink::shed(Shedding shedding) {
  shedding_ = shedding;
  mapper_.shed(shedding);
}

RealtimeRecord MapLink::finish() {
  thread_.wait_idle();
  close_segment();
  RealtimeRecord record;
  record.skipped_by_mapping = thread_.skipped();
  record.shed = mapper_.shed_work();
  record.shed.depths = depths_shed_;
  return record;
}

// Does nothing without a map.
void MapLink::close_segment() {
  if (mapper_.reference()) mapper_.close();
}

}  // namespace edgevo
