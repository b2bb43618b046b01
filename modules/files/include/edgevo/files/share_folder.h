// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Files that ship with edgevo and are found without a path: models of detectors.
#include <filesystem>
#include <string>

namespace edgevo {

/// Path of `name` ("models/edge_network.onnx") in the share folder of the running program (data_folder(); a
/// build links it to the sources), else in that of the system (for other programs that link edgevo). Throws
/// InputError with `remedy` if there is no such file.
std::filesystem::path share_file(const std::string& name, const std::string& remedy);

}  // namespace edgevo
