// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mrpt_bridge/rawlog_source.h"

#include <algorithm>
#include <filesystem>

#include "edgevo/core/bad_frame.h"
#include "edgevo/core/error.h"
#include "edgevo/core/frame_checks.h"
#include "edgevo/core/gyro_of_sensors.h"
#include "edgevo/core/order_statistics.h"
#include "edgevo/core/output_file.h"
#include "edgevo/core/time_order.h"
#include "edgevo/mrpt_bridge/conversions.h"
#include "edgevo/mrpt_bridge/image_file.h"
#include "edgevo/mrpt_bridge/rawlog_image.h"
#include "edgevo/mrpt_bridge/rawlog_reader.h"
#include "edgevo/mrpt_bridge/rawlog_writer.h"
#include "rawlog_images_folder.h"
#include "rawlog_imus.h"
#include "rawlog_survey.h"
#include "vehicle_track_reader.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

// A recorder that stored milliseconds as seconds, or seconds as ticks: the odometry runs, but without a valid
// speed.
std::string doubt_about_times(const std::vector<Timestamp>& times) {
  constexpr double kShortest = 1e-4, kLongest = 5;  // seconds from image to image, outside of any video
  if (times.size() < 3) return {};
  std::vector<double> steps;
  for (size_t i = 1; i < times.size(); ++i) steps.push_back(seconds_between(times[i - 1], times[i]));
  const double usual = median(std::move(steps));
  if (usual > kShortest && usual < kLongest) return {};
  return fixed(usual, 7) + " s from image to image: was another unit recorded as seconds?";
}

std::vector<std::string> labels(const RawlogSurvey& survey) {
  std::vector<std::string> result;
  for (const SurveyedCamera& camera : survey.cameras) result.push_back(camera.label);
  return result;
}

const SurveyedCamera& choose_camera(const RawlogSurvey& survey, const RawlogSourceOptions& options) {
  if (survey.cameras.empty() && !survey.damage.empty())
    throw InputError(survey.damage, "no image came before", "");
  if (survey.cameras.empty())
    throw InputError(
        options.path, "no image in it",
        "record CObservationImage, CObservationStereoImages or CObservation3DRangeScan with intensity");
  if (options.sensor_label.empty()) {
    if (survey.cameras.size() == 1) return survey.cameras.front();
    throw InputError(options.path, "several cameras: " + survey.list(), "choose one with --sensor LABEL");
  }
  if (const SurveyedCamera* camera = survey.find(options.sensor_label)) return *camera;
  throw InputError(options.path,
                   "no images of the sensor '" + options.sensor_label + "'; there are " + survey.list(),
                   "did you mean --sensor " + nearest_name(options.sensor_label, labels(survey)) + "?");
}

class RawlogSource : public ImageSource {
 public:
  RawlogSource(const RawlogSourceOptions& options, const RawlogSurvey& survey, const SurveyedCamera& chosen)
      : path_(options.path),
        survey_(survey),
        chosen_(chosen),
        camera_(options.camera ? *options.camera
                               : from_mrpt(chosen.camera, path_ + ", calibration of " + chosen.label +
                                                              " (or give --camera)")),
        own_calibration_(options.camera.has_value()),
        decisions_(options.decisions),
        images_folder_(chosen.external ? find_images_folder(path_) : std::string()),
        intensities_(decide_on_intensities(options.bits)),
        reader_(path_) {}

  const Camera& camera() const override { return camera_; }
  std::optional<SE3> T_vehicle_cam() const override { return chosen_.T_vehicle_cam; }
  std::optional<int> size() const override {
    if (!survey_.complete) return std::nullopt;
    return int(chosen_.times.size());
  }
  std::string kind() const override { return "rawlog"; }
  std::string label() const override { return chosen_.label; }
  VehicleTrack vehicle_track(VehicleSensor sensor) const override {
    return read_vehicle_track(path_, sensor, times());
  }
  GyroReadings gyro_readings() const override {
    // With or without its namespace.
    const bool has_imu = std::any_of(survey_.others.begin(), survey_.others.end(), [](const auto& other) {
      return other.first.find("CObservationIMU") != std::string::npos;
    });
    if (survey_.complete && !has_imu) return {};
    return gyro_of(read_rawlog_imus(path_, times()));
  }
  std::vector<std::pair<std::string, std::string>> details() const override;
  std::vector<InputDecision> decisions() const override {
    std::vector<InputDecision> all = decisions_;
    if (intensities_.decision) all.push_back(*intensities_.decision);
    for (InputDecision& d : time_decisions(chosen_.times)) all.push_back(std::move(d));
    return all;
  }
  std::vector<Timestamp> times() const override {
    return survey_.complete ? chosen_.times : std::vector<Timestamp>();
  }
  std::string ground_truth_path() const override {
    const std::string at = rawlog_stem(path_) + "_groundtruth_tum.txt";
    std::error_code ignored;
    return fs::exists(at, ignored) ? at : std::string();
  }
  std::optional<Frame> next() override;
  bool skip() override {
    if (!advance()) return false;
    ++index_;
    return true;
  }

 private:
  std::optional<RawlogImage> advance();
  void check_calibration(const RawlogImage& image, const std::string& where) const;
  std::optional<Timestamp> following_time() const;
  /// The frame without its number; with its time as stated.
  Frame read(const RawlogImage& image, const std::string& where);
  std::string file_of(const std::string& name) const;
  Intensities decide_on_intensities(int bits) const;

  std::string path_;
  RawlogSurvey survey_;
  SurveyedCamera chosen_;
  Camera camera_;
  bool own_calibration_;
  std::vector<InputDecision> decisions_;
  std::string images_folder_;
  Intensities intensities_;
  RawlogReader reader_;
  mrpt::obs::CObservation::Ptr current_;  // owner of what a RawlogImage points into
  int index_ = 0;
  TimeOrder order_;
  bool done_ = false;
};

std::vector<std::pair<std::string, std::string>> RawlogSource::details() const {
  std::vector<std::pair<std::string, std::string>> result;
  result.emplace_back("sensor", chosen_.label + " (" + chosen_.kind + ")");
  result.emplace_back("all cameras", survey_.list());
  result.emplace_back("images", chosen_.external ? "external, in " + images_folder_ : "embedded");
  std::string others;
  for (const auto& [name, count] : survey_.others)
    others += (others.empty() ? "" : ", ") + std::to_string(count) + " " + name;
  if (!others.empty()) result.emplace_back("other observations", others);
  if (const std::string doubt = doubt_about_times(fill_missing(chosen_.times)); !doubt.empty())
    result.emplace_back("times", doubt);
  if (!survey_.complete) result.emplace_back("note", "the rawlog is long; counted are its first 256 MB");
  if (!survey_.damage.empty()) result.emplace_back("damage", survey_.damage);
  return result;
}

// Advances to the next image of the chosen camera.
std::optional<RawlogImage> RawlogSource::advance() {
  while (!done_) {
    done_ = true;  // stays so if the reader throws
    current_ = reader_.next();
    if (!current_) break;
    done_ = false;
    auto image = find_image(*current_);
    if (image && image->label == chosen_.label) return image;
  }
  return std::nullopt;
}

std::optional<Frame> RawlogSource::next() {
  const auto image = advance();
  if (!image) return std::nullopt;
  const std::string where = path_ + ", frame " + std::to_string(index_) + " of " + chosen_.label;
  done_ = true;  // stays so if the calibration throws
  check_calibration(*image, where);
  done_ = false;
  const int index = index_++;
  const Timestamp time = order_.require(index, image->time, following_time(), where);
  try {
    Frame frame = read(*image, where);
    frame.index = index;
    frame.time = time;
    return frame;
  } catch (const InputError& e) {
    throw BadFrame(index, time, e);
  }
}

// Time of the image at index_; nothing beyond the part of the file that was surveyed.
std::optional<Timestamp> RawlogSource::following_time() const {
  const size_t i = size_t(index_);
  return i < chosen_.times.size() ? std::make_optional(chosen_.times[i]) : std::nullopt;
}

void RawlogSource::check_calibration(const RawlogImage& image, const std::string& where) const {
  if (!own_calibration_ && *image.camera != chosen_.camera)
    throw InputError(where, "the calibration differs from that of the first frame",
                     "give one for all with --camera");
}

Frame RawlogSource::read(const RawlogImage& image, const std::string& where) {
  const bool is_file = image.image->isExternallyStored();
  std::string file = is_file ? file_of(image.image->getExternalStorageFile()) : std::string();
  GrayImage pixels = is_file ? read_gray_image(file, intensities_.scale)
                             : from_mrpt(*image.image, intensities_.scale, where);
  check_image_size(pixels, camera_.pinhole(), where);
  if (intensities_.scale) file.clear();  // holds other pixels
  return {0, image.time, std::move(pixels), std::move(file)};
}

// Path of an external image. An absolute name is kept.
std::string RawlogSource::file_of(const std::string& name) const {
  return (fs::path(images_folder_.empty() ? find_images_folder(path_) : images_folder_) / name).string();
}

Intensities RawlogSource::decide_on_intensities(int bits) const {
  if (!chosen_.external)
    return decide_intensities(chosen_.intensities, bits,
                              std::to_string(chosen_.intensities.images()) + " images of the rawlog");
  std::vector<std::string> files;
  for (const std::string& name : chosen_.some_files) files.push_back(file_of(name));
  return decide_intensities(files, bits);
}

GrayImage first_image(const RawlogSourceOptions& options) {
  RawlogReader reader(options.path);
  while (const auto observation = reader.next()) {
    const auto image = find_image(*observation);
    if (!image || (!options.sensor_label.empty() && image->label != options.sensor_label)) continue;
    if (!image->image->isExternallyStored()) return from_mrpt(*image->image, std::nullopt, options.path);
    const fs::path folder = find_images_folder(options.path);
    return read_gray_image((folder / image->image->getExternalStorageFile()).string());
  }
  return {};
}

}  // namespace

std::pair<int, int> first_image_size(const RawlogSourceOptions& options) {
  try {
    const GrayImage image = first_image(options);
    return {image.width, image.height};
  } catch (const InputError&) {
    return {0, 0};  // opening the source, or its first frame, says why
  }
}

std::unique_ptr<ImageSource> open_rawlog(const RawlogSourceOptions& options) {
  const RawlogSurvey survey = survey_rawlog(options.path);
  return std::make_unique<RawlogSource>(options, survey, choose_camera(survey, options));
}

}  // namespace edgevo
