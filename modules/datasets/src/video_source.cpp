// SPDX-License-Identifier: BSD-3-Clause
#include "video_source.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "assumed_camera.h"
#include "edgevo/core/bad_frame.h"
#include "edgevo/core/error.h"
#include "edgevo/core/frame_checks.h"
#include "edgevo/core/output_file.h"
#include "edgevo/opencv_bridge/quiet_opencv.h"
#include "rate.h"
#include "sequence.h"
#include "text_file.h"
#include "video_stamps.h"

namespace edgevo {
namespace {

constexpr double kMaxFrames = 1e9;  // plausible limit of a file's own frame count; also fits an int
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

// Quarter turns, clockwise, by which OpenCV turns the frames as its container requests.
int quarter_turns_of(const cv::VideoCapture& capture) {
  if (capture.get(cv::CAP_PROP_ORIENTATION_AUTO) == 0) return 0;
  const long turns = std::lround(capture.get(cv::CAP_PROP_ORIENTATION_META) / 90);
  return int((turns % 4 + 4) % 4);
}

// The size is that of the frames as they are delivered, turned.
SeenImages images_of(const cv::VideoCapture& capture) {
  return {{},
          int(capture.get(cv::CAP_PROP_FRAME_WIDTH)),
          int(capture.get(cv::CAP_PROP_FRAME_HEIGHT)),
          quarter_turns_of(capture)};
}

std::vector<InputDecision> orientation_of(const SeenImages& images) {
  if (images.quarter_turns == 0) return {};
  return {{"orientation",
           "frames turned clockwise by " + std::to_string(90 * images.quarter_turns) + " degrees",
           "as the video's container says", ""}};
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

// FFmpeg opens an image as a video of one frame; a stream of JPEG images is a video.
bool is_single_image(const std::string& path) {
  return cv::haveImageReader(path) && read_video_stamps(path).seconds.size() <= 1;
}

// Of a file with the boxes of an MP4 that holds a photo.
bool is_image_brand(const std::string& brand) {
  return brand == "heic" || brand == "heix" || brand == "mif1" || brand == "avif";
}

// An MP4 lists its frames in a box that is mostly written last. Boxes begin with their length, in four bytes
// or, where these are 1, in eight after their name.
bool is_cut_mp4(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const auto number = [&](int bytes) {
    uint64_t value = 0;
    for (int i = 0; i < bytes; ++i) value = value << 8 | uint64_t(uint8_t(file.get()));
    return value;
  };
  const auto word = [&] {
    char text[5] = {};
    file.read(text, 4);
    return std::string(text);
  };
  std::error_code unreadable;
  const uint64_t size = std::filesystem::file_size(path, unreadable);
  if (!file || unreadable) return false;
  for (uint64_t at = 0; at + 8 <= size && file.seekg(std::streamoff(at));) {
    uint64_t length = number(4);
    const std::string box = word();
    if (at == 0 && box != "ftyp") return false;
    if (at == 0 && is_image_brand(word())) return false;
    if (length == 1) length = number(8);
    if (length < 8 || length > size - at) return true;
    if (box == "moov") return false;
    at += length;
  }
  return true;
}

// The rate between two frames, without the fastest and the slowest hundredth of them.
InputDecision varying_rate(const std::vector<double>& stamps) {
  std::vector<double> steps;
  for (size_t i = 1; i < stamps.size(); ++i) steps.push_back(stamps[i] - stamps[i - 1]);
  std::sort(steps.begin(), steps.end());
  const size_t ends = steps.size() / 100;
  return {"times", "the video's own stamps",
          "its rate varies from " + fixed(1 / steps[steps.size() - 1 - ends], 1) + " to " +
              fixed(1 / steps[ends], 1) + " frames a second",
          ""};
}

// Matroska is not read on from where it is damaged.
std::string inconsistency_of_end(const std::vector<double>& stamps, double stated_s) {
  if (stamps.back() > 0.95 * stated_s) return "";  // sound may last longer
  return "the last frame that is found is at " + fixed(stamps.back(), 2) + " of " + fixed(stated_s, 2) +
         " s: the video may be damaged; convert it again";
}

// cv::VideoCapture reports the end of a video and damaged data alike: grab() is false. After a frame that
// does not decode it goes on with the next one. A video that ends well before its own frame count is reported
// as damaged; since counts are estimates, a few missing frames are not, unless its index lists them.
class VideoSource : public ImageSource {
 public:
  VideoSource(const SourceOptions& options, cv::VideoCapture capture)
      : path_(options.path),
        capture_(std::move(capture)),
        decisions_(orientation_of(images_of(capture_))),
        camera_(choose_or_assume_camera(options, "", images_of(capture_), &decisions_)),
        rate_(choose_rate(options.fps, capture_.get(cv::CAP_PROP_FPS))) {
    const double count = capture_.get(cv::CAP_PROP_FRAME_COUNT);
    if (count >= 1 && count < kMaxFrames) count_ = int(count);
    use(read_video_stamps(path_), options.fps != 0);
  }

  const Camera& camera() const override { return camera_; }
  std::optional<int> size() const override { return count_; }
  std::string kind() const override { return "video"; }
  Details details() const override {
    return stamps_.empty() && !rate_.decision ? Details{{"times", rate_.says}} : Details();
  }
  std::vector<InputDecision> decisions() const override { return decisions_; }
  std::vector<Timestamp> times() const override {
    std::vector<Timestamp> times;
    for (const double s : stamps_) times.push_back(Timestamp::from_seconds(s));
    return times;
  }

  std::optional<Frame> next() override {
    if (!skip()) return std::nullopt;
    cv::Mat pixels;
    const int index = index_ - 1;
    const std::string where = path_ + ", frame " + std::to_string(index);
    try {
      if (is_bad_ || !capture_.retrieve(pixels) || pixels.empty() || pixels.depth() != CV_8U)
        throw InputError(where, "the image does not decode", "convert the video again");
      Frame frame{index, time_of(index), to_gray(pixels)};
      check_image_size(frame.image, camera_.pinhole(), where);
      return frame;
    } catch (const InputError& e) {
      throw BadFrame(index, time_of(index), e);
    }
  }
  bool skip() override {
    if (!is_grabbed_ && bad_ == 0 && !done_) grab_next();
    is_bad_ = bad_ > 0;
    if (is_bad_)
      --bad_;
    else if (is_grabbed_)
      is_grabbed_ = false;
    else
      return false;
    ++index_;
    return true;
  }

 private:
  // Grabs the next frame that decodes, and counts those before it that do not.
  void grab_next() {
    for (int i = index_; !is_grabbed_ && !done_; ++i) {
      if (std::binary_search(missing_.begin(), missing_.end(), i))
        ++bad_;
      else if (capture_.grab())
        is_grabbed_ = true;
      else if (i < listed_)
        ++bad_;
      else
        done_ = true;
    }
    if (done_) check_end();
  }
  void check_end() {
    if (count_ && index_ < *count_ - std::max(kMissingFrames, *count_ / kMissingShare)) {
      bad_ = 0;
      throw InputError(path_,
                       "ends after " + std::to_string(index_) + " of " + std::to_string(*count_) + " frames",
                       "the video is damaged; convert it again");
    }
    if (!lists_all_) bad_ = 0;  // a packet may hold less than a frame
    if (ends_within_a_packet(path_))
      throw InputError(path_,
                       "is cut short: it ends within a packet after " + std::to_string(index_) + " frames",
                       "copy it again, if there is more of it");
  }
  // Stamps are used where the rate varies; a rate that holds is more exact than they are.
  void use(const VideoStamps& stamps, bool rate_is_given) {
    const double own_rate = capture_.get(cv::CAP_PROP_FPS);
    const bool varies = stamps.seconds.size() > 1 && !have_rate(stamps.seconds, own_rate);
    if (!varies) missing_ = stamps.missing;
    listed_ = int(stamps.seconds.size() + missing_.size());
    lists_all_ = stamps.is_complete;
    const double stated_s = count_ ? *count_ / own_rate : 0;
    if (varies) count_ = int(stamps.seconds.size());  // OpenCV's is the duration times a rate
    if (varies && !rate_is_given) {
      stamps_ = stamps.seconds;
      decisions_.push_back(varying_rate(stamps_));
      decisions_.back().doubt = inconsistency_of_end(stamps_, stated_s);
    } else if (rate_.decision) {
      decisions_.push_back(*rate_.decision);
    }
    if (stamps.is_16_bit_gray)
      decisions_.push_back({"intensities", "the upper 8 of 16 bits", "that is what OpenCV gives of a video",
                            "a camera of 10 to 14 bits then has few gray levels; convert the video to images "
                            "(ffmpeg -i VIDEO %06d.png)"});
  }

  Timestamp time_of(int index) const {
    if (stamps_.empty()) return rate_.time(index);
    const size_t i = size_t(index), last = stamps_.size() - 1;
    if (i <= last) return Timestamp::from_seconds(stamps_[i]);
    return Timestamp::from_seconds(stamps_[last] + double(i - last) / rate_.fps);
  }

  std::string path_;
  cv::VideoCapture capture_;
  std::vector<InputDecision> decisions_;
  Camera camera_;
  Rate rate_;
  std::vector<double> stamps_;  // of a varying rate, in seconds; else empty
  std::optional<int> count_;
  std::vector<int> missing_;  // frames without data, increasing
  int listed_ = 0;            // frames by the packets of the file, with the missing ones
  bool lists_all_ = false;    // that number is exact
  int index_ = 0;             // the next frame
  int bad_ = 0;               // frames from there on that do not decode
  bool is_grabbed_ = false;   // the one after them
  bool is_bad_ = false;       // the newest one did not decode
  bool done_ = false;
};

class LiveCamera : public ImageSource {
 public:
  LiveCamera(const SourceOptions& options, const Camera& camera, GrabImage grab,
             const std::vector<InputDecision>& decisions)
      : path_(options.path), camera_(camera), grab_(std::move(grab)), decisions_(decisions) {}

  const Camera& camera() const override { return camera_; }
  std::optional<int> size() const override { return std::nullopt; }
  std::string kind() const override { return "live camera"; }
  bool is_live() const override { return true; }
  std::vector<InputDecision> decisions() const override { return decisions_; }

  std::optional<Frame> next() override {
    if (done_) return std::nullopt;
    done_ = true;  // stays so if a check throws
    cv::Mat pixels;
    const bool came = grab_(&pixels) && !pixels.empty() && pixels.depth() == CV_8U;
    const Timestamp now = time_now();
    const std::string where = path_ + ", frame " + std::to_string(index_);
    if (!came)
      throw InputError(where, "the camera gives no image",
                       "check its cable, and whether another program uses it");
    Frame frame{index_, now, to_gray(pixels)};
    check_image_size(frame.image, camera_.pinhole(), where);
    ++index_;
    done_ = false;
    return frame;
  }

 private:
  static int64_t nanoseconds(std::chrono::nanoseconds time) { return time.count(); }
  // The wall clock at the start, continued by one that nobody sets: times increase whatever NTP does.
  Timestamp time_now() const {
    const auto since = std::chrono::steady_clock::now() - began_steady_;
    return Timestamp::from_nanoseconds(nanoseconds(began_.time_since_epoch()) + nanoseconds(since));
  }

  std::string path_;
  Camera camera_;
  GrabImage grab_;
  std::vector<InputDecision> decisions_;
  const std::chrono::system_clock::time_point began_ = std::chrono::system_clock::now();
  const std::chrono::steady_clock::time_point began_steady_ = std::chrono::steady_clock::now();
  int index_ = 0;
  bool done_ = false;
};

}  // namespace

std::unique_ptr<ImageSource> open_video(const SourceOptions& options) {
  const QuietOpenCv quiet;
  if (is_single_image(options.path))
    throw InputError(options.path, "is a single image", "give the folder of the images, or a video");
  if (is_cut_mp4(options.path))
    throw InputError(options.path, "is an MP4 without its end ('moov'): the recording was cut off",
                     "restore it with the program that made it; MKV and TS survive a cut");
  cv::VideoCapture capture;
  try {
    capture.open(options.path, cv::CAP_FFMPEG);
  } catch (const cv::Exception&) {
  }
  if (!capture.isOpened() || is_drawn_text(options.path))
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
  const bool states_size =
      !options.fov_deg && read_camera_text(camera_file_of(options, "").path, options.sensor_label).has_size();
  const auto capture = std::make_shared<cv::VideoCapture>();
  if (!capture->open(int(index)))
    throw InputError(options.path, "the camera does not open", "check that it is plugged in");
  // Images are requested in the size of the calibration, if it states one.
  std::vector<InputDecision> decisions;
  const Camera camera =
      choose_or_assume_camera(options, "", states_size ? SeenImages() : images_of(*capture), &decisions);
  capture->set(cv::CAP_PROP_FRAME_WIDTH, camera.pinhole().width);
  capture->set(cv::CAP_PROP_FRAME_HEIGHT, camera.pinhole().height);
  return play_live(
      options, camera, [capture](cv::Mat* pixels) { return capture->read(*pixels); }, decisions);
}

std::unique_ptr<ImageSource> play_live(const SourceOptions& options, const Camera& camera, GrabImage grab,
                                       const std::vector<InputDecision>& decisions) {
  return std::make_unique<LiveCamera>(options, camera, std::move(grab), decisions);
}

}  // namespace edgevo
