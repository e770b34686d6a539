#include "io/toml/override.h"

#include <fmt/format.h>

#include <charconv>
#include <optional>

#include "base/suggest.h"

namespace koshi::io {
namespace {

struct Assignment {
  std::vector<std::string> path;
  std::string value;
};

// Splits `a."b.c".'d e'.f=value` at the dots and the first "=" outside quotes, which may be of both kinds and stand
// around whole names.
std::optional<Assignment> split(const std::string& text) {
  Assignment result{{""}, ""};
  char quote = 0;  // the one that is open
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quote != 0 && c == quote) {
      quote = 0;
    } else if (quote == 0 && (c == '"' || c == '\'') && result.path.back().empty()) {
      quote = c;
    } else if (quote == 0 && c == '.') {
      result.path.emplace_back();
    } else if (quote == 0 && c == '=') {
      result.value = text.substr(i + 1);
      for (const auto& step : result.path)
        if (step.empty()) return std::nullopt;
      return result;
    } else {
      result.path.back() += c;
    }
  }
  return std::nullopt;
}

void set_place(Value& value, const Place& place) {
  value.place = place;
  value.overridden = true;
  if (auto* array = std::get_if<Array>(&value.data))
    for (Value& element : *array) set_place(element, place);
  if (auto* table = std::get_if<Table>(&value.data))
    for (Entry& entry : *table) {
      entry.place = place;
      set_place(entry.value, place);
    }
}

// The text as a value of TOML where it is one ("0.5", "[1, 2]", "true"), else as it stands ("cube-I", "0.1 cm").
Value parse_value(const std::string& text, const Place& place) {
  Value value;
  value.data = text;
  try {
    Value document = parse_toml("value = " + text, place.file);
    Table& table = std::get<Table>(document.data);
    if (table.size() == 1) value = std::move(table.front().value);
  } catch (const InputError&) {
  }
  set_place(value, place);
  return value;
}

std::string name_of(const Value& value) {
  const Entry* name = value.table() ? find(*value.table(), "name") : nullptr;
  return name != nullptr && name->value.text() ? *name->value.text() : std::string();
}

// Elements of a list go by the name of their table or by index.
Value& element(Array& array, const std::string& step, const std::string& path, const Place& place) {
  std::vector<std::string> names;
  for (Value& value : array) {
    const std::string name = name_of(value);
    if (name == step) return value;
    if (!name.empty()) names.push_back(name);
  }
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(step.data(), step.data() + step.size(), index);
  if (error == std::errc() && end == step.data() + step.size() && index < array.size()) return array[index];
  const std::string range = array.empty() ? "it is empty" : fmt::format("give an index from 0 to {}", array.size() - 1);
  const std::string by_name = names.empty() ? "" : fmt::format(" or a name; {}", suggestion(step, names));
  throw InputError(place, fmt::format("\"{}\" has no element \"{}\"; {}{}", path, step, range, by_name));
}

}  // namespace

void apply_override(Value& root, const std::string& text) {
  const Place place{"--set " + text, 0, 0};
  const auto assignment = split(text);
  if (!assignment)
    throw InputError(place, "not an assignment; expected section.key=value such as lattice.spacing=\"0.1 cm\"");

  // Walk down the path; tables and keys that are not there yet are made.
  Value* value = &root;
  std::string path;
  for (const std::string& step : assignment->path) {
    if (auto* array = std::get_if<Array>(&value->data)) {
      value = &element(*array, step, path, place);
    } else if (auto* table = std::get_if<Table>(&value->data)) {
      Entry* entry = find(*table, step);
      if (entry == nullptr) {
        Value empty;
        empty.data = Table{};
        set_place(empty, place);
        entry = &table->emplace_back(Entry{step, place, std::move(empty)});
      }
      value = &entry->value;
    } else {
      throw InputError(place, fmt::format("\"{}\" is {}; it has no \"{}\" in it", path, describe(*value), step));
    }
    path += (path.empty() ? "" : ".") + step;
  }
  *value = parse_value(assignment->value, place);
}

}  // namespace koshi::io
