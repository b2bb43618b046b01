#pragma once
// Strict parameters in YAML.
//
// A parameter struct has defaults for every field and names them once, in visit(); reading, range checks and writing the
// effective values all walk that one list:
//
//   struct EdgeParams {
//     double percentile = 0.9;
//     void visit(ParamVisitor& v) { v.number("percentile", percentile, 0.5, 0.99, "share of pixels ..."); }
//   };
//
// Nested structs open a group: { auto g = v.group("edges"); edges.visit(v); }. A key that no struct names is an error which
// offers the nearest name; a value out of range is an error that states the range.
#include <functional>
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

namespace edgevo {

/// Who walks a struct's parameters: a reader, a writer, or a check of ranges.
class ParamVisitor {
 public:
  virtual ~ParamVisitor() = default;
  /// A number in [min, max]; `help` is its text in params/default.yaml.
  virtual void number(const char* key, double& value, double min, double max, const char* help) = 0;
  /// An integer in [min, max].
  virtual void integer(const char* key, int& value, int min, int max, const char* help) = 0;
  /// An odd integer, such as the side of a patch that has a middle.
  virtual void odd(const char* key, int& value, int min, int max, const char* help) { integer(key, value, min, max, help); }
  /// true or false.
  virtual void boolean(const char* key, bool& value, const char* help) = 0;
  /// Free text; with `choices`, one of these.
  virtual void text(const char* key, std::string& value, const std::vector<std::string>& choices,
                    const char* help) = 0;
  /// Keys that follow lie in the group `key`; use group() instead.
  virtual void begin_group(const char* key) = 0;
  /// Ends the innermost group.
  virtual void end_group() = 0;

  /// Opens a group and closes it when the returned guard goes out of scope.
  class Group {
   public:
    explicit Group(ParamVisitor& v) : v_(&v) {}  ///< of a group that was just begun
    ~Group() { v_->end_group(); }
    Group(const Group&) = delete;
    Group& operator=(const Group&) = delete;

   private:
    ParamVisitor* v_;
  };
  /// Begins a group for the life of what it returns.
  [[nodiscard]] Group group(const char* key) {
    begin_group(key);
    return Group(*this);
  }
};

using VisitParams = std::function<void(ParamVisitor&)>;  ///< a struct's visit(), bound to it

/// Overwrites the fields that `yaml_text` names. Each error message opens with `where` (a file name) and the line.
/// The text is the plain part of YAML: nested `key: value` lines indented with blanks, comments, quoted texts.
/// Throws InputError: not readable, unknown key (with the nearest known one), key given twice or without a value, wrong
/// type, out of range, not a choice. Then some fields may be overwritten already: throw the struct away.
void read_params(const std::string& yaml_text, const std::string& where, const VisitParams& visit);

/// As read_params, from a file. Throws InputError if it cannot be read.
void read_params_file(const std::string& path, const VisitParams& visit);

/// Sets one dotted key ("mapping.window.keyframes=9"), as the command line gives it; same errors.
void set_param(const std::string& assignment, const VisitParams& visit);

/// The effective values as YAML, in the order of visit(); each line indented by `indent` spaces. With `comments`, each
/// key is followed by its help text and range.
std::string write_params(const VisitParams& visit, int indent = 0, bool comments = false);

}  // namespace edgevo
