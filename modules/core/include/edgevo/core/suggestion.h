// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Suggestions for misspelt words.
#include <string>
#include <string_view>
#include <vector>

namespace edgevo {

/// Levenshtein distance: the fewest letters to insert, remove or replace. Cost: the product of the lengths.
size_t edit_distance(std::string_view a, std::string_view b);

/// "did you mean 'x'?" with the candidate nearest to `word`, if no more than a third of its letters differ;
/// else empty. Unlike nearest_name(), for words that may be none of the candidates at all.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace edgevo
