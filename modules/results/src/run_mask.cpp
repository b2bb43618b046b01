// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/results/run_mask.h"

#include <filesystem>

#include "edgevo/core/error.h"

namespace edgevo {

bool copy_run_mask(const std::string& run, const std::string& out, bool force) {
  namespace fs = std::filesystem;
  const fs::path found = fs::path(run) / "mask.png";
  std::error_code error;
  if (!fs::exists(fs::path(run) / "summary.yaml", error))
    throw InputError(run, "is not the folder of a finished run", "give the -o of `edgevo run`");
  if (!fs::exists(found, error)) return false;
  if (!force && fs::exists(out, error))
    throw InputError(out, "exists already", "give another name, or --force to replace it");
  fs::copy_file(found, out, fs::copy_options::overwrite_existing, error);
  if (error) throw InputError(out, "cannot be written: " + error.message(), "give another name");
  return true;
}

}  // namespace edgevo
