#include "io/units.h"

#include <fmt/format.h>
#include <udunits2.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/suggest.h"

namespace koshi::io {
namespace {

constexpr std::array<DimensionWords, 12> all_words{{
    {"a plain number", "", "0.18"},
    {"a length", "m", "0.2 cm"},
    {"a time", "s", "1e-7 s"},
    {"a pressure", "Pa", "1112 MPa"},
    {"a density", "kg/m^3", "2000 kg/m^3"},
    {"a force", "N", "9.8 N"},
    {"an acceleration", "m/s^2", "9.8 m/s^2"},
    {"a velocity", "m/s", "-0.1 cm/s"},
    {"an angle", "rad", "10 deg"},
    {"an angular velocity", "rad/s", "10 deg/s"},
    {"a rate", "1/s", "100 1/s"},
    {"an energy per area", "J/m^2", "100 J/m^2"},
}};

// Units people write for these dimensions; a misspelt one is looked for here.
const std::vector<std::string>& common_units() {
  static const std::vector<std::string> units{
      "m",    "mm",   "cm",     "km",    "um",    "inch",  "foot",   "s",     "ms",     "us",     "min",
      "hour", "day",  "Pa",     "kPa",   "MPa",   "GPa",   "psi",    "bar",   "kg/m^3", "g/cm^3", "N",
      "kN",   "MN",   "mN",     "kgf",   "lbf",   "m/s^2", "cm/s^2", "m/s",   "cm/s",   "mm/s",   "deg",
      "rad",  "mrad", "degree", "deg/s", "rad/s", "1/s",   "Hz",     "J/m^2", "N/m",    "N/mm"};
  return units;
}

struct FreeUnit {
  void operator()(ut_unit* unit) const { ut_free(unit); }
};
using Unit = std::unique_ptr<ut_unit, FreeUnit>;

struct FreeConverter {
  void operator()(cv_converter* converter) const { cv_free(converter); }
};
using Converter = std::unique_ptr<cv_converter, FreeConverter>;

// The units of UDUNITS' database, read once; "deg", which it lacks, means degree.
ut_system* unit_system() {
  static ut_system* const system = [] {
    ut_set_error_message_handler(ut_ignore);
    ut_system* const read = ut_read_xml(nullptr);
    if (read == nullptr)
      throw RunError(
          "cannot read the UDUNITS-2 database of units; install it (Debian: libudunits2-data) or name it in "
          "UDUNITS2_XML_PATH");
    const Unit degree(ut_get_unit_by_name(read, "degree"));
    ut_map_name_to_unit("deg", UT_ASCII, degree.get());
    return read;
  }();
  return system;
}

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

// UDUNITS also reads numbers, dates and logarithms inside a unit ("2 m", "s since 2000-01-01"): they would only hide
// mistakes. Digits may only be exponents, or the 1 of "1/s".
bool is_plain_unit(std::string_view text) {
  constexpr std::size_t longest = 64;
  if (text.empty() || text.size() > longest) return false;
  if (text.starts_with("1/")) text.remove_prefix(2);
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const char before = i == 0 ? ' ' : text[i - 1];
    const bool other_alphabet = static_cast<unsigned char>(c) >= 0x80;  // µ, °, ·
    const bool exponent = is_digit(c) && (is_letter(before) || is_digit(before) || before == '^' || before == '-' ||
                                          (before == '*' && i >= 2 && text[i - 2] == '*'));
    if (!is_letter(c) && !other_alphabet && !exponent &&
        std::string_view(" */^.-()%").find(c) == std::string_view::npos)
      return false;
  }
  return true;
}

Unit parse_unit(std::string_view text) {
  if (!is_plain_unit(text)) return nullptr;
  const std::string whole = text.starts_with('/') ? fmt::format("1{}", text) : std::string(text);
  return Unit(ut_parse(unit_system(), whole.c_str(), UT_UTF8));
}

// UDUNITS takes the radian for a plain 1; whether a unit has it shows in its definition.
bool is_angular(const ut_unit* unit) {
  std::array<char, 256> text{};
  const int length = ut_format(unit, text.data(), text.size() - 1, UT_ASCII | UT_DEFINITION);
  return length > 0 && std::string_view(text.data()).find("rad") != std::string_view::npos;
}

// Factor from a unit to the SI unit of a dimension; none when they do not measure the same.
std::optional<double> factor_to_si(ut_unit* unit, Dimension dimension) {
  const std::string_view si = words(dimension).si_unit;
  const Unit target(ut_parse(unit_system(), std::string(si).c_str(), UT_UTF8));
  if (!ut_are_convertible(unit, target.get()) || is_angular(unit) != is_angular(target.get())) return std::nullopt;
  const Converter converter(ut_get_converter(unit, target.get()));
  // Units with an offset (dates, temperatures) have no factor.
  if (converter == nullptr || cv_convert_double(converter.get(), 0.0) != 0) return std::nullopt;
  return cv_convert_double(converter.get(), 1.0);
}

// digits x 10^exponent
struct Decimal {
  std::int64_t digits;
  int exponent;
};

std::optional<Decimal> decimal(std::string_view text) {
  Decimal result{0, 0};
  const bool negative = text.starts_with('-');
  if (negative) text.remove_prefix(1);
  bool after_point = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '.') {
      after_point = true;
    } else if (is_digit(text[i])) {
      if (__builtin_mul_overflow(result.digits, 10, &result.digits) ||
          __builtin_add_overflow(result.digits, text[i] - '0', &result.digits))
        return std::nullopt;
      if (after_point) --result.exponent;
    } else {
      // The exponent: from_chars has no use for its plus sign.
      std::string_view tail = text.substr(i + 1);
      if (tail.starts_with('+')) tail.remove_prefix(1);
      int exponent = 0;
      const auto [end, error] = std::from_chars(tail.data(), tail.data() + tail.size(), exponent);
      constexpr int largest = 1000;
      if (error != std::errc() || std::abs(exponent) > largest) return std::nullopt;
      result.exponent += exponent;
      break;
    }
  }
  if (negative) result.digits = -result.digits;
  return result;
}

// Not finite when the text is out of the range of numbers.
double to_double(const std::string& text) {
  double value = std::numeric_limits<double>::quiet_NaN();
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

// number x factor, rounded once when both are short decimals: 1.8 x 0.01 is 18e-3, not 0.018000000000000002.
double scaled(std::string_view number_text, double number, double factor) {
  // UDUNITS' factors carry rounding of their own; a decimal of twelve digits within it is what was meant.
  const std::string factor_text = fmt::format("{:.12g}", factor);
  const bool short_factor = std::abs(to_double(factor_text) - factor) <= 4e-16 * std::abs(factor);
  const auto a = decimal(number_text);
  const auto b = decimal(factor_text);
  std::int64_t digits = 0;
  if (!short_factor || !a || !b || __builtin_mul_overflow(a->digits, b->digits, &digits)) return number * factor;
  return to_double(fmt::format("{}e{}", digits, a->exponent + b->exponent));
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

// `, did you mean "MPa"?` when a common unit of the dimension is a few typing errors away.
std::string meant_unit(std::string_view text, Dimension dimension) {
  std::vector<std::string> units;
  for (const auto& unit : common_units())
    if (factor_to_si(parse_unit(unit).get(), dimension)) units.push_back(unit);
  const auto meant = nearest(text, units);
  return meant ? fmt::format(" (did you mean \"{}\"?)", *meant) : "";
}

// What a unit measures, in words where this program has them.
std::string measured_by(ut_unit* unit, std::string_view text) {
  for (std::size_t i = 0; i < all_words.size(); ++i)
    if (factor_to_si(unit, static_cast<Dimension>(i))) return std::string(all_words[i].noun);
  return fmt::format("a quantity in {}", text);
}

}  // namespace

const DimensionWords& words(Dimension dimension) { return all_words[static_cast<std::size_t>(dimension)]; }

std::string expected_quantity(Dimension dimension) {
  const auto& w = words(dimension);
  if (dimension == Dimension::number) return fmt::format("{} such as {}", w.noun, w.example);
  return fmt::format("{} such as \"{}\" (a bare number is in {})", w.noun, w.example, w.si_unit);
}

double parse_quantity(std::string_view text, Dimension dimension, const Place& place) {
  const auto fail = [&](const std::string& message) {
    throw InputError(place, fmt::format("{}; expected {}", message, expected_quantity(dimension)));
  };

  std::string_view rest = trimmed(text);
  if (rest.starts_with('+')) rest.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
  if (error == std::errc::invalid_argument) fail(fmt::format("\"{}\" does not start with a number", text));
  if (error != std::errc() || !std::isfinite(number)) fail(fmt::format("\"{}\" is out of the range of numbers", text));
  const std::string_view number_text(rest.data(), static_cast<std::size_t>(end - rest.data()));
  const std::string_view unit_text = trimmed(rest.substr(number_text.size()));
  if (unit_text.empty()) return number;

  if (unit_text.size() > 1 && unit_text[0] == ',' && is_digit(unit_text[1]))
    fail(fmt::format("\"{}\" has a decimal comma; write a point, as in {}.{}", text, number_text, unit_text.substr(1)));

  const Unit unit = parse_unit(unit_text);
  if (unit == nullptr)
    fail(fmt::format("unknown unit \"{}\" in \"{}\"{}", unit_text, text, meant_unit(unit_text, dimension)));
  const auto factor = factor_to_si(unit.get(), dimension);
  if (!factor) fail(fmt::format("\"{}\" is {}", text, measured_by(unit.get(), unit_text)));
  const double value = scaled(number_text, number, *factor);
  if (!std::isfinite(value)) fail(fmt::format("\"{}\" is out of the range of numbers", text));
  return value;
}

}  // namespace koshi::io
