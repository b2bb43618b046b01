// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The YAML description of a network: how images are passed in, and which output is the probability.
#include <opencv2/core.hpp>
#include <string>

#include "edgevo/core/params.h"

namespace edgevo {

/// Contents of the YAML file.
struct NetworkDescription {
  /// Names of input and output.
  std::string input = "input", output = "output";
  /// Rule for the size of images: "multiple_of N" or "fixed WxH".
  std::string size = "multiple_of 1";
  /// Order of channels: gray, rgb or bgr.
  std::string channels = "gray";
  /// Scale of pixels; the input is (pixel * scale - mean) / std.
  double scale = 1.0 / 255.0;
  /// One number, or one per channel, separated by blanks.
  std::string mean = "0", std = "1";

  void visit(KeyVisitor& v);
};

/// Parsed description.
struct NetworkInput {
  bool is_fixed = false;
  /// Size of the network's images, if it is fixed.
  cv::Size size;
  /// Otherwise the number of which width and height are multiples.
  int multiple = 1;
  int channels = 1;
  double scale = 0;
  /// Mean and standard deviation per channel.
  cv::Scalar mean, std;

  /// Size of the network input for an image of this size. Throws InputError, prefixed by `where`, for an
  /// image larger than a fixed size.
  cv::Size size_for(cv::Size image, const std::string& where) const;
};

/// Reads a description. Throws InputError for an unknown key.
NetworkDescription read_network_description(const std::string& path);
/// Parses a description. Throws InputError for an invalid size rule, and for means or standard deviations
/// that do not fit the channels.
NetworkInput network_input(const NetworkDescription& description, const std::string& where);

}  // namespace edgevo
