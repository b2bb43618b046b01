#pragma once
// Strict parameters in YAML.
//
// A parameter struct has defaults for every field and names them once, in visit(); reading, range checks, the
// help and writing the effective values all walk that one list:
//
//   struct EdgeParams {
//     /// share
//     double percentile = 0.9;
//     void visit(ParamVisitor& v) {
//       v.number(kBasic, "percentile", percentile, 0.5, 0.99, "share of pixels ...");
//     }
//   };
//
// Nested structs open a group: { auto g = v.group("edges"); edges.visit(v); }. A key that no struct names is
// an error which offers the nearest name; a value out of range is an error that states the range. A file that
// holds no parameters (a scene, a list of sequences) is walked in the same way by a KeyVisitor, without
// levels.
#include <functional>
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

namespace edgevo {

/// Who may have a reason to set a parameter.
enum class ParamLevel {
  /// Every user; params/default.yaml shows these only.
  kBasic,
  /// Those who measure what it does.
  kAdvanced,
  /// A heuristic that can be switched off, to measure what it is worth.
  kExperimental
};
constexpr ParamLevel kBasic = ParamLevel::kBasic;                ///< for visit()
constexpr ParamLevel kAdvanced = ParamLevel::kAdvanced;          ///< for visit()
constexpr ParamLevel kExperimental = ParamLevel::kExperimental;  ///< for visit()

/// "basic", "advanced", "experimental".
const char* to_string(ParamLevel level);

/// Walks the keys of a file in YAML: a reader, a writer, or a check of ranges.
class KeyVisitor {
 public:
  virtual ~KeyVisitor() = default;
  /// A number in [min, max]; `help` is its text for the user.
  void number(const char* key, double& value, double min, double max, const char* help) {
    on_number(kBasic, key, value, min, max, help);
  }
  /// An integer in [min, max].
  void integer(const char* key, int& value, int min, int max, const char* help) {
    on_integer(kBasic, key, value, min, max, help);
  }
  /// An odd integer, such as the side of a patch that has a middle.
  void odd(const char* key, int& value, int min, int max, const char* help) {
    on_odd(kBasic, key, value, min, max, help);
  }
  /// true or false.
  void boolean(const char* key, bool& value, const char* help) { on_boolean(kBasic, key, value, help); }
  /// Free text; with `choices`, one of these.
  void text(const char* key, std::string& value, const std::vector<std::string>& choices, const char* help) {
    on_text(kBasic, key, value, choices, help);
  }

  /// Opens a group and closes it when the returned guard goes out of scope.
  class Group {
   public:
    explicit Group(KeyVisitor& v) : v_(&v) {}  ///< of a group that was just begun
    ~Group() { v_->end_group(); }
    Group(const Group&) = delete;
    Group& operator=(const Group&) = delete;

   private:
    KeyVisitor* v_;
  };
  /// Begins a group for the life of what it returns.
  [[nodiscard]] Group group(const char* key) {
    begin_group(key);
    return Group(*this);
  }

 protected:
  /// What a visitor does with a number; the others likewise.
  virtual void on_number(ParamLevel level, const char* key, double& value, double min, double max,
                         const char* help) = 0;
  /// ... with an integer
  virtual void on_integer(ParamLevel level, const char* key, int& value, int min, int max,
                          const char* help) = 0;
  /// ... with an odd integer; as with any integer, unless overridden
  virtual void on_odd(ParamLevel level, const char* key, int& value, int min, int max, const char* help) {
    on_integer(level, key, value, min, max, help);
  }
  /// ... with true or false
  virtual void on_boolean(ParamLevel level, const char* key, bool& value, const char* help) = 0;
  /// ... with a text
  virtual void on_text(ParamLevel level, const char* key, std::string& value,
                       const std::vector<std::string>& choices, const char* help) = 0;
  /// Keys that follow lie in the group `key`.
  virtual void begin_group(const char* key) = 0;
  /// Ends the innermost group.
  virtual void end_group() = 0;
};

/// Walks parameters: as KeyVisitor, but each key states its level.
class ParamVisitor : public KeyVisitor {
 public:
  /// A number in [min, max]; `help` is its text for the user.
  void number(ParamLevel level, const char* key, double& value, double min, double max, const char* help) {
    on_number(level, key, value, min, max, help);
  }
  /// An integer in [min, max].
  void integer(ParamLevel level, const char* key, int& value, int min, int max, const char* help) {
    on_integer(level, key, value, min, max, help);
  }
  /// An odd integer, such as the side of a patch that has a middle.
  void odd(ParamLevel level, const char* key, int& value, int min, int max, const char* help) {
    on_odd(level, key, value, min, max, help);
  }
  /// true or false.
  void boolean(ParamLevel level, const char* key, bool& value, const char* help) {
    on_boolean(level, key, value, help);
  }
  /// Free text; with `choices`, one of these.
  void text(ParamLevel level, const char* key, std::string& value, const std::vector<std::string>& choices,
            const char* help) {
    on_text(level, key, value, choices, help);
  }
};

using VisitParams = std::function<void(ParamVisitor&)>;  ///< a struct's visit(), bound to it

/// Overwrites the fields that `yaml_text` names. Each error message opens with `where` (a file name) and the
/// line. The text is the plain part of YAML: nested `key: value` lines indented with blanks, comments, quoted
/// texts. Throws InputError: not readable, unknown key (with the nearest known one), key given twice or
/// without a value, wrong type, out of range, not a choice. Then some fields may be overwritten already:
/// throw the struct away.
void read_params(const std::string& yaml_text, const std::string& where, const VisitParams& visit);

/// As read_params, from a file. Throws InputError if it cannot be read.
void read_params_file(const std::string& path, const VisitParams& visit);

/// Sets one dotted key ("mapping.window.keyframes=9"), as the command line gives it; same errors.
void set_param(const std::string& assignment, const VisitParams& visit);

/// The effective values as YAML, in the order of visit(); each line indented by `indent` spaces. With
/// `comments`, each key is followed by its help text and range.
std::string write_params(const VisitParams& visit, int indent = 0, bool comments = false);

/// The basic parameters alone, with comments: the text of params/default.yaml below its first lines.
std::string write_basic_params(const VisitParams& visit);

/// One parameter as the help shows it.
struct ParamDescription {
  /// who may want to set it
  ParamLevel level;
  /// dotted, as --set takes it
  std::string key;
  /// the present value, as write_params() writes it
  std::string value;
  /// of a number "[min, max]", of a text its choices; empty for free text
  std::string range;
  /// what it is
  std::string help;
};

/// All parameters in the order of visit().
std::vector<ParamDescription> describe_params(const VisitParams& visit);

}  // namespace edgevo
