// The one table of keys of the input. Each key of a table is told once: its name, the member it sets, its form, default
// and meaning. Reading, writing, the check for unknown keys and the schema all follow from it.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "io/toml/form.h"

namespace koshi::io {

/// What is known of a key apart from the struct it belongs to.
struct KeyInfo {
  Spec spec;
  bool required = false;    ///< where it applies
  std::string description;  ///< sentences
  std::string example;      ///< TOML text of a value; empty: the one of its form
  /// Groups of keys of which exactly one must be given; for the schema, model::check refuses others.
  std::vector<std::string> one_of;
  /// Where the key has a meaning, e.g. `shape "sphere"`; empty: everywhere.
  std::string condition;
  /// The keys that the condition looks at. When one of them is given by --set, a key of the file that lost its meaning
  /// is left aside; else it is an error.
  std::vector<std::string> deciding;
  std::string (*expected)(const Spec&) = nullptr;  ///< of its form
  void (*schema)(const Spec&, Json&) = nullptr;    ///< of its form
};

/// One key of the table of TOML that fills a struct S.
template <class S>
struct Key : KeyInfo {
  std::function<void(const Value&, const Spec&, S&)> read;
  std::function<std::string(const S&, const Spec&)> write;  ///< TOML text; empty for an unset value
  std::function<bool(const S&)> applies;                    ///< none: always
  std::function<bool(const S&)> needed;                     ///< of a required key where it applies; none: always

  bool applies_to(const S& s) const { return !applies || applies(s); }
  bool needed_by(const S& s) const { return required && (!needed || needed(s)); }

  /// A word that stands for a value of its own.
  Key or_word(const std::string& word, void (*set)(S&), bool (*is_set)(const S&)) && {
    read = [word, set, other = std::move(read)](const Value& value, const Spec& about, S& s) {
      if (value.text() != nullptr && *value.text() == word)
        set(s);
      else
        other(value, about, s);
    };
    write = [word, is_set, other = std::move(write)](const S& s, const Spec& about) {
      return is_set(s) ? toml_text(word) : other(s, about);
    };
    return std::move(*this);
  }

  /// Restricts the key to some states of the struct.
  Key only_for(const std::string& text, const std::vector<std::string>& keys,
               std::function<bool(const S&)> predicate) && {
    condition = text;
    deciding = keys;
    applies = std::move(predicate);
    return std::move(*this);
  }

  /// Lets a required key be left out in other states of the struct; its member then is that of a default one.
  Key needed_if(std::function<bool(const S&)> predicate) && {
    needed = std::move(predicate);
    write = [needed = needed, other = std::move(write)](const S& s, const Spec& about) {
      const std::string text = other(s, about);
      return !needed(s) && text == other(S{}, about) ? std::string() : text;
    };
    return std::move(*this);
  }
};

/// What may be said of a key beside its name, member and description.
struct About {
  Dimension dimension = Dimension::number;
  Dimension rotation = Dimension::angle;
  bool required = false;
  std::string unset_word{};
  std::vector<std::string> allowed{};
  std::string title{};
  model::Range range{};
  model::Range rotation_range{};
  std::string example{};
  std::vector<std::string> one_of{};
};

/// A key that sets `member`: a pointer to member, or a function from S& to a reference.
template <class S, class Member>
Key<S> key(const std::string& name, Member member, const std::string& description, const About& about = {}) {
  using T = std::remove_cvref_t<std::invoke_result_t<Member, S&>>;
  const Form<T> of_type = form(Tag<T>{});
  Key<S> result;
  result.spec = {name,          about.dimension, about.rotation, about.unset_word,
                 about.allowed, about.title,     about.range,    about.rotation_range};
  result.required = about.required;
  result.example = about.example;
  result.one_of = about.one_of;
  result.description = description;
  result.expected = of_type.expected;
  result.schema = of_type.schema;
  result.read = [member, read = of_type.read](const Value& value, const Spec& spec, S& s) {
    read(value, spec, std::invoke(member, s));
  };
  result.write = [member, write = of_type.write](const S& s, const Spec& spec) {
    return write(std::invoke(member, s), spec);
  };
  return result;
}

/// The keys of each struct; keys_body.cpp and its neighbours.
const std::vector<Key<model::Definition>>& keys_of(Tag<model::Definition>);
const std::vector<Key<model::LatticeDefinition>>& keys_of(Tag<model::LatticeDefinition>);
const std::vector<Key<model::BodyDefinition>>& keys_of(Tag<model::BodyDefinition>);
const std::vector<Key<model::ScanDefinition>>& keys_of(Tag<model::ScanDefinition>);
const std::vector<Key<model::MaterialDefinition>>& keys_of(Tag<model::MaterialDefinition>);
const std::vector<Key<material::Fracture>>& keys_of(Tag<material::Fracture>);
const std::vector<Key<material::Scatter>>& keys_of(Tag<material::Scatter>);
const std::vector<Key<model::GrainBoundaryDefinition>>& keys_of(Tag<model::GrainBoundaryDefinition>);
const std::vector<Key<model::RegionDefinition>>& keys_of(Tag<model::RegionDefinition>);
const std::vector<Key<model::CrackDefinition>>& keys_of(Tag<model::CrackDefinition>);
const std::vector<Key<model::StopDefinition>>& keys_of(Tag<model::StopDefinition>);
const std::vector<Key<model::SelectionDefinition>>& keys_of(Tag<model::SelectionDefinition>);
const std::vector<Key<model::SphereShape>>& keys_of(Tag<model::SphereShape>);
const std::vector<Key<model::CylinderShape>>& keys_of(Tag<model::CylinderShape>);
const std::vector<Key<model::HalfSpaceShape>>& keys_of(Tag<model::HalfSpaceShape>);
const std::vector<Key<model::BoundaryDefinition>>& keys_of(Tag<model::BoundaryDefinition>);
const std::vector<Key<model::LoadDefinition>>& keys_of(Tag<model::LoadDefinition>);
const std::vector<Key<model::MacroscopicDefinition>>& keys_of(Tag<model::MacroscopicDefinition>);
const std::vector<Key<model::MeanStrain>>& keys_of(Tag<model::MeanStrain>);
const std::vector<Key<model::MeanStress>>& keys_of(Tag<model::MeanStress>);
const std::vector<Key<model::AnalysisDefinition>>& keys_of(Tag<model::AnalysisDefinition>);
const std::vector<Key<model::DampingDefinition>>& keys_of(Tag<model::DampingDefinition>);
const std::vector<Key<model::ProbeDefinition>>& keys_of(Tag<model::ProbeDefinition>);
const std::vector<Key<model::OutputDefinition>>& keys_of(Tag<model::OutputDefinition>);

template <class S>
concept HasKeys = requires {
  keys_of(Tag<S>{});
};

template <class S>
std::vector<std::string> names_of(const std::vector<Key<S>>& keys) {
  std::vector<std::string> names;
  names.reserve(keys.size());
  for (const auto& key : keys) names.push_back(key.spec.name);
  return names;
}

/// The table of a value; throws when it is none or has keys that are not among `names`. `title` is its name in
/// messages.
const Table& known_table(const Value& value, const std::string& title, const std::vector<std::string>& names);

/// Throws for a required key that is not there.
[[noreturn]] void refuse_missing(const Value& value, const std::string& title, const KeyInfo& key);

/// Throws for a key whose condition is not met, unless an override took its meaning away.
void check_meaningless(const Table& table, const KeyInfo& key);

/// Sets the members of `out` from a table; `title` names the table in messages.
template <class S>
void read_table(const Value& value, const std::string& title, S& out) {
  const auto& keys = keys_of(Tag<S>{});
  const Table& table = known_table(value, title, names_of(keys));
  // Keys with a condition come second: the condition looks at what the others have set.
  for (const bool conditional : {false, true}) {
    for (const auto& key : keys) {
      if (key.condition.empty() == conditional) continue;
      const Entry* entry = find(table, key.spec.name);
      if (!key.applies_to(out))
        check_meaningless(table, key);
      else if (entry != nullptr)
        key.read(entry->value, key.spec, out);
      else if (key.needed_by(out))
        refuse_missing(value, title, key);
    }
  }
}

/// The set keys of a struct as "key = value".
template <class S>
std::vector<std::string> assignments(const S& value) {
  std::vector<std::string> texts;
  for (const auto& key : keys_of(Tag<S>{})) {
    const std::string text = key.applies_to(value) ? key.write(value, key.spec) : std::string();
    if (!text.empty()) texts.push_back(key.spec.name + " = " + text);
  }
  return texts;
}

/// `{ a = 1, b = 2 }`
std::string inline_table(const std::vector<std::string>& assignments);

/// A key of the schema and the TOML text of its default; empty: none.
using Described = std::pair<KeyInfo, std::string>;

/// JSON Schema of a table with these keys, and of a list of such tables.
void object_schema(const std::vector<Described>& keys, Json& out);
void list_schema(const std::vector<Described>& keys, Json& out);

/// The keys of a struct with the defaults of a default-constructed one.
template <class S>
std::vector<Described> described() {
  std::vector<Described> keys;
  for (const auto& key : keys_of(Tag<S>{}))
    keys.emplace_back(key, key.required ? std::string() : key.write(S{}, key.spec));
  return keys;
}

/// A nested table.
template <HasKeys S>
Form<S> form(Tag<S>) {
  return {
      .read = [](const Value& value, const Spec& spec,
                 S& out) { read_table(value, spec.title.empty() ? "[" + spec.name + "]" : spec.title, out); },
      .write = [](const S& value, const Spec&) { return inline_table(assignments(value)); },
      .expected = [](const Spec&) { return "a table with " + quoted_list(names_of(keys_of(Tag<S>{}))); },
      .schema = [](const Spec&, Json& out) { object_schema(described<S>(), out); },
  };
}

/// A list of tables, [[name]].
template <HasKeys S>
Form<std::vector<S>> form(Tag<std::vector<S>>) {
  return {
      .read =
          [](const Value& value, const Spec& spec, std::vector<S>& out) {
            if (value.array() == nullptr) wrong_form(value, spec, form(Tag<std::vector<S>>{}).expected(spec));
            for (const Value& element : *value.array())
              read_table(element, "[[" + spec.name + "]]", out.emplace_back());
          },
      .write = [](const std::vector<S>&, const Spec&) { return std::string(); },
      .expected = [](const Spec& spec) { return "tables, each under [[" + spec.name + "]]"; },
      .schema = [](const Spec&, Json& out) { list_schema(described<S>(), out); },
  };
}

/// Named tables, [material.NAME].
Form<std::vector<model::MaterialDefinition>> form(Tag<std::vector<model::MaterialDefinition>>);

}  // namespace koshi::io
