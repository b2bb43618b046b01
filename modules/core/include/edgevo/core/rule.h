#pragma once
// The rules of the method that are not in the paper, each under a name at the place where it decides. An
// ablation takes them out one at a time: share/bench/ablate.py.
//
//   if (fits && rotation > limit && rule("motions agree")) return true;
//
// A rule is asked last, where it is about to act: the number of calls is how often it acted.
namespace edgevo {

/// True. In a build with -DEDGEVO_ABLATION=ON: false where the environment variable EDGEVO_WITHOUT (names,
/// separated by commas) has `name`; counts its calls, and at the end of the program adds a line `name,calls`
/// for each rule to the file that EDGEVO_RULES names. `name`: a literal. Cost: a call; not for inner loops.
/// Any thread.
bool rule(const char* name);

}  // namespace edgevo
