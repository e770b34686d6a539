// XML texts of foreign files.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace koshi::io {

struct XmlElement {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::vector<XmlElement> children;
  std::string text;  ///< its own, without the children's

  /// Value of an attribute, empty if there is none.
  std::string attribute(const std::string& key) const;
  /// The first child of this name, null if there is none.
  const XmlElement* child(std::string_view wanted) const;
};

/// The root of a document. Errors: InputError without a place for what is no XML, is nested deeper than 32 elements or
/// has more than 1 000 000 of them; entities of the document's own are refused.
XmlElement parse_xml(std::string_view text);

}  // namespace koshi::io
