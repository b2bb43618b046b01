// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/detectors/edge_images.h"

#include <atomic>
#include <filesystem>
#include <mutex>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "contact_sheet.h"
#include "edgevo/core/bad_frame.h"
#include "edgevo/core/block_yaml.h"
#include "edgevo/core/input_file.h"
#include "edgevo/core/output_file.h"
#include "edgevo/core/run_parallel.h"
#include "edgevo/detectors/all_detectors.h"
#include "edgevo/files/image_names.h"
#include "edgevo/files/output_folder.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSettingsFile = "edges.yaml";

// Computes the output image of a frame. Use one object per thread.
class EdgeImager {
 public:
  explicit EdgeImager(const EdgeParams& params)
      : detector_(make_edge_detector(params, all_edge_detectors())),
        probability_(make_edge_probability(params, all_edge_detectors())) {}

  Plane<uint8_t> image_of(const Frame& frame) {
    const ImageView<uint8_t> gray = frame.image.view();
    if (probability_) return probability_->estimate(gray, image_name(frame));
    return detector_->detect({gray, compute_gradient(gray)});
  }
  std::string description() const { return probability_ ? probability_->description() : "the gradient"; }

 private:
  std::unique_ptr<EdgeDetector> detector_;
  std::unique_ptr<EdgeProbability> probability_;
};

std::string settings_text(const EdgeImageOptions& options, const EdgeImager& imager, const Pinhole& size) {
  std::error_code ignored;
  const std::string source = fs::exists(options.source_path, ignored)
                                 ? fs::canonical(options.source_path, ignored).string()
                                 : options.source_path;
  return "# What `edgevo edges` made these images of\ndetector: " + yaml_scalar(options.edges.detector) +
         "\nmodel: " + yaml_scalar(imager.description()) + "\nsource: " + yaml_scalar(source) +
         "\nimage_size: " + std::to_string(size.width) + "x" + std::to_string(size.height) + "\n";
}

void begin_folder(const EdgeImageOptions& options, const std::string& settings) {
  check_folder_is_ours(options.folder, {kSettingsFile}, options.force);
  make_output_folder(options.folder);
  const std::string path = (fs::path(options.folder) / kSettingsFile).string();
  std::error_code ignored;
  if (fs::exists(path, ignored) && read_file(path, "remove it") != settings)
    throw InputError(options.folder,
                     "contains edges of another source, size, detector or model (" + path + ")",
                     "give another -o, or remove the folder");
  write_file(path, settings);
}

// Writes to a temporary name first, so that an existing file is always complete.
void write_whole(const std::string& path, const Plane<uint8_t>& image) {
  std::vector<uint8_t> bytes;
  cv::imencode(".png", cv::Mat(image.height(), image.width(), CV_8UC1, const_cast<uint8_t*>(image.row(0))),
               bytes);
  const std::string part = path + ".part";
  write_file(part, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  std::error_code error;
  fs::rename(part, path, error);
  if (error)
    throw InputError(path, "cannot be written: " + error.message(), "free the name, or give another -o");
}

// The source, shared by the threads, and the counts.
class SharedWork {
 public:
  SharedWork(ImageSource& source, const EdgeImageOptions& options)
      : source_(source), options_(options), sheet_(source.size()) {}

  std::optional<Frame> next() {
    const std::lock_guard<std::mutex> lock(mutex_);
    while (!failed_ && !(options_.stop && options_.stop())) try {
        std::optional<Frame> frame = source_.next();
        if (frame) sheet_.offer(*frame);
        return frame;
      } catch (const BadFrame&) {
        ++counts_.skipped;
      }
    return std::nullopt;
  }
  void note(int EdgeImageCounts::*count) {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++(counts_.*count);
    if (options_.on_frame_done) options_.on_frame_done(counts_.all());
  }
  void fail() { failed_ = true; }

  const EdgeImageCounts& counts() const { return counts_; }
  const ContactSheet& sheet() const { return sheet_; }

 private:
  ImageSource& source_;
  const EdgeImageOptions& options_;
  std::mutex mutex_;
  std::atomic<bool> failed_{false};
  EdgeImageCounts counts_;
  ContactSheet sheet_;
};

void work_on(SharedWork& shared, EdgeImager& imager, const std::string& folder) try {
  while (const std::optional<Frame> frame = shared.next()) {
    const std::string path = (fs::path(folder) / (image_name(*frame) + ".png")).string();
    std::error_code ignored;
    const bool is_there = fs::exists(path, ignored);
    if (!is_there) write_whole(path, imager.image_of(*frame));
    shared.note(is_there ? &EdgeImageCounts::kept : &EdgeImageCounts::written);
  }
} catch (...) {
  shared.fail();
  throw;
}

}  // namespace

EdgeImageCounts write_edge_images(ImageSource& source, const EdgeImageOptions& options) {
  if (source.is_live())
    throw InputError(options.source_path, "is a live camera, whose images have no names", "record it first");
  std::vector<EdgeImager> imagers;
  for (int i = 0; i < std::max(1, options.threads); ++i) imagers.emplace_back(options.edges);
  begin_folder(options, settings_text(options, imagers.front(), source.camera().pinhole()));
  SharedWork shared(source, options);
  run_parallel(0, int(imagers.size()), int(imagers.size()),
               [&](int i) { work_on(shared, imagers[size_t(i)], options.folder); });
  if (!(options.stop && options.stop())) shared.sheet().write(options.folder, options.edges);
  return shared.counts();
}

}  // namespace edgevo
