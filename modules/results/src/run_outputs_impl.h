// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <atomic>
#include <functional>
#include <optional>
#include <string>

#include "earlier_run.h"
#include "edgevo/core/worker.h"
#include "edgevo/mrpt_bridge/playback_writer.h"
#include "edgevo/results/run_folder.h"
#include "edgevo/results/run_outputs.h"
#include "live_files.h"
#include "resource_use.h"
#include "space_reserve.h"

namespace edgevo {

struct RunOutputs::Impl {
  Impl(const std::string& path, const Camera& camera_of_images, const MapParams& map,
       const OutputOptions& requested);

  /// Sets an earlier run aside and opens the growing files, at the first frame.
  void begin();
  /// Does it now, or with OutputOptions::own_thread in the writer's thread, after what it was given before.
  void write(std::function<void()> task);
  /// Waits for the writer.
  void catch_up();
  void write_image(const Frame& frame, const std::string& image_path);
  void keep_image(const Frame& frame, const std::string& image_path);
  void keep_record(const FrameRecord& record);
  /// Does something with run.mcap; the first failure ends that file, not the run.
  void with_mcap(const std::function<void(McapOutput*)>& work);
  void write_mcap_events();
  /// As with_mcap(), of map.db.
  void with_map(const std::function<void(MapFileWriter*)>& work);
  void write_map_events();
  void remove_if_unused() const;

  ResourceMeter meter;
  MapParams params;
  Camera camera;
  OutputOptions options;
  EarlierRun earlier;
  /// Whether the folder existed before.
  bool was_there;
  RunFolder folder;
  SpaceReserve text_reserve, summary_reserve;
  std::optional<RecoveryHeader> recovery_header;
  /// For `live`, which begin() makes.
  std::optional<MapCursor> events;
  /// Writer of the images; set by begin().
  std::optional<PlaybackWriter> playback;
  std::optional<LiveFiles> live;
  /// For `mcap`, which begin() makes; it is null without one, or once it could not be written.
  std::optional<MapCursor> mcap_events;
  std::unique_ptr<McapOutput> mcap;
  /// For `kept_map`, which begin() makes; the same holds.
  std::optional<MapCursor> map_events;
  std::unique_ptr<MapFileWriter> kept_map;
  std::atomic<bool> images_failed{false};
  std::string map_note, mcap_note;
  /// Files next to the frames: a disk that is busy holds a write up for 0.1 s. Last member: it ends before
  /// what it writes to.
  Worker writer;
};

}  // namespace edgevo
