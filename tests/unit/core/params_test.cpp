// SPDX-License-Identifier: BSD-3-Clause
// Strict reading of parameters: anything not understood is an error that says what is accepted.
#include "edgevo/core/params.h"

#include <gmock/gmock.h>

#include <fstream>

#include "edgevo/core/error.h"
#include "edgevo/core/random.h"
#include "support/temp_folder.h"

namespace edgevo {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

struct EdgeParams {
  double percentile = 0.9;
  std::string detector = "canny";
  void visit(ParamVisitor& v) {
    v.number(kBasic, "percentile", percentile, 0.5, 0.99, "share of pixels below the threshold");
    v.text(kExperimental, "detector", detector, {"canny", "edge_drawing", "structured"}, "which detector");
  }
};

struct TestParams {
  int window = 7, patch = 5;
  bool realtime = false;
  std::string model;
  EdgeParams edges;
  void visit(ParamVisitor& v) {
    {
      auto g = v.group("mapping");
      v.integer(kAdvanced, "window", window, 3, 20, "keyframes");
      v.odd(kAdvanced, "patch", patch, 3, 11, "side of a patch");
      auto inner = v.group("deep");
      v.boolean(kAdvanced, "realtime", realtime, "two threads");
    }
    v.text(kBasic, "model", model, {}, "file of a network");
    auto g = v.group("edges");
    edges.visit(v);
  }
};

VisitParams visitor(TestParams* p) {
  return [p](ParamVisitor& v) { p->visit(v); };
}

TestParams read(const std::string& yaml) {
  TestParams p;
  read_params(yaml, "p.yaml", visitor(&p));
  return p;
}

std::string params_error_of(const std::string& yaml) {
  try {
    read(yaml);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(Params, OverwritesOnlyNamedFields) {
  const TestParams p = read("edges:\n  percentile: 0.75\nmapping:\n  deep:\n    realtime: true\n");
  EXPECT_EQ(p.edges.percentile, 0.75);
  EXPECT_TRUE(p.realtime);
  EXPECT_EQ(p.window, 7);
  EXPECT_EQ(p.edges.detector, "canny");
}

TEST(Params, OddNumbersAreOdd) {
  EXPECT_EQ(read("mapping:\n  patch: 7\n").patch, 7);
  EXPECT_THAT(params_error_of("mapping:\n  patch: 6\n"),
              StartsWith("p.yaml:2: mapping.patch: '6' is even; write an odd number"));
  EXPECT_THAT(params_error_of("mapping:\n  patch: 13\n"), HasSubstr("between 3 and 11"));
  EXPECT_THAT(params_error_of("mapping:\n  patch: 5.5\n"), HasSubstr("not a whole number"));
  TestParams p;
  EXPECT_THAT(write_params(visitor(&p), 0, true), HasSubstr("patch: 5  # side of a patch; [3, 11], odd\n"));
}

TEST(Params, EmptyTextAndEmptyGroupsChangeNothing) {
  EXPECT_EQ(read("").window, 7);
  EXPECT_EQ(read(" \n\n").window, 7);
  EXPECT_EQ(read("# only a comment\n").window, 7);
  EXPECT_EQ(read("mapping:\nedges:\n  detector: canny\n").window, 7);
}

TEST(Params, AnUnknownKeyOffersTheNearestName) {
  EXPECT_EQ(params_error_of("mapping:\n  windw: 9\n"),
            "p.yaml:2: unknown parameter 'mapping.windw'; did you mean 'mapping.window'?");
  EXPECT_THAT(params_error_of("window: 9\n"), HasSubstr("did you mean 'mapping.window'?"));
  EXPECT_THAT(params_error_of("edges:\n  percentile:\n    x: 1\n"),
              HasSubstr("p.yaml:2: edges.percentile has no value"));
  EXPECT_THAT(params_error_of("nonsense:\n"),
              HasSubstr("unknown parameter 'nonsense'"));  // even without a value
}

TEST(Params, ARangeIsStatedInASentence) {
  EXPECT_EQ(params_error_of("mapping:\n  window: 99\n"),
            "p.yaml:2: mapping.window: '99' is out of range; it must be between 3 and 20");
  EXPECT_EQ(params_error_of("edges:\n  percentile: 0.4\n"),
            "p.yaml:2: edges.percentile: '0.4' is out of range; it must be between 0.5 and 0.99");
  EXPECT_THAT(params_error_of("edges:\n  percentile: .nan\n"), Not(""));
  EXPECT_EQ(read("mapping:\n  window: 20\n").window, 20);
  EXPECT_EQ(read("edges:\n  percentile: 0.5\n").edges.percentile, 0.5);
}

TEST(Params, AWrongTypeIsAnError) {
  EXPECT_THAT(params_error_of("mapping:\n  window: many\n"), HasSubstr("'many' is not a number"));
  EXPECT_THAT(params_error_of("mapping:\n  window: 7.5\n"), HasSubstr("'7.5' is not a whole number"));
  EXPECT_THAT(params_error_of("mapping:\n  window: 7px\n"), HasSubstr("'7px' is not a number"));
  EXPECT_THAT(params_error_of("mapping:\n  window: 0x7\n"), HasSubstr("'0x7' is not a number"));
  EXPECT_THAT(params_error_of("mapping:\n  deep:\n    realtime: yes\n"),
              HasSubstr("'yes' is neither true nor false"));
  EXPECT_THAT(params_error_of("mapping:\n  window:\n"), HasSubstr("mapping.window has no value"));
  EXPECT_THAT(params_error_of("edges: 3\n"), HasSubstr("edges is a group of parameters, not a value"));
  EXPECT_THAT(params_error_of("mapping:\n  window: [7, 8]\n"), HasSubstr("p.yaml:2: contains a list"));
  EXPECT_THAT(params_error_of("edges:\n  - percentile: 0.6\n"), HasSubstr("p.yaml:2: contains a list"));
}

TEST(Params, AChoiceOffersTheNearest) {
  EXPECT_THAT(params_error_of("edges:\n  detector: edge_drawin\n"),
              AllOf(HasSubstr("'edge_drawin' is not one of canny, edge_drawing, structured"),
                    HasSubstr("did you mean edge_drawing?")));
}

TEST(Params, AnythingButNestedKeysAndValuesIsRefused) {
  EXPECT_THAT(params_error_of("just some words\n"), StartsWith("p.yaml:1: is not readable as `key: value`"));
  EXPECT_THAT(params_error_of("- 1\n- 2\n"), StartsWith("p.yaml:1: contains a list"));
  EXPECT_THAT(params_error_of("edges: {percentile: 0.6\n"), HasSubstr("contains a list or a { } map"));
  EXPECT_THAT(params_error_of("a: b: c\n"), HasSubstr("contains a second colon"));
  EXPECT_THAT(params_error_of("model:x\n"), HasSubstr("is not readable as `key: value`"));
  EXPECT_THAT(params_error_of("model: 'x\n"), HasSubstr("a quote is not closed"));
  EXPECT_THAT(params_error_of("model: \"x\n"), HasSubstr("a quote is not closed"));
  EXPECT_THAT(params_error_of("model: 'x' y\n"), HasSubstr("something follows the closing quote"));
  EXPECT_THAT(params_error_of("model: \"\\q\"\n"), HasSubstr("an escape"));
  EXPECT_THAT(params_error_of("model: |\n  text\n"), HasSubstr("a value cannot begin with |"));
  EXPECT_THAT(params_error_of("model: *alias\n"), HasSubstr("a value cannot begin with *"));
  EXPECT_THAT(params_error_of("model: ~\n"), HasSubstr("model has no value"));
  EXPECT_THAT(params_error_of("model: a\n---\nmodel: b\n"), HasSubstr("p.yaml:2: begins a second document"));
}

TEST(Params, IndentationIsChecked) {
  EXPECT_THAT(params_error_of("edges:\n\tpercentile: 0.6\n"), HasSubstr("p.yaml:2: is indented with a tab"));
  EXPECT_THAT(params_error_of("model: a\n  window: 7\n"),
              HasSubstr("p.yaml:2: is indented more than the line above"));
  EXPECT_THAT(params_error_of("mapping:\n    window: 7\n  deep:\n"), HasSubstr("p.yaml:3: does not align"));
  EXPECT_EQ(read("  mapping:\n      window: 9\n  model: a\n").window, 9);  // as write_params indents
}

TEST(Params, AKeyGivenTwiceIsAnError) {
  EXPECT_EQ(params_error_of("model: a\nmodel: b\n"), "p.yaml:2: model was given in line 1 already; keep one");
  EXPECT_THAT(params_error_of("edges:\nmodel: a\nedges:\n  percentile: 0.6\n"),
              HasSubstr("edges was given in line 1"));
}

TEST(Params, CommentsQuotesAndCarriageReturns) {
  EXPECT_EQ(read("---  # parameters\r\nmodel: a#b  # why\r\n").model, "a#b");
  EXPECT_EQ(read("model: 'it''s: # no comment'\n").model, "it's: # no comment");
  EXPECT_EQ(read("model: \"a\\tb\\\\\\\"\"\n").model, "a\tb\\\"");
  EXPECT_EQ(read("model: C:/data\n").model, "C:/data");
}

// Damages a good file at random: it is either read, within the ranges, or fails with a message of one line.
TEST(Params, SurvivesDamagedFiles) {
  Random random(11);
  const std::string good =
      "# p\nmapping:\n  window: 9\n  deep:\n    realtime: true\nmodel: 'a'\nedges:\n  percentile: 0.6\n";
  constexpr char kAlphabet[] = "abw:.-#'\"\\[]{}|>&*!%@~ \n\r\t0129e\x80\xff";
  int accepted = 0, refused = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    std::string text = good;
    for (int changes = 1 + random.below(3); changes > 0; --changes) {
      const size_t at = size_t(random.below(int(text.size())));
      if (random.below(2))
        text.insert(at, 1, kAlphabet[random.below(int(sizeof kAlphabet))]);
      else
        text.erase(at, size_t(1 + random.below(5)));
    }
    try {
      const TestParams p = read(text);
      ++accepted;
      ASSERT_TRUE(p.window >= 3 && p.window <= 20 && p.edges.percentile >= 0.5 && p.edges.percentile <= 0.99)
          << text;
    } catch (const InputError& e) {
      ++refused;
      ASSERT_EQ(std::string(e.what()).find_first_of("\r\n"), std::string::npos) << text;
    }
  }
  EXPECT_GT(accepted, 300);
  EXPECT_GT(refused, 1000);
}

TEST(Params, MessagesAreOneLine) {
  for (const char* yaml :
       {"mapping:\n  window: \"1\\n2\"\n", "\"a\\nb\": 1\n", "edges:\n  detector: \"x\\ny\"\n"}) {
    const std::string error = params_error_of(yaml);
    EXPECT_FALSE(error.empty());
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  }
}

TEST(Params, AnErrorLeavesNoHalfReadFile) {
  TestParams p;
  EXPECT_THROW(read_params("edges:\n  percentile: 0.6\nunknown: 1\n", "p.yaml", visitor(&p)), InputError);
  EXPECT_EQ(p.edges.percentile, 0.9);
}

TEST(Params, WrittenValuesReadBackUnchanged) {
  TestParams p;
  p.window = 11;
  p.realtime = true;
  p.edges.percentile = 0.5 + 1.0 / 3.0;
  p.edges.detector = "structured";
  for (const char* model : {"",       "a/b.yml",     "C: odd #name", "'quoted'", "\"double\"", "true", "12",
                            "- dash", " blank ",     "[list]",       "{map}",    "*star",      "&amp", "null",
                            "~",      "back\\slash", "two\nlines",   "it's",     "-",          "a:",   "x: y",
                            "\t"}) {
    p.model = model;
    for (bool comments : {false, true}) {
      const TestParams q = read(write_params(visitor(&p), 0, comments));
      EXPECT_EQ(q.model, p.model);
      EXPECT_EQ(q.window, 11);
      EXPECT_TRUE(q.realtime);
      EXPECT_EQ(q.edges.percentile, p.edges.percentile);
      EXPECT_EQ(q.edges.detector, "structured");
    }
  }
}

TEST(Params, WritesInTheOrderOfVisitWithHelpAndRange) {
  TestParams p;
  EXPECT_EQ(write_params(visitor(&p), 2),
            "  mapping:\n    window: 7\n    patch: 5\n    deep:\n      realtime: false\n  model: ''\n  "
            "edges:\n    percentile: 0.9\n"
            "    detector: canny\n");
  EXPECT_THAT(write_params(visitor(&p), 0, true), HasSubstr("window: 7  # keyframes; [3, 20]"));
  EXPECT_THAT(write_params(visitor(&p), 0, true), HasSubstr("canny | edge_drawing | structured"));
}

TEST(Params, BasicParametersLeaveNoEmptyGroups) {
  TestParams p;
  EXPECT_EQ(write_basic_params(visitor(&p)),
            "model: ''  # file of a network\n"
            "edges:\n  percentile: 0.9  # share of pixels below the threshold; [0.5, 0.99]\n");
}

TEST(Params, AreDescribedOneByOne) {
  TestParams p;
  const std::vector<ParamDescription> all = describe_params(visitor(&p));
  ASSERT_EQ(all.size(), 6u);
  EXPECT_EQ(all[1].key, "mapping.patch");
  EXPECT_EQ(all[1].range, "[3, 11], odd");
  EXPECT_EQ(all[2].key, "mapping.deep.realtime");
  EXPECT_EQ(all[2].value, "false");
  EXPECT_EQ(all[2].level, ParamLevel::kAdvanced);
  EXPECT_EQ(all[3].range, "") << "free text";
  EXPECT_EQ(all[5].key, "edges.detector");
  EXPECT_STREQ(to_string(all[5].level), "experimental");
  EXPECT_EQ(all[5].help, "which detector");
}

// A file other than a parameter file: its keys have no level.
TEST(Params, KeysWithoutALevelAreReadTheSameWay) {
  struct Scene {
    int frames = 0;
    void visit(KeyVisitor& v) { v.integer("frames", frames, 1, 100, "number of images"); }
  } scene;
  read_params("frames: 7\n", "scene.yaml", [&](ParamVisitor& v) { scene.visit(v); });
  EXPECT_EQ(scene.frames, 7);
}

TEST(Params, ASingleAssignment) {
  TestParams p;
  set_param("mapping.window=9", visitor(&p));
  EXPECT_EQ(p.window, 9);
  set_param("model=a=b", visitor(&p));
  EXPECT_EQ(p.model, "a=b");
  set_param("model=", visitor(&p));
  EXPECT_EQ(p.model, "");
  EXPECT_THROW(set_param("mapping.window", visitor(&p)), InputError);
  EXPECT_THROW(set_param("=3", visitor(&p)), InputError);
  EXPECT_THROW(set_param("mapping.window=", visitor(&p)), InputError);
  EXPECT_THROW(set_param("mapping=3", visitor(&p)), InputError);
  EXPECT_THROW(set_param("mapping.windw=3", visitor(&p)), InputError);
}

TEST(Params, AMissingFileOrAFolderIsAnError) {
  TestParams p;
  EXPECT_THROW(read_params_file("/nonexistent/p.yaml", visitor(&p)), InputError);
  EXPECT_THROW(read_params_file(::testing::TempDir(), visitor(&p)), InputError);
}

TEST(Params, ReadsAFile) {
  const test::TempFolder folder;
  const std::string path = folder / "params.yaml";
  std::ofstream(path) << "mapping:\n  window: 5\n";
  TestParams p;
  read_params_file(path, visitor(&p));
  EXPECT_EQ(p.window, 5);
  std::ofstream(path, std::ios::trunc).close();
  EXPECT_NO_THROW(read_params_file(path, visitor(&p)));  // an empty file changes nothing
  EXPECT_EQ(p.window, 5);
}

}  // namespace
}  // namespace edgevo
