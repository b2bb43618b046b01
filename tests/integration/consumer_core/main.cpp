// SPDX-License-Identifier: BSD-3-Clause
// consumer_core FOLDER: tracks the images of a folder that `edgevo simulate` wrote (images/, times.txt,
// camera.txt, groundtruth_tum.txt). Ends with code 0 if at least 95 % of them have a pose.
#include <edgevo/edgevo.h>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string>

namespace {

// A heading, then: fx fy cx cy k1 k2 p1 p2 width height k3
edgevo::Camera read_camera(const std::string& path) {
  std::ifstream file(path);
  std::string heading;
  std::getline(file, heading);
  edgevo::Pinhole p;
  edgevo::Distortion d;
  file >> p.fx >> p.fy >> p.cx >> p.cy >> d.k1 >> d.k2 >> d.p1 >> d.p2 >> p.width >> p.height >> d.k3;
  if (!file) throw std::runtime_error(path + ": cannot be read");
  return {p, d};
}

edgevo::GrayImage read_image(const std::string& path) {
  const cv::Mat mat = cv::imread(path, cv::IMREAD_GRAYSCALE);
  if (mat.empty()) throw std::runtime_error(path + ": cannot be read");
  return {mat.cols, mat.rows, std::vector<uint8_t>(mat.begin<uint8_t>(), mat.end<uint8_t>())};
}

edgevo::Run track(const std::string& folder) {
  std::vector<cv::String> images;
  cv::glob(folder + "/images/*.png", images);
  std::sort(images.begin(), images.end());
  std::ifstream times(folder + "/times.txt");
  edgevo::Odometry odometry(read_camera(folder + "/camera.txt"), {}, {});
  double seconds = 0;
  for (size_t i = 0; i < images.size() && times >> seconds; ++i)
    odometry.process({int(i), edgevo::Timestamp::from_seconds(seconds), read_image(images[i])});
  return odometry.finish();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return std::fputs("usage: consumer_core FOLDER\n", stderr), 2;
  try {
    const edgevo::Run run = track(argv[1]);
    const auto has_pose = [](const edgevo::FrameRecord& f) { return f.T_world_cam.has_value(); };
    const size_t frames = run.frames.size(),
                 poses = size_t(std::count_if(run.frames.begin(), run.frames.end(), has_pose));
    std::printf("%zu of %zu frames have a pose\n", poses, frames);
    std::fputs(to_table(edgevo::evaluate(run, std::string(argv[1]) + "/groundtruth_tum.txt")).c_str(),
               stdout);
    return frames > 0 && 100 * poses >= 95 * frames ? 0 : 1;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "consumer_core: %s\n", e.what());
    return 2;
  }
}
