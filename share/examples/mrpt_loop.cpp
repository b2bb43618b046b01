// SPDX-License-Identifier: BSD-3-Clause
// The odometry in a loop over a rawlog, with MRPT's own classes.
//
//   mrpt_loop FILE.rawlog OUT.txt [FOLDER]
//
// OUT.txt: `t x y z yaw pitch roll` of the vehicle, as CPose3DInterpolator reads it. FOLDER gets the files
// that `edgevo run` writes: final trajectory, maps, report, summary.
//
// Takes every CObservationImage, computes its pose by the odometry, and keeps the vehicle's path in MRPT's
// axes (x forward, y left, z up). The same loop runs on a live sensor: replace the file by
// CCameraSensor::getNextFrame().
#include <edgevo/core/error.h>
#include <edgevo/mrpt_bridge/conversions.h>
#include <edgevo/odometry/odometry.h>
#include <edgevo/results/run_outputs.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/poses/CPose3DInterpolator.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

namespace {

using mrpt::obs::CObservationImage;

// MRPT 2.5.8 finds the external images of a rawlog in another folder only with this base path.
void set_image_folder(const std::filesystem::path& rawlog) {
  const std::filesystem::path folder = rawlog.parent_path() / (rawlog.stem().string() + "_Images");
  mrpt::img::CImage::setImagesPathBase(folder.string());
}

class VehicleOdometry {
 public:
  /// `folder` receives the files of a run; if empty, none are written.
  explicit VehicleOdometry(std::string folder) : folder_(std::move(folder)) {}

  void add(const CObservationImage& image, const std::string& where) {
    if (!odometry_) start(image, where);
    edgevo::Frame frame;
    frame.index = frames_++;
    frame.time = edgevo::from_mrpt(image.timestamp);
    frame.image = edgevo::from_mrpt(image.image, where);
    const edgevo::FrameRecord record = odometry_->process(frame);
    if (outputs_ && !outputs_->add_frame(frame)) finish();  // reports why it could not be written
    if (!record.T_world_cam_live) return;  // bootstrapping or lost: no pose, and the path has a gap
    const mrpt::poses::CPose3D T_first_cam = edgevo::to_mrpt(*record.T_world_cam_live);
    path_.insert(image.timestamp, (mount_ + T_first_cam + (-mount_)).asTPose());
    ++poses_;
  }

  int frames() const { return frames_; }
  int poses() const { return poses_; }
  bool save(const std::string& file) const { return path_.saveToTextFile(file); }
  /// Ends the odometry and writes the folder. Throws edgevo::InputError.
  void finish() {
    if (!outputs_) return;
    edgevo::Run run = odometry_->finish();
    run.T_vehicle_cam = edgevo::from_mrpt(mount_);
    edgevo::RunInfo info;
    info.source_kind = "mrpt_loop";
    info.camera = camera_;
    outputs_->finish(run, info);
  }

 private:
  void start(const CObservationImage& image, const std::string& where) {
    mount_ = image.cameraPose;
    camera_ = edgevo::from_mrpt(image.cameraParams, where);
    odometry_ =
        std::make_unique<edgevo::Odometry>(camera_, edgevo::OdometryParams(), edgevo::OdometryOptions());
    if (!folder_.empty())
      outputs_ = std::make_unique<edgevo::RunOutputs>(folder_, camera_, edgevo::MapParams());
  }

  std::string folder_;
  edgevo::Camera camera_;
  std::unique_ptr<edgevo::Odometry> odometry_;
  std::unique_ptr<edgevo::RunOutputs> outputs_;
  mrpt::poses::CPose3D mount_;  // of the camera on the vehicle; the lever arm counts once lengths are metres
  mrpt::poses::CPose3DInterpolator path_;
  int frames_ = 0, poses_ = 0;
};

int run(const std::string& rawlog, const std::string& out, const std::string& folder) {
  mrpt::io::CFileGZInputStream file;
  if (!std::filesystem::is_regular_file(rawlog) || !file.open(rawlog))
    throw edgevo::InputError(rawlog, "cannot be read", "give a rawlog");
  set_image_folder(rawlog);
  auto archive = mrpt::serialization::archiveFrom(file);
  VehicleOdometry odometry(folder);
  try {
    for (;;)
      if (const auto image = std::dynamic_pointer_cast<CObservationImage>(archive.ReadObject())) {
        image->load();  // from its own file, where it has one
        odometry.add(*image, rawlog);
        image->unload();
      }
  } catch (const mrpt::serialization::CExceptionEOF&) {
  }
  if (!odometry.save(out)) throw edgevo::InputError(out, "cannot be written", "give another file");
  odometry.finish();
  std::printf("%d images, %d poses\n", odometry.frames(), odometry.poses());
  return 0;
}

// MRPT adds call stacks below it.
std::string first_line(const std::string& text) {
  const size_t begin = std::min(text.find_first_not_of("\r\n"), text.size());
  return text.substr(begin, text.find_first_of("\r\n", begin) - begin);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3 && argc != 4) {
    std::fprintf(stderr, "usage: mrpt_loop FILE.rawlog OUT.txt [FOLDER]\n");
    return 2;
  }
  try {
    return run(argv[1], argv[2], argc == 4 ? argv[3] : "");
  } catch (const std::exception& e) {
    std::fprintf(stderr, "mrpt_loop: %s\n", first_line(e.what()).c_str());
    return 2;
  }
}
