// SPDX-License-Identifier: BSD-3-Clause
#include "renumbered_map.h"

#include <algorithm>

#include "edgevo/map/map_event.h"
#include "map_tables.h"

namespace edgevo {
namespace {

// The first numbers that are free.
struct Free {
  int id = 0, segment = 0, epoch = 0;

  explicit Free(const PlaceStore& store) {
    for (const StoredKeyframe& k : store.keyframes()) {
      id = std::max(id, k.id + 1);
      segment = std::max(segment, k.record->segment + 1);
      epoch = std::max(epoch, k.epoch + 1);
    }
  }
};

}  // namespace

Numbers append(const KeptMap& map, KeptMap* to) {
  const Free first(to->store);
  Numbers numbers;
  for (const StoredKeyframe& k : map.store.keyframes()) numbers[k.id] = first.id + int(numbers.size());
  for (StoredKeyframe k : map.store.keyframes()) {
    auto record = std::make_shared<KeyframeRecord>(*k.record);
    record->segment += first.segment;
    k.id = numbers.at(k.id), k.epoch += first.epoch, k.record = std::move(record);
    const auto next = k.next ? numbers.find(k.next->id) : numbers.end();
    next == numbers.end() ? k.next.reset() : void(k.next->id = next->second);
    to->store.add(std::move(k));
  }
  for (const Constraint& c : map.constraints)
    if (numbers.count(c.from.number()) > 0 && numbers.count(c.to.number()) > 0)
      to->constraints.push_back(renumbered(c, numbers, numbers));
  return numbers;
}

Constraint renumbered(Constraint c, const Numbers& of_from, const Numbers& of_to) {
  c.from = NodeId::keyframe(of_from.at(c.from.number()));
  c.to = NodeId::keyframe(of_to.at(c.to.number()));
  return c;
}

bool in_unit_of(const std::map<int, Sim3>& T_of_keyframe, Constraint* c) {
  const auto from = T_of_keyframe.find(c->from.number()), to = T_of_keyframe.find(c->to.number());
  if (from == T_of_keyframe.end() || to == T_of_keyframe.end()) return false;
  *c = in_new_units(*c, from->second.scale, to->second.scale);
  return true;
}

}  // namespace edgevo
