// SPDX-License-Identifier: BSD-3-Clause
#include "gyro_source.h"

#include <algorithm>
#include <utility>

#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "edgevo/core/wrapped_source.h"
#include "edgevo/datasets/gyro_file.h"
#include "edgevo/gyro/gyro_model.h"

namespace edgevo {
namespace {

constexpr const char* kNoGyro = "off";

class GyroSource : public WrappedSource {
 public:
  GyroSource(std::unique_ptr<ImageSource> inner, std::vector<GyroSample> samples, InputDecision decision)
      : WrappedSource(std::move(inner)),
        samples_(std::make_shared<const std::vector<GyroSample>>(std::move(samples))),
        decision_(std::move(decision)) {}

  GyroReadings gyro_readings() const override {
    if (samples_->empty()) return {};
    return [samples = samples_, next = size_t(0)]() mutable -> std::optional<GyroSample> {
      return next < samples->size() ? std::make_optional((*samples)[next++]) : std::nullopt;
    };
  }
  std::vector<InputDecision> decisions() const override {
    auto all = inner().decisions();
    if (!decision_.subject.empty()) all.push_back(decision_);
    return all;
  }

 private:
  std::shared_ptr<const std::vector<GyroSample>> samples_;
  InputDecision decision_;
};

// A file of another recording, or in another clock.
void check_times(const std::vector<GyroSample>& samples, const ImageSource& source, const std::string& path) {
  const std::vector<Timestamp> images = source.times();
  if (images.empty()) return;
  if (samples.front().time < images.back() && images.front() < samples.back().time) return;
  throw InputError(path,
                   "its times (" + to_string(samples.front().time) + " to " + to_string(samples.back().time) +
                       ") are not those of the images (" + to_string(images.front()) + " to " +
                       to_string(images.back()) + ")",
                   "give the gyro of the same recording and clock, or --gyro off");
}

// Where images have no gyro; empty: nowhere.
std::string uncovered(const std::vector<GyroSample>& samples, const ImageSource& source) {
  const std::vector<Timestamp> images = source.times();
  if (images.empty()) return {};
  const auto covers = [&](Timestamp t) {  // as far as clocks may differ
    return seconds_between(t, samples.front().time) <= kMostGyroOffsetS &&
           seconds_between(samples.back().time, t) <= kMostGyroOffsetS;
  };
  const auto first = std::find_if(images.begin(), images.end(), covers),
             end = std::find_if_not(first, images.end(), covers);
  if (first == images.begin() && end == images.end()) return {};
  if (first == end) return "it covers no image";
  return "it covers only the images from " + to_string(*first) + " to " + to_string(*(end - 1)) + " s, of " +
         to_string(images.front()) + " to " + to_string(images.back()) + " s";
}

GyroFile read_for(const ImageSource& source, const std::string& path) {
  GyroFile file = read_gyro_file(path);
  check_times(file.samples, source, path);
  if (const std::string part = uncovered(file.samples, source); !part.empty())
    file.decided += (file.decided.empty() ? "" : "; ") + part;
  return file;
}

std::unique_ptr<ImageSource> with_file(std::unique_ptr<ImageSource> inner, GyroFile file,
                                       const std::string& path, const std::string& why) {
  InputDecision decision{"gyro", path, why + (file.decided.empty() ? "" : "; " + file.decided), ""};
  return std::make_unique<GyroSource>(std::move(inner), std::move(file.samples), std::move(decision));
}

}  // namespace

std::unique_ptr<ImageSource> with_gyro(std::unique_ptr<ImageSource> inner, const SourceOptions& options) {
  if (options.gyro == kNoGyro)
    return std::make_unique<GyroSource>(std::move(inner), std::vector<GyroSample>(), InputDecision());
  if (!options.gyro.empty()) {
    GyroFile file = read_for(*inner, options.gyro);
    return with_file(std::move(inner), std::move(file), options.gyro, "by --gyro");
  }
  const std::string found = find_gyro_file(options.path);
  if (found.empty() || inner->gyro_readings()) return inner;  // its own is that of the recording
  try {
    GyroFile file = read_for(*inner, found);
    return with_file(std::move(inner), std::move(file), found, "lies next to the images; --gyro off without");
  } catch (const InputError& e) {
    return std::make_unique<GyroSource>(std::move(inner), std::vector<GyroSample>(),
                                        InputDecision{"gyro", "not used", "", std::string(e.what()) + "."});
  }
}

}  // namespace edgevo
