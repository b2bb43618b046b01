#pragma once
// The YAML beside a network: how an image goes in, and where the probability comes out.
#include <opencv2/core.hpp>
#include <string>

#include "edgevo/core/params.h"

namespace edgevo {

struct NetworkDescription {
  std::string input = "input", output = "output";
  std::string size = "multiple_of 1";  ///< "multiple_of N", or "fixed WxH"
  std::string channels = "gray";       ///< gray, rgb, bgr
  double scale = 1.0 / 255.0;          ///< what goes in is (pixel * scale - mean) / std
  std::string mean = "0", std = "1";   ///< one number, or one a channel with blanks between

  void visit(KeyVisitor& v);
};

/// The description, taken apart.
struct NetworkInput {
  bool is_fixed = false;
  cv::Size size;     ///< fixed: of the network
  int multiple = 1;  ///< else: width and height are multiples of it
  int channels = 1;
  double scale = 0;
  cv::Scalar mean, std;  ///< by channel

  /// Of the network for an image of this size. Throws InputError, opened by `where`, for an image that is
  /// larger than a fixed size.
  cv::Size size_for(cv::Size image, const std::string& where) const;
};

/// Throws InputError: an unknown key, a size rule that is none, means or deviations that do not fit the
/// channels.
NetworkDescription read_network_description(const std::string& path);
NetworkInput network_input(const NetworkDescription& description, const std::string& where);

}  // namespace edgevo
