// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/results/run_outputs.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "edgevo/core/rectification.h"
#include "edgevo/core/trace.h"
#include "edgevo/run_quality/run_statistics.h"
#include "edgevo/run_quality/trusted_part.h"
#include "edgevo/tracking/frame_view.h"
#include "export_files.h"
#include "mcap_run.h"
#include "recovery_format.h"
#include "run_outputs_impl.h"

namespace edgevo {
namespace {

// Enough for 10 000 frames: three trajectories and frames.csv take about 600 bytes a frame.
constexpr size_t kTextBytes = 6 << 20, kSummaryBytes = 64 << 10;
// Writes that may wait: two a frame, so a second of a camera.
constexpr size_t kMaxWrites = 60;

const MapParams& checked(const MapParams& map) {
  map.check();
  return map;
}

bool is_there(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

MapHeader map_header(const RecoveryHeader& header) {
  const Rectification rectification = rectification_of(header.info.camera, header.info.working_pinhole);
  return {rectification.target(), camera_text(header.info.camera), header.info.source_path};
}

}  // namespace

RunOutputs::Impl::Impl(const std::string& path, const Camera& camera_of_images, const MapParams& map,
                       const OutputOptions& requested)
    : params(checked(map)),
      camera(camera_of_images),
      options(requested),
      earlier(path, requested.force),
      was_there(is_there(path)),
      folder(path),
      text_reserve(path, kTextBytes),
      summary_reserve(path, kSummaryBytes),
      writer({"writing", kMaxWrites, options.own_thread || options.mcap == McapContent::kImages}) {}

void RunOutputs::Impl::begin() {
  if (playback) return;
  earlier.set_aside();
  playback.emplace(folder.path(), camera);
  if (recovery_header) live.emplace(folder.path(), *recovery_header, std::move(*events));
  if (mcap_events)
    folder.attempt(kMcapFile, [this](const std::string& path_of_it) {
      mcap = std::make_unique<McapOutput>(path_of_it, mcap_run(*recovery_header, params));
    });
  if (map_events)
    folder.attempt(kMapFile, [this](const std::string& path_of_it) {
      kept_map = std::make_unique<MapFileWriter>(path_of_it, map_header(*recovery_header));
    });
}

void RunOutputs::Impl::with_map(const std::function<void(MapFileWriter*)>& work) {
  if (!kept_map) return;
  try {
    work(kept_map.get());
  } catch (const InputError& e) {
    folder.note_failure(kMapFile, e);
    kept_map.reset();
  }
}

void RunOutputs::Impl::write_map_events() {
  if (!map_events) return;
  write([this, read = map_events->read()] {
    with_map([&](MapFileWriter* map) {
      for (const auto& event : read) {
        if (const auto* added = std::get_if<ConstraintAdded>(&*event)) map->add(*added);
        if (const auto* withdrawn = std::get_if<ConstraintWithdrawn>(&*event)) map->withdraw(withdrawn->id);
      }
    });
  });
}

void RunOutputs::Impl::with_mcap(const std::function<void(McapOutput*)>& work) {
  if (!mcap) return;
  try {
    work(mcap.get());
  } catch (const InputError& e) {
    folder.note_failure(kMcapFile, e);
    mcap.reset();
  }
}

// Read by the caller, so that what is in the file before an image does not depend on the writer's thread; and
// without a file, too: an event is kept in memory until it has been read.
void RunOutputs::Impl::write_mcap_events() {
  if (!mcap_events) return;
  write([this, read = mcap_events->read()] {
    const TraceScope traced("write run.mcap");
    with_mcap([&](McapOutput* output) { output->apply(read); });
  });
}

// A disk that is too slow for long holds the run up.
void RunOutputs::Impl::write(std::function<void()> task) { writer.submit_when_room(std::move(task)); }

void RunOutputs::Impl::catch_up() { writer.wait_idle(); }

void RunOutputs::Impl::write_image(const Frame& frame, const std::string& image_path) {
  if (image_path.empty())
    playback->add_frame(frame);
  else if (options.copy_images)
    playback->add_frame_copy(frame.index, image_path);
  else
    playback->add_frame_link(frame.index, image_path);
}

void RunOutputs::Impl::remove_if_unused() const {
  std::error_code not_empty;
  if (!was_there && !playback) std::filesystem::remove(folder.path(), not_empty);
}

void RunOutputs::Impl::keep_image(const Frame& frame, const std::string& image_path) {
  if (images_failed) return;
  const TraceScope traced("write the image", frame.index);
  try {
    write_image(frame, image_path);
    if (options.forget) playback->forget_images();
  } catch (const InputError& e) {
    images_failed = true;
    folder.note_failure("playback_Images", e);
  }
}

void RunOutputs::Impl::keep_record(const FrameRecord& record) {
  const TraceScope traced("write the record", record.index);
  if (record.T_world_cam_live && earlier.is_set_aside()) earlier.remove();
  if (!live) return;
  live->write_events();
  live->add(record);
}

RunOutputs::RunOutputs(const std::string& folder, const Camera& camera, const MapParams& map,
                       const OutputOptions& options)
    : impl_(std::make_unique<Impl>(folder, camera, map, options)) {}

RunOutputs::~RunOutputs() { impl_->remove_if_unused(); }

void RunOutputs::keep_recovery_log(const RecoveryHeader& header, const std::shared_ptr<MapLog>& log) {
  impl_->recovery_header = header;
  impl_->events.emplace(log);
  if (impl_->options.mcap != McapContent::kOff) impl_->mcap_events.emplace(log);
  if (impl_->options.keep_map) impl_->map_events.emplace(log);
}

void RunOutputs::adopt(int last_frame) {
  impl_->playback.emplace(impl_->folder.path(), impl_->camera);
  impl_->playback->adopt_images(last_frame);
}

void RunOutputs::adopt(std::unique_ptr<McapOutput> mcap, const std::optional<InputError>& failure) {
  impl_->mcap = std::move(mcap);
  if (failure) impl_->folder.note_failure(kMcapFile, *failure);
}

void RunOutputs::adopt_map() {
  const std::string path = impl_->folder.path_of(kMapFile);
  if (!is_there(path)) return;
  impl_->folder.attempt(kMapFile,
                        [&](const std::string&) { impl_->kept_map = std::make_unique<MapFileWriter>(path); });
}

void RunOutputs::add_keyframe(const StoredKeyframe& keyframe) {
  if (!impl_->options.keep_map) return;
  impl_->write([this, keyframe] {
    const TraceScope traced("write map.db", keyframe.record->frame_index);
    impl_->with_map([&](MapFileWriter* map) { map->add(keyframe); });
  });
}

bool RunOutputs::add_frame(const Frame& frame, const std::string& image_path) {
  if (impl_->images_failed) return false;
  impl_->begin();
  if (frame.image.empty()) return true;
  // Of an image on disk the pixels are not needed.
  impl_->write(
      [this, image_path, kept = image_path.empty() ? frame : Frame{frame.index, frame.time, {}, {}}] {
        impl_->keep_image(kept, image_path);
      });
  return !impl_->images_failed;
}

void RunOutputs::add_record(const FrameRecord& record) {
  impl_->begin();
  impl_->write([this, record] { impl_->keep_record(record); });
  impl_->write_mcap_events();
  impl_->write_map_events();
}

bool RunOutputs::wants_views() const { return impl_->options.mcap == McapContent::kImages; }

void RunOutputs::add_view(Timestamp time, const FrameView& view) {
  if (!wants_views()) return;
  impl_->write([this, time, view] {
    const TraceScope traced("draw the edges");
    impl_->with_mcap([&](McapOutput* output) { output->add_view(time, view); });
  });
}

void RunOutputs::end_unfinished() {
  impl_->begin();
  impl_->write_mcap_events();
  impl_->write([this] { impl_->with_mcap([](McapOutput* output) { output->flush(); }); });
  impl_->catch_up();
  if (impl_->live) impl_->live->write_events();
  if (!impl_->live || impl_->live->is_broken())
    throw InputError(recovery_log_path(impl_->folder.path()), "could not be written: the results are lost",
                     "free space, or run without --forget");
}

void RunOutputs::finish(const Run& run, const RunInfo& info, bool keep_log) {
  const TraceScope traced("write the results");
  impl_->begin();
  impl_->write_mcap_events();
  impl_->write_map_events();
  impl_->catch_up();
  // Writing takes seconds, and the program may be killed before the end.
  if (impl_->live) impl_->live->write_events();
  if (count(run).with_pose > 0) impl_->earlier.remove();
  std::optional<Run> trusted;
  if (!impl_->options.include_doubtful && count(run).doubtful_keyframes > 0) trusted = trusted_part(run);
  ExportContext context{trusted ? *trusted : run, impl_->params,     &info,
                        &impl_->camera,           &*impl_->playback, &impl_->meter};
  if (trusted) context.with_doubtful = &run;
  context.mcap = impl_->mcap.get();
  context.kept_map = impl_->kept_map.get();
  context.use_of_run = impl_->meter.so_far();
  impl_->text_reserve.release();
  export_files([](FileKind kind) { return kind != FileKind::kSummary; }, &context, &impl_->folder);
  impl_->summary_reserve.release();
  export_files([](FileKind kind) { return kind == FileKind::kSummary; }, &context, &impl_->folder);
  impl_->map_note = context.map.note;
  if (impl_->mcap) impl_->mcap_note = impl_->mcap->note();
  impl_->folder.throw_first_failure();
  if (!keep_log) remove_recovery_log(impl_->folder.path());
}

const std::string& RunOutputs::map_note() const { return impl_->map_note; }

const std::string& RunOutputs::mcap_note() const { return impl_->mcap_note; }

std::string RunOutputs::earlier_run() const {
  return impl_->earlier.is_set_aside() ? impl_->folder.path_of(kEarlierRun) : std::string();
}

}  // namespace edgevo
