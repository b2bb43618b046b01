// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Factories of the detectors for all_detectors.cpp; each is defined in the file of its name.
#include "edgevo/edges/edge_detector.h"
#include "edgevo/edges/edge_probability.h"

namespace edgevo {

std::unique_ptr<EdgeDetector> make_edge_drawing_detector(const EdgeParams& params);
std::unique_ptr<EdgeDetector> make_probable_detector(const EdgeParams& params);
std::unique_ptr<EdgeDetector> make_combined_detector(const EdgeParams& params);

std::unique_ptr<EdgeProbability> make_structured_probability(const EdgeParams& params);
std::unique_ptr<EdgeProbability> make_network_probability(const EdgeParams& params);
std::unique_ptr<EdgeProbability> make_precomputed_probability(const EdgeParams& params);

}  // namespace edgevo
