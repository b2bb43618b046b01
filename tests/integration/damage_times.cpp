// SPDX-License-Identifier: BSD-3-Clause
// damage_times IN.rawlog OUT.rawlog back|twice|swap|none: copies a rawlog with a fault of its times at the
// 21st observation: from there on the clock is five seconds behind, it is there twice, it changes places with
// the one before, or it has no time.
#include <cstdio>
#include <string>
#include <vector>

#include "edgevo/mrpt_bridge/rawlog_reader.h"
#include "edgevo/mrpt_bridge/rawlog_writer.h"

namespace {

constexpr size_t kAt = 20;

using Observations = std::vector<mrpt::obs::CObservation::Ptr>;

bool damage(const std::string& fault, Observations* all) {
  if (fault == "back")
    for (size_t i = kAt; i < all->size(); ++i) (*all)[i]->timestamp -= std::chrono::seconds(5);
  else if (fault == "twice")
    all->insert(all->begin() + kAt, (*all)[kAt]);
  else if (fault == "swap")
    std::swap((*all)[kAt - 1], (*all)[kAt]);
  else if (fault == "none")
    (*all)[kAt]->timestamp = mrpt::Clock::time_point();
  else
    return false;
  return true;
}

int copy(const std::string& in, const std::string& out, const std::string& fault) {
  edgevo::RawlogReader reader(in);
  Observations all;
  while (const auto observation = reader.next()) all.push_back(observation);
  if (all.size() <= kAt || !damage(fault, &all)) return 2;
  edgevo::RawlogWriter writer(out);
  for (const auto& observation : all) writer.write(*observation);
  writer.close();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  try {
    return copy(argv[1], argv[2], argv[3]);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "damage_times: %s\n", e.what());
    return 2;
  }
}
