// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/datasets/subsample.h"

#include <algorithm>
#include <climits>

#include "edgevo/core/error.h"
#include "edgevo/core/wrapped_source.h"

namespace edgevo {
namespace {

class SubsampledSource : public WrappedSource {
 public:
  SubsampledSource(std::unique_ptr<ImageSource> inner, const SourceOptions& options)
      : WrappedSource(std::move(inner)),
        next_(options.first),
        last_(options.last.value_or(INT_MAX)),
        every_(options.every) {
    details_ = this->inner().details();
    details_.emplace_back("frames taken", range(options));
  }

  std::optional<int> size() const override {
    const auto all = inner().size();
    if (!all) return std::nullopt;
    const int end = std::min(*all, last_);
    return std::max(0, (end - first_ + every_ - 1) / every_);
  }
  std::vector<std::pair<std::string, std::string>> details() const override { return details_; }
  std::vector<Timestamp> times() const override {
    const auto all = inner().times();
    std::vector<Timestamp> taken;
    for (size_t i = size_t(first_); i < std::min(all.size(), size_t(last_)); i += size_t(every_))
      taken.push_back(all[i]);
    return taken;
  }

  std::optional<Frame> next() override {
    if (!advance()) return std::nullopt;
    ++position_;
    return inner().next();
  }
  bool skip() override {
    if (!advance()) return false;
    ++position_;
    return inner().skip();
  }

 private:
  static std::string range(const SourceOptions& options) {
    std::string text =
        std::to_string(options.first) + ":" + (options.last ? std::to_string(*options.last) : "");
    return options.every == 1 ? text : text + ", every " + std::to_string(options.every) + ".";
  }
  // Advances the inner source to the next selected frame.
  bool advance() {
    if (next_ >= last_) return false;
    for (; position_ < next_; ++position_)
      if (!inner().skip()) return false;
    next_ = next_ > INT_MAX - every_ ? INT_MAX : next_ + every_;
    return true;
  }

  std::vector<std::pair<std::string, std::string>> details_;
  int position_ = 0;  // next frame of the inner source
  int next_;          // next selected frame
  int first_ = next_;
  int last_, every_;
};

}  // namespace

std::unique_ptr<ImageSource> subsample(std::unique_ptr<ImageSource> inner, const SourceOptions& options) {
  if (options.every < 1)
    throw InputError("--every", "is below 1", "give 1 for all frames, 2 for each second one, ...");
  if (options.first < 0 || (options.last && *options.last <= options.first))
    throw InputError("--frames", "is not a range A:B with 0 <= A < B", "give for example --frames 0:300");
  if (const auto size = inner->size(); size && options.first >= *size)
    throw InputError("--frames",
                     "begins at " + std::to_string(options.first) + ", but " + options.path + " has " +
                         std::to_string(*size) + " frames",
                     "begin earlier");
  if (options.first == 0 && !options.last && options.every == 1) return inner;
  return std::make_unique<SubsampledSource>(std::move(inner), options);
}

}  // namespace edgevo
