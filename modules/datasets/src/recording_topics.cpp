// SPDX-License-Identifier: BSD-3-Clause
#include "recording_topics.h"

#include <algorithm>

#include "edgevo/core/order_statistics.h"
#include "edgevo/core/output_file.h"
#include "recorded_image.h"

namespace edgevo {
namespace {

constexpr const char* kImage = "sensor_msgs/Image";
constexpr const char* kCompressedImage = "sensor_msgs/CompressedImage";
constexpr size_t kStamps = 8;                 // images that show the rate
constexpr uint64_t kSearchBytes = 256 << 20;  // of a file without an index

bool has_images(const RecordedTopic& topic) {
  return (topic.type == kImage || topic.type == kCompressedImage) &&
         topic.serialization != Serialization::kOther;
}

ImageTopic describe(const Recording& recording, size_t topic) {
  const RecordedTopic& recorded = recording.topics()[topic];
  ImageTopic image;
  image.topic = topic;
  image.name = recorded.name;
  image.is_compressed = recorded.type == kCompressedImage;
  image.serialization = recorded.serialization;
  image.images = recorded.messages;
  return image;
}

void read_stamps(Recording* recording, ImageTopic* image) {
  recording->select({{image->topic}, kHeaderBytes, kSearchBytes});
  while (image->stamps.size() < kStamps) {
    const auto message = recording->next();
    if (!message) return;
    const MessageHeader header = decode_header(message->bytes, image->serialization, image->name);
    image->stamps.push_back(header.stamp);
    image->recorded.push_back(Timestamp::from_nanoseconds(message->recorded_ns));
    image->frame = header.frame;
  }
}

// Why a topic cannot be used, without what opens every message.
std::string reason(const std::string& message, const std::string& where) {
  return message.rfind(where + ": ", 0) == 0 ? message.substr(where.size() + 2) : message;
}

void read_first(Recording* recording, ImageTopic* image) {
  recording->select({{image->topic}, SIZE_MAX, kSearchBytes});
  const auto message = recording->next();
  if (!message) {
    image->problem = "it has no images";
    return;
  }
  const RecordedImage first = decode_recorded(message->bytes, *image, std::nullopt, image->name);
  image->encoding = first.encoding;
  image->width = first.image.width;
  image->height = first.image.height;
}

ImageTopic probe(Recording* recording, size_t topic) {
  ImageTopic image = describe(*recording, topic);
  try {
    read_stamps(recording, &image);
    read_first(recording, &image);
  } catch (const InputError& e) {
    image.problem = reason(e.what(), image.name);
  }
  return image;
}

std::vector<ImageTopic> probe_all(Recording* recording) {
  std::vector<ImageTopic> images;
  for (size_t i = 0; i < recording->topics().size(); ++i)
    if (has_images(recording->topics()[i]) && recording->topics()[i].messages.value_or(1) > 0)
      images.push_back(probe(recording, i));
  return images;
}

// "/cam0/image_raw (1200 at 20.0 Hz, 752x480 mono8)".
std::string describe(const ImageTopic& image) {
  const std::string count = image.images ? std::to_string(*image.images) : "images";
  const std::string rate = image.step_s() > 0 ? " at " + fixed(1 / image.step_s(), 1) + " Hz" : "";
  const std::string size =
      std::to_string(image.width) + "x" + std::to_string(image.height) + " " + image.encoding;
  return image.name + " (" + count + rate + ", " + (image.problem.empty() ? size : image.problem) + ")";
}

std::string list(const std::vector<ImageTopic>& images) {
  std::string text;
  for (const ImageTopic& image : images) text += (text.empty() ? "" : ", ") + describe(image);
  return text;
}

[[noreturn]] void refuse_none(const Recording& recording, const std::string& path) {
  throw InputError(path, "no images in it; its topics are " + list_topics(recording),
                   "record sensor_msgs/Image or sensor_msgs/CompressedImage");
}

std::vector<std::string> names_of(const std::vector<RecordedTopic>& topics) {
  std::vector<std::string> names;
  for (const RecordedTopic& topic : topics)
    if (has_images(topic)) names.push_back(topic.name);
  return names;
}

[[noreturn]] void refuse_name(const Recording& recording, const std::string& path, const std::string& name) {
  for (const RecordedTopic& topic : recording.topics())
    if (topic.name == name)
      throw InputError(
          path, name + " holds " + topic.type + " (" + topic.encoding + "), of which no images are read",
          "choose sensor_msgs/Image or sensor_msgs/CompressedImage");
  const std::vector<std::string> names = names_of(recording.topics());
  if (names.empty()) refuse_none(recording, path);
  throw InputError(path, "no topic '" + name + "'; its topics are " + list_topics(recording),
                   "did you mean --topic " + nearest_name(name, names) + "?");
}

ImageTopic by_name(Recording* recording, const std::string& path, const std::string& name) {
  const auto& topics = recording->topics();
  for (size_t i = 0; i < topics.size(); ++i)
    if (has_images(topics[i]) && (topics[i].name == name || topics[i].name == "/" + name)) {
      ImageTopic image = probe(recording, i);
      if (!image.problem.empty()) throw InputError(path, image.name + ": " + image.problem, "");
      return image;
    }
  refuse_name(*recording, path, name);
}

}  // namespace

bool ImageTopic::has_no_stamps() const {
  return std::all_of(stamps.begin(), stamps.end(), [](Timestamp t) { return t == Timestamp(); });
}

double ImageTopic::step_s() const {
  const std::vector<Timestamp>& times = has_no_stamps() ? recorded : stamps;
  std::vector<double> steps;
  for (size_t i = 1; i < times.size(); ++i) steps.push_back(seconds_between(times[i - 1], times[i]));
  return steps.empty() ? 0 : median(std::move(steps));
}

ImageTopic choose_image_topic(Recording* recording, const std::string& path, const std::string& name) {
  if (!name.empty()) return by_name(recording, path, name);
  const std::vector<ImageTopic> images = probe_all(recording);
  if (images.empty()) refuse_none(*recording, path);
  std::vector<ImageTopic> usable;
  for (const ImageTopic& image : images)
    if (image.problem.empty()) usable.push_back(image);
  if (usable.size() == 1) return usable.front();
  if (usable.empty()) throw InputError(path, images.front().name + ": " + images.front().problem, "");
  throw InputError(path, std::to_string(images.size()) + " topics with images: " + list(images),
                   "choose one with --topic " + usable.front().name);
}

std::string list_topics(const Recording& recording) {
  std::string text;
  for (const RecordedTopic& topic : recording.topics())
    text += (text.empty() ? "" : ", ") + topic.name + " (" + topic.type +
            (topic.serialization == Serialization::kOther ? ", " + topic.encoding : "") +
            (topic.messages ? ", " + std::to_string(*topic.messages) : "") + ")";
  return text.empty() ? "none" : text;
}

}  // namespace edgevo
