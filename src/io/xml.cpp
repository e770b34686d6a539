#include "io/xml.h"

#include <expat.h>
#include <fmt/format.h>

#include <memory>

#include "koshi/error.h"

namespace koshi::io {
namespace {

/// Elements while they are read: expat calls back at each start, end and text.
struct Building {
  XML_Parser parser;
  XmlElement top;
  std::vector<XmlElement*> open{};  // siblings may move, but never the ancestors of the one being read
  std::size_t count = 0;
  const char* refused = nullptr;
};

void refuse(Building& building, const char* reason) {
  building.refused = reason;
  XML_StopParser(building.parser, XML_FALSE);
}

void on_start(void* data, const char* name, const char** attributes) {
  Building& building = *static_cast<Building*>(data);
  if (building.open.size() > 32) return refuse(building, "elements nested deeper than 32");
  if (++building.count > 1000000) return refuse(building, "more than 1 000 000 elements");
  XmlElement& element = building.open.back()->children.emplace_back();
  element.name = name;
  for (; attributes[0] != nullptr; attributes += 2) element.attributes[attributes[0]] = attributes[1];
  building.open.push_back(&element);
}

void on_end(void* data, const char*) { static_cast<Building*>(data)->open.pop_back(); }

void on_text(void* data, const char* text, int length) {
  static_cast<Building*>(data)->open.back()->text.append(text, static_cast<std::size_t>(length));
}

void on_entity(void* data, const char*, int, const char*, int, const char*, const char*, const char*, const char*) {
  refuse(*static_cast<Building*>(data), "entities of its own");
}

}  // namespace

std::string XmlElement::attribute(const std::string& key) const {
  const auto at = attributes.find(key);
  return at == attributes.end() ? "" : at->second;
}

const XmlElement* XmlElement::child(std::string_view wanted) const {
  for (const XmlElement& element : children)
    if (element.name == wanted) return &element;
  return nullptr;
}

XmlElement parse_xml(std::string_view text) {
  const std::unique_ptr<XML_ParserStruct, void (*)(XML_Parser)> parser(XML_ParserCreate(nullptr), XML_ParserFree);
  if (!parser) throw std::bad_alloc();
  Building building{parser.get(), {}, {}};
  building.open.push_back(&building.top);
  XML_SetUserData(parser.get(), &building);
  XML_SetElementHandler(parser.get(), on_start, on_end);
  XML_SetCharacterDataHandler(parser.get(), on_text);
  XML_SetEntityDeclHandler(parser.get(), on_entity);

  constexpr std::size_t step = 1 << 20;
  for (bool last = false; !last;) {
    const std::string_view part = text.substr(0, step);
    text.remove_prefix(part.size());
    last = text.empty();
    if (XML_Parse(parser.get(), part.data(), static_cast<int>(part.size()), last) == XML_STATUS_OK) continue;
    throw InputError(
        fmt::format("is no XML: {} in line {}",
                    building.refused != nullptr ? building.refused : XML_ErrorString(XML_GetErrorCode(parser.get())),
                    XML_GetCurrentLineNumber(parser.get())));
  }
  return std::move(building.top.children.front());
}

}  // namespace koshi::io
