#pragma once
// Files that come with edgevo and are found without being named: models of detectors.
#include <filesystem>
#include <string>

namespace edgevo {

/// `name` ("models/edge_network.onnx") in the share folder: that of the running program (data_folder(); a
/// build links it to the sources), else that of the system (for programs of others that link edgevo). Throws
/// InputError where there is no such file; `remedy` says what to do then.
std::filesystem::path share_file(const std::string& name, const std::string& remedy);

}  // namespace edgevo
