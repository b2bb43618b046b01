// SPDX-License-Identifier: BSD-3-Clause
// Any ONNX network that estimates an edge probability, run by OpenCV's dnn: HED, RCF, PiDiNet, DexiNed, or
// that of edgevo. A YAML file of the same name describes its input and output.
#include <algorithm>
#include <filesystem>
#include <opencv2/dnn.hpp>
#include <opencv2/imgproc.hpp>

#include "detector_list.h"
#include "edgevo/core/error.h"
#include "edgevo/core/input_file.h"
#include "edgevo/edges/opencv_view.h"
#include "edgevo/files/share_folder.h"
#include "edgevo/opencv_bridge/quiet_opencv.h"
#include "file_checksum.h"
#include "network_description.h"
#include "opencv_error.h"

namespace edgevo {
namespace {

constexpr const char* kNetworkRemedy =
    "give an ONNX network that OpenCV reads, with a description of the same name (NAME.onnx, NAME.yaml)";

// NAME.onnx or NAME.yaml, whichever of the two was given.
std::string sibling(const std::string& path, const char* extension) {
  return std::filesystem::path(path).replace_extension(extension).string();
}

cv::dnn::Net load(const std::string& path) try {
  check_regular_file(path, kNetworkRemedy);
  const QuietOpenCv quiet;
  cv::dnn::Net net = cv::dnn::readNetFromONNX(path);
  net.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);  // the same on every machine
  net.setPreferableTarget(cv::dnn::DNN_TARGET_CPU);
  return net;
} catch (const cv::Exception& e) {
  throw InputError(path, "is not a usable network: " + one_line(e), kNetworkRemedy);
}

// 1 x channels x height x width. `image` is extended to `size` by mirroring, without moving its pixels.
cv::Mat make_blob(const cv::Mat& image, cv::Size size, const NetworkInput& input) {
  cv::Mat wide, scaled;
  cv::copyMakeBorder(image, wide, 0, size.height - image.rows, 0, size.width - image.cols,
                     cv::BORDER_REFLECT_101);
  wide.convertTo(scaled, CV_32F, input.scale);
  const int shape[] = {1, input.channels, size.height, size.width};
  cv::Mat blob(4, shape, CV_32F);
  for (int c = 0; c < input.channels; ++c) {
    cv::Mat plane(size.height, size.width, CV_32F, blob.ptr<float>(0, c));
    scaled.convertTo(plane, CV_32F, 1.0 / input.std[c], -input.mean[c] / input.std[c]);
  }
  return blob;
}

std::string shape_of(const cv::Mat& m) {
  std::string text;
  for (int i = 0; i < m.dims; ++i) text += (i == 0 ? "" : "x") + std::to_string(m.size[i]);
  return text;
}

class NetworkProbability : public EdgeProbability {
 public:
  explicit NetworkProbability(const std::string& path)
      : path_(sibling(path, ".onnx")),
        description_(read_network_description(sibling(path, ".yaml"))),
        input_(network_input(description_, sibling(path, ".yaml"))),
        net_(load(path_)) {}

  Plane<uint8_t> estimate(const ImageView<uint8_t>& gray, const std::string&) override {
    const cv::Size size = input_.size_for({gray.width, gray.height}, path_);
    const cv::Mat found = forward(make_blob(as_mat(gray), size, input_));
    if (found.dims != 4 || found.size[0] != 1 || found.size[1] != 1 || found.size[2] != size.height ||
        found.size[3] != size.width)
      throw InputError(path_,
                       "gives " + shape_of(found) + " for an image of 1x1x" + std::to_string(size.height) +
                           "x" + std::to_string(size.width),
                       "correct 'size' or 'output' in " + sibling(path_, ".yaml"));
    const cv::Mat whole(size.height, size.width, CV_32F, const_cast<float*>(found.ptr<float>()));
    Plane<uint8_t> probability(gray.width, gray.height);
    whole(cv::Rect(0, 0, gray.width, gray.height)).convertTo(as_mat(probability), CV_8U, 255.0);
    return probability;
  }

  std::string description() const override {
    return file_checksum(path_) + "; " + file_checksum(sibling(path_, ".yaml"));
  }

 private:
  cv::Mat forward(const cv::Mat& blob) try {
    const QuietOpenCv quiet;
    net_.setInput(blob, description_.input);
    return net_.forward(description_.output);
  } catch (const cv::Exception& e) {
    throw InputError(path_,
                     "does not work with input '" + description_.input + "' of " + shape_of(blob) +
                         " and output '" + description_.output + "': " + one_line(e),
                     "correct " + sibling(path_, ".yaml"));
  }

  std::string path_;
  NetworkDescription description_;
  NetworkInput input_;
  cv::dnn::Net net_;
};

}  // namespace

std::unique_ptr<EdgeProbability> make_network_probability(const EdgeParams& params) {
  return std::make_unique<NetworkProbability>(
      params.model.empty()
          ? share_file("models/edge_network.onnx", "give a network with edges.model=FILE").string()
          : params.model);
}

}  // namespace edgevo
