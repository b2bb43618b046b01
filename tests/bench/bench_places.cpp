// SPDX-License-Identifier: BSD-3-Clause
// Time of PlaceIndex::candidates() among as many views as the argument says: simulated ones of 400 corners,
// whose descriptors are those of 500 kinds of corner with a fifth of their bits changed, as scenes repeat
// what they consist of. The queries are views of it with a tenth of the bits changed.
#include <benchmark/benchmark.h>

#include <random>
#include <vector>

#include "edgevo/core/thread_clock.h"
#include "edgevo/places/place_index.h"

namespace {

using namespace edgevo;

constexpr size_t kCorners = 400, kKinds = 500;

CornerDescriptor random_descriptor(std::mt19937* random) {
  CornerDescriptor d;
  for (uint8_t& byte : d) byte = uint8_t((*random)());
  return d;
}

CornerDescriptor changed(CornerDescriptor d, double share, std::mt19937* random) {
  std::geometric_distribution<size_t> unchanged(share);  // bits up to the next one that changes
  for (size_t bit = unchanged(*random); bit < 8 * d.size(); bit += 1 + unchanged(*random))
    d[bit / 8] = uint8_t(d[bit / 8] ^ (1U << (bit % 8)));
  return d;
}

RememberedView changed(RememberedView view, double share, std::mt19937* random) {
  for (CornerDescriptor& d : view.corners.descriptors) d = changed(d, share, random);
  return view;
}

RememberedView random_view(const std::vector<CornerDescriptor>& kinds, std::mt19937* random) {
  RememberedView view;
  for (size_t i = 0; i < kCorners; ++i)
    view.corners.descriptors.push_back(changed(kinds[(*random)() % kinds.size()], 0.2, random));
  for (uint64_t& bits : view.signature.bits) bits = (uint64_t((*random)()) << 32) | (*random)();
  return view;
}

void candidates(benchmark::State& state) {
  std::mt19937 random(1);
  std::vector<CornerDescriptor> kinds;
  for (size_t i = 0; i < kKinds; ++i) kinds.push_back(random_descriptor(&random));
  PlaceIndex index;
  std::vector<RememberedView> queries;
  for (int i = 0; i < state.range(0); ++i) {
    const RememberedView view = random_view(kinds, &random);
    index.add(view);
    if (queries.size() < 100) queries.push_back(changed(view, 0.1, &random));
  }
  size_t next = 0, found = 0, looked_up = 0;
  const double begin_ms = thread_cpu_ms();
  for (auto _ : state) {
    const size_t query = next++ % queries.size();
    PlaceVotes votes;
    for (const int view : index.candidates(queries[query], 3, &votes)) found += size_t(view) == query;
    ++looked_up;
  }
  state.counters["cpu_ms"] = (thread_cpu_ms() - begin_ms) / double(looked_up);
  state.counters["found"] = double(found) / double(looked_up);
}

BENCHMARK(candidates)->Arg(300)->Arg(1000)->Arg(10000)->Iterations(200)->Unit(benchmark::kMillisecond);

}  // namespace
