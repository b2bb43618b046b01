// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/kept_map/write_map.h"

#include "final_map.h"
#include "keyframe_bytes.h"
#include "map_file.h"
#include "map_tables.h"

namespace edgevo {
namespace {

void write_rows(const KeptMap& map, Database* target) {
  KeyframeRows keyframes(target);
  ConstraintRows constraints(target);
  for (const StoredKeyframe& k : map.store.keyframes()) {
    keyframes.put(k.id, bytes_of(KeyframePlace{k.id, k.epoch, *k.record}), bytes_of(*k.view));
    if (k.next) constraints.put(number_of_motion(k.id), motion_of(k));
  }
  for (size_t i = 0; i < map.constraints.size(); ++i) constraints.put(int64_t(i), map.constraints[i]);
}

void fill_with(const KeptMap& map, Database* target) {
  write_texts(target,
              finished_texts(texts_of(map.header), {map.scale_source, map.scale_sigma, map.correction}));
  write_rows(map, target);
}

}  // namespace

void write_map(const KeptMap& map, const std::string& path) {
  const std::string made = name_while_made(path);
  remove_map_files(made);
  attempt_writing(path, "check its folder and the space; what was there is kept",
                  [&] { write_whole_map(made, [&](Database* target) { fill_with(map, target); }); });
  take_its_name(path);
}

}  // namespace edgevo
