// Materials: tables that go by their name, [material.NAME].
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "io/toml/key.h"

namespace koshi::io {

using Materials = std::vector<model::MaterialDefinition>;

Form<Materials> form(Tag<Materials>) {
  return {
      .read =
          [](const Value& value, const Spec& spec, Materials& out) {
            if (value.table() == nullptr || value.table()->empty())
              wrong_form(value, spec, form(Tag<Materials>{}).expected(spec));
            for (const Entry& entry : *value.table()) {
              // A key of a material right under [material] means that the name was forgotten.
              const auto names = names_of(keys_of(Tag<model::MaterialDefinition>{}));
              if (entry.value.table() == nullptr && std::find(names.begin(), names.end(), entry.key) != names.end())
                throw InputError(entry.place, fmt::format("\"{}\" stands in [material] itself; materials have a name: "
                                                          "[material.rock]",
                                                          entry.key));
              auto& material = out.emplace_back();
              material.name = entry.key;
              read_table(entry.value, fmt::format("[material.{}]", toml_key(entry.key)), material);
            }
          },
      .write = [](const Materials&, const Spec&) { return std::string(); },
      .expected = [](const Spec&) { return std::string("tables with a name such as [material.rock]"); },
      .schema =
          [](const Spec&, Json& out) {
            Json material;
            object_schema(described<model::MaterialDefinition>(), material);
            out = {{"type", "object"}, {"additionalProperties", material}, {"minProperties", 1}};
          },
  };
}

}  // namespace koshi::io
