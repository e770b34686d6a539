// Quantities with units.
#include <gtest/gtest.h>

#include <numbers>

#include "io/units.h"

namespace koshi::io {
namespace {

double parse(const std::string& text, Dimension dimension) {
  return parse_quantity(text, dimension, {"case.toml", 3, 5});
}

std::string message(const std::string& text, Dimension dimension) {
  try {
    parse(text, dimension);
  } catch (const InputError& error) {
    EXPECT_EQ(error.place().line, 3);
    EXPECT_EQ(error.place().column, 5);
    return error.message();
  }
  return "no error";
}

// Every conversion by a decimal factor gives the double nearest to the decimal product, which the literal on the right
// is; 1.8 * 0.01 and 1.1 * 0.0254 in doubles are not.
TEST(Units, DecimalConversionsRoundOnce) {
  EXPECT_NE(1.8 * 0.01, 0.018);
  EXPECT_EQ(parse("0.2 cm", Dimension::length), 0.002);
  EXPECT_EQ(parse("1.8 cm", Dimension::length), 0.018);
  EXPECT_EQ(parse("7.8 cm", Dimension::length), 0.078);
  EXPECT_EQ(parse("0.7 mm", Dimension::length), 0.0007);
  EXPECT_EQ(parse("1e-3 km", Dimension::length), 1.0);
  EXPECT_EQ(parse("1.1 inch", Dimension::length), 0.02794);
  EXPECT_EQ(parse("-0.1 cm/s", Dimension::velocity), -0.001);
  EXPECT_EQ(parse("1112 MPa", Dimension::pressure), 1.112e9);
  EXPECT_EQ(parse("1.112e3 MPa", Dimension::pressure), 1.112e9);
  EXPECT_EQ(parse("2.2 g/cm^3", Dimension::density), 2200);
  EXPECT_EQ(parse("9.8 N", Dimension::force), 9.8);
  EXPECT_EQ(parse("1 kgf", Dimension::force), 9.80665);
  EXPECT_EQ(parse("0.1 us", Dimension::time), 1e-7);
  // n mm is n/1000 m for every n: 2000 sizes, none off by a bit.
  int checked = 0;
  for (int n = 1; n <= 2000; ++n, ++checked) EXPECT_EQ(parse(std::to_string(n) + " mm", Dimension::length), n / 1000.0);
  EXPECT_EQ(checked, 2000);
}

TEST(Units, BareNumbersAreSI) {
  EXPECT_EQ(parse("0.5", Dimension::length), 0.5);
  EXPECT_EQ(parse(" +2 ", Dimension::force), 2);
  EXPECT_EQ(parse("0.18", Dimension::number), 0.18);
  EXPECT_EQ(parse("18 %", Dimension::number), 0.18);
}

TEST(Units, AnglesAreADimension) {
  EXPECT_NEAR(parse("180 deg", Dimension::angle), std::numbers::pi, 1e-15);
  EXPECT_NEAR(parse("180 degrees", Dimension::angle), std::numbers::pi, 1e-15);
  EXPECT_EQ(parse("0.5 rad", Dimension::angle), 0.5);
  EXPECT_NEAR(parse("90 deg/s", Dimension::angular_velocity), std::numbers::pi / 2, 1e-15);
  EXPECT_EQ(parse("100 1/s", Dimension::rate), 100);
  EXPECT_EQ(parse("100 /s", Dimension::rate), 100);
  EXPECT_EQ(parse("100 s^-1", Dimension::rate), 100);
  EXPECT_EQ(parse("2 kHz", Dimension::rate), 2000);
  EXPECT_EQ(message("1 Hz", Dimension::angular_velocity),
            "\"1 Hz\" is a rate; expected an angular velocity such as \"10 deg/s\" (a bare number is in rad/s)");
  EXPECT_EQ(message("10 %", Dimension::angle),
            "\"10 %\" is a plain number; expected an angle such as \"10 deg\" (a bare number is in rad)");
}

TEST(Units, FormsOfTheSameUnit) {
  for (const char* text : {"3 m/s^2", "3 m/s2", "3 m s-2", "3 m.s^-2", "3 m/s**2", "3m/s^2", "3 N/kg"})
    EXPECT_EQ(parse(text, Dimension::acceleration), 3) << text;
  EXPECT_EQ(parse("1 µm", Dimension::length), 1e-6);
  EXPECT_EQ(parse("1 um", Dimension::length), 1e-6);
}

TEST(Units, WrongDimension) {
  EXPECT_EQ(message("0.2 s", Dimension::length),
            "\"0.2 s\" is a time; expected a length such as \"0.2 cm\" (a bare number is in m)");
  EXPECT_EQ(message("5 kg", Dimension::density),
            "\"5 kg\" is a quantity in kg; expected a density such as \"2000 kg/m^3\" (a bare number is in kg/m^3)");
  EXPECT_EQ(message("3 m", Dimension::number), "\"3 m\" is a length; expected a plain number such as 0.18");
  EXPECT_EQ(message("20 celsius", Dimension::length),
            "\"20 celsius\" is a quantity in celsius; expected a length such as \"0.2 cm\" (a bare number is in m)");
}

TEST(Units, UnknownUnit) {
  EXPECT_EQ(message("1112 Mpa", Dimension::pressure),
            "unknown unit \"Mpa\" in \"1112 Mpa\" (did you mean \"MPa\"?); expected a pressure such as \"1112 MPa\" (a "
            "bare number is in Pa)");
  EXPECT_EQ(
      message("3 furlongz", Dimension::length),
      "unknown unit \"furlongz\" in \"3 furlongz\"; expected a length such as \"0.2 cm\" (a bare number is in m)");
  EXPECT_EQ(message("2,5 mm", Dimension::length),
            "\"2,5 mm\" has a decimal comma; write a point, as in 2.5 mm; expected a length such as \"0.2 cm\" (a bare "
            "number is in m)");
  // UDUNITS itself would take these for lengths, times and powers.
  for (const char* text : {"1 000 m", "2 2 m", "1 m 2", "5 s since 2000-01-01", "1 m @ 3", "1 lg(re 1 mW)", "1 m^0.5",
                           "1 ((((m", "1 cm/", "1 m^400", "1 -", "1 m;s", "0x10 m"})
    EXPECT_TRUE(message(text, Dimension::length).starts_with("unknown unit"))
        << text << ": " << message(text, Dimension::length);
}

TEST(Units, NotANumber) {
  EXPECT_EQ(message("about 3 m", Dimension::length),
            "\"about 3 m\" does not start with a number; expected a length such as \"0.2 cm\" (a bare number is in m)");
  const std::string range =
      " is out of the range of numbers; expected a length such as \"0.2 cm\" (a bare number is in m)";
  for (const char* text : {"1e999 m", "inf m", "nan", "1e308 km"})
    EXPECT_EQ(message(text, Dimension::length), "\"" + std::string(text) + "\"" + range);
  EXPECT_TRUE(message("", Dimension::length).starts_with("\"\" does not start with a number"));
}

}  // namespace
}  // namespace koshi::io
