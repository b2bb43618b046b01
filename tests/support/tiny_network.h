// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A network in ONNX, written byte by byte: probability = sigmoid(8 |gradient| - 3) of the gray levels divided
// by 255. With it no test needs a model file or a program that makes one.
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace edgevo::test {

/// A message in the wire format of protocol buffers, with fields that are integers or bytes.
class Message {
 public:
  Message& whole(int field, uint64_t value) {
    varint(uint64_t(field) << 3);
    varint(value);
    return *this;
  }
  Message& bytes(int field, const std::string& value) {
    varint(uint64_t(field) << 3 | 2);
    varint(value.size());
    bytes_ += value;
    return *this;
  }
  const std::string& str() const { return bytes_; }

 private:
  void varint(uint64_t value) {
    for (; value >= 128; value >>= 7) bytes_ += char(value % 128 + 128);
    bytes_ += char(value);
  }
  std::string bytes_;
};

/// Weights as an initializer.
inline std::string tensor(const std::string& name, const std::vector<int>& shape,
                          const std::vector<float>& values) {
  constexpr int kFloat = 1;
  Message m;
  for (const int side : shape) m.whole(1, uint64_t(side));
  std::string raw(values.size() * sizeof(float), 0);
  std::memcpy(raw.data(), values.data(), raw.size());
  return m.whole(2, kFloat).bytes(8, name).bytes(9, raw).str();
}

inline std::string list_attribute(const std::string& name, const std::vector<int>& values) {
  constexpr int kInts = 7;
  Message m;
  m.bytes(1, name);
  for (const int value : values) m.whole(8, uint64_t(value));
  return m.whole(20, kInts).str();
}

inline std::string node(const std::string& type, const std::vector<std::string>& inputs,
                        const std::string& output, const std::vector<std::string>& attributes = {}) {
  Message m;
  for (const std::string& input : inputs) m.bytes(1, input);
  m.bytes(2, output).bytes(3, type + "_" + output).bytes(4, type);
  for (const std::string& attribute : attributes) m.bytes(5, attribute);
  return m.str();
}

/// An image with one channel; a side of 0 is variable.
inline std::string image_value(const std::string& name, int height, int width) {
  Message shape;
  for (const int side : {1, 1, height, width})
    shape.bytes(1, side > 0 ? Message().whole(1, uint64_t(side)).str() : Message().bytes(2, "side").str());
  const std::string type = Message().bytes(1, Message().whole(1, 1).bytes(2, shape.str()).str()).str();
  return Message().bytes(1, name).bytes(2, type).str();
}

/// The network, with input "image" and output "edges"; with `stride` 2 the output has half the size.
inline std::string tiny_network(int stride = 1, int height = 0, int width = 0) {
  std::vector<float> kernels;
  for (const float sign : {1.0f, -1.0f}) {
    for (const float k : {-1.f, 0.f, 1.f, -2.f, 0.f, 2.f, -1.f, 0.f, 1.f}) kernels.push_back(sign * k);
    for (const float k : {-1.f, -2.f, -1.f, 0.f, 0.f, 0.f, 1.f, 2.f, 1.f}) kernels.push_back(sign * k);
  }
  const std::vector<std::string> around{list_attribute("kernel_shape", {3, 3}),
                                        list_attribute("pads", {1, 1, 1, 1}),
                                        list_attribute("strides", {stride, stride})};
  Message graph;
  graph.bytes(1, node("Conv", {"image", "kernels"}, "slopes", around))
      .bytes(1, node("Relu", {"slopes"}, "rises"))
      .bytes(1, node("Conv", {"rises", "sum", "bias"}, "score", {list_attribute("kernel_shape", {1, 1})}))
      .bytes(1, node("Sigmoid", {"score"}, "edges"))
      .bytes(2, "tiny")
      .bytes(5, tensor("kernels", {4, 1, 3, 3}, kernels))
      .bytes(5, tensor("sum", {1, 4, 1, 1}, {8, 8, 8, 8}))
      .bytes(5, tensor("bias", {1}, {-3}))
      .bytes(11, image_value("image", height, width))
      .bytes(12, image_value("edges", height / stride, width / stride));
  return Message().whole(1, 7).bytes(7, graph.str()).bytes(8, Message().whole(2, 11).str()).str();
}

inline const char* tiny_network_description() {
  return "input: image\noutput: edges\nsize: multiple_of 4\nchannels: gray\n";
}

}  // namespace edgevo::test
