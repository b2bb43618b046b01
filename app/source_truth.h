#pragma once
#include <string>

#include "edgevo/evaluation/trajectory.h"

namespace edgevo::app {

/// The ground truth of a data set's folder, or the trajectory file that `path` names. Throws InputError where
/// there is none.
Trajectory source_truth(const std::string& path);

}  // namespace edgevo::app
