#include "io/toml/value.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>

namespace koshi::io {
namespace {

Place place_of(const toml::source_region& source, const std::string& file_name) {
  return {file_name, static_cast<int>(source.begin.line), static_cast<int>(source.begin.column)};
}

Value value_of(const toml::node& node, const std::string& file_name) {
  Value value;
  value.place = place_of(node.source(), file_name);
  if (const auto* table = node.as_table()) {
    Table entries;
    for (const auto& [key, child] : *table)
      entries.push_back({std::string(key.str()), place_of(key.source(), file_name), value_of(child, file_name)});
    // The parser sorts by key; messages should name the first error of the file.
    const auto before = [](const Entry& a, const Entry& b) {
      return std::pair(a.place.line, a.place.column) < std::pair(b.place.line, b.place.column);
    };
    std::stable_sort(entries.begin(), entries.end(), before);
    value.data = std::move(entries);
  } else if (const auto* array = node.as_array()) {
    Array elements;
    for (const auto& child : *array) elements.push_back(value_of(child, file_name));
    value.data = std::move(elements);
  } else if (const auto* text = node.as_string()) {
    value.data = text->get();
  } else if (const auto* integer = node.as_integer()) {
    value.data = integer->get();
  } else if (const auto* number = node.as_floating_point()) {
    value.data = number->get();
  } else if (const auto* flag = node.as_boolean()) {
    value.data = flag->get();
  } else {
    value.data = DateTime{};
  }
  return value;
}

// Number of characters of the string that text begins with, its quotes among them; one left open by "...": up to the
// end of the line, by """...""": up to the end of the text.
std::size_t string_length(std::string_view text) {
  const char quote = text.front();
  const std::string fence(3, quote);
  const bool lines = text.starts_with(fence);
  std::size_t at = lines ? 3 : 1;
  for (; at < text.size(); ++at) {
    if (text[at] == '\\' && quote == '"') {
      ++at;
      continue;
    }
    if (!lines && text[at] == '\n') return at;
    if (!lines && text[at] == quote) return at + 1;
    if (!lines || !text.substr(at).starts_with(fence)) continue;
    // Up to two quotes before the closing ones belong to the text.
    at += 3;
    for (int more = 0; more < 2 && text.substr(at).starts_with(quote); ++more) ++at;
    return at;
  }
  return text.size();
}

// Every dot of a key nests one table in another, and trees are walked by recursion: a key of a million dots would
// exhaust the stack. No key of a case has more than a few. Dots within strings are text.
void refuse_deep_keys(std::string_view text, const std::string& file_name) {
  constexpr int most = 100;
  std::size_t line_begin = 0;
  int line = 1;
  int dots = 0;
  std::size_t at = 0;
  const auto pass = [&](std::size_t end) {
    for (; at < end; ++at)
      if (text[at] == '\n') {
        ++line;
        line_begin = at + 1;
      }
  };
  while (at < text.size()) {
    const char c = text[at];
    if (c == '#') {
      pass(std::min(text.find('\n', at), text.size()));
      continue;
    }
    if (c == '"' || c == '\'') {
      pass(at + string_length(text.substr(at)));
      continue;
    }
    if (c == '.' && ++dots > most)
      throw InputError({file_name, line, static_cast<int>(at - line_begin) + 1},
                       fmt::format("more than {} dots in a row; keys have a few", most));
    if (std::string_view(",=[]{}\n").find(c) != std::string_view::npos) dots = 0;
    pass(at + 1);
  }
}

// The text's line of this number, from 1.
std::string_view line_of(std::string_view text, int number) {
  while (--number > 0 && text.find('\n') != std::string_view::npos) text.remove_prefix(text.find('\n') + 1);
  return text.substr(0, text.find('\n'));
}

// The parser's words, with what would be right where they do not say it.
std::string syntax_message(std::string_view description, std::string_view line) {
  constexpr std::string_view prefix = "Error while parsing ";
  const bool usual = description.starts_with(prefix);
  if (usual) description.remove_prefix(prefix.size());
  const auto mentions = [&](std::string_view words) { return description.find(words) != std::string_view::npos; };
  const auto holds = [&](std::string_view mark) { return line.find(mark) != std::string_view::npos; };
  std::string hint;
  if (mentions("utf-8"))
    hint = "; save it as UTF-8";
  else if (holds("\u201C") || holds("\u201D") || holds("\u2018") || holds("\u2019"))
    hint = "; quotes are straight, as in \"0.2 cm\", not those of a word processor";
  else if (mentions("comment or whitespace, saw '/'"))
    hint = "; a comment begins with #";
  else if (mentions("determine value type") || mentions("comment or whitespace"))
    hint = "; text and quantities with a unit need quotes, such as \"0.2 cm\"";
  else if (mentions("boolean"))
    hint = "; it is written true or false, in small letters";
  else if (mentions("unescaped control characters"))
    hint = "; a text ends with a quote on its own line";
  else if (mentions("cannot redefine"))
    hint = "; every key and table may stand once";
  return fmt::format("cannot read {}{}{}", usual ? "" : "the file: ", description, hint);
}

}  // namespace

const Entry* find(const Table& table, std::string_view key) {
  const auto found = std::find_if(table.begin(), table.end(), [&](const Entry& entry) { return entry.key == key; });
  return found == table.end() ? nullptr : &*found;
}

Entry* find(Table& table, std::string_view key) {
  return const_cast<Entry*>(find(static_cast<const Table&>(table), key));
}

std::string describe(const Value& value) {
  struct Words {
    std::string operator()(bool flag) const { return flag ? "true" : "false"; }
    std::string operator()(std::int64_t number) const { return fmt::format("the number {}", number); }
    std::string operator()(double number) const { return fmt::format("the number {}", number); }
    std::string operator()(const std::string& text) const {
      constexpr std::size_t longest = 60;
      if (text.size() > longest) return "a long text";
      return fmt::format("the text \"{}\"", text);
    }
    std::string operator()(const DateTime&) const { return "a date or time"; }
    std::string operator()(const Array& list) const {
      return list.empty() ? "an empty list" : fmt::format("a list of {}", list.size());
    }
    std::string operator()(const Table& table) const { return table.empty() ? "an empty table" : "a table"; }
  };
  return std::visit(Words{}, value.data);
}

Value parse_toml(std::string_view text, const std::string& file_name) {
  refuse_deep_keys(text, file_name);
  try {
    return value_of(toml::parse(text, std::string_view(file_name)), file_name);
  } catch (const toml::parse_error& error) {
    const Place place = place_of(error.source(), file_name);
    throw InputError(place, syntax_message(error.description(), line_of(text, place.line)));
  }
}

}  // namespace koshi::io
