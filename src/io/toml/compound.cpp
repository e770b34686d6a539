// Forms of lists and small tables: vectors, components of motion, boxes, histories, lists of words.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <set>

#include "io/toml/form.h"

namespace koshi::io {
namespace {

Spec element_of(const Spec& spec, std::size_t index) {
  Spec element = spec;
  element.name = fmt::format("{}[{}]", spec.name, index);
  return element;
}

// The elements of a list of known length.
const Array& elements(const Value& value, const Spec& spec, std::size_t count, const std::string& expected) {
  const Array* array = value.array();
  if (array == nullptr || array->size() != count) wrong_form(value, spec, expected);
  return *array;
}

std::string list_of(const std::vector<std::string>& texts) { return fmt::format("[{}]", fmt::join(texts, ", ")); }

template <class T>
Json schema_of(Tag<T> tag, const Spec& spec) {
  Json schema;
  form(tag).schema(spec, schema);
  return schema;
}

// A list of three elements that have a form of their own.
template <class T>
Form<std::array<T, 3>> triple() {
  return {
      .read =
          [](const Value& value, const Spec& spec, std::array<T, 3>& out) {
            const Array& array = elements(value, spec, 3, triple<T>().expected(spec));
            for (std::size_t i = 0; i < 3; ++i) form(Tag<T>{}).read(array[i], element_of(spec, i), out[i]);
          },
      .write =
          [](const std::array<T, 3>& value, const Spec& spec) {
            const auto write = form(Tag<T>{}).write;
            return list_of({write(value[0], spec), write(value[1], spec), write(value[2], spec)});
          },
      .expected = [](const Spec& spec) { return "a list of three (x, y, z), each " + form(Tag<T>{}).expected(spec); },
      .schema =
          [](const Spec& spec, Json& out) {
            out = {{"type", "array"}, {"items", schema_of(Tag<T>{}, spec)}, {"minItems", 3}, {"maxItems", 3}};
          },
  };
}

std::vector<std::string> components(std::size_t count) {
  return {model::component_names.begin(), model::component_names.begin() + static_cast<std::ptrdiff_t>(count)};
}

// Displacements have the key's dimension, rotations (components 3 to 5) its second one.
Spec component_of(const Spec& spec, std::size_t component) {
  Spec result = spec;
  result.name = fmt::format("{}.{}", spec.name, model::component_names[component]);
  if (component >= 3) {
    result.dimension = spec.rotation;
    result.range = spec.rotation_range;
  }
  return result;
}

// A table of the first `count` components of motion.
template <std::size_t count>
Form<std::array<std::optional<double>, count>> component_table() {
  using Type = std::array<std::optional<double>, count>;
  return {
      .read =
          [](const Value& value, const Spec& spec, Type& out) {
            const Table* table = value.table();
            if (table == nullptr || table->empty()) wrong_form(value, spec, component_table<count>().expected(spec));
            const auto known = components(count);
            for (const Entry& entry : *table) {
              const auto found = std::find(known.begin(), known.end(), entry.key);
              if (found == known.end()) unknown_word(entry.place, spec.name + " component", entry.key, known);
              const auto i = static_cast<std::size_t>(found - known.begin());
              form(Tag<double>{}).read(entry.value, component_of(spec, i), out[i].emplace());
            }
          },
      .write =
          [](const Type& value, const Spec& spec) {
            std::vector<std::string> texts;
            for (std::size_t i = 0; i < count; ++i) {
              if (!value[i]) continue;
              const std::string number = form(Tag<double>{}).write(*value[i], spec);
              texts.push_back(fmt::format("{} = {}", model::component_names[i], number));
            }
            return texts.empty() ? std::string() : fmt::format("{{ {} }}", fmt::join(texts, ", "));
          },
      .expected =
          [](const Spec& spec) {
            return fmt::format("a table such as {{ z = \"{}\" }} with some of {}", words(spec.dimension).example,
                               quoted_list(components(count)));
          },
      .schema =
          [](const Spec& spec, Json& out) {
            Json properties;
            for (std::size_t i = 0; i < count; ++i)
              properties[std::string(model::component_names[i])] = schema_of(Tag<double>{}, component_of(spec, i));
            out = Json{
                {"type", "object"}, {"properties", properties}, {"additionalProperties", false}, {"minProperties", 1}};
          },
  };
}

}  // namespace

Form<Vec3> form(Tag<Vec3>) { return triple<double>(); }

// Axes by their names; three times true or false is read too.
Form<std::array<bool, 3>> form(Tag<std::array<bool, 3>>) {
  using Type = std::array<bool, 3>;
  return {
      .read =
          [](const Value& value, const Spec& spec, Type& out) {
            const auto is_flag = [](const Value& element) { return std::holds_alternative<bool>(element.data); };
            if (value.array() != nullptr && std::any_of(value.array()->begin(), value.array()->end(), is_flag))
              return triple<bool>().read(value, spec, out);
            Spec words_spec = spec;
            words_spec.allowed = components(3);
            std::vector<std::string> words;
            form(Tag<std::vector<std::string>>{}).read(value, words_spec, words);
            for (std::size_t i = 0; i < 3; ++i)
              out[i] = std::find(words.begin(), words.end(), model::component_names[i]) != words.end();
          },
      .write =
          [](const Type& value, const Spec&) {
            std::vector<std::string> texts;
            for (std::size_t i = 0; i < 3; ++i)
              if (value[i]) texts.push_back(toml_text(std::string(model::component_names[i])));
            return list_of(texts);
          },
      .expected = [](const Spec&) { return "a list with some of " + quoted_list(components(3)); },
      .schema =
          [](const Spec& spec, Json& out) {
            Json flags;
            triple<bool>().schema(spec, flags);
            const Json names{{"type", "array"}, {"items", {{"enum", components(3)}}}, {"uniqueItems", true}};
            out = {{"anyOf", {names, flags}}};
          },
  };
}

Form<std::array<std::optional<double>, 6>> form(Tag<std::array<std::optional<double>, 6>>) {
  return component_table<6>();
}
Form<std::array<std::optional<double>, 3>> form(Tag<std::array<std::optional<double>, 3>>) {
  return component_table<3>();
}

Form<std::array<bool, 6>> form(Tag<std::array<bool, 6>>) {
  using Type = std::array<bool, 6>;
  return {
      .read =
          [](const Value& value, const Spec& spec, Type& out) {
            Spec words_spec = spec;
            words_spec.allowed = components(6);
            std::vector<std::string> words;
            form(Tag<std::vector<std::string>>{}).read(value, words_spec, words);
            out.fill(false);
            for (std::size_t i = 0; i < 6; ++i)
              out[i] = std::find(words.begin(), words.end(), model::component_names[i]) != words.end();
          },
      .write =
          [](const Type& value, const Spec&) {
            std::vector<std::string> texts;
            for (std::size_t i = 0; i < 6; ++i)
              if (value[i]) texts.push_back(toml_text(std::string(model::component_names[i])));
            return texts.empty() ? std::string() : list_of(texts);
          },
      .expected = [](const Spec&) { return "a list with some of " + quoted_list(components(6)); },
      .schema =
          [](const Spec&, Json& out) {
            out = {{"type", "array"}, {"items", {{"enum", components(6)}}}, {"uniqueItems", true}};
          },
  };
}

Form<std::pair<Vec3, Vec3>> form(Tag<std::pair<Vec3, Vec3>>) {
  using Type = std::pair<Vec3, Vec3>;
  return {
      .read =
          [](const Value& value, const Spec& spec, Type& out) {
            const std::string expected = form(Tag<Type>{}).expected(spec);
            const Table* table = value.table();
            if (table == nullptr) wrong_form(value, spec, expected);
            for (const Entry& entry : *table)
              if (entry.key != "min" && entry.key != "max")
                unknown_word(entry.place, spec.name + " key", entry.key, {"min", "max"});
            for (const bool upper : {false, true}) {
              const std::string key = upper ? "max" : "min";
              const Entry* entry = find(*table, key);
              if (entry == nullptr)
                throw InputError(value.place, fmt::format("{} has no \"{}\"; expected {}", spec.name, key, expected));
              Spec corner = spec;
              corner.name = spec.name + "." + key;
              form(Tag<Vec3>{}).read(entry->value, corner, upper ? out.second : out.first);
            }
          },
      .write =
          [](const Type& value, const Spec& spec) {
            return fmt::format("{{ min = {}, max = {} }}", form(Tag<Vec3>{}).write(value.first, spec),
                               form(Tag<Vec3>{}).write(value.second, spec));
          },
      .expected = [](const Spec&) { return std::string("a table { min = [x, y, z], max = [x, y, z] }"); },
      .schema =
          [](const Spec& spec, Json& out) {
            const Json corner = schema_of(Tag<Vec3>{}, spec);
            out = {{"type", "object"},
                   {"properties", {{"min", corner}, {"max", corner}}},
                   {"required", {"min", "max"}},
                   {"additionalProperties", false}};
          },
  };
}

// A pair of a history: the time and the factor.
std::pair<Spec, Spec> specs_of_pair(const Spec& pair) {
  Spec time = element_of(pair, 0), factor = element_of(pair, 1);
  time.dimension = Dimension::time;
  time.range = model::ranges::moment_of_history;
  factor.dimension = Dimension::number;
  factor.range = model::ranges::factor;
  return {time, factor};
}

Form<model::History> form(Tag<model::History>) {
  return {
      .read =
          [](const Value& value, const Spec& spec, model::History& out) {
            const std::string expected = form(Tag<model::History>{}).expected(spec);
            if (value.array() == nullptr || value.array()->empty()) wrong_form(value, spec, expected);
            for (const Value& pair : *value.array()) {
              const Spec pair_spec = element_of(spec, out.size());
              const Array& both = elements(pair, pair_spec, 2, "a pair [time, factor] such as [\"1 s\", 0.5]");
              const auto [time, factor] = specs_of_pair(pair_spec);
              auto& [t, f] = out.emplace_back();
              form(Tag<double>{}).read(both[0], time, t);
              form(Tag<double>{}).read(both[1], factor, f);
            }
          },
      .write =
          [](const model::History& value, const Spec& spec) {
            std::vector<std::string> texts;
            for (const auto& [t, f] : value)
              texts.push_back(list_of({form(Tag<double>{}).write(t, spec), form(Tag<double>{}).write(f, spec)}));
            return texts.empty() ? std::string() : list_of(texts);
          },
      .expected = [](const Spec&) { return std::string("a list of pairs such as [[\"0 s\", 0], [\"1 s\", 1]]"); },
      .schema =
          [](const Spec& spec, Json& out) {
            const auto [time, factor] = specs_of_pair(spec);
            const Json times = schema_of(Tag<double>{}, time);
            const Json factors = schema_of(Tag<double>{}, factor);
            const Json pair{
                {"type", "array"}, {"prefixItems", Json::array({times, factors})}, {"minItems", 2}, {"maxItems", 2}};
            out = Json{{"type", "array"}, {"items", pair}, {"minItems", 1}};
          },
  };
}

Form<std::vector<std::string>> form(Tag<std::vector<std::string>>) {
  using Type = std::vector<std::string>;
  return {
      .read =
          [](const Value& value, const Spec& spec, Type& out) {
            const std::string expected = form(Tag<Type>{}).expected(spec);
            if (value.array() == nullptr) wrong_form(value, spec, expected);
            out.clear();
            std::set<std::string> seen;
            for (const Value& element : *value.array()) {
              const std::string* word = element.text();
              if (word == nullptr) wrong_form(element, element_of(spec, out.size()), expected);
              if (!spec.allowed.empty() &&
                  std::find(spec.allowed.begin(), spec.allowed.end(), *word) == spec.allowed.end())
                unknown_word(element.place, "entry of " + spec.name, *word, spec.allowed);
              if (!seen.insert(*word).second)
                throw InputError(element.place, fmt::format("{} lists \"{}\" twice; once is enough", spec.name, *word));
              out.push_back(*word);
            }
          },
      .write =
          [](const Type& value, const Spec&) {
            std::vector<std::string> texts;
            for (const std::string& word : value) texts.push_back(toml_text(word));
            return list_of(texts);
          },
      .expected =
          [](const Spec& spec) {
            return spec.allowed.empty() ? "a list of texts" : "a list with some of " + quoted_list(spec.allowed);
          },
      .schema =
          [](const Spec& spec, Json& out) {
            Json item{{"type", "string"}};
            if (!spec.allowed.empty()) item = {{"enum", spec.allowed}};
            out = {{"type", "array"}, {"items", item}, {"uniqueItems", true}};
          },
  };
}

Form<std::map<int, std::string>> form(Tag<std::map<int, std::string>>) {
  using Type = std::map<int, std::string>;
  return {
      .read =
          [](const Value& value, const Spec& spec, Type& out) {
            const std::string expected = form(Tag<Type>{}).expected(spec);
            if (value.table() == nullptr || value.table()->empty()) wrong_form(value, spec, expected);
            for (const Entry& entry : *value.table()) {
              int number = 0;
              const char* const end = entry.key.data() + entry.key.size();
              const auto [rest, error] = std::from_chars(entry.key.data(), end, number);
              if (error != std::errc() || rest != end)
                throw InputError(entry.place,
                                 fmt::format("{} has the key \"{}\"; expected {}", spec.name, entry.key, expected));
              Spec element = spec;
              element.name = fmt::format("{}.{}", spec.name, entry.key);
              // "1" and "01" are two keys of TOML but one number.
              if (out.contains(number))
                throw InputError(entry.place, fmt::format("{} gives {} twice; once is enough", spec.name, number));
              form(Tag<std::string>{}).read(entry.value, element, out[number]);
            }
          },
      .write =
          [](const Type& value, const Spec&) {
            std::vector<std::string> texts;
            for (const auto& [number, word] : value) texts.push_back(fmt::format("{} = {}", number, toml_text(word)));
            return texts.empty() ? std::string() : fmt::format("{{ {} }}", fmt::join(texts, ", "));
          },
      .expected =
          [](const Spec&) {
            return std::string("a table of whole numbers and materials such as { 0 = \"void\", 1 = \"rock\" }");
          },
      .schema =
          [](const Spec&, Json& out) {
            out = {{"type", "object"}, {"additionalProperties", {{"type", "string"}}}, {"minProperties", 1}};
          },
  };
}

}  // namespace koshi::io
