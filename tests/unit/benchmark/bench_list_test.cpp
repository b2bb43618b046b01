// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/benchmark/bench_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "edgevo/core/error.h"
#include "edgevo/core/input_file.h"

namespace edgevo {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

BenchList parse(const std::string& text) {
  return parse_bench_list(text, "list", {"glare", "mixed", "dropped"});
}

std::string error_of(const std::string& text) {
  try {
    parse(text);
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

TEST(BenchList, WrittenTextIsReadBackAsTheSameList) {
  const std::string text =
      "seeds: 3 9\nsequences:\n  b:\n    source: scene:lakeshore:winter\n    variants: normal every3+glare\n "
      "   frames: 0:40\n"
      "  a-b:\n    source: /folder of/it\n    camera: c.yaml\n    params: p.yaml\n    variants: mixed\n";
  const BenchList list = parse(text), again = parse(bench_list_yaml(list));
  EXPECT_EQ(again.seeds, list.seeds);
  ASSERT_EQ(again.sequences.size(), 2u);
  EXPECT_EQ(again.sequences[0].source, "scene:lakeshore:winter");
  EXPECT_EQ(again.sequences[0].frames, "0:40");
  EXPECT_EQ(again.sequences[0].variants[1].name, "every3+glare");
  EXPECT_EQ(again.sequences[0].variants[1].every, 3);
  EXPECT_EQ(again.sequences[1].source, "/folder of/it");
  EXPECT_EQ(again.sequences[1].params, "p.yaml");
  EXPECT_EQ(again.sequences[1].camera, "c.yaml");
}

constexpr const char* kOne = "sequences:\n  a:\n    source: x\n";

TEST(BenchList, IsReadInOrderWithItsDefaults) {
  const BenchList list = parse(
      "seeds: 3 1..2, 9\nvariants: normal every3+glare+backward gaps\nsequences:\n  b:\n    source: "
      "scene:desk\n    frames: 0:40\n"
      "  a:\n    source: folder/of it\n    camera: c.yaml\n    params: p.yaml\n    variants: mixed\n");
  EXPECT_THAT(list.seeds, ElementsAre(3, 1, 2, 9));
  ASSERT_EQ(list.sequences.size(), 2u);
  const BenchSequence &b = list.sequences[0], &a = list.sequences[1];
  EXPECT_EQ(b.name, "b");
  EXPECT_EQ(b.source, "scene:desk");
  EXPECT_EQ(b.frames, "0:40");
  EXPECT_EQ(b.where, "list:5");
  ASSERT_EQ(b.variants.size(), 3u);
  EXPECT_EQ(b.variants[0].name, "normal");
  EXPECT_EQ(b.variants[0].every, 1);
  EXPECT_EQ(b.variants[0].light, "");
  EXPECT_FALSE(b.variants[0].backward);
  EXPECT_EQ(b.variants[1].name, "every3+glare+backward");
  EXPECT_TRUE(b.variants[1].backward);
  EXPECT_EQ(b.variants[1].every, 3);
  EXPECT_EQ(b.variants[1].light, "glare");
  EXPECT_FALSE(b.variants[1].gaps);
  EXPECT_TRUE(b.variants[2].gaps);
  EXPECT_FALSE(b.variants[2].backward);
  EXPECT_EQ(a.source, "folder/of it");
  EXPECT_EQ(a.camera, "c.yaml");
  EXPECT_EQ(a.params, "p.yaml");
  ASSERT_EQ(a.variants.size(), 1u);
  EXPECT_EQ(a.variants[0].light, "mixed");
  EXPECT_EQ(list.jobs(), 16);
}

TEST(BenchList, WithoutSeedsAndVariantsThereAreFiveNormalRuns) {
  const BenchList list = parse(kOne);
  EXPECT_THAT(list.seeds, ElementsAre(1, 2, 3, 4, 5));
  EXPECT_EQ(list.jobs(), 5);
}

TEST(BenchList, ErrorsNameTheLine) {
  const std::string one = kOne;
  EXPECT_THAT(error_of(""), HasSubstr("list: names no sequence"));
  EXPECT_THAT(error_of("sequences:\n"), HasSubstr("list: names no sequence"));
  EXPECT_THAT(error_of("sequences:\n  a: x\n"), HasSubstr("list:2: the sequence 'a' is not a group"));
  EXPECT_THAT(error_of("sequences:\n  a:\n    frames: 0:3\n"),
              HasSubstr("list:2: the sequence 'a' has no source"));
  EXPECT_THAT(error_of("sequences:\n  a:\n    source:\n"),
              HasSubstr("list:3: sequences.a.source has no value"));
  EXPECT_THAT(error_of("sequences:\n  a.b:\n    source: x\n"),
              HasSubstr("list:2: a sequence's name contains a dot"));
  EXPECT_THAT(error_of(one + "    every: 3\n"), HasSubstr("list:4: unknown parameter 'sequences.a.every'"));
  EXPECT_THAT(error_of(one + "  a:\n    source: y\n"), HasSubstr("list:4: "));
  EXPECT_THAT(error_of(one + "seed: 1\n"),
              HasSubstr("list:4: unknown parameter 'seed'; did you mean 'seeds'?"));
  for (const char* seeds : {"x", "-1", "3..1", "1..", "1...3", "1.5", "0..1000"})
    EXPECT_THAT(error_of(one + "seeds: " + seeds + "\n"),
                HasSubstr(std::string("list:4: '") + seeds + "' is not a seed"));
  EXPECT_THAT(error_of(one + "seeds: 1..3 2\n"), HasSubstr("list:4: the seed 2 is given twice"));
  EXPECT_THAT(error_of(one + "variants: glaree\n"),
              HasSubstr("list:4: unknown variant 'glaree'; did you mean 'glare'?"));
  for (const char* variant : {"every", "every0", "every-2", "everyone", "every3x"})
    EXPECT_THAT(error_of(one + "variants: " + variant + "\n"),
                HasSubstr(std::string("unknown variant '") + variant));
  EXPECT_THAT(error_of(one + "variants: normal +\n"), HasSubstr("list:4: '+' is not a variant"));
  EXPECT_THAT(error_of(one + "variants: glare+mixed\n"),
              HasSubstr("list:4: 'glare+mixed' changes the light twice"));
  EXPECT_THAT(error_of(one + "    variants: normal normal\n"),
              HasSubstr("list:4: the variant 'normal' is given twice"));
  EXPECT_THAT(error_of(one + "variants: ','\n"), HasSubstr("list:4: names no variant"));
}

// ---- settings ----

const std::string kSettings = "set:\n  few: mapping.window.max_points=500\n  both: a.b=1 c=two\n";

std::vector<std::string> names_of(const BenchSequence& sequence) {
  std::vector<std::string> names;
  for (const BenchVariant& variant : sequence.variants) names.push_back(variant.name);
  return names;
}

TEST(BenchList, EachVariantIsRunWithoutAndWithEachSetting) {
  const BenchSequence a = parse("variants: normal every3\n" + kSettings + kOne).sequences[0];
  EXPECT_THAT(names_of(a),
              ElementsAre("normal", "normal+few", "normal+both", "every3", "every3+few", "every3+both"));
  EXPECT_TRUE(a.variants[0].settings.empty());
  ASSERT_EQ(a.variants[5].settings.size(), 1u);
  EXPECT_EQ(a.variants[5].every, 3);
  EXPECT_EQ(a.variants[5].settings[0].name, "both");
  EXPECT_EQ(a.variants[5].settings[0].where, "list:4");
  EXPECT_THAT(a.variants[5].settings[0].assignments, ElementsAre("a.b=1", "c=two"));
}

TEST(BenchList, VariantsThatNameASettingAreRunUnchanged) {
  const BenchSequence a = parse("variants: normal every3+few+both\n" + kSettings + kOne).sequences[0];
  EXPECT_THAT(names_of(a), ElementsAre("normal", "every3+few+both"));
  EXPECT_EQ(a.variants[1].settings.size(), 2u);
}

TEST(BenchList, SettingsAreWrittenAndReadBackTheSame) {
  const BenchList list = parse("variants: normal mixed\n" + kSettings + kOne);
  const std::string text = bench_list_yaml(list);
  const BenchList again = parse(text);
  EXPECT_EQ(bench_list_yaml(again), text);
  EXPECT_EQ(names_of(again.sequences[0]), names_of(list.sequences[0]));
  EXPECT_THAT(again.sequences[0].variants[2].settings[0].assignments, ElementsAre("a.b=1", "c=two"));
}

TEST(BenchList, ABadSettingIsReportedWithItsLine) {
  const std::string one = kOne;
  EXPECT_THAT(error_of("set:\n" + one), HasSubstr("list:1: names no setting"));
  EXPECT_THAT(error_of("set:\n  a:\n" + one), HasSubstr("list:2: set.a has no value"));
  EXPECT_THAT(error_of("set:\n  a: ''\n" + one), HasSubstr("list:2: the setting 'a' is empty"));
  for (const char* name : {"a.b", "glare", "normal", "every7", "gaps"})
    EXPECT_THAT(error_of(std::string("set:\n  ") + name + ": k=1\n" + one),
                HasSubstr(std::string("list:2: '") + name + "' cannot be the name of a setting"));
  EXPECT_THAT(error_of("variants: normal+fw\n" + kSettings + one), HasSubstr("did you mean 'few'?"));
  EXPECT_THAT(error_of("variants: few+few\n" + kSettings + one),
              HasSubstr("list:1: 'few+few' names the setting 'few' twice"));
}

// 28 November 2026, 23:59 UTC.
constexpr std::chrono::system_clock::time_point kEvening{std::chrono::seconds(1795910340)};

TEST(SceneSeed, IsTheNumberOfDaysUntilTodayOfGreenwich) {
  const std::string rule = "days_since 2026-01-01";
  EXPECT_EQ(parse_scene_seed(rule, "list:2", kEvening), 331u);
  EXPECT_EQ(parse_scene_seed(rule, "list:2", kEvening + std::chrono::minutes(1)), 332u);
  EXPECT_EQ(parse_scene_seed(rule, "list:2", kEvening - std::chrono::hours(24 * 331)), 0u);
  EXPECT_EQ(parse_scene_seed("days_since 2024-02-28", "list:2", kEvening), 1004u) << "a leap year";
  EXPECT_EQ(parse_scene_seed("331", "list:2", kEvening), 331u);
}

TEST(SceneSeed, OtherTextsAreRefusedWithTheirLine) {
  const auto error = [](const std::string& text) {
    try {
      parse_bench_list("seeds: 1\nscene_seed: " + text + "\nsequences:\n  a:\n    source: scene:desk\n",
                       "list", {}, {}, kEvening);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  for (const char* text :
       {"-1", "7a", "days_since yesterday", "days_since 2026-02-29", "days_since 2026-13-01",
        "days_since 2026-1-1", "days_since 2026-11-29", "days_until 2027-01-01"})
    EXPECT_THAT(error(text), HasSubstr("list:2: ")) << text;
  EXPECT_EQ(error("days_since 2026-11-28"), "no error");
}

TEST(SceneSeed, BelongsToTheScenesOfTheList) {
  const std::string text =
      "seeds: 1\nscene_seed: days_since 2026-01-01\nsequences:\n  a:\n    source: recorded\n";
  EXPECT_THAT(error_of(text), HasSubstr("list:2: the list renders no scene"));
  BenchList list = parse_bench_list(text + "  b:\n    source: scene:desk\n", "list", {}, {}, kEvening);
  EXPECT_EQ(list.scene_seed, 331u);
  EXPECT_EQ(list.sequences[0].scene_seed, std::nullopt);
  EXPECT_EQ(list.sequences[1].scene_seed, 331u);
  set_scene_seed(9, "--scene-seed", &list);
  EXPECT_EQ(list.sequences[1].scene_seed, 9u);
  const BenchList tomorrow =
      parse_bench_list(bench_list_yaml(list), "copy", {}, {}, kEvening + std::chrono::hours(24));
  EXPECT_EQ(tomorrow.sequences[1].scene_seed, 9u) << "a list that is run on keeps its scenes";
}

TEST(BenchList, ShippedListsAreRead) {
  const std::vector<std::string> lights{"drift",   "jumps", "gamma", "vignette", "glare", "blooming",
                                        "shadows", "blur",  "noise", "dropped",  "mixed"};
  for (const auto& [name, jobs] :
       {std::pair("rendered", 100), {"real", 170}, {"lights", 300}, {"ablation", 2166}, {"unseen", 27}}) {
    const std::string path = std::string(EDGEVO_SOURCE_DIR) + "/share/bench/" + name + ".yaml";
    EXPECT_EQ(parse_bench_list(read_file(path, ""), path, lights).jobs(), jobs);
  }
}

BenchList parse_with_detectors(const std::string& text) {
  return parse_bench_list(text, "list", {"glare", "mixed", "dropped"}, {"canny", "edge_drawing"});
}

TEST(BenchList, EachVariantIsRunWithEachDetector) {
  const BenchList list = parse_with_detectors(
      "seeds: 1\nvariants: normal every3\ndetectors: canny precomputed:edge_drawing\n" + std::string(kOne));
  const std::vector<BenchVariant>& variants = list.sequences[0].variants;
  ASSERT_EQ(variants.size(), 4u);
  EXPECT_EQ(variants[0].name, "normal+canny");
  EXPECT_EQ(variants[0].detector, "canny");
  EXPECT_EQ(variants[3].name, "every3+precomputed:edge_drawing");
  EXPECT_EQ(variants[3].detector, "precomputed:edge_drawing");
  EXPECT_EQ(variants[3].every, 3);
  EXPECT_EQ(parse_with_detectors(kOne).sequences[0].variants[0].detector, "");
}

TEST(BenchList, AnUnknownDetectorSuggestsTheNearest) {
  try {
    parse_with_detectors("detectors: cany\n" + std::string(kOne));
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("list:1: unknown detector 'cany'; did you mean 'canny'"));
  }
}

TEST(BenchList, IsWrittenAndReadBackTheSame) {
  const BenchList list = parse_with_detectors(
      "seeds: 3 1..2\nvariants: normal every3+glare\ndetectors: canny\nsequences:\n  b:\n    source: \"it: "
      "is\"\n    frames: 0:40\n"
      "  a:\n    source: folder/of it\n    camera: c.yaml\n    params: p.yaml\n    variants: mixed\n");
  const std::string text = bench_list_yaml(list);
  const BenchList again = parse_with_detectors(text);
  EXPECT_EQ(bench_list_yaml(again), text);
  EXPECT_EQ(again.seeds, list.seeds);
  ASSERT_EQ(again.sequences.size(), 2u);
  EXPECT_EQ(again.sequences[0].source, "it: is");
  EXPECT_EQ(again.sequences[0].variants[1].name, "every3+glare+canny");
  EXPECT_EQ(again.sequences[1].camera, "c.yaml");
  EXPECT_EQ(again.sequences[1].variants[0].detector, "canny");
}

}  // namespace
}  // namespace edgevo
