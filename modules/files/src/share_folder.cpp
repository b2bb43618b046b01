// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/files/share_folder.h"

#include "edgevo/core/error.h"
#include "edgevo/files/program_folder.h"

namespace edgevo {

std::filesystem::path share_file(const std::string& name, const std::string& remedy) {
  const std::filesystem::path folders[] = {data_folder(), "/usr/local/share/edgevo", "/usr/share/edgevo"};
  std::error_code ignored;
  for (const std::filesystem::path& folder : folders)
    if (std::filesystem::is_regular_file(folder / name, ignored)) return folder / name;
  throw InputError((folders[0] / name).string(), "is not there", remedy);
}

}  // namespace edgevo
