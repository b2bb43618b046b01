// SPDX-License-Identifier: BSD-3-Clause
#include "map_link.h"

namespace edgevo {

MapLink::MapLink(const Camera& camera, const OdometryParams& params, const OdometryOptions& options,
                 MapRecords* records)
    : records_(records),
      rebuilder_(PyramidBuilder::for_rebuilding(camera, params.edges, options.detectors)),
      mapper_(camera.pinhole, params,
              {options.seed,
               // In realtime mapping must not pause for long.
               options.realtime,
               [this](const FramePyramid& old, const ImageMotion& motion, const ImageCorrection& now) {
                 rebuilder_.set_correction(now);
                 return rebuilder_.rebuild(old, motion);
               }}),
      thread_(&mapper_, options.realtime,
              [this](const TrackedFrame& frame, const MapUpdate& update) { take_update(frame, update); }) {}

std::string MapLink::make_map(const BootstrapResult& views) {
  thread_.wait_idle();
  close_segment();
  return mapper_.initialise(views);
}

void MapLink::begin_segment(int segment) {
  segment_ = segment;
  thread_.refresh();
  note_window();
}

MapLink::Rest MapLink::finish() {
  thread_.wait_idle();
  close_segment();
  return {mapper_.camera(), thread_.skipped()};
}

// Does nothing without a map.
void MapLink::close_segment() {
  if (!mapper_.reference()) return;
  mapper_.close();
  record_marginalised();
  note_window();
}

// Called in the mapping thread.
void MapLink::take_update(const TrackedFrame& frame, const MapUpdate& update) {
  records_->note_times(frame.frame_index, update.times);
  record_marginalised();
  if (update.keyframe_id >= 0) note_window();
}

// Records keyframes that have left the window, and those that a correction of the camera moved.
void MapLink::record_marginalised() {
  records_->add_marginalised(mapper_.take_marginalised(), segment_);
  records_->set_lines(mapper_.take_lines());
  records_->revise(mapper_.take_revised());
}

void MapLink::note_window() { records_->note_window(mapper_.window().keyframes(), segment_); }

}  // namespace edgevo
