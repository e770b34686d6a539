#include "model/formula.h"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "koshi/error.h"

namespace koshi::model {
namespace {

constexpr const char* known =
    "known: x, y, z [m], t [s], pi, sin, cos, tan, asin, acos, atan, atan2, sinh, cosh, tanh, exp, log, log10, sqrt, "
    "abs, floor, sign, min, max, + - * / ^ ( ), comparisons, && || and a ? b : c";

double sign(double value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

[[noreturn]] void fail(const std::string& what, std::size_t position) {
  throw InputError(fmt::format("the formula {} at character {}; {}", what, position + 1, known));
}

// What the parser would take for something else: texts, assignments to x, and letters that look like others.
void check_characters(const std::string& text) {
  if (text.size() > Formula::longest)
    throw InputError(fmt::format("the formula has {} characters; at most {} are read", text.size(), Formula::longest));
  constexpr std::string_view other = "_.+-*/^(),<>=!&|?: ";
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (!plain && other.find(c) == std::string_view::npos) fail("has a character that no formula has", i);
    const bool compares = (i > 0 && std::string_view("<>=!").find(text[i - 1]) != std::string_view::npos) ||
                          (i + 1 < text.size() && text[i + 1] == '=');
    if (c == '=' && !compares) fail("has an = that compares nothing (equal is ==)", i);
  }
}

// Only these: the parser's own set differs from version to version, and one of them is random in some.
void define_functions(mu::Parser& parser) {
  parser.ClearFun();
  parser.ClearConst();
  parser.DefineConst("pi", std::numbers::pi);
  const auto one = [&](const char* name, double (*function)(double)) { parser.DefineFun(name, function); };
  one("sin", std::sin), one("cos", std::cos), one("tan", std::tan);
  one("asin", std::asin), one("acos", std::acos), one("atan", std::atan);
  one("sinh", std::sinh), one("cosh", std::cosh), one("tanh", std::tanh);
  one("exp", std::exp), one("log", std::log), one("log10", std::log10), one("sqrt", std::sqrt);
  one("abs", std::abs), one("floor", std::floor), one("sign", sign);
  const auto two = [&](const char* name, double (*function)(double, double)) { parser.DefineFun(name, function); };
  two("atan2", std::atan2), two("min", std::fmin), two("max", std::fmax);
}

// The parser's message for what most often goes wrong, in words of the input.
std::string what_of(const mu::Parser::exception_type& error) {
  switch (error.GetCode()) {
    case mu::ecUNASSIGNABLE_TOKEN:
      return fmt::format("has the unknown name or sign \"{}\"", error.GetToken());
    case mu::ecUNEXPECTED_EOF:
      return "ends too early";
    case mu::ecMISSING_PARENS:
      return "has a parenthesis that is not closed";
    case mu::ecUNEXPECTED_PARENS:
      return "has a parenthesis too many";
    case mu::ecTOO_MANY_PARAMS:
      return "gives a function too many values";
    case mu::ecTOO_FEW_PARAMS:
      return "gives a function too few values";
    default:
      return error.GetToken().empty() ? "cannot be read" : fmt::format("cannot be read: \"{}\"", error.GetToken());
  }
}

}  // namespace

struct Formula::Implementation {
  mu::Parser parser;
  std::array<double, 4> value{};  // x, y, z, t
  bool time = false;
};

Formula::Formula(const std::string& text) : implementation_(std::make_unique<Implementation>()) {
  check_characters(text);
  Implementation& own = *implementation_;
  try {
    define_functions(own.parser);
    constexpr std::array<const char*, 4> names{"x", "y", "z", "t"};
    for (std::size_t v = 0; v < 4; ++v) own.parser.DefineVar(names[v], &own.value[v]);
    own.parser.SetExpr(text);
    own.parser.Eval();
    own.time = own.parser.GetUsedVar().contains("t");
    if (own.parser.GetNumResults() != 1)
      throw InputError(fmt::format("the formula has {} values; give one", own.parser.GetNumResults()));
  } catch (const mu::Parser::exception_type& error) {
    const int position = error.GetPos();  // of the end: beyond it, or none
    fail(what_of(error), position < 0 ? text.size() : std::min(text.size(), static_cast<std::size_t>(position)));
  }
}

Formula::~Formula() = default;
Formula::Formula(Formula&&) noexcept = default;
Formula& Formula::operator=(Formula&&) noexcept = default;

double Formula::at(const Vec3& place, double t) const {
  implementation_->value = {place[0], place[1], place[2], t};
  return implementation_->parser.Eval();
}

bool Formula::varies_in_time() const { return implementation_->time; }

}  // namespace koshi::model
