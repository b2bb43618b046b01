#pragma once
// Runs the jobs of a list and collects their trials.
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/error.h"
#include "edgevo/evaluation/bench_list.h"
#include "edgevo/evaluation/bench_table.h"

namespace edgevo::app {

struct Progression {
  int jobs = 0, ran = 0, taken = 0;
  std::optional<InputError> first_failure;
  int ended() const { return ran + taken; }
};

/// A row a sequence and variant; jobs that have ended in OUT before are not run again. `list_path` is the
/// file that camera and parameter files stand beside, `data` the folder that relative sources are in. A job
/// that breaks, or that a signal keeps from ending, is a missing trial of its row. Throws InputError: a
/// source that is not there, an OUT that cannot be.
std::vector<BenchRow> run_list(const BenchList& list, const std::string& list_path, const std::string& out,
                               const std::string& data);
/// The same, with what happened.
std::vector<BenchRow> run_list(const BenchList& list, const std::string& list_path, const std::string& out,
                               const std::string& data, Progression* all);

/// As the operating system names it.
std::string processor_name();

}  // namespace edgevo::app
