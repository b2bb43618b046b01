// SPDX-License-Identifier: BSD-3-Clause
#include "help_parameters.h"

#include <algorithm>
#include <cstdio>

#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "edgevo/results/parameters_text.h"
#include "edgevo/results/run_params.h"
#include "help.h"

namespace edgevo::app {
namespace {

std::vector<ParamDescription> parameters_of_run() {
  RunParams defaults;
  return describe_params([&](ParamVisitor& v) { defaults.visit(v); });
}

}  // namespace

bool print_parameters_help(int argc, const char* const* argv) {
  const std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  if (words.size() < 2 || words[0] != "help" || words[1] != "parameters") return false;
  for (size_t i = 2; i < words.size(); ++i)
    if (words[i] != "--all")
      throw InputError("edgevo help parameters", "unknown argument '" + words[i] + "'",
                       "give --all or nothing");
  std::fputs(parameters_text(parameters_of_run(), words.size() > 2).c_str(), stdout);
  return true;
}

void write_parameters_help(const std::string& folder) {
  const std::vector<ParamDescription> params = parameters_of_run();
  write_file(folder + "/" + help_file_name("parameters"), parameters_text(params, false));
  write_file(folder + "/" + help_file_name("parameters-all"), parameters_text(params, true));
}

}  // namespace edgevo::app
