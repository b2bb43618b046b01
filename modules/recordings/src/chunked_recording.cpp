// SPDX-License-Identifier: BSD-3-Clause
#include "chunked_recording.h"

#include <algorithm>
#include <numeric>

namespace edgevo {

std::string with_commas(uint64_t number) {
  std::string digits = std::to_string(number);
  for (size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, ",");
  return digits;
}

std::string ros1_type(const std::string& type) {
  const size_t at = type.find("/msg/");
  return at == std::string::npos ? type : type.substr(0, at) + type.substr(at + 4);
}

void ChunkedRecording::select(const MessageSelection& selection) {
  selection_ = selection;
  wanted_.assign(topics_.size(), false);
  for (const size_t topic : selection.topics) wanted_.at(topic) = true;
  next_chunk_ = 0;
  searched_ = 0;
  chunk_.reset();
}

std::optional<RecordedMessage> ChunkedRecording::next() {
  while (chunk_ || open_next_chunk()) try {
      if (auto message = next_in(chunk_.get())) return message;
      chunk_.reset();
    } catch (const DamagedPart&) {
      chunk_.reset();
      throw;
    }
  return std::nullopt;
}

bool ChunkedRecording::open_next_chunk() {
  while (next_chunk_ < chunks_.size()) {
    const Chunk& chunk = chunks_[next_chunk_++];
    if (!may_hold_wanted(chunk)) continue;
    chunk_ = open_chunk(chunk);
    return true;
  }
  return false;
}

bool ChunkedRecording::may_hold_wanted(const Chunk& chunk) {
  if (!chunk.messages) {
    searched_ += chunk.end - chunk.begin;
    return searched_ <= selection_.search_bytes;
  }
  return std::any_of(chunk.messages->begin(), chunk.messages->end(),
                     [&](const auto& channel) { return wanted_topic(channel.first).has_value(); });
}

std::optional<size_t> ChunkedRecording::wanted_topic(uint32_t id) const {
  const auto topic = topic_of_.find(id);
  if (topic == topic_of_.end() || topic->second >= wanted_.size() || !wanted_[topic->second])
    return std::nullopt;
  return topic->second;
}

void ChunkedRecording::add_channel(uint32_t id, const RecordedTopic& topic) {
  if (knows_channel(id)) return;
  const auto same = std::find_if(topics_.begin(), topics_.end(), [&](const RecordedTopic& t) {
    return t.name == topic.name && t.type == topic.type && t.encoding == topic.encoding;
  });
  topic_of_[id] = size_t(same - topics_.begin());
  if (same == topics_.end()) topics_.push_back(topic);
}

void ChunkedRecording::arrange(const std::map<uint32_t, int64_t>& count) {
  learn_all_channels();
  if (chunks_.empty() && !missing_.empty())
    throw InputError(file_.path(), "nothing whole in it: " + missing_, "record again, or look for a copy");
  std::stable_sort(chunks_.begin(), chunks_.end(),
                   [](const Chunk& a, const Chunk& b) { return a.start_ns < b.start_ns; });
  sort_topics();
  count_messages(count);
}

void ChunkedRecording::learn_all_channels() {
  for (const Chunk& chunk : chunks_) {
    const bool is_known =
        chunk.messages && std::all_of(chunk.messages->begin(), chunk.messages->end(),
                                      [&](const auto& c) { return knows_channel(c.first); });
    if (!is_known) try {
        const auto records = open_chunk(chunk);
        learn_channels(records.get());
      } catch (const DamagedPart&) {  // said when it is read
      }
  }
}

void ChunkedRecording::sort_topics() {
  std::vector<size_t> order(topics_.size()), rank(topics_.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return topics_[a].name < topics_[b].name; });
  std::vector<RecordedTopic> sorted;
  for (const size_t topic : order) rank[topic] = sorted.size(), sorted.push_back(topics_[topic]);
  for (auto& [id, topic] : topic_of_) topic = rank[topic];
  topics_ = std::move(sorted);
}

void ChunkedRecording::count_messages(const std::map<uint32_t, int64_t>& count) {
  std::map<uint32_t, int64_t> sum = count;
  if (sum.empty())
    for (const Chunk& chunk : chunks_) {
      if (!chunk.messages) return;
      for (const auto& [id, messages] : *chunk.messages) {
        if (messages == 0) return;
        sum[id] += messages;
      }
    }
  for (RecordedTopic& topic : topics_) topic.messages = 0;
  for (const auto& [id, messages] : sum)
    if (const auto topic = topic_of_.find(id); topic != topic_of_.end())
      *topics_[topic->second].messages += messages;
}

std::string ChunkedRecording::name_of(const Chunk& chunk) const {
  return file_.path() + ", chunk at byte " + std::to_string(chunk.begin);
}

void ChunkedRecording::set_cut_off(uint64_t end_of_whole, const std::string& part) {
  const uint64_t rest = file_.size() - std::min(file_.size(), end_of_whole);
  missing_ = rest == 0 ? "not closed by its recorder: what came after its " + with_commas(file_.size()) +
                             " bytes is missing"
                       : "cut off: the last " + with_commas(rest) + " of its " + with_commas(file_.size()) +
                             " bytes are not a whole " + part;
}

}  // namespace edgevo
