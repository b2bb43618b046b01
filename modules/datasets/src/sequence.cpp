// SPDX-License-Identifier: BSD-3-Clause
#include "sequence.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "edgevo/core/error.h"
#include "edgevo/core/frame_checks.h"
#include "edgevo/core/time_order.h"
#include "edgevo/mrpt_bridge/image_file.h"
#include "edgevo/mrpt_bridge/intensities.h"
#include "listed_order.h"
#include "text_file.h"
#include "time_unit.h"
#include "transparency.h"

namespace edgevo {
namespace {

class SequenceSource : public ImageSource {
 public:
  SequenceSource(Sequence sequence, int bits)
      : sequence_(std::move(sequence)), intensities_(decide_intensities(sequence_.images, bits)) {
    if (intensities_.decision) sequence_.decisions.push_back(*intensities_.decision);
    if (auto transparent = transparency_of(sequence_.images)) sequence_.decisions.push_back(*transparent);
    if (!sequence_.ordered_by_names)
      doubt_listed_order(sequence_.images, sequence_.times, &sequence_.decisions);
  }

  const Camera& camera() const override { return sequence_.camera; }
  std::optional<int> size() const override { return int(sequence_.images.size()); }
  std::string kind() const override { return sequence_.kind; }
  std::optional<SE3> T_vehicle_cam() const override { return sequence_.T_vehicle_cam; }
  VehicleTrack vehicle_track(VehicleSensor sensor) const override {
    return sensor == VehicleSensor::kGps ? sequence_.gps : VehicleTrack();
  }
  std::vector<std::pair<std::string, std::string>> details() const override { return sequence_.details; }
  std::vector<InputDecision> decisions() const override {
    std::vector<InputDecision> all = sequence_.decisions;
    for (InputDecision& d : time_decisions(sequence_.times)) all.push_back(std::move(d));
    return all;
  }
  std::vector<Timestamp> times() const override { return sequence_.times; }
  std::string ground_truth_path() const override { return sequence_.ground_truth_path; }

  std::optional<Frame> next() override {
    if (position_ >= sequence_.images.size()) return std::nullopt;
    const size_t i = position_++;  // also past a bad frame
    const std::string& path = sequence_.images[i];
    const Timestamp time = order_.require(int(i), sequence_.times[i], time_after(i),
                                          path + " (frame " + std::to_string(i) + ")");
    try {
      GrayImage image = read_gray_image(path, intensities_.scale);
      if (!sequence_.any_size) check_image_size(image, sequence_.camera.pinhole(), path);
      // A file of more bits does not hold the pixels of the frame.
      return Frame{int(i), time, std::move(image), intensities_.scale ? std::string() : path};
    } catch (const InputError& e) {
      throw BadFrame(int(i), time, e);
    }
  }
  bool skip() override {
    if (position_ >= sequence_.images.size()) return false;
    ++position_;
    return true;
  }

 private:
  std::optional<Timestamp> time_after(size_t i) const {
    return i + 1 < sequence_.times.size() ? std::make_optional(sequence_.times[i + 1]) : std::nullopt;
  }

  Sequence sequence_;
  Intensities intensities_;
  size_t position_ = 0;
  TimeOrder order_;
};

// What recorders write for a frame without a time.
bool says_no_time(const std::string& text) {
  return text == "-" || text == "nan" || text == "NaN" || text == "NAN" || text == "-nan";
}

// `texts` are numbers; texts[i] is in lines[stated[i]].
void check_one_unit(const std::vector<TextLine>& lines, const std::vector<size_t>& stated,
                    const std::vector<std::string>& texts) {
  std::vector<double> times;
  for (const std::string& text : texts) times.push_back(std::strtod(text.c_str(), nullptr));
  const auto other = other_unit_in(times);
  if (!other) return;
  const size_t i = other->index;
  throw InputError(lines[stated[i]].where,
                   quote(texts[i]) + " is in another unit than " + quote(texts[i - 1]) +
                       " before it (a factor of " + std::to_string(std::lround(other->factor)) + ")",
                   "write all times in seconds");
}

}  // namespace

std::unique_ptr<ImageSource> play(Sequence sequence, int bits) {
  return std::make_unique<SequenceSource>(std::move(sequence), bits);
}

std::vector<Timestamp> read_times(const std::string& path, const SourceOptions& options,
                                  Decisions* decisions) {
  return parse_times_of(split_lines(read_text_file(path), path), options, decisions);
}

std::vector<Timestamp> parse_times_of(const std::vector<TextLine>& lines, const SourceOptions& options,
                                      Decisions* decisions) {
  std::vector<std::string> texts;
  std::vector<size_t> stated;  // lines with a time
  for (size_t i = 0; i < lines.size(); ++i)
    if (!says_no_time(lines[i].text)) texts.push_back(lines[i].text), stated.push_back(i);
  std::vector<Timestamp> parsed;
  UnitOfTimes unit;
  size_t bad = 0;
  if (!parse_times(texts, options.time_unit, &parsed, &unit, &bad))
    throw InputError(lines[stated[bad]].where, quote(texts[bad]) + " is not a time",
                     "write seconds, one number a line");
  check_one_unit(lines, stated, texts);
  if (decisions && (unit.unit.decimals > 0 || !unit.doubt.empty()))
    decisions->push_back({"times", std::string("in ") + unit.unit.name, unit.reason, unit.doubt});
  std::vector<Timestamp> times(lines.size(), kNoTime);
  for (size_t i = 0; i < stated.size(); ++i) times[stated[i]] = parsed[i];
  return times;
}

void check_counts(const std::vector<std::string>& images, const std::vector<Timestamp>& times,
                  const std::string& times_path, const std::string& images_folder) {
  if (images.size() == times.size()) return;
  throw InputError(times_path,
                   std::to_string(times.size()) + " times for " + std::to_string(images.size()) +
                       " images in " + images_folder,
                   "give one time for each image");
}

CameraFile camera_file_of(const SourceOptions& options, const std::string& own) {
  const std::string path = options.camera_file.empty() ? existing(own) : options.camera_file;
  if (!path.empty()) return {path, options.sensor_label, options.camera_scale};
  throw InputError(options.path, "no calibration" + (own.empty() ? "" : " (" + own + " is missing)"),
                   "give the camera's file with --camera (edgevo calibrate --chessboard makes one), or its "
                   "angle with --fov; edgevo run also takes --camera auto: found from the motion");
}

std::string existing(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored) ? path : std::string();
}

}  // namespace edgevo
