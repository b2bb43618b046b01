// SPDX-License-Identifier: BSD-3-Clause
// Damages copies of a kept map and reads them: each must be read, with what is whole, or be refused as bad
// input. For builds with a sanitizer.
//   fuzz_map MAP.db COPIES SEED
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

#include "edgevo/core/error.h"
#include "edgevo/kept_map/kept_map.h"
#include "edgevo/places/place_index.h"

namespace {

using namespace edgevo;

std::string bytes_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Single bytes, a run of one value, a page at another's place, or an end that is missing.
void damage(std::string* bytes, std::mt19937* random) {
  constexpr size_t kPage = 4096;
  const auto below = [&](size_t n) { return std::uniform_int_distribution<size_t>(0, n - 1)(*random); };
  const size_t at = below(bytes->size()), pages = bytes->size() / kPage;
  switch (below(4)) {
    case 0:
      for (size_t n = 1 + below(30); n > 0; --n) (*bytes)[below(bytes->size())] = char(below(256));
      break;
    case 1:
      bytes->replace(at, std::min(1 + below(3 * kPage), bytes->size() - at),
                     std::min(1 + below(3 * kPage), bytes->size() - at), char(below(256)));
      break;
    case 2:
      if (pages > 1) bytes->replace(kPage * below(pages), kPage, bytes->substr(kPage * below(pages), kPage));
      break;
    default:
      bytes->resize(at);
  }
}

struct Counts {
  int whole = 0, warned = 0, refused = 0;
};

// What the map's users read first of it.
void use(const KeptMap& map, const std::string& file) {
  describe(map, file);
  PlaceIndex index;
  for (const StoredKeyframe& k : map.store.keyframes())
    if (k.view) index.add(*k.view);
}

void read_damaged(const std::string& bytes, const std::string& file, Counts* counts) {
  std::ofstream(file, std::ios::binary) << bytes;
  try {
    const KeptMap map = read_map(file);
    use(map, file);
    ++(map.warnings.empty() ? counts->whole : counts->warned);
  } catch (const InputError&) {
    ++counts->refused;
  }
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 4) return std::fprintf(stderr, "fuzz_map MAP.db COPIES SEED\n"), 2;
  const std::string map = bytes_of(argv[1]);
  if (map.empty()) return std::fprintf(stderr, "%s: cannot be read\n", argv[1]), 2;
  const std::string file = (std::filesystem::temp_directory_path() / "fuzz_map.db").string();
  std::mt19937 random(unsigned(std::atoi(argv[3])));
  Counts counts;
  for (int i = 0; i < std::atoi(argv[2]); ++i) {
    std::string bytes = map;
    damage(&bytes, &random);
    read_damaged(bytes, file, &counts);
  }
  std::filesystem::remove(file);
  std::printf("read as whole %d, with warnings %d, refused %d\n", counts.whole, counts.warned,
              counts.refused);
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 1;
}
