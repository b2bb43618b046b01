// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/map/map_log.h"

#include <algorithm>
#include <deque>
#include <map>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

namespace edgevo {

struct MapLog::Impl {
  mutable std::mutex mutex;
  std::deque<std::shared_ptr<const MapEvent>> events;
  size_t first = 0;                    // number of the first kept event, counted from the first append()
  std::map<size_t, size_t> next_read;  // by cursor: number of the next event
  size_t next_cursor = 0;
  std::vector<int> keyframes;  // ids of the announced ones, ascending
  std::set<int> constraints;   // numbers of those announced and not withdrawn
  int next_constraint = 0;

  size_t end() const { return first + events.size(); }

  // Drops the events that every cursor has passed; hands them out, so that they are destroyed without lock.
  std::vector<std::shared_ptr<const MapEvent>> trim() {
    size_t wanted = end();
    for (const auto& [id, next] : next_read) wanted = std::min(wanted, next);
    std::vector<std::shared_ptr<const MapEvent>> passed;
    for (; first < wanted; ++first) {
      passed.push_back(std::move(events.front()));
      events.pop_front();
    }
    return passed;
  }

  void append(std::shared_ptr<const MapEvent> event) {
    if (const auto* added = std::get_if<KeyframeAdded>(event.get())) keyframes.push_back(added->id);
    if (next_read.empty())
      ++first;
    else
      events.push_back(std::move(event));
  }

  void require_keyframe(NodeId id) const {
    if (id.kind() == NodeId::Kind::kKeyframe &&
        std::binary_search(keyframes.begin(), keyframes.end(), id.number()))
      return;
    throw std::invalid_argument("constraint: " + to_string(id) + " is no keyframe of the run");
  }
};

MapLog::MapLog() : impl_(std::make_unique<Impl>()) {}
MapLog::~MapLog() = default;

void MapLog::append(MapEvent event) {
  auto shared = std::make_shared<const MapEvent>(std::move(event));
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  impl_->append(std::move(shared));
}

int MapLog::add_constraint(const Constraint& constraint) {
  check_constraint(constraint);
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  if (constraint.from != NodeId::world()) impl_->require_keyframe(constraint.from);
  impl_->require_keyframe(constraint.to);
  const int id = impl_->next_constraint++;
  impl_->constraints.insert(id);
  impl_->append(std::make_shared<const MapEvent>(ConstraintAdded{id, constraint}));
  return id;
}

void MapLog::withdraw_constraint(int id) {
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  if (impl_->constraints.erase(id) == 0)
    throw std::invalid_argument("constraint " + std::to_string(id) + ": there is none with this number");
  impl_->append(std::make_shared<const MapEvent>(ConstraintWithdrawn{id}));
}

size_t MapLog::kept() const {
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  return impl_->events.size();
}

MapCursor::MapCursor(std::shared_ptr<MapLog> log) : log_(std::move(log)) {
  MapLog::Impl& impl = *log_->impl_;
  const std::lock_guard<std::mutex> lock(impl.mutex);
  id_ = impl.next_cursor++;
  impl.next_read[id_] = impl.end();
}

MapCursor::~MapCursor() {
  if (!log_) return;
  std::vector<std::shared_ptr<const MapEvent>> passed;
  MapLog::Impl& impl = *log_->impl_;
  const std::lock_guard<std::mutex> lock(impl.mutex);
  impl.next_read.erase(id_);
  passed = impl.trim();
}

MapCursor::MapCursor(MapCursor&&) noexcept = default;

std::vector<std::shared_ptr<const MapEvent>> MapCursor::read() {
  std::vector<std::shared_ptr<const MapEvent>> passed;
  MapLog::Impl& impl = *log_->impl_;
  const std::lock_guard<std::mutex> lock(impl.mutex);
  size_t& next = impl.next_read.at(id_);
  std::vector<std::shared_ptr<const MapEvent>> news(impl.events.begin() + long(next - impl.first),
                                                    impl.events.end());
  next = impl.end();
  passed = impl.trim();
  return news;
}

}  // namespace edgevo
