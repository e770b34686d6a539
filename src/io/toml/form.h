// The form of a C++ type in the input: how it is read, written, named in messages and described in the schema.
#pragma once

#include <fmt/format.h>

#include <array>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/suggest.h"
#include "io/toml/value.h"
#include "io/units.h"
#include "koshi/definition.h"
#include "model/choices.h"
#include "model/ranges.h"

namespace koshi::io {

using Json = nlohmann::ordered_json;

/// What a form must know of its key.
struct Spec {
  std::string name;  ///< of the key, for messages
  Dimension dimension = Dimension::number;
  Dimension rotation = Dimension::angle;  ///< of the rotations among the six components
  std::string unset_word{};               ///< the word that stands for an unset value ("auto"); empty: none
  std::vector<std::string> allowed{};     ///< of a list of words; empty: any
  std::string title{};                    ///< of a nested table in messages; empty: [name]
  model::Range range{};                   ///< of numbers
  model::Range rotation_range{};          ///< of the rotations among the six components
};

template <class T>
struct Form {
  /// Sets `out`; InputError at the value's place when it has another form.
  void (*read)(const Value& value, const Spec& spec, T& out);
  /// TOML text that reads back as the same value; empty for an unset value.
  std::string (*write)(const T& value, const Spec& spec);
  /// What would be right, for messages.
  std::string (*expected)(const Spec& spec);
  /// Sets `out` to the JSON Schema of the value.
  void (*schema)(const Spec& spec, Json& out);
};

template <class T>
struct Tag {};

Form<bool> form(Tag<bool>);
Form<double> form(Tag<double>);
Form<int> form(Tag<int>);
Form<std::string> form(Tag<std::string>);
Form<Vec3> form(Tag<Vec3>);
/// Per axis.
Form<std::array<bool, 3>> form(Tag<std::array<bool, 3>>);
/// List of components of motion.
Form<std::array<bool, 6>> form(Tag<std::array<bool, 6>>);
/// Table of components of motion.
Form<std::array<std::optional<double>, 6>> form(Tag<std::array<std::optional<double>, 6>>);
/// Table of axes.
Form<std::array<std::optional<double>, 3>> form(Tag<std::array<std::optional<double>, 3>>);
Form<std::vector<double>> form(Tag<std::vector<double>>);
/// {min, max}
Form<std::pair<Vec3, Vec3>> form(Tag<std::pair<Vec3, Vec3>>);
Form<model::History> form(Tag<model::History>);
Form<std::vector<std::string>> form(Tag<std::vector<std::string>>);
/// Table of whole numbers and words.
Form<std::map<int, std::string>> form(Tag<std::map<int, std::string>>);

/// Throws "NAME is WHAT IT IS; expected ...".
[[noreturn]] void wrong_form(const Value& value, const Spec& spec, const std::string& expected);

/// Throws "unknown WHAT WORD; did you mean ...? allowed: ...".
[[noreturn]] void unknown_word(const Place& place, const std::string& what, const std::string& word,
                               const std::vector<std::string>& allowed);

/// JSON Schema of one of some words.
void words_schema(const std::vector<std::string>& words, Json& out);

/// TOML text of a string, and of a key.
std::string toml_text(const std::string& text);
std::string toml_key(const std::string& key);

/// One of the words of an enumeration.
template <class E>
requires std::is_enum_v<E> Form<E> form(Tag<E>) {
  return {
      .read =
          [](const Value& value, const Spec& spec, E& out) {
            if (value.text() == nullptr) wrong_form(value, spec, form(Tag<E>{}).expected(spec));
            for (const auto& choice : model::choices<E>) {
              if (choice.name != *value.text()) continue;
              out = choice.value;
              return;
            }
            unknown_word(value.place, spec.name, *value.text(), model::choice_names<E>());
          },
      .write = [](const E& value, const Spec&) { return toml_text(model::choice_name(value)); },
      .expected = [](const Spec&) { return "one of " + quoted_list(model::choice_names<E>()); },
      .schema = [](const Spec&, Json& out) { words_schema(model::choice_names<E>(), out); },
  };
}

/// A value that may be unset.
template <class T>
Form<std::optional<T>> form(Tag<std::optional<T>>) {
  return {
      .read =
          [](const Value& value, const Spec& spec, std::optional<T>& out) {
            out.reset();
            if (!spec.unset_word.empty() && value.text() != nullptr) {
              if (*value.text() == spec.unset_word) return;
              const bool a_word = value.text()->find_first_of("0123456789") == std::string::npos;
              if (a_word) wrong_form(value, spec, form(Tag<std::optional<T>>{}).expected(spec));
            }
            form(Tag<T>{}).read(value, spec, out.emplace());
          },
      .write =
          [](const std::optional<T>& value, const Spec& spec) {
            if (value) return form(Tag<T>{}).write(*value, spec);
            return spec.unset_word.empty() ? std::string() : toml_text(spec.unset_word);
          },
      .expected =
          [](const Spec& spec) {
            const std::string expected = form(Tag<T>{}).expected(spec);
            return spec.unset_word.empty() ? expected : fmt::format("\"{}\" or {}", spec.unset_word, expected);
          },
      .schema = [](const Spec& spec, Json& out) { form(Tag<T>{}).schema(spec, out); },
  };
}

}  // namespace koshi::io
