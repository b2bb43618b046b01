#pragma once
#include <optional>

#include "earlier_run.h"
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

  /// The first frame is there: nothing in the folder is the earlier run's from here on.
  void begin();
  void write_image(const Frame& frame, const std::string& image_path);
  void remove_if_unused() const;

  ResourceMeter meter;
  MapParams params;
  Camera camera;
  OutputOptions options;
  EarlierRun earlier;
  bool was_there;  ///< the folder
  RunFolder folder;
  SpaceReserve text_reserve, summary_reserve;
  std::optional<JournalHeader> journal_header;
  std::optional<PlaybackWriter> playback;  ///< since the run has begun
  std::optional<LiveFiles> live;
  bool images_failed = false;
};

}  // namespace edgevo
