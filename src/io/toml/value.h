// A TOML document as a plain tree in which every key and value knows its place.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "koshi/error.h"

namespace koshi::io {

struct Value;
struct Entry;
using Array = std::vector<Value>;
using Table = std::vector<Entry>;  ///< in the order of the file

/// A date or time of TOML: no key takes one.
struct DateTime {};

struct Value {
  std::variant<bool, std::int64_t, double, std::string, DateTime, Array, Table> data;
  Place place;
  bool overridden = false;  ///< given by --set, not by the file

  const Table* table() const { return std::get_if<Table>(&data); }
  const Array* array() const { return std::get_if<Array>(&data); }
  const std::string* text() const { return std::get_if<std::string>(&data); }
};

struct Entry {
  std::string key;
  Place place;  ///< of the key
  Value value;
};

/// The entry of a table with this key; null when there is none.
const Entry* find(const Table& table, std::string_view key);
Entry* find(Table& table, std::string_view key);

/// What a value is, for messages: `text "abc"`, `the number 3`, `a list`.
std::string describe(const Value& value);

/// Errors: InputError at the place of a syntax error. Places carry `file_name`.
Value parse_toml(std::string_view text, const std::string& file_name);

}  // namespace koshi::io
