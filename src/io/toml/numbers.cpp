// Form of a list of numbers of any length.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "io/toml/form.h"

namespace koshi::io {

Form<std::vector<double>> form(Tag<std::vector<double>>) {
  using Type = std::vector<double>;
  return {
      .read =
          [](const Value& value, const Spec& spec, Type& out) {
            if (value.array() == nullptr || value.array()->empty())
              wrong_form(value, spec, form(Tag<Type>{}).expected(spec));
            out.clear();
            for (const Value& element : *value.array()) {
              Spec of_element = spec;
              of_element.name = fmt::format("{}[{}]", spec.name, out.size());
              form(Tag<double>{}).read(element, of_element, out.emplace_back());
            }
          },
      .write =
          [](const Type& value, const Spec& spec) {
            std::vector<std::string> texts;
            for (const double number : value) texts.push_back(form(Tag<double>{}).write(number, spec));
            return texts.empty() ? std::string() : fmt::format("[{}]", fmt::join(texts, ", "));
          },
      .expected = [](const Spec& spec) { return "a list, each " + form(Tag<double>{}).expected(spec); },
      .schema =
          [](const Spec& spec, Json& out) {
            Json item;
            form(Tag<double>{}).schema(spec, item);
            out = Json{{"type", "array"}, {"items", item}, {"minItems", 1}};
          },
  };
}

}  // namespace koshi::io
