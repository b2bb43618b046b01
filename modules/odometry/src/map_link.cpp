// SPDX-License-Identifier: BSD-3-Clause
#include "map_link.h"

#include <utility>

namespace edgevo {

MapLink::MapLink(const Rectification& rectification, const OdometryParams& params,
                 const OdometryOptions& options, std::shared_ptr<MapLog> log)
    : log_(std::move(log)),
      rebuilder_(PyramidBuilder::for_rebuilding(rectification, params.edges, options.detectors)),
      mapper_(rectification, params,
              {options.seed,
               // In realtime mapping must not pause for long.
               options.realtime,
               [this](const FramePyramid& old, const ImageMotion& motion, const ImageCorrection& now) {
                 rebuilder_.set_correction(now);
                 return rebuilder_.rebuild(old, motion);
               },
               log_, options.move_map}),
      // Called in the mapping thread. What mapping learns about a frame leaves with this event.
      thread_(&mapper_, options.realtime, [this](const TrackedFrame& frame, const MapUpdate& update) {
        log_->append(FrameMapped{frame.frame_index, update.times, update.adjustment});
      }) {}

std::string MapLink::make_map(const BootstrapResult& views) {
  thread_.wait_idle();
  close_segment();
  return mapper_.initialise(views);
}

void MapLink::begin_segment(int segment) {
  mapper_.begin_segment(segment);
  thread_.refresh();
}

int MapLink::finish() {
  thread_.wait_idle();
  close_segment();
  return thread_.skipped();
}

// Does nothing without a map.
void MapLink::close_segment() {
  if (mapper_.reference()) mapper_.close();
}

}  // namespace edgevo
