// Forms of single values: flags, quantities, words.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/escape.h"
#include "io/toml/form.h"

namespace koshi::io {

void wrong_form(const Value& value, const Spec& spec, const std::string& expected) {
  throw InputError(value.place, fmt::format("{} is {}; expected {}", spec.name, describe(value), expected));
}

void unknown_word(const Place& place, const std::string& what, const std::string& word,
                  const std::vector<std::string>& allowed) {
  const auto meant = nearest(word, allowed);
  const std::string question = meant ? fmt::format("did you mean \"{}\"? ", *meant) : "";
  throw InputError(place, fmt::format("unknown {} \"{}\"; {}allowed: {}", what, word, question, quoted_list(allowed)));
}

void words_schema(const std::vector<std::string>& words, Json& out) { out["enum"] = words; }

namespace {

void range_schema(const model::Range& range, Json& out) {
  out[range.open_below ? "exclusiveMinimum" : "minimum"] = range.least;
  out[range.open_above ? "exclusiveMaximum" : "maximum"] = range.most;
  // JSON Schema leaves further keywords to whoever reads them.
  if (range.smallest > 0) out["smallestSize"] = range.smallest;
}

}  // namespace

// What an editor would not show is escaped, control characters among it, which TOML does not take as they are.
std::string toml_text(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return escaped(result) + '"';
}

std::string toml_key(const std::string& key) {
  constexpr std::string_view bare = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
  return key.empty() || key.find_first_not_of(bare) != std::string::npos ? toml_text(key) : key;
}

Form<bool> form(Tag<bool>) {
  return {
      .read =
          [](const Value& value, const Spec& spec, bool& out) {
            const bool* flag = std::get_if<bool>(&value.data);
            if (flag == nullptr) wrong_form(value, spec, "true or false");
            out = *flag;
          },
      .write = [](const bool& value, const Spec&) { return std::string(value ? "true" : "false"); },
      .expected = [](const Spec&) { return std::string("true or false"); },
      .schema = [](const Spec&, Json& out) { out["type"] = "boolean"; },
  };
}

Form<double> form(Tag<double>) {
  return {
      .read =
          [](const Value& value, const Spec& spec, double& out) {
            if (const auto* integer = std::get_if<std::int64_t>(&value.data)) {
              out = static_cast<double>(*integer);
            } else if (const auto* number = std::get_if<double>(&value.data)) {
              if (!std::isfinite(*number)) wrong_form(value, spec, "a finite number");
              out = *number;
            } else if (value.text() != nullptr) {
              out = parse_quantity(*value.text(), spec.dimension, value.place);
            } else {
              wrong_form(value, spec, expected_quantity(spec.dimension));
            }
            model::require(spec.range, spec.name, out, value.place);
          },
      .write =
          [](const double& value, const Spec&) {
            // The shortest text that reads back as the same number; a point or exponent makes it a float of TOML.
            const std::string text = fmt::format("{}", value);
            return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
          },
      .expected = [](const Spec& spec) { return expected_quantity(spec.dimension); },
      .schema =
          [](const Spec& spec, Json& out) {
            out["type"] = {"number", "string"};
            const auto& w = words(spec.dimension);
            if (!w.si_unit.empty()) out["unit"] = w.si_unit;
            range_schema(spec.range, out);
            if (!w.si_unit.empty()) out["examples"] = {w.example};
          },
  };
}

Form<int> form(Tag<int>) {
  return {
      .read =
          [](const Value& value, const Spec& spec, int& out) {
            const auto* integer = std::get_if<std::int64_t>(&value.data);
            if (integer == nullptr) wrong_form(value, spec, "a whole number");
            model::require(spec.range, spec.name, static_cast<double>(*integer), value.place);
            out = static_cast<int>(*integer);
          },
      .write = [](const int& value, const Spec&) { return std::to_string(value); },
      .expected = [](const Spec&) { return std::string("a whole number"); },
      .schema =
          [](const Spec& spec, Json& out) {
            out["type"] = "integer";
            range_schema(spec.range, out);
          },
  };
}

Form<std::string> form(Tag<std::string>) {
  return {
      .read =
          [](const Value& value, const Spec& spec, std::string& out) {
            if (value.text() == nullptr) wrong_form(value, spec, "a text in quotes");
            if (value.text()->empty())
              throw InputError(value.place, fmt::format("{} is empty; give it a text or leave it out", spec.name));
            out = *value.text();
          },
      .write = [](const std::string& value, const Spec&) { return value.empty() ? std::string() : toml_text(value); },
      .expected = [](const Spec&) { return std::string("a text in quotes"); },
      .schema = [](const Spec&, Json& out) { out["type"] = "string"; },
  };
}

}  // namespace koshi::io
