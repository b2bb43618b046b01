// SPDX-License-Identifier: BSD-3-Clause
#include "network_description.h"

#include <charconv>
#include <cmath>
#include <sstream>
#include <vector>

#include "edgevo/core/error.h"

namespace edgevo {
namespace {

constexpr int kLargestSide = 16384;  // pixels: limit of cv::Mat and memory

// Number from 1 to kLargestSide; 0 if the text is no such number.
int whole(const std::string& text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && value >= 1 && value <= kLargestSide
             ? value
             : 0;
}

void set_size(const std::string& text, const std::string& where, NetworkInput* input) {
  std::istringstream words(text);
  std::string rule, value, rest;
  words >> rule >> value >> rest;
  const size_t cross = value.find('x');
  if (rule == "multiple_of" && rest.empty() && (input->multiple = whole(value)) > 0) return;
  input->is_fixed = true;
  if (rule == "fixed" && rest.empty() && cross != std::string::npos)
    input->size = {whole(value.substr(0, cross)), whole(value.substr(cross + 1))};
  if (input->size.area() == 0)
    throw InputError(where + ": size", "'" + text + "' is not a valid size rule",
                     "write multiple_of N, or fixed WIDTHxHEIGHT");
}

cv::Scalar by_channel(const std::string& text, int channels, const std::string& where) {
  std::istringstream words(text);
  words.imbue(std::locale::classic());
  std::vector<double> values;
  for (double value; words >> value;) values.push_back(value);
  bool fits = words.eof() && (values.size() == 1 || int(values.size()) == channels);
  for (const double value : values) fits = fits && std::isfinite(value);
  if (!fits)
    throw InputError(
        where,
        "'" + text + "' is not a number, or one for each of " + std::to_string(channels) + " channel(s)",
        "write for example 0.485 0.456 0.406");
  cv::Scalar all;
  for (int c = 0; c < channels; ++c) all[c] = values[values.size() == 1 ? 0 : size_t(c)];
  return all;
}

}  // namespace

void NetworkDescription::visit(KeyVisitor& v) {
  v.text("input", input, {}, "name of the input, 1 x channels x height x width");
  v.text("output", output, {}, "name of the output, 1 x 1 x height x width, probabilities 0 to 1");
  v.text("size", size, {}, "multiple_of N, or fixed WxH; smaller images are extended to the right and below");
  v.text("channels", channels, {"gray", "rgb", "bgr"}, "order of channels");
  v.number("scale", scale, 1e-6, 1e3, "the input is (pixel * scale - mean) / std");
  v.text("mean", mean, {}, "one number, or one per channel");
  v.text("std", std, {}, "one number, or one per channel");
}

cv::Size NetworkInput::size_for(cv::Size image, const std::string& where) const {
  const auto up = [this](int pixels) { return (pixels + multiple - 1) / multiple * multiple; };
  if (!is_fixed) return {up(image.width), up(image.height)};
  if (image.width <= size.width && image.height <= size.height) return size;
  throw InputError(where,
                   "takes images of " + std::to_string(size.width) + "x" + std::to_string(size.height) +
                       ", not of " + std::to_string(image.width) + "x" + std::to_string(image.height),
                   "scale the images (--image-scale), or give another network");
}

NetworkDescription read_network_description(const std::string& path) {
  NetworkDescription description;
  read_params_file(path, [&](ParamVisitor& v) { description.visit(v); });
  return description;
}

NetworkInput network_input(const NetworkDescription& d, const std::string& where) {
  NetworkInput input;
  set_size(d.size, where, &input);
  input.channels = d.channels == "gray" ? 1 : 3;
  input.scale = d.scale;
  input.mean = by_channel(d.mean, input.channels, where + ": mean");
  input.std = by_channel(d.std, input.channels, where + ": std");
  for (int c = 0; c < input.channels; ++c)
    if (!(input.std[c] > 0))
      throw InputError(where + ": std", "is not larger than 0", "the input is (pixel * scale - mean) / std");
  return input;
}

}  // namespace edgevo
