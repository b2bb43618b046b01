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

// The texts of the file, strictly read, and where each key stands.
struct RawList {
  std::string seeds = "1..5", variants = "normal", detectors;
  std::vector<BenchSequence> sequences;
  std::vector<std::string> sequence_variants;    // of each sequence; empty: those of all
  std::map<std::string, std::string> locations;  // dotted key -> "file:line"
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

// True for `text` that is one whole number and nothing else.
template <class T>
bool whole(const std::string& text, T* value) {
  const auto read = std::from_chars(text.data(), text.data() + text.size(), *value);
  return read.ec == std::errc() && read.ptr == text.data() + text.size();
}

void add_seeds(const std::string& word, const std::string& where, std::vector<uint64_t>* seeds) {
  constexpr uint64_t kMost = 1000;  // seeds of a range: more is a slip of the pen
  const size_t dots = word.find("..");
  uint64_t first = 0, last = 0;
  const bool good = dots == std::string::npos
                        ? whole(word, &first) && whole(word, &last)
                        : whole(word.substr(0, dots), &first) && whole(word.substr(dots + 2), &last);
  if (!good || last < first || last - first >= kMost)
    throw InputError(where, "'" + word + "' is no seed",
                     "write whole numbers as `1 2 7` or `1..5`, a thousand at most");
  for (uint64_t i = 0; i <= last - first; ++i) {
    if (std::find(seeds->begin(), seeds->end(), first + i) != seeds->end())
      throw InputError(where, "the seed " + std::to_string(first + i) + " stands there twice", "keep one");
    seeds->push_back(first + i);
  }
}

// What the words of a variant may be, besides those that are always known.
struct KnownWords {
  std::vector<std::string> lights, detectors;
};

bool holds(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

bool is_detector(const std::string& word, const KnownWords& known) {
  constexpr std::string_view kPrecomputed = "precomputed:";
  const bool precomputed = word.compare(0, kPrecomputed.size(), kPrecomputed) == 0;
  return holds(known.detectors, precomputed ? word.substr(kPrecomputed.size()) : word);
}

[[noreturn]] void unknown_word(const std::string& word, const std::string& where, const KnownWords& known) {
  std::vector<std::string> all = known.lights;
  all.insert(all.end(), known.detectors.begin(), known.detectors.end());
  all.insert(all.end(), {"normal", "every3", "backward", "gaps"});
  throw InputError(where, "unknown variant '" + word + "'",
                   "did you mean '" + nearest_name(word, all) + "'?");
}

void set_once(std::string* field, const std::string& word, const std::string& where,
              const std::string& what) {
  if (!field->empty()) throw InputError(where, what + " twice", "keep one");
  *field = word;
}

void add_effect(const std::string& word, const std::string& where, const KnownWords& known,
                BenchVariant* variant) {
  constexpr std::string_view kEvery = "every";
  const bool thins = word.compare(0, kEvery.size(), kEvery) == 0;
  if (thins && whole(word.substr(kEvery.size()), &variant->every) && variant->every >= 1) return;
  if (word == "normal") return;
  if (word == "backward" || word == "gaps") {
    (word == "gaps" ? variant->gaps : variant->backward) = true;
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
      throw InputError(where, "the variant '" + name + "' stands there twice", "keep one");
    BenchVariant variant;
    variant.name = name;
    if (words(name, "+").empty())
      throw InputError(where, "'" + name + "' is no variant", "write for example every3+glare");
    for (const std::string& word : words(name, "+")) add_effect(word, where, known, &variant);
    variants.push_back(variant);
  }
  if (variants.empty()) throw InputError(where, "names no variant", "write for example `variants: normal`");
  return variants;
}

// Each variant by each of the detectors.
std::string crossed(const std::string& variants, const std::string& detectors) {
  std::string all;
  for (const std::string& variant : words(variants, " \t,"))
    for (const std::string& detector : words(detectors, " \t,")) all += variant + "+" + detector + " ";
  return all.empty() ? variants : all;
}

// Sequences have names of the user's choosing: a first look finds them, so that the strict reader knows all
// keys.
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
      throw InputError(list->location(entry.key), "a sequence's name holds a dot",
                       "use letters, digits, - and _");
    names.insert(name);
    BenchSequence sequence;
    sequence.name = name;
    sequence.where = list->location(entry.key);
    list->sequences.push_back(sequence);
  }
  list->sequence_variants.resize(list->sequences.size());
}

void visit(ParamVisitor& v, RawList* list) {
  v.text("seeds", list->seeds, {}, "");
  v.text("variants", list->variants, {}, "");
  v.text("detectors", list->detectors, {}, "");
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
  find_sequences(parse_block_yaml(text, where), &list);
  read_params(text, where, [&](ParamVisitor& v) { visit(v, &list); });
  if (list.sequences.empty()) throw InputError(where, "names no sequence", "see share/bench/rendered.yaml");
  return list;
}

void check_detectors(const RawList& raw, const KnownWords& known) {
  for (const std::string& word : words(raw.detectors, " \t,"))
    if (!is_detector(word, known))
      throw InputError(raw.location("detectors"), "unknown detector '" + word + "'",
                       "did you mean '" + nearest_name(word, known.detectors) + "'?");
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
                           const std::vector<std::string>& lights,
                           const std::vector<std::string>& detectors) {
  const KnownWords known{lights, detectors};
  RawList raw = read_raw(text, where);
  check_detectors(raw, known);
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
    s.variants = parse_variants(crossed(own.empty() ? raw.variants : own, raw.detectors), location, known);
    list.sequences.push_back(s);
  }
  return list;
}

std::string bench_list_yaml(const BenchList& list) {
  RawList raw;
  raw.seeds.clear();
  for (const uint64_t seed : list.seeds) raw.seeds += (raw.seeds.empty() ? "" : " ") + std::to_string(seed);
  raw.sequences = list.sequences;
  for (const BenchSequence& s : list.sequences) {
    std::string names;
    for (const BenchVariant& variant : s.variants) names += (names.empty() ? "" : " ") + variant.name;
    raw.sequence_variants.push_back(names);
  }
  return write_params([&](ParamVisitor& v) { visit(v, &raw); });
}

}  // namespace edgevo
