// SPDX-License-Identifier: BSD-3-Clause
// Calibrations in XML. ViSP: <camera> with a name, image_width, image_height and a <model> for each kind of
// projection, of which the one with distortion is taken: u = u0 + px x (1 + kud r^2); its model-based
// trackers write px, py, u0, v0, width and height into <camera> itself. OpenCV: <opencv_storage> with the
// keys of its YAML, read as those are.
#include <libxml/parser.h>
#include <libxml/tree.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <memory>

#include "camera_numbers.h"
#include "dialect.h"
#include "edgevo/core/error.h"
#include "text_file.h"

namespace edgevo {
namespace {

using Document = std::unique_ptr<xmlDoc, void (*)(xmlDoc*)>;

// Without network, entities from files, or messages to stderr.
Document parse_xml(const std::string& text, const std::string& where) {
  constexpr size_t kLargest = size_t(64) << 20;
  Document document(text.size() > kLargest ? nullptr
                                           : xmlReadMemory(text.data(), int(text.size()), nullptr, nullptr,
                                                           XML_PARSE_NONET | XML_PARSE_NOERROR |
                                                               XML_PARSE_NOWARNING | XML_PARSE_NOCDATA),
                    xmlFreeDoc);
  if (!document || !xmlDocGetRootElement(document.get()))
    throw InputError(where, "is not complete XML", "restore the file");
  if (document->intSubset)  // its entities could make it endless
    throw InputError(where, "has a document type, which no calibration has", "remove <!DOCTYPE ...>");
  return document;
}

std::string name_of(const xmlNode* node) { return reinterpret_cast<const char*>(node->name); }

std::vector<xmlNode*> children(const xmlNode* node) {
  std::vector<xmlNode*> elements;
  for (xmlNode* child = node->children; child; child = child->next)
    if (child->type == XML_ELEMENT_NODE) elements.push_back(child);
  return elements;
}

// Its text without blanks around it.
std::string text_of(xmlNode* node) {
  const std::unique_ptr<xmlChar, void (*)(void*)> content(xmlNodeGetContent(node), xmlFree);
  std::string text = content ? reinterpret_cast<const char*>(content.get()) : "";
  text.erase(0, text.find_first_not_of(" \t\r\n"));
  text.erase(text.find_last_not_of(" \t\r\n") + 1);
  return text;
}

// ---- ViSP ----

constexpr const char* kWithout = "perspectiveProjWithoutDistortion";
constexpr const char* kWith = "perspectiveProjWithDistortion";

struct Element {
  xmlNode* node;
  std::string where;

  // nullptr: there is none.
  xmlNode* find(const char* name) const {
    for (xmlNode* child : children(node))
      if (name_of(child) == name) return child;
    return nullptr;
  }
  double number(const char* name) const {
    xmlNode* const child = find(name);
    if (!child) throw InputError(where, std::string("has no <") + name + ">", "restore the file");
    return parse_number(text_of(child), where + ", <" + name + ">");
  }
  std::string text(const char* name) const {
    xmlNode* const child = find(name);
    return child ? text_of(child) : std::string();
  }
};

StatedLens visp_lens(const Element& camera) {
  std::map<std::string, Element> models;
  for (xmlNode* child : children(camera.node)) {
    if (name_of(child) != "model") continue;
    const Element model{child, camera.where};
    models.emplace(model.text("type"), model);
  }
  if (models.empty()) models.emplace(kWithout, camera);  // as in the files of ViSP's trackers
  const auto with = models.find(kWith), without = models.find(kWithout);
  const auto chosen = with != models.end() ? with : without;
  if (chosen == models.end())
    throw InputError(camera.where, "ViSP's " + quote(models.begin()->first) + " is not supported",
                     std::string("save the camera as ") + kWith);
  const Element& m = chosen->second;
  StatedLens lens{LensKind::kPinhole, {m.number("px"), m.number("py"), m.number("u0"), m.number("v0")}, {}};
  if (chosen != with) return lens;
  lens.kind = LensKind::kPlumbBob;
  lens.coefficients = {m.number("kud"), 0, 0, 0};
  return lens;
}

CameraText visp_camera(const Element& camera) {
  const auto side = [&](const char* name, const char* of_tracker) {
    const char* const key = camera.find(name) ? name : of_tracker;
    return camera.find(key) ? image_side(camera.number(key), camera.where) : 0;
  };
  return camera_of_lens(visp_lens(camera), side("image_width", "width"), side("image_height", "height"),
                        camera.where);
}

NamedCameras visp_cameras(const std::shared_ptr<xmlDoc>& document, const std::string& where) {
  NamedCameras cameras;
  xmlNode* const root = xmlDocGetRootElement(document.get());
  std::vector<xmlNode*> nodes = name_of(root) == "camera" ? std::vector<xmlNode*>{root} : children(root);
  for (xmlNode* node : nodes) {
    if (name_of(node) != "camera") continue;
    const Element camera{node, where};
    cameras.push_back({camera.text("name"), [document, camera] { return visp_camera(camera); }});
  }
  if (cameras.empty())
    throw InputError(where, "is XML of <" + name_of(root) + ">, no calibration of ViSP or OpenCV",
                     kWriteNumbers);
  return cameras;
}

// ---- OpenCV ----

// Numbers are separated by blanks, as are the texts of a list; a text with blanks is one in quotes.
std::vector<std::string> opencv_texts(xmlNode* node) {
  const std::string text = text_of(node);
  const bool is_text = text.find_first_of("\"'") != std::string::npos;
  std::vector<std::string> all;
  std::string blanks = text;
  std::replace(blanks.begin(), blanks.end(), '\n', ' ');
  if (!is_text) return split_fields(blanks);
  all.push_back(text);
  return all;
}

void add_values(const std::vector<xmlNode*>& nodes, const std::string& prefix, int depth,
                const std::string& where, YamlValues* values) {
  constexpr int kDeepest = 8;
  if (depth > kDeepest) throw InputError(where, "its elements nest too deep", "restore the file");
  for (xmlNode* node : nodes) {
    std::string key = prefix + name_of(node);
    for (char& c : key) c = char(std::tolower(static_cast<unsigned char>(c)));
    const auto below = children(node);
    if (!below.empty()) {
      add_values(below, key + ".", depth + 1, where, values);
    } else if (!values->emplace(key, YamlValue{opencv_texts(node), int(xmlGetLineNo(node)), true}).second &&
               name_of(node) != "_") {  // an item of a list
      throw InputError(where, "<" + name_of(node) + "> is given twice", "keep one");
    }
  }
}

NamedCameras opencv_cameras(const xmlNode* root, const std::string& where) {
  YamlValues values;
  add_values(children(root), "", 0, where, &values);
  return {{"camera", [values, where] { return camera_of_yaml_values(values, where); }}};
}

}  // namespace

bool is_xml(const std::string& text) {
  const size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string::npos && text[first] == '<';
}

NamedCameras xml_cameras(const std::string& text, const std::string& where) {
  const std::shared_ptr<xmlDoc> document = parse_xml(text, where);
  const xmlNode* const root = xmlDocGetRootElement(document.get());
  if (name_of(root) == "opencv_storage") return opencv_cameras(root, where);
  return visp_cameras(document, where);
}

}  // namespace edgevo
