// SPDX-License-Identifier: BSD-3-Clause
// Mutated map files: read, described, drawn, each view unpacked. EDGEVO_FUZZ_ROUNDS sets the number of
// mutations of each file, for runs under a sanitizer.
#include <cstdlib>

#include "edgevo/core/input_file.h"
#include "edgevo/core/output_file.h"
#include "edgevo/kept_map/map_picture.h"
#include "edgevo/places/place_index.h"
#include "fuzz/mutate.h"
#include "unit/kept_map/made_map.h"

namespace edgevo::test {
namespace {

int rounds() {
  constexpr int kUsual = 300;
  const char* const text = std::getenv("EDGEVO_FUZZ_ROUNDS");
  return text ? std::atoi(text) : kUsual;
}

void use(const std::string& path) {
  const KeptMap map = read_map(path);
  describe(map, path);
  PlaceIndex index;
  if (map.store.size() % 4 == 0) map_picture(map);
  for (size_t i = 0; i < map.store.size(); i += 7) {
    map.store.points_around(i);
    const RememberedView& view = *map.store.keyframes()[i].view;
    unpack(view.edges);
    index.add(view);
  }
}

void fuzz_map(const MadeMap& made, bool is_finished, uint64_t seed) {
  const TempFolder folder;
  const std::string path = folder / "map.db";
  made.write(path);
  if (!is_finished) {
    MapFileWriter writer(path, made.header);
    made.write(&writer);
  }
  expect_both(fuzz(read_file(path, ""), rounds(), seed, [&](const std::string& bytes) {
    write_file(path, bytes);
    use(path);
  }));
}

TEST(FuzzKeptMap, Finished) { fuzz_map(MadeMap(24, 20, 10, 4), true, 701); }
TEST(FuzzKeptMap, FinishedLarge) { fuzz_map(MadeMap(90, 60, 30, 10), true, 702); }
TEST(FuzzKeptMap, Interrupted) { fuzz_map(MadeMap(24, 20, 10, 4), false, 703); }

// The log of a killed run.
TEST(FuzzKeptMap, Log) {
  const MadeMap made(24, 20, 10, 4);
  const TempFolder folder;
  MapFileWriter writer(folder / "growing.db", made.header);
  made.write(&writer);
  const std::string path = folder / "map.db";
  write_file(path, read_file(folder / "growing.db", ""));
  const FuzzCounts counts =
      fuzz(read_file(folder / "growing.db-wal", ""), rounds(), 704, [&](const std::string& bytes) {
        write_file(path + "-wal", bytes);
        use(path);
      });
  EXPECT_GT(counts.accepted, 0);
}

}  // namespace
}  // namespace edgevo::test
