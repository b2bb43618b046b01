// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mcap_output/mcap_output.h"

#include <deque>

#include "edge_image.h"
#include "edgevo/core/error.h"
#include "edgevo/scale/run_scaling.h"
#include "final_part.h"
#include "map_stream.h"
#include "pose_stream.h"

namespace edgevo {
namespace {

// Frames that wait for the first estimate of a scale; beyond, the file has an arbitrary unit. At 30 a second
// a minute: a robot passes the 40 m of an estimate in it.
constexpr int kMaxWaiting = 2000;
// Seconds between two images.
constexpr double kImagePeriod_s = 0.19;

using Event = std::shared_ptr<const MapEvent>;

}  // namespace

McapContent parse_mcap_content(const std::string& text, const std::string& where) {
  if (text == "off") return McapContent::kOff;
  if (text == "poses") return McapContent::kPoses;
  if (text == "images") return McapContent::kImages;
  throw InputError(where, "is neither images nor poses nor off", "give one of them");
}

struct McapOutput::Impl {
  // Everything that depends on the unit of the file.
  struct Streams {
    Streams(TopicFile* file, const McapRun& run, bool is_metric)
        : frames(run.T_vehicle_cam, is_metric),
          poses(file, &frames),
          map(file, &frames, run.pinhole, run.filter) {}

    LiveFrames frames;
    PoseStream poses;
    MapStream map;
  };

  Impl(const std::string& path, const McapRun& of_run)
      : run(of_run),
        file(path, of_run.library),
        scaling(of_run.scale, of_run.tracks, of_run.pinhole, of_run.T_vehicle_cam, of_run.scale_params),
        metres(scaling.newest()) {
    if (of_run.scale.list.front().kind == ScaleSource::Kind::kNone) begin(false);
  }

  void begin(bool is_metric) {
    streams = std::make_unique<Streams>(&file, run, is_metric);
    if (is_metric) streams->frames.set_metres_per_unit(metres->factor, metres->sigma);
    for (const Event& event : waiting) write(*event);
    waiting.clear();
  }
  // The unit is that of the whole file: what came before it was known waits.
  void add(const Event& event) {
    scaling.apply(*event);
    if (scaling.newest()) metres = scaling.newest();
    if (streams) return write(*event);
    waiting.push_back(event);
    frames_waiting += std::holds_alternative<FrameAnchored>(*event);
    if (metres) return begin(true);
    if (frames_waiting > kMaxWaiting) begin_without_metres();
  }
  void begin_without_metres() {
    begin(false);
    note = "lengths in " + std::string(kMcapFile) +
           " are in an arbitrary unit: no scale was found in the first " + std::to_string(kMaxWaiting) +
           " frames";
    streams->poses.log(RosLevel::kWarn, note);
  }
  void write(const MapEvent& event) {
    std::visit([this](const auto& e) { handle(e); }, event);
  }

  void handle(const SegmentPlaced& e) {
    streams->frames.follow(e);
    streams->poses.note_segment(e);
  }
  void handle(const EpochsPlaced& e) {
    streams->frames.follow(e);
    streams->poses.note_change(e);
  }
  void handle(const KeyframeMarginalised& e) { streams->map.add(e); }
  void handle(const MapMoved& e) { streams->map.apply(e); }
  void handle(const LinesFinished& e) { streams->map.add(e); }
  void handle(const FrameAnchored& e) {
    Streams& s = *streams;
    if (s.frames.is_metric() && s.poses.is_new(e.frame))
      s.frames.set_metres_per_unit(metres->factor, metres->sigma);
    s.poses.add(e.frame);
    s.map.set_now(s.poses.now());
    if (e.frame.T_world_cam_live) s.frames.note_pose(*e.frame.T_world_cam_live);
  }
  // What says nothing that is written.
  template <class Other>
  void handle(const Other&) {}

  // A run of which nothing was known before its end.
  void begin_at_end(const Run& finished) {
    if (streams) return;
    if (finished.is_metric()) metres = {finished.scale.factor, finished.scale.sigma, 0};
    begin(finished.is_metric());
  }
  void write_end(const Run& finished, const OccupancyGrid* grid);

  McapRun run;
  TopicFile file;
  RunScaling scaling;
  std::optional<ScaleEstimate> metres;  // newest per unit of the live poses
  std::unique_ptr<Streams> streams;     // null until the unit is known
  std::deque<Event> waiting;
  int frames_waiting = 0;
  std::string note;
  std::optional<Timestamp> last_image;
};

void McapOutput::Impl::write_end(const Run& finished, const OccupancyGrid* grid) {
  PoseStream& poses = streams->poses;
  const LiveEnd end = poses.end();
  if (finished.is_metric() != streams->frames.is_metric()) {
    const std::string why = "path, lines and grid have another unit than " + std::string(kMcapFile) +
                            " and are not in it: the scale " +
                            (finished.is_metric() ? "came too late" : "was lost at the end");
    note += (note.empty() ? "" : "; ") + why;
    return poses.log(RosLevel::kWarn, why);
  }
  poses.write_last_change(final_T_map_odom(finished, end), streams->frames.changes() + 1);
  write_final_part(finished, grid, end, &file);
}

McapOutput::McapOutput(const std::string& path, const McapRun& run)
    : impl_(std::make_unique<Impl>(path, run)) {}

McapOutput::~McapOutput() = default;

void McapOutput::apply(const std::vector<std::shared_ptr<const MapEvent>>& events) {
  for (const auto& event : events) impl_->add(event);
}

void McapOutput::add_view(Timestamp time, const FrameView& view) {
  auto& last = impl_->last_image;
  if (!view.pyramid || (last && seconds_between(*last, time) < kImagePeriod_s)) return;
  last = time;
  const RosHeader header{time, kCameraFrame};
  impl_->file.write(Topic::kCameraInfo, time, camera_message(header, impl_->run.pinhole));
  impl_->file.write(Topic::kImage, time, image_message(header, edge_image(view)));
}

const std::string& McapOutput::note() const { return impl_->note; }

void McapOutput::flush() { impl_->file.end_chunk(); }

void McapOutput::finish(const Run& run, const OccupancyGrid* grid) {
  impl_->begin_at_end(run);
  impl_->write_end(run, grid);
  impl_->file.finish({{"is_metric", impl_->streams->frames.is_metric() ? "true" : "false"},
                      {"map_changes", std::to_string(impl_->streams->poses.changes())},
                      {"unit", unit_statement(run)}});
}

}  // namespace edgevo
