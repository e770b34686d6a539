#include "io/toml/key.h"

#include <fmt/format.h>

#include <algorithm>

namespace koshi::io {

const Table& known_table(const Value& value, const std::string& title, const std::vector<std::string>& names) {
  const Table* table = value.table();
  if (table == nullptr)
    throw InputError(value.place, fmt::format("{} is {}; expected a table", title, describe(value)));
  for (const Entry& entry : *table)
    if (std::find(names.begin(), names.end(), entry.key) == names.end())
      throw InputError(entry.place,
                       fmt::format("unknown key \"{}\" in {}; {}", entry.key, title, suggestion(entry.key, names)));
  return *table;
}

void refuse_missing(const Value& value, const std::string& title, const KeyInfo& key) {
  throw InputError(value.place,
                   fmt::format("{} has no \"{}\"; expected {}", title, key.spec.name, key.expected(key.spec)));
}

void check_meaningless(const Table& table, const KeyInfo& key) {
  const Entry* entry = find(table, key.spec.name);
  if (entry == nullptr) return;
  const auto overridden = [&](const std::string& name) {
    const Entry* deciding = find(table, name);
    return deciding != nullptr && deciding->value.overridden;
  };
  if (!entry->value.overridden && std::any_of(key.deciding.begin(), key.deciding.end(), overridden)) return;
  throw InputError(entry->place, fmt::format("\"{}\" has no meaning here; it goes with {}", entry->key, key.condition));
}

std::string inline_table(const std::vector<std::string>& assignments) {
  return fmt::format("{{ {} }}", fmt::join(assignments, ", "));
}

}  // namespace koshi::io
