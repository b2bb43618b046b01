// SPDX-License-Identifier: BSD-3-Clause
#include "video_source.h"

#include <chrono>
#include <cmath>
#include <fstream>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "assumed_camera.h"
#include "edgevo/core/bad_frame.h"
#include "edgevo/core/error.h"
#include "edgevo/core/frame_checks.h"
#include "edgevo/opencv_bridge/quiet_opencv.h"
#include "rate.h"
#include "sequence.h"
#include "text_file.h"

namespace edgevo {
namespace {

constexpr double kMostFrames = 1e9;  // plausible limit of a file's own frame count; also fits an int
// Counts are estimates: a video is damaged where more than two frames, and more than one in 50, are missing.
constexpr int kMissingFrames = 2, kMissingShare = 50;
constexpr int kLastCamera = 255;  // N of /dev/videoN

GrayImage to_gray(const cv::Mat& bgr) {
  GrayImage gray{bgr.cols, bgr.rows, std::vector<uint8_t>(bgr.total())};
  cv::Mat target(bgr.rows, bgr.cols, CV_8UC1, gray.pixels.data());
  if (bgr.channels() == 1)
    bgr.copyTo(target);
  else
    cv::cvtColor(bgr, target, cv::COLOR_BGR2GRAY);
  return gray;
}

FirstImage size_of(const cv::VideoCapture& capture) {
  return {"", int(capture.get(cv::CAP_PROP_FRAME_WIDTH)), int(capture.get(cv::CAP_PROP_FRAME_HEIGHT))};
}

// A transport stream is a sequence of packets of equal size, each starting with a sync byte; it has no frame
// count.
bool ends_within_a_packet(const std::string& path) {
  constexpr std::streamoff kPacket = 188;
  constexpr char kSync = 0x47;
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = file.tellg();
  for (const std::streamoff at : {std::streamoff(0), kPacket, 2 * kPacket})
    if (!file.seekg(at) || file.get() != kSync) return false;
  return size % kPacket != 0;
}

// cv::VideoCapture reports the end of a video and damaged data alike: read() is false. A video that ends well
// before its own frame count is reported as damaged; since counts are estimates, a few missing frames are
// not.
class VideoSource : public ImageSource {
 public:
  VideoSource(const SourceOptions& options, cv::VideoCapture capture)
      : path_(options.path),
        capture_(std::move(capture)),
        camera_(choose_or_assume_camera(options, "", size_of(capture_), &details_)),
        rate_(choose_rate(options.fps, capture_.get(cv::CAP_PROP_FPS))) {
    const double count = capture_.get(cv::CAP_PROP_FRAME_COUNT);
    if (count >= 1 && count < kMostFrames) count_ = int(count);
  }

  const Camera& camera() const override { return camera_; }
  std::optional<int> size() const override { return count_; }
  std::string kind() const override { return "video"; }
  Details details() const override {
    Details all = details_;
    all.emplace_back("times", rate_.says);
    return all;
  }

  std::optional<Frame> next() override {
    if (!skip()) return std::nullopt;
    cv::Mat pixels;
    const int index = index_ - 1;
    const std::string where = path_ + ", frame " + std::to_string(index);
    try {
      if (!capture_.retrieve(pixels) || pixels.empty() || pixels.depth() != CV_8U)
        throw InputError(where, "the image does not decode", "convert the video again");
      Frame frame{index, rate_.time(index), to_gray(pixels)};
      check_image_size(frame.image, camera_.pinhole(), where);
      return frame;
    } catch (const InputError& e) {
      throw BadFrame(index, rate_.time(index), e);
    }
  }
  bool skip() override {
    if (done_) return false;
    if (capture_.grab()) {
      ++index_;
      return true;
    }
    done_ = true;
    if (count_ && index_ < *count_ - std::max(kMissingFrames, *count_ / kMissingShare))
      throw InputError(path_,
                       "ends after " + std::to_string(index_) + " of " + std::to_string(*count_) + " frames",
                       "the video is damaged; convert it again");
    if (ends_within_a_packet(path_))
      throw InputError(path_,
                       "is cut short: it ends within a packet after " + std::to_string(index_) + " frames",
                       "copy it again, if there is more of it");
    return false;
  }

 private:
  std::string path_;
  cv::VideoCapture capture_;
  Details details_;
  Camera camera_;
  Rate rate_;
  std::optional<int> count_;
  int index_ = 0;
  bool done_ = false;
};

class LiveCamera : public ImageSource {
 public:
  LiveCamera(const SourceOptions& options, const Camera& camera, GrabImage grab, const Details& details)
      : path_(options.path), camera_(camera), grab_(std::move(grab)), details_(details) {}

  const Camera& camera() const override { return camera_; }
  std::optional<int> size() const override { return std::nullopt; }
  std::string kind() const override { return "live camera"; }
  bool is_live() const override { return true; }
  Details details() const override { return details_; }

  std::optional<Frame> next() override {
    if (done_) return std::nullopt;
    done_ = true;  // stays so if a check throws
    cv::Mat pixels;
    const bool came = grab_(&pixels) && !pixels.empty() && pixels.depth() == CV_8U;
    const Timestamp now = Timestamp::from_nanoseconds(nanoseconds_now());
    const std::string where = path_ + ", frame " + std::to_string(index_);
    if (!came)
      throw InputError(where, "the camera gives no image",
                       "check its cable, and whether another program uses it");
    Frame frame{index_, now, to_gray(pixels)};
    if (index_ > 0) check_time_increases(previous_, frame.time, where);
    check_image_size(frame.image, camera_.pinhole(), where);
    previous_ = frame.time;
    ++index_;
    done_ = false;
    return frame;
  }

 private:
  static int64_t nanoseconds_now() {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
  }

  std::string path_;
  Camera camera_;
  GrabImage grab_;
  Details details_;
  Timestamp previous_;
  int index_ = 0;
  bool done_ = false;
};

}  // namespace

std::unique_ptr<ImageSource> open_video(const SourceOptions& options) {
  const QuietOpenCv quiet;
  cv::VideoCapture capture;
  try {
    capture.open(options.path, cv::CAP_FFMPEG);
  } catch (const cv::Exception&) {
  }
  if (!capture.isOpened())
    throw InputError(options.path, "is neither a rawlog nor a video that can be read",
                     "give a .rawlog, a dataset folder, a folder of images or a video");
  return std::make_unique<VideoSource>(options, std::move(capture));
}

std::unique_ptr<ImageSource> open_live_camera(const SourceOptions& options) {
  const QuietOpenCv quiet;
  const std::string number = options.path.substr(options.path.find(':') + 1);
  const double index = parse_number(number, options.path);
  if (index < 0 || index > kLastCamera || index != std::floor(index))
    throw InputError(options.path, "is not a camera", "write camera:N with N from 0");
  if (!options.fov_deg) choose_camera(options, "");  // throws if there is no calibration
  const auto capture = std::make_shared<cv::VideoCapture>();
  if (!capture->open(int(index)))
    throw InputError(options.path, "the camera does not open", "check that it is plugged in");
  Details details;
  const Camera camera = choose_or_assume_camera(options, "", size_of(*capture), &details);
  capture->set(cv::CAP_PROP_FRAME_WIDTH, camera.pinhole().width);
  capture->set(cv::CAP_PROP_FRAME_HEIGHT, camera.pinhole().height);
  return play_live(
      options, camera, [capture](cv::Mat* pixels) { return capture->read(*pixels); }, details);
}

std::unique_ptr<ImageSource> play_live(const SourceOptions& options, const Camera& camera, GrabImage grab,
                                       const Details& details) {
  return std::make_unique<LiveCamera>(options, camera, std::move(grab), details);
}

}  // namespace edgevo
