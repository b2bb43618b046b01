// The odometry in a loop over a rawlog, by MRPT's own classes.
//
//   mrpt_loop FILE.rawlog OUT.txt      OUT.txt: `t x y z yaw pitch roll` of the vehicle, as
//   CPose3DInterpolator reads it
//
// Takes every CObservationImage, asks the odometry for the pose, and keeps the vehicle's path in MRPT's axes
// (x forward, y left, z up). The same loop runs on a live sensor: replace the file by
// CCameraSensor::getNextFrame().
#include <edgevo/core/error.h>
#include <edgevo/mrpt_bridge/conversions.h>
#include <edgevo/odometry/odometry.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/poses/CPose3DInterpolator.h>
#include <mrpt/serialization/CArchive.h>

#include <cstdio>
#include <filesystem>
#include <memory>

namespace {

using mrpt::obs::CObservationImage;

// MRPT 2.5.8 looks for the images of a rawlog in another folder only when it runs in there.
void set_image_folder(const std::filesystem::path& rawlog) {
  const std::filesystem::path folder = rawlog.parent_path() / (rawlog.stem().string() + "_Images");
  mrpt::img::CImage::setImagesPathBase(folder.string());
}

class VehicleOdometry {
 public:
  void add(const CObservationImage& image, const std::string& where) {
    if (!odometry_) start(image, where);
    edgevo::Frame frame;
    frame.index = frames_++;
    frame.time = edgevo::from_mrpt(image.timestamp);
    frame.image = edgevo::from_mrpt(image.image, where);
    const edgevo::FrameRecord& record = odometry_->process(frame);
    if (!record.T_world_cam_live) return;  // bootstrapping or lost: no pose, and the path has a gap
    const mrpt::poses::CPose3D T_first_cam = edgevo::to_mrpt(*record.T_world_cam_live);
    path_.insert(image.timestamp, (mount_ + T_first_cam + (-mount_)).asTPose());
    ++poses_;
  }

  int frames() const { return frames_; }
  int poses() const { return poses_; }
  bool save(const std::string& file) const { return path_.saveToTextFile(file); }

 private:
  void start(const CObservationImage& image, const std::string& where) {
    mount_ = image.cameraPose;
    odometry_ = std::make_unique<edgevo::Odometry>(edgevo::from_mrpt(image.cameraParams, where),
                                                   edgevo::OdometryParams(), edgevo::OdometryOptions());
  }

  std::unique_ptr<edgevo::Odometry> odometry_;
  mrpt::poses::CPose3D mount_;  // of the camera on the vehicle; the lever arm counts once lengths are metres
  mrpt::poses::CPose3DInterpolator path_;
  int frames_ = 0, poses_ = 0;
};

int run(const std::string& rawlog, const std::string& out) {
  mrpt::io::CFileGZInputStream file;
  if (!file.open(rawlog)) throw edgevo::InputError(rawlog, "cannot be read", "give a rawlog");
  set_image_folder(rawlog);
  auto archive = mrpt::serialization::archiveFrom(file);
  VehicleOdometry odometry;
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
  std::printf("%d images, %d poses\n", odometry.frames(), odometry.poses());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: mrpt_loop FILE.rawlog OUT.txt\n");
    return 2;
  }
  try {
    return run(argv[1], argv[2]);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "mrpt_loop: %s\n", e.what());
    return 2;
  }
}
