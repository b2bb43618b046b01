#include "map_link.h"

namespace edgevo {

MapLink::MapLink(const Camera& camera, const OdometryParams& params, const OdometryOptions& options,
                 MapRecords* records)
    : records_(records),
      rebuilder_(PyramidBuilder::for_rebuilding(camera, params.edges, options.detectors)),
      mapper_(camera.pinhole, params,
              {options.seed,
               // In realtime the mapping must not stand still for long.
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
  return {mapper_.camera(), thread_.left_out()};
}

// If there is one.
void MapLink::close_segment() {
  if (!mapper_.reference()) return;
  mapper_.close();
  take_settled();
  note_window();
}

// In the mapping thread.
void MapLink::take_update(const TrackedFrame& frame, const MapUpdate& update) {
  records_->note_times(frame.frame_index, update.times);
  take_settled();
  if (update.keyframe_id >= 0) note_window();
}

// Keyframes that have left the window, and what the camera's correction moved.
void MapLink::take_settled() {
  records_->retire(mapper_.take_retired(), segment_);
  records_->set_lines(mapper_.take_lines());
  records_->revise(mapper_.take_revised());
}

void MapLink::note_window() { records_->note_window(mapper_.window().keyframes(), segment_); }

}  // namespace edgevo
