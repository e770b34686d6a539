#include <nlohmann/json.hpp>

#include "io/toml/key.h"
#include "koshi/input.h"

namespace koshi::io {
namespace {

Json json_of(const Value& value) {
  struct Convert {
    Json operator()(bool flag) const { return flag; }
    Json operator()(std::int64_t number) const { return number; }
    Json operator()(double number) const { return number; }
    Json operator()(const std::string& text) const { return text; }
    Json operator()(const DateTime&) const { return nullptr; }
    Json operator()(const Array& list) const {
      Json result = Json::array();
      for (const Value& element : list) result.push_back(json_of(element));
      return result;
    }
    Json operator()(const Table& table) const {
      Json result = Json::object();
      for (const Entry& entry : table) result[entry.key] = json_of(entry.value);
      return result;
    }
  };
  return std::visit(Convert{}, value.data);
}

// The value that a TOML text stands for.
Json json_of_text(const std::string& text) {
  return json_of(parse_toml("value = " + text, "schema").table()->front().value);
}

}  // namespace

void object_schema(const std::vector<Described>& keys, Json& out) {
  Json properties;
  Json required = Json::array();
  Json groups = Json::object();
  for (const auto& [key, default_text] : keys) {
    Json& schema = properties[key.spec.name];
    key.schema(key.spec, schema);
    schema["description"] = key.description + (key.condition.empty() ? "" : " Only for " + key.condition + ".");
    if (!default_text.empty()) schema["default"] = json_of_text(default_text);
    if (!key.example.empty()) schema["examples"] = Json::array({json_of_text(key.example)});
    if (key.required && key.condition.empty()) required.push_back(key.spec.name);
    for (const std::string& group : key.one_of) groups[group].push_back({{"required", {key.spec.name}}});
    // JSON Schema leaves further keywords to whoever reads them.
    if (key.required && !key.condition.empty()) schema["requiredWhereItApplies"] = true;
  }
  out = {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
  if (!required.empty()) out["required"] = required;
  for (const auto& group : groups) out["allOf"].push_back({{"oneOf", group}});
}

void list_schema(const std::vector<Described>& keys, Json& out) {
  Json items;
  object_schema(keys, items);
  out = {{"type", "array"}, {"items", items}};
}

std::string schema_json() {
  Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "Input of Koshi"}};
  Json root;
  object_schema(described<model::Definition>(), root);
  schema.update(root);
  return schema.dump(2) + "\n";
}

}  // namespace koshi::io
