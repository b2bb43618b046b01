// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/simulation/folder_export.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <opencv2/imgcodecs.hpp>

#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "edgevo/core/run_parallel.h"
#include "edgevo/files/image_names.h"
#include "edgevo/simulation/simulated_gyro.h"
#include "edgevo/simulation/true_edge_labels.h"

namespace edgevo {
namespace {

std::string numbered(const std::string& folder, int index, const char* extension) {
  return folder + "/" + padded_number(index) + extension;
}

void write_png(const std::string& path, const GrayImage& image) {
  const cv::Mat view(image.height, image.width, CV_8U, const_cast<uint8_t*>(image.pixels.data()));
  std::vector<uint8_t> bytes;
  cv::imencode(".png", view, bytes, {cv::IMWRITE_PNG_COMPRESSION, 1});
  write_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

// PFM: rows from the bottom up, a negative scale for little endian.
void write_pfm(const std::string& path, const std::vector<float>& depth, int width, int height) {
  std::string bytes = "Pf\n" + std::to_string(width) + " " + std::to_string(height) + "\n-1.0\n";
  for (int v = height - 1; v >= 0; --v)
    bytes.append(reinterpret_cast<const char*>(depth.data() + size_t(v) * width),
                 size_t(width) * sizeof(float));
  write_file(path, bytes);
}

// Seven decimals, or as many digits as give the number back: a run of the folder is that of the scene.
std::string exact(double value) {
  std::string text = fixed(value, 7);
  if (std::strtod(text.c_str(), nullptr) == value) return text;
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

std::string camera_line(const Camera& camera) {
  const Pinhole p = camera.pinhole();
  const Distortion d = camera.distortion();
  std::string text = "# fx fy cx cy k1 k2 p1 p2 width height k3\n";
  for (double value : {p.fx, p.fy, p.cx, p.cy, d.k1, d.k2, d.p1, d.p2}) text += exact(value) + " ";
  return text + std::to_string(p.width) + " " + std::to_string(p.height) + " " + exact(d.k3) + "\n";
}

std::string pose_line(Timestamp time, const SE3& T) {
  std::string line = to_string(time);
  const Eigen::Vector3d& t = T.translation();
  Eigen::Quaterniond q = T.rotation();
  if (q.w() < 0) q.coeffs() *= -1;  // the sign with w >= 0, as is common
  for (double value : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()}) line += " " + fixed(value, 9);
  return line + "\n";
}

// " --option 0.02"; empty for 0.
std::string seconds_option(const char* name, double seconds) {
  if (seconds == 0) return {};
  const std::string digits = fixed(seconds, 9);
  return name + digits.substr(0, digits.find_last_not_of('0') + 1);
}

// " --mount 0,20,0,0,0,0"; empty for the mount of the scene.
std::string mount_option(const Scene& scene) {
  if (!scene.mount) return {};
  const CameraMount& m = *scene.mount;
  std::string text = " --mount ";
  for (const double value : {m.roll_deg, m.pitch_deg, m.yaw_deg}) text += fixed(value, 3) + ",";
  return text + fixed(m.position.x(), 3) + "," + fixed(m.position.y(), 3) + "," + fixed(m.position.z(), 3);
}

// " --camera camera.txt"; empty for the camera of the scene.
std::string camera_option(const Scene& scene) { return scene.has_given_camera ? " --camera camera.txt" : ""; }

std::string shutter_note(const Shutter& shutter) {
  if (shutter.rolling_s == 0 && shutter.exposure_s == 0) return {};
  return "The shutter takes time: time, pose and depth of a frame are those of the middle of the exposure of "
         "its middle row.\n";
}

std::string traffic_option(const Scene& scene) {
  std::string text;
  for (const std::string& kind : scene.traffic) text += " --traffic " + kind;
  return text;
}

std::string own_part_option(const FolderExport& options) {
  if (!options.own_part) return {};
  const OverlayOptions& o = options.own_part->options();
  return " --own-part " + o.own_part + " --part-share " + fixed(o.part_share, 3);
}

std::string source_text(const Scene& scene, const FolderExport& options, int begin, int end) {
  const std::string shutter = seconds_option(" --rolling-shutter ", scene.shutter.rolling_s) +
                              seconds_option(" --exposure ", scene.shutter.exposure_s) + mount_option(scene) +
                              camera_option(scene) + traffic_option(scene) + own_part_option(options);
  const std::string seed = std::to_string(scene.seed),
                    frames = std::to_string(begin) + ":" + std::to_string(end);
  return "# Rendered scene `" + scene.name + "`\n\nFrames " + frames + ", seed " + seed +
         ". Rendered by edgevo; nothing in it was photographed or taken from others.\nPoses and depth are "
         "exact, in metres. Again: `edgevo simulate " +
         scene.name + " --seed " + seed + " --frames " + frames + shutter + " -o FOLDER`\n" +
         shutter_note(scene.shutter);
}

GrayImage image_of(const SceneRenderer& renderer, const FolderExport& options, int index) {
  GrayImage image = renderer.render_image(index);
  return options.own_part ? options.own_part->apply(image, index, 0, std::nullopt).image : image;
}

GrayImage own_part_mask(const SceneRenderer& renderer, const Overlay& part) {
  const Pinhole p = renderer.camera().pinhole();
  return {p.width, p.height, part.own_part_mask()};
}

void write_texts(const SceneRenderer& renderer, const std::string& folder, const FolderExport& options,
                 int begin, int end) {
  const std::string& camera = options.camera_text;
  const Scene& scene = renderer.scene();
  std::string times;
  for (int i = begin; i < end; ++i) times += to_string(scene.times[size_t(i)]) + "\n";
  write_file(folder + "/times.txt", times);
  write_file(folder + "/groundtruth_tum.txt", ground_truth_tum(renderer, begin, end));
  write_file(folder + "/camera.txt", camera.empty() ? camera_line(scene.camera) : camera);
  write_file(folder + "/SOURCE.md", source_text(scene, options, begin, end));
}

}  // namespace

std::string ground_truth_tum(const SceneRenderer& renderer, int begin, int end) {
  const Scene& scene = renderer.scene();
  const SE3 T_first_scene = scene.T_scene_cam[size_t(begin)].inverse();
  std::string text = "# t tx ty tz qx qy qz qw (T_world_cam, metres)\n";
  for (int i = begin; i < end; ++i)
    text += pose_line(scene.times[size_t(i)], T_first_scene * scene.T_scene_cam[size_t(i)]);
  return text;
}

void clear_sequence(const std::string& folder) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  if (!fs::exists(folder + "/SOURCE.md", ignored)) return;
  for (const char* name : {"images", "depth", "edges", "correspondences", "masks", "mask.png", "times.txt",
                           "camera.txt", "groundtruth_tum.txt", "imu.txt", "gyro_truth.yaml", "SOURCE.md"})
    fs::remove_all(fs::path(folder) / name, ignored);
}

FolderWriter::FolderWriter(std::string folder, const Camera& camera, const std::string& camera_text)
    : folder_(std::move(folder)), camera_text_(camera_text.empty() ? camera_line(camera) : camera_text) {
  make_output_folder(folder_ + "/images");
}

void FolderWriter::add(const Frame& frame) {
  const std::string name = image_name(frame);
  if (!times_.empty() && !natural_less(last_name_, name))
    throw InputError(
        frame.image_path.empty() ? name : frame.image_path,
        "does not follow " + last_name_ + " by its name, so that a folder would play in another order",
        "name the output OUT.rawlog");
  write_png(folder_ + "/images/" + name + ".png", frame.image);
  last_name_ = name;
  times_ += to_string(frame.time) + "\n";
}

void FolderWriter::add_mask(const Frame& frame, const GrayImage& mask) {
  make_output_folder(folder_ + "/masks");
  write_png(folder_ + "/masks/" + image_name(frame) + ".png", mask);
}

void FolderWriter::add_fixed_mask(const GrayImage& mask) { write_png(folder_ + "/mask.png", mask); }

void FolderWriter::add_gyro(const GyroReadings& readings) {
  std::vector<GyroSample> samples;
  while (const std::optional<GyroSample> sample = readings ? readings() : std::nullopt)
    samples.push_back(*sample);
  if (!samples.empty()) write_file(folder_ + "/imu.txt", imu_text(samples));
}

void FolderWriter::finish(const std::string& ground_truth, const std::string& source_note) {
  write_file(folder_ + "/times.txt", times_);
  write_file(folder_ + "/camera.txt", camera_text_);
  if (!ground_truth.empty()) write_file(folder_ + "/groundtruth_tum.txt", ground_truth);
  write_file(folder_ + "/SOURCE.md", source_note);
}

void export_folder(const SceneRenderer& renderer, const std::string& folder, const FolderExport& options,
                   const OnFrameDone& on_frame_done) {
  const int begin = options.begin, end = options.end < 0 ? renderer.size() : options.end;
  if (begin < 0 || begin >= end || end > renderer.size())
    throw InputError("scene " + renderer.scene().name,
                     "frames " + std::to_string(begin) + ":" + std::to_string(end) + " are not in it",
                     "it has frames 0:" + std::to_string(renderer.size()));
  make_output_folder(folder + "/images");
  if (options.depth) make_output_folder(folder + "/depth");
  if (options.edges) make_output_folder(folder + "/edges");
  const bool has_bodies = !renderer.scene().bodies.empty();
  if (has_bodies) make_output_folder(folder + "/masks");
  write_texts(renderer, folder, options, begin, end);
  if (options.own_part) write_png(folder + "/mask.png", own_part_mask(renderer, *options.own_part));
  std::mutex mutex;
  int done = 0;
  run_parallel(begin, end, std::max(1, options.threads), [&](int i) {
    write_png(numbered(folder + "/images", i, ".png"), image_of(renderer, options, i));
    if (has_bodies) write_png(numbered(folder + "/masks", i, ".png"), renderer.render_bodies(i));
    if (options.depth)
      write_pfm(numbered(folder + "/depth", i, ".pfm"), renderer.render_depth(i),
                renderer.undistorted().width, renderer.undistorted().height);
    if (options.edges) write_png(numbered(folder + "/edges", i, ".png"), true_edge_labels(renderer, i));
    const std::lock_guard<std::mutex> lock(mutex);
    if (on_frame_done) on_frame_done(++done);
  });
}

}  // namespace edgevo
