// SPDX-License-Identifier: BSD-3-Clause
#include "recording_tail.h"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <set>
#include <thread>

#include "edgevo/core/error.h"
#include "edgevo/mrpt_bridge/rawlog_reader.h"
#include "edgevo/mrpt_bridge/rawlog_writer.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

using Name = std::pair<std::string, int64_t>;  // label and time identify an observation of a recording

Name name_of(const mrpt::obs::CObservation& observation) {
  return {observation.sensorLabel, observation.timestamp.time_since_epoch().count()};
}

bool this_program_has_open(const std::string& path) {
  std::error_code ignored;
  const fs::path wanted = fs::canonical(path, ignored);
  for (const auto& entry : fs::directory_iterator("/proc/self/fd", ignored))
    if (fs::read_symlink(entry.path(), ignored) == wanted) return true;
  return false;
}

bool wait_until_closed(const std::string& path) {
  using std::chrono::steady_clock;
  const auto end = steady_clock::now() + std::chrono::seconds(10);
  while (this_program_has_open(path)) {
    if (steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

std::set<Name> names_in(const std::string& rawlog) {
  std::set<Name> names;
  RawlogReader reader(rawlog);
  while (const auto observation = reader.next()) names.insert(name_of(*observation));
  return names;
}

void append(const std::vector<mrpt::obs::CObservation::Ptr>& observations, const std::string& rawlog) {
  const std::string part = rawlog + ".tail";
  RawlogWriter writer(part);
  for (const auto& observation : observations) writer.write(*observation);
  writer.close();
  std::ofstream out(rawlog, std::ios::binary | std::ios::app);
  out << std::ifstream(part, std::ios::binary).rdbuf();
  out.close();
  if (!out)
    throw InputError(rawlog, "the last observations could not be appended",
                     "they are in " + part + "; join the files with cat");
  fs::remove(part);
}

}  // namespace

void RecordingTail::record_next_to(const std::string& images_folder) {
  const std::string ending = "_Images";
  const size_t length = images_folder.size() - std::min(images_folder.size(), ending.size());
  if (images_folder.substr(length) == ending) rawlog_ = images_folder.substr(0, length) + ".rawlog";
}

bool RecordingTail::all_written() {
  while (!held_.empty() && held_.front().use_count() == 1) held_.pop_front();
  return held_.empty();
}

int RecordingTail::append_the_rest() {
  if (all_written() || rawlog_.empty() || !fs::exists(rawlog_)) return 0;
  if (!wait_until_closed(rawlog_))
    throw InputError(rawlog_, "it is still open, the last observations are lost", "");
  const std::set<Name> written = names_in(rawlog_);
  std::vector<mrpt::obs::CObservation::Ptr> rest;
  for (const auto& observation : held_)
    if (!written.count(name_of(*observation))) rest.push_back(observation);
  held_.clear();
  if (!rest.empty()) append(rest, rawlog_);
  return int(rest.size());
}

}  // namespace edgevo
