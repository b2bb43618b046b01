// SPDX-License-Identifier: BSD-3-Clause
#include "bench_plan.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "edgevo/core/error.h"
#include "edgevo/core/input_file.h"
#include "edgevo/core/output_file.h"
#include "edgevo/files/program_folder.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

constexpr size_t kManyJobs = 10000;  // ten seconds of planning time

// Folder name for any text: special characters become underscores; a hash makes the name unique.
std::string folder_name(const std::string& text) {
  std::string name;
  for (const char c : text) name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  uint64_t hash = 1469598103934665603u;  // FNV-1a
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  return name.substr(name.size() > 40 ? name.size() - 40 : 0) + "_" + std::to_string(hash);
}

bool is_open(const BenchJob& job) {
  try {
    return !finished_trial(job);
  } catch (const InputError&) {
    return false;  // a corrupt result is reported with the table and not overwritten
  }
}

std::string id_of(const EngineJob& job) {
  const auto& [variant, seed] = job.trials.front();
  const std::string more = job.trials.size() > 1 ? "+" + std::to_string(job.trials.size() - 1) : "";
  return job.sequence + "/" + variant + "/seed" + std::to_string(seed) + more;
}

std::vector<EngineJob> packed(const std::vector<std::pair<std::string, uint64_t>>& trials,
                              const std::string& sequence, size_t pack) {
  std::vector<EngineJob> jobs;
  for (const auto& trial : trials) {
    if (jobs.empty() || jobs.back().trials.size() >= pack) jobs.push_back({sequence, {}, {}, {}});
    jobs.back().trials.push_back(trial);
  }
  return jobs;
}

nlohmann::ordered_json as_json(const EngineJob& job) {
  return {{"sequence", job.sequence}, {"scene", job.scene}, {"edges", job.edges}, {"trials", job.trials}};
}

// One entry of the plan: a job or a scene.
nlohmann::ordered_json planned(const std::string& out, const char* kind, const std::string& name) {
  const std::string path = workflow_path(out, "plan.json");
  const auto plan = nlohmann::ordered_json::parse(read_file(path, "call edgevo bench"), nullptr, false);
  const bool there = plan.is_object() && plan.contains(kind) && plan[kind].contains(name);
  if (!there) throw InputError(path, "plans no '" + name + "'", "run edgevo bench to plan again");
  return plan[kind][name];
}

void check_names(const BenchSequence& sequence) {
  if (sequence.name == "workflow")
    throw InputError(sequence.where, "a sequence cannot be called workflow: the engine keeps its files there",
                     "use another name");
  for (const BenchVariant& v : sequence.variants)
    if (!precomputed_by(v).empty() && (!v.light.empty() || v.backward))
      throw InputError(sequence.where, "the edges of '" + v.name + "' cannot be precomputed",
                       "leave its light and its order as they are, or name a detector without precomputed:");
}

void forget_end(const std::string& out, const std::string& id) {
  std::error_code ignored;
  fs::remove(workflow_path(out, "jobs/" + id + ".ended"), ignored);
}

}  // namespace

std::string precomputed_by(const BenchVariant& variant) {
  const bool is = variant.detector.compare(0, kPrecomputedPrefix.size(), kPrecomputedPrefix) == 0;
  return is ? variant.detector.substr(kPrecomputedPrefix.size()) : "";
}

std::string scene_key(const BenchInput& input) {
  return input.scene_key().empty() ? "" : folder_name(input.scene_key());
}

std::string edges_key(const BenchInput& input, const std::string& detector) {
  return detector.empty() ? "" : folder_name(detector + " " + input.sequence().name);
}

EngineJob planned_job(const std::string& out, const std::string& id) {
  const nlohmann::ordered_json entry = planned(out, "jobs", id);
  EngineJob job;
  entry.at("sequence").get_to(job.sequence);
  entry.at("trials").get_to(job.trials);
  return job;
}

std::string planned_scene(const std::string& out, const std::string& key) {
  return planned(out, "scenes", key).get<std::string>();
}

std::string workflow_path(const std::string& out, const std::string& name) {
  return (fs::absolute(out).lexically_normal() / "workflow" / name).string();
}

BenchPlan::BenchPlan(const BenchList& list, const BenchTarget& target, const std::string& version) {
  const size_t most = std::max(kManyJobs, list.sequences.size());
  const size_t pack = (size_t(list.jobs()) + most - 1) / most;
  for (const BenchSequence& sequence : list.sequences) add_sequence(list, sequence, target, version, pack);
}

void BenchPlan::add_sequence(const BenchList& list, const BenchSequence& sequence, const BenchTarget& target,
                             const std::string& version, size_t pack) {
  check_names(sequence);
  const BenchInput input(sequence, target.data, target.list_path);
  input.check_output(target.out);
  std::vector<std::pair<std::string, uint64_t>> open;
  for (const BenchVariant& variant : sequence.variants)
    for (const uint64_t seed : list.seeds)
      if (is_open(make_job(input, variant, seed, target.out, version))) open.emplace_back(variant.name, seed);
  open_ += int(open.size());
  for (const EngineJob& job : packed(open, sequence.name, pack)) add_job(input, job);
}

void BenchPlan::add_job(const BenchInput& input, EngineJob job) {
  job.scene = scene_key(input);
  if (!job.scene.empty()) scenes_.emplace(job.scene, job.sequence);
  for (const BenchVariant& v : input.sequence().variants) {
    const auto is_it = [&](const auto& trial) { return trial.first == v.name; };
    const std::string detector = precomputed_by(v), key = edges_key(input, detector);
    if (key.empty() || std::none_of(job.trials.begin(), job.trials.end(), is_it)) continue;
    edges_[key] = {job.scene, input.source_path(), detector, input.sequence().frames, input.camera_path()};
    if (std::find(job.edges.begin(), job.edges.end(), key) == job.edges.end()) job.edges.push_back(key);
  }
  jobs_.emplace(id_of(job), std::move(job));
}

void BenchPlan::write(const BenchList& list, const BenchTarget& target) const {
  nlohmann::ordered_json plan;
  plan["program"] = (program_folder() / "edgevo-commands").string();
  plan["folder"] = fs::current_path().string();
  plan["workflow"] = workflow_path(target.out, "");
  plan["out"] = target.out;
  plan["arguments"] = {workflow_path(target.out, "list.yaml"),
                       "--beside",
                       target.list_path,
                       "--out",
                       target.out,
                       "--data",
                       target.data};
  plan["scenes"] = scenes_;
  plan["edges"] = edges_;
  plan["jobs"] = nlohmann::ordered_json::object();
  nlohmann::ordered_json jobs = nlohmann::ordered_json::object();
  auto& entries = jobs.get_ref<nlohmann::ordered_json::object_t&>();
  for (const auto& [id, job] : jobs_) {
    entries.emplace_back(id, as_json(job));  // [] would search all of them
    forget_end(target.out, id);
  }
  plan["jobs"] = std::move(jobs);
  make_output_folder(workflow_path(target.out, ""));
  write_file(workflow_path(target.out, "list.yaml"), bench_list_yaml(list));
  write_file(workflow_path(target.out, "plan.json"), plan.dump() + '\n');
}

}  // namespace edgevo
