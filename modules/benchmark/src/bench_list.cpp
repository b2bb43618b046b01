// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/benchmark/bench_list.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <set>
#include <sstream>

#include "edgevo/core/block_yaml.h"
#include "edgevo/core/error.h"
#include "edgevo/core/params.h"

namespace edgevo {
namespace {

constexpr const char* kGroup = "sequences.";
constexpr const char* kSetGroup = "set.";

// Texts of the file, strictly read, and the location of each key.
struct RawList {
  std::string seeds = "1..5", variants = "normal", detectors, scene_seed;
  std::vector<BenchSequence> sequences;
  std::vector<std::string> sequence_variants;                 // of each sequence; empty: the default
  std::vector<std::pair<std::string, std::string>> settings;  // name and its assignments
  std::map<std::string, std::string> locations;               // dotted key -> "file:line"
  std::string file;

  std::string location(const std::string& key) const {
    const auto it = locations.find(key);
    return it == locations.end() ? file : it->second;
  }
};

std::vector<std::string> words(const std::string& text, const char* separators) {
  std::vector<std::string> all;
  for (size_t begin = 0; (begin = text.find_first_not_of(separators, begin)) != std::string::npos;) {
    const size_t end = std::min(text.find_first_of(separators, begin), text.size());
    all.push_back(text.substr(begin, end - begin));
    begin = end;
  }
  return all;
}

// Whether `text` is an integer and nothing else.
template <class T>
bool whole(const std::string& text, T* value) {
  const auto read = std::from_chars(text.data(), text.data() + text.size(), *value);
  return read.ec == std::errc() && read.ptr == text.data() + text.size();
}

void add_seeds(const std::string& word, const std::string& where, std::vector<uint64_t>* seeds) {
  constexpr uint64_t kMax = 1000;  // seeds of a range: more is a typing error
  const size_t dots = word.find("..");
  uint64_t first = 0, last = 0;
  const bool good = dots == std::string::npos
                        ? whole(word, &first) && whole(word, &last)
                        : whole(word.substr(0, dots), &first) && whole(word.substr(dots + 2), &last);
  if (!good || last < first || last - first >= kMax)
    throw InputError(where, "'" + word + "' is not a seed",
                     "write whole numbers as `1 2 7` or `1..5`, a thousand at most");
  for (uint64_t i = 0; i <= last - first; ++i) {
    if (std::find(seeds->begin(), seeds->end(), first + i) != seeds->end())
      throw InputError(where, "the seed " + std::to_string(first + i) + " is given twice", "keep one");
    seeds->push_back(first + i);
  }
}

// Allowed words of a variant, besides the built-in ones.
struct KnownWords {
  std::vector<std::string> lights, detectors;
  std::vector<BenchSetting> settings;
};

const BenchSetting* find_setting(const std::string& name, const std::vector<BenchSetting>& settings) {
  const auto it =
      std::find_if(settings.begin(), settings.end(), [&](const auto& s) { return s.name == name; });
  return it != settings.end() ? &*it : nullptr;
}

bool holds(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

bool is_detector(const std::string& word, const KnownWords& known) {
  const bool precomputed = word.compare(0, kPrecomputedPrefix.size(), kPrecomputedPrefix) == 0;
  return holds(known.detectors, precomputed ? word.substr(kPrecomputedPrefix.size()) : word);
}

[[noreturn]] void unknown_word(const std::string& word, const std::string& where, const KnownWords& known) {
  std::vector<std::string> all = known.lights;
  all.insert(all.end(), known.detectors.begin(), known.detectors.end());
  all.insert(all.end(), {"normal", "every3", "backward", "gaps"});
  for (const BenchSetting& setting : known.settings) all.push_back(setting.name);
  throw InputError(where, "unknown variant '" + word + "'",
                   "did you mean '" + nearest_name(word, all) + "'?");
}

void set_once(std::string* field, const std::string& word, const std::string& where,
              const std::string& what) {
  if (!field->empty()) throw InputError(where, what + " twice", "keep one");
  *field = word;
}

// Handles the words for order and selection of frames; false for any other word.
bool changes_order(const std::string& word, BenchVariant* variant) {
  constexpr std::string_view kEvery = "every";
  const bool thins = word.compare(0, kEvery.size(), kEvery) == 0;
  if (thins && whole(word.substr(kEvery.size()), &variant->every) && variant->every >= 1) return true;
  if (word == "backward" || word == "gaps") (word == "gaps" ? variant->gaps : variant->backward) = true;
  return word == "normal" || word == "backward" || word == "gaps";
}

void add_effect(const std::string& word, const std::string& where, const KnownWords& known,
                BenchVariant* variant) {
  if (changes_order(word, variant)) return;
  if (const BenchSetting* setting = find_setting(word, known.settings)) {
    if (find_setting(word, variant->settings))
      throw InputError(where, "'" + variant->name + "' names the setting '" + word + "' twice", "keep one");
    variant->settings.push_back(*setting);
    return;
  }
  if (is_detector(word, known))
    set_once(&variant->detector, word, where, "'" + variant->name + "' names a detector");
  else if (holds(known.lights, word))
    set_once(&variant->light, word, where, "'" + variant->name + "' changes the light");
  else
    unknown_word(word, where, known);
}

std::vector<BenchVariant> parse_variants(const std::string& text, const std::string& where,
                                         const KnownWords& known) {
  std::vector<BenchVariant> variants;
  std::set<std::string> names;
  for (const std::string& name : words(text, " \t,")) {
    if (!names.insert(name).second)
      throw InputError(where, "the variant '" + name + "' is given twice", "keep one");
    BenchVariant variant;
    variant.name = name;
    if (words(name, "+").empty())
      throw InputError(where, "'" + name + "' is not a variant", "write for example every3+glare");
    for (const std::string& word : words(name, "+")) add_effect(word, where, known, &variant);
    variants.push_back(variant);
  }
  if (variants.empty()) throw InputError(where, "names no variant", "write for example `variants: normal`");
  return variants;
}

// Each variant with each of the detectors.
std::string crossed(const std::string& variants, const std::string& detectors) {
  std::string all;
  for (const std::string& variant : words(variants, " \t,"))
    for (const std::string& detector : words(detectors, " \t,")) all += variant + "+" + detector + " ";
  return all.empty() ? variants : all;
}

// Each variant without and with each of the settings; unchanged if one names a setting itself.
std::string with_settings(const std::string& variants, const KnownWords& known) {
  std::string all;
  for (const std::string& variant : words(variants, " \t,")) {
    all += variant + " ";
    for (const BenchSetting& setting : known.settings) all += variant + "+" + setting.name + " ";
  }
  return all;
}

bool name_settings(const std::string& variants, const KnownWords& known) {
  const std::vector<std::string> all = words(variants, " \t,+");
  return std::any_of(all.begin(), all.end(),
                     [&](const std::string& word) { return find_setting(word, known.settings); });
}

bool name_settings(const RawList& raw, const KnownWords& known) {
  return name_settings(raw.variants, known) ||
         std::any_of(raw.sequence_variants.begin(), raw.sequence_variants.end(),
                     [&](const std::string& own) { return name_settings(own, known); });
}

// Settings have user-defined names, too.
void find_settings(const std::vector<YamlEntry>& entries, RawList* list) {
  const auto is_set = [](const YamlEntry& entry) { return entry.key == "set"; };
  for (const YamlEntry& entry : entries)
    if (entry.key.rfind(kSetGroup, 0) == 0)
      list->settings.emplace_back(entry.key.substr(std::string_view(kSetGroup).size()), "");
  if (list->settings.empty() && std::any_of(entries.begin(), entries.end(), is_set))
    throw InputError(list->location("set"), "names no setting",
                     "write `NAME: GROUP.KEY=VALUE` indented below it");
}

// Sequences have user-defined names: a first pass collects them, so that the strict reader knows all keys.
void find_sequences(const std::vector<YamlEntry>& entries, RawList* list) {
  std::set<std::string> names;
  for (const YamlEntry& entry : entries) {
    list->locations[entry.key] = list->file + ":" + std::to_string(entry.line);
    if (entry.key.rfind(kGroup, 0) != 0) continue;
    const std::string name = entry.key.substr(std::string_view(kGroup).size());
    if (names.count(name.substr(0, name.find('.')))) continue;
    if (entry.has_value)
      throw InputError(list->location(entry.key), "the sequence '" + name + "' is not a group",
                       "write its `source: ...` indented below it");
    if (name.find('.') != std::string::npos)
      throw InputError(list->location(entry.key), "a sequence's name contains a dot",
                       "use letters, digits, - and _");
    names.insert(name);
    BenchSequence sequence;
    sequence.name = name;
    sequence.where = list->location(entry.key);
    list->sequences.push_back(sequence);
  }
  list->sequence_variants.resize(list->sequences.size());
}

void visit(KeyVisitor& v, RawList* list) {
  v.text("seeds", list->seeds, {}, "");
  v.text("variants", list->variants, {}, "");
  v.text("scene_seed", list->scene_seed, {}, "");
  v.text("detectors", list->detectors, {}, "");
  if (!list->settings.empty()) {
    const auto set = v.group("set");
    for (auto& [name, assignments] : list->settings) v.text(name.c_str(), assignments, {}, "");
  }
  const auto all = v.group("sequences");
  for (size_t i = 0; i < list->sequences.size(); ++i) {
    BenchSequence& s = list->sequences[i];
    const auto one = v.group(s.name.c_str());
    v.text("source", s.source, {}, "");
    v.text("frames", s.frames, {}, "");
    v.text("camera", s.camera, {}, "");
    v.text("params", s.params, {}, "");
    v.text("variants", list->sequence_variants[i], {}, "");
  }
}

RawList read_raw(const std::string& text, const std::string& where) {
  RawList list;
  list.file = where;
  const std::vector<YamlEntry> entries = parse_block_yaml(text, where);
  find_sequences(entries, &list);
  find_settings(entries, &list);
  read_params(text, where, [&](ParamVisitor& v) { visit(v, &list); });
  if (list.sequences.empty()) throw InputError(where, "names no sequence", "see share/bench/rendered.yaml");
  return list;
}

bool is_known(const std::string& word, const KnownWords& known) {
  BenchVariant ignored;
  return changes_order(word, &ignored) || holds(known.lights, word) || is_detector(word, known);
}

// Parses the entries below `set`; their keys are checked when the runs are planned.
std::vector<BenchSetting> parse_settings(const RawList& raw, const KnownWords& known) {
  std::vector<BenchSetting> settings;
  for (const auto& [name, assignments] : raw.settings) {
    const std::string where = raw.location(kSetGroup + name);
    if (words(name, "+, \t.") != std::vector<std::string>{name} || is_known(name, known))
      throw InputError(where, "'" + name + "' cannot be the name of a setting",
                       "use letters, digits, - and _, and no word that variants have already");
    settings.push_back({name, words(assignments, " \t"), where});
    if (settings.back().assignments.empty())
      throw InputError(where, "the setting '" + name + "' is empty", "write GROUP.KEY=VALUE");
  }
  return settings;
}

void check_detectors(const RawList& raw, const KnownWords& known) {
  for (const std::string& word : words(raw.detectors, " \t,"))
    if (!is_detector(word, known))
      throw InputError(raw.location("detectors"), "unknown detector '" + word + "'",
                       "did you mean '" + nearest_name(word, known.detectors) + "'?");
}

// The settings of the variant that the list does not have yet.
void add_settings(const BenchVariant& variant, RawList* raw) {
  for (const BenchSetting& setting : variant.settings) {
    const auto is_it = [&](const auto& there) { return there.first == setting.name; };
    if (std::any_of(raw->settings.begin(), raw->settings.end(), is_it)) continue;
    std::string text;
    for (const std::string& assignment : setting.assignments) text += (text.empty() ? "" : " ") + assignment;
    raw->settings.emplace_back(setting.name, text);
  }
}

}  // namespace

int BenchList::jobs() const {
  size_t count = 0;
  for (const BenchSequence& s : sequences) count += s.variants.size() * seeds.size();
  return int(count);
}

std::vector<uint64_t> parse_seeds(const std::string& text, const std::string& where) {
  std::vector<uint64_t> seeds;
  for (const std::string& word : words(text, " \t,")) add_seeds(word, where, &seeds);
  if (seeds.empty()) throw InputError(where, "names no seed", "write for example `seeds: 1..5`");
  return seeds;
}

BenchList parse_bench_list(const std::string& text, const std::string& where,
                           const std::vector<std::string>& lights, const std::vector<std::string>& detectors,
                           std::chrono::system_clock::time_point now) {
  KnownWords known{lights, detectors, {}};
  RawList raw = read_raw(text, where);
  check_detectors(raw, known);
  known.settings = parse_settings(raw, known);
  const bool as_named = name_settings(raw, known);
  BenchList list;
  list.seeds = parse_seeds(raw.seeds, raw.location("seeds"));
  for (size_t i = 0; i < raw.sequences.size(); ++i) {
    BenchSequence& s = raw.sequences[i];
    if (s.source.empty())
      throw InputError(s.where, "the sequence '" + s.name + "' has no source",
                       "write `source: ...` indented below it");
    const std::string group = kGroup + s.name, own = raw.sequence_variants[i];
    s.where = raw.location(group + ".source");
    const std::string location = raw.location(own.empty() ? "variants" : group + ".variants");
    const std::string variants = crossed(own.empty() ? raw.variants : own, raw.detectors);
    s.variants = parse_variants(as_named ? variants : with_settings(variants, known), location, known);
    list.sequences.push_back(s);
  }
  const std::string seed_line = raw.location("scene_seed");
  if (!raw.scene_seed.empty())
    set_scene_seed(parse_scene_seed(raw.scene_seed, seed_line, now), seed_line, &list);
  return list;
}

void set_scene_seed(uint64_t seed, const std::string& where, BenchList* list) {
  bool has_scene = false;
  for (BenchSequence& s : list->sequences)
    if (s.is_rendered()) s.scene_seed = seed, has_scene = true;
  if (!has_scene)
    throw InputError(where, "the list renders no scene", "remove it, or name a `source: scene:...`");
  list->scene_seed = seed;
}

std::string bench_list_yaml(const BenchList& list) {
  RawList raw;
  raw.seeds.clear();
  for (const uint64_t seed : list.seeds) raw.seeds += (raw.seeds.empty() ? "" : " ") + std::to_string(seed);
  if (list.scene_seed) raw.scene_seed = std::to_string(*list.scene_seed);
  raw.sequences = list.sequences;
  for (const BenchSequence& s : list.sequences) {
    std::string names;
    for (const BenchVariant& variant : s.variants) names += (names.empty() ? "" : " ") + variant.name;
    raw.sequence_variants.push_back(names);
    for (const BenchVariant& variant : s.variants) add_settings(variant, &raw);
  }
  return write_params([&](ParamVisitor& v) { visit(v, &raw); });
}

}  // namespace edgevo
