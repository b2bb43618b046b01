#include "edgevo/results/run_outputs.h"

#include <optional>

#include "edgevo/mrpt_bridge/playback_writer.h"
#include "edgevo/results/run_folder.h"
#include "export_files.h"
#include "space_reserve.h"

namespace edgevo {
namespace {

// Three trajectories and frames.csv take about 600 bytes a frame: 10 000 frames.
constexpr size_t kTextBytes = 6 << 20, kSummaryBytes = 64 << 10;

const MapParams& checked(const MapParams& map) {
  map.check();
  return map;
}

}  // namespace

struct RunOutputs::Impl {
  Impl(const std::string& path, const Camera& camera_of_images, const MapParams& map)
      : params(checked(map)),
        camera(camera_of_images),
        folder(path),
        text_reserve(path, kTextBytes),
        summary_reserve(path, kSummaryBytes),
        playback(path, camera_of_images) {}

  ResourceMeter meter;
  MapParams params;
  Camera camera;
  RunFolder folder;
  SpaceReserve text_reserve, summary_reserve;
  PlaybackWriter playback;
  bool images_failed = false;
};

RunOutputs::RunOutputs(const std::string& folder, const Camera& camera, const MapParams& map)
    : impl_(std::make_unique<Impl>(folder, camera, map)) {}

RunOutputs::~RunOutputs() = default;

bool RunOutputs::add_frame(const Frame& frame, const std::string& image_path) {
  if (impl_->images_failed) return false;
  try {
    if (image_path.empty())
      impl_->playback.add_frame(frame);
    else
      impl_->playback.add_frame_link(frame.index, image_path);
  } catch (const InputError& e) {
    impl_->images_failed = true;
    impl_->folder.note_failure("playback_Images", e);
  }
  return !impl_->images_failed;
}

void RunOutputs::finish(const Run& run, const RunInfo& info) {
  ExportContext context{run, impl_->params, &info, &impl_->camera, &impl_->playback, &impl_->meter};
  context.use_of_run = impl_->meter.so_far();
  impl_->text_reserve.release();
  export_files([](FileKind kind) { return kind != FileKind::kSummary; }, &context, &impl_->folder);
  impl_->summary_reserve.release();
  export_files([](FileKind kind) { return kind == FileKind::kSummary; }, &context, &impl_->folder);
  impl_->folder.tell_failures();
}

}  // namespace edgevo
