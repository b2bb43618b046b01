// SPDX-License-Identifier: BSD-3-Clause
#include "joined_recording.h"

#include <algorithm>

#include "unpack.h"

namespace edgevo {
namespace {

class JoinedRecording : public Recording {
 public:
  JoinedRecording(std::vector<std::unique_ptr<Recording>> parts, const JoinedFacts& facts)
      : parts_(std::move(parts)), facts_(facts), missing_(facts.missing) {
    for (const auto& part : parts_) {
      for (const RecordedTopic& topic : part->topics()) add(topic);
      if (!part->missing().empty()) missing_ += (missing_.empty() ? "" : "; ") + part->missing();
    }
    std::sort(topics_.begin(), topics_.end(),
              [](const RecordedTopic& a, const RecordedTopic& b) { return a.name < b.name; });
    if (!missing_.empty()) return;
    for (RecordedTopic& topic : topics_)
      if (const auto known = facts.messages.find(topic.name);
          known != facts.messages.end() && !topic.messages)
        topic.messages = known->second;
  }

  std::string kind() const override { return facts_.kind; }
  const std::vector<RecordedTopic>& topics() const override { return topics_; }
  std::string missing() const override { return missing_; }
  void select(const MessageSelection& selection) override {
    selection_ = selection;
    part_ = 0;
    if (!parts_.empty()) select_in_part();
  }
  std::optional<RecordedMessage> next() override {
    while (part_ < parts_.size()) {
      if (auto message = parts_[part_]->next()) {
        message->topic = place_of(parts_[part_]->topics()[message->topic]);
        unpack(&*message);
        return message;
      }
      if (++part_ < parts_.size()) select_in_part();
    }
    return std::nullopt;
  }

 private:
  static bool is_same(const RecordedTopic& a, const RecordedTopic& b) {
    return a.name == b.name && a.type == b.type && a.encoding == b.encoding;
  }
  size_t place_of(const RecordedTopic& topic) const {
    const auto same =
        std::find_if(topics_.begin(), topics_.end(), [&](const auto& t) { return is_same(t, topic); });
    return size_t(same - topics_.begin());
  }
  void add(const RecordedTopic& topic) {
    const size_t place = place_of(topic);
    if (place == topics_.size()) return topics_.push_back(topic);
    auto& messages = topics_[place].messages;
    messages = messages && topic.messages ? std::make_optional(*messages + *topic.messages) : std::nullopt;
  }
  void unpack(RecordedMessage* message) {
    if (!facts_.has_packed_messages) return;
    if (is_zstd(message->bytes)) {
      unpack_zstd(message->bytes, selection_.head_bytes, "message of " + topics_[message->topic].name,
                  &unpacked_);
      message->bytes = unpacked_;
    }
    message->bytes = message->bytes.substr(0, selection_.head_bytes);
  }
  void select_in_part() {
    MessageSelection inner = selection_;
    if (facts_.has_packed_messages) inner.head_bytes = SIZE_MAX;
    inner.topics.clear();
    const auto& topics = parts_[part_]->topics();
    for (size_t i = 0; i < topics.size(); ++i)
      if (std::count(selection_.topics.begin(), selection_.topics.end(), place_of(topics[i])) > 0)
        inner.topics.push_back(i);
    parts_[part_]->select(inner);
  }

  std::vector<std::unique_ptr<Recording>> parts_;
  JoinedFacts facts_;
  std::string missing_, unpacked_;
  std::vector<RecordedTopic> topics_;
  MessageSelection selection_;
  size_t part_ = 0;
};

}  // namespace

std::unique_ptr<Recording> join_recordings(std::vector<std::unique_ptr<Recording>> parts,
                                           const JoinedFacts& facts) {
  return std::make_unique<JoinedRecording>(std::move(parts), facts);
}

}  // namespace edgevo
