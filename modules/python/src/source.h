// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "arguments.h"
#include "edgevo/core/image_source.h"
#include "edgevo/datasets/open_source.h"
#include "edgevo/evaluation/trajectory.h"
#include "edgevo/simulation/rendered_source.h"
#include "in_use.h"

namespace edgevo::python {

/// A source as Python holds it: one that was opened or rendered, or the base of a class of the user.
struct PySource {
  /// The source; null for one of the user, which has a camera and __next__ of its own.
  std::unique_ptr<ImageSource> source;
  /// How it was opened.
  SourceOptions options;
  /// Its renderer, if it is rendered.
  std::shared_ptr<const SceneRenderer> renderer;
  /// Frames of the scene that are rendered.
  int first = 0, end = 0;
  /// Camera of a source of the user; may be null.
  py::object camera;
  /// Held while frames are read.
  InUse in_use;
};

/// Opens what `path` names, without the GIL.
std::unique_ptr<PySource> open(const SourceOptions& options);

/// The frames of a class of the user, through its __next__. Takes the GIL. Throws what Python raises
/// (py::error_already_set), TypeError or InputError.
std::unique_ptr<ImageSource> frames_of(py::object user_source, std::function<void(const std::string&)> say);

/// The true trajectory of a source. Throws InputError if it has none.
Trajectory true_trajectory(const PySource& source);

}  // namespace edgevo::python
