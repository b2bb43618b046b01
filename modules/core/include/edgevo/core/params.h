// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Strict parameters in YAML.
//
// A parameter struct has a default for every field and lists its fields once, in visit(). Reading, range
// checks, help and writing the effective values all use that list:
//
//   struct EdgeParams {
//     /// Share.
//     double percentile = 0.9;
//     void visit(ParamVisitor& v) {
//       v.number(kBasic, "percentile", percentile, 0.5, 0.99, "share of pixels ...");
//     }
//   };
//
// Nested structs open a group: { auto g = v.group("edges"); edges.visit(v); }. An unknown
// key is an error that suggests the nearest name; a value out of range is an error that states the range.
// Files that hold no parameters (a scene, a list of sequences) are read in the same way with a KeyVisitor,
// without levels.
#include <functional>
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

namespace edgevo {

/// Audience of a parameter.
enum class ParamLevel {
  /// For every user; params/default.yaml lists only these.
  kBasic,
  /// For users who measure the effect.
  kAdvanced,
  /// Switch or constant of a heuristic, for ablations.
  kExperimental
};
/// Short for ParamLevel::kBasic, for visit().
constexpr ParamLevel kBasic = ParamLevel::kBasic;
/// Short for ParamLevel::kAdvanced, for visit().
constexpr ParamLevel kAdvanced = ParamLevel::kAdvanced;
/// Short for ParamLevel::kExperimental, for visit().
constexpr ParamLevel kExperimental = ParamLevel::kExperimental;

/// Name of the level: "basic", "advanced", "experimental".
const char* to_string(ParamLevel level);

/// Visits the keys of a YAML file: reads, writes or checks ranges.
class KeyVisitor {
 public:
  virtual ~KeyVisitor() = default;
  /// Visits a number in [min, max]; `help` is the text for the user.
  void number(const char* key, double& value, double min, double max, const char* help) {
    on_number(kBasic, key, value, min, max, help);
  }
  /// Visits an integer in [min, max].
  void integer(const char* key, int& value, int min, int max, const char* help) {
    on_integer(kBasic, key, value, min, max, help);
  }
  /// Visits an odd integer in [min, max], such as the side of a patch with a central pixel.
  void odd(const char* key, int& value, int min, int max, const char* help) {
    on_odd(kBasic, key, value, min, max, help);
  }
  /// Visits a Boolean (true or false).
  void boolean(const char* key, bool& value, const char* help) { on_boolean(kBasic, key, value, help); }
  /// Visits a text: free, or one of `choices` if there are any.
  void text(const char* key, std::string& value, const std::vector<std::string>& choices, const char* help) {
    on_text(kBasic, key, value, choices, help);
  }

  /// Opens a group and closes it when the returned guard goes out of scope.
  class Group {
   public:
    /// Guards a group that was just begun.
    explicit Group(KeyVisitor& v) : v_(&v) {}
    ~Group() { v_->end_group(); }
    Group(const Group&) = delete;
    Group& operator=(const Group&) = delete;

   private:
    KeyVisitor* v_;
  };
  /// Begins a group that lasts as long as the returned guard.
  [[nodiscard]] Group group(const char* key) {
    begin_group(key);
    return Group(*this);
  }

 protected:
  /// Handles a number in [min, max].
  virtual void on_number(ParamLevel level, const char* key, double& value, double min, double max,
                         const char* help) = 0;
  /// Handles an integer in [min, max].
  virtual void on_integer(ParamLevel level, const char* key, int& value, int min, int max,
                          const char* help) = 0;
  /// Handles an odd integer; as any integer, unless overridden.
  virtual void on_odd(ParamLevel level, const char* key, int& value, int min, int max, const char* help) {
    on_integer(level, key, value, min, max, help);
  }
  /// Handles a Boolean.
  virtual void on_boolean(ParamLevel level, const char* key, bool& value, const char* help) = 0;
  /// Handles a text.
  virtual void on_text(ParamLevel level, const char* key, std::string& value,
                       const std::vector<std::string>& choices, const char* help) = 0;
  /// Begins the group `key`, to which the following keys belong.
  virtual void begin_group(const char* key) = 0;
  /// Ends the innermost group.
  virtual void end_group() = 0;
};

/// Visits parameters: a KeyVisitor whose keys have a level.
class ParamVisitor : public KeyVisitor {
 public:
  /// Visits a number in [min, max]; `help` is the text for the user.
  void number(ParamLevel level, const char* key, double& value, double min, double max, const char* help) {
    on_number(level, key, value, min, max, help);
  }
  /// Visits an integer in [min, max].
  void integer(ParamLevel level, const char* key, int& value, int min, int max, const char* help) {
    on_integer(level, key, value, min, max, help);
  }
  /// Visits an odd integer in [min, max], such as the side of a patch with a central pixel.
  void odd(ParamLevel level, const char* key, int& value, int min, int max, const char* help) {
    on_odd(level, key, value, min, max, help);
  }
  /// Visits a Boolean (true or false).
  void boolean(ParamLevel level, const char* key, bool& value, const char* help) {
    on_boolean(level, key, value, help);
  }
  /// Visits a text: free, or one of `choices` if there are any.
  void text(ParamLevel level, const char* key, std::string& value, const std::vector<std::string>& choices,
            const char* help) {
    on_text(level, key, value, choices, help);
  }
};

/// visit() of a parameter struct, bound to an object.
using VisitParams = std::function<void(ParamVisitor&)>;

/// Overwrites the fields that `yaml_text` names. Each error message starts with `where` (a file name) and the
/// line. Accepts the plain part of YAML: nested `key: value` lines indented with blanks, comments, quoted
/// texts. Throws InputError: syntax error, unknown key (with the nearest known one), key given twice or
/// without a value, wrong type, out of range, not among the choices. Some fields may be overwritten by then:
/// discard the struct.
void read_params(const std::string& yaml_text, const std::string& where, const VisitParams& visit);

/// As read_params(), from a file. Also throws InputError if it cannot be read. Of a file with a block
/// `parameters:` at its left margin, such as a run's summary.yaml, that block is read; returns whether it was
/// one.
bool read_params_file(const std::string& path, const VisitParams& visit);

/// Sets one dotted key ("mapping.window.keyframes=9"), as on the command line; same errors as read_params().
void set_param(const std::string& assignment, const VisitParams& visit);

/// Effective values as YAML, in the order of visit(); each line indented by `indent` spaces. With
/// `comments`, each key is followed by its help text and range.
std::string write_params(const VisitParams& visit, int indent = 0, bool comments = false);

/// Basic parameters as YAML with comments: the text of params/default.yaml below its first lines.
std::string write_basic_params(const VisitParams& visit);

/// One parameter as the help shows it.
struct ParamDescription {
  /// Audience.
  ParamLevel level;
  /// Dotted key, as for --set.
  std::string key;
  /// Current value, as write_params() writes it.
  std::string value;
  /// "[min, max]" of a number, the choices of a text; empty for free text.
  std::string range;
  /// Help text.
  std::string help;
};

/// All parameters in the order of visit().
std::vector<ParamDescription> describe_params(const VisitParams& visit);

}  // namespace edgevo
