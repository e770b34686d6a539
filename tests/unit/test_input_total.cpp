// Reading is total: whatever bytes come, there is a definition or an InputError.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "support/broken_input.h"

namespace koshi::tests {
namespace {

std::vector<std::string> seeds() {
  std::vector<std::string> texts;
  for (const char* folder : {"examples", "tests/fuzz/corpus/input"})
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(std::filesystem::path(KOSHI_SOURCE_DIR) / folder)) {
      if (entry.path().extension() != ".toml") continue;
      std::stringstream text;
      text << std::ifstream(entry.path()).rdbuf();
      texts.push_back(text.str());
    }
  return texts;
}

// Deletes, doubles, moves or replaces a piece of the text, some of them with what the grammar cares for.
std::string mutated(std::string text, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
  const std::vector<std::string> pieces{"\"", "[",  "]",    "{",    "}",   "=",   ",",  ".",    "\n",   "#",   "-",
                                        "e9", "\\", "\xff", "\x01", "nan", "inf", "[[", "]]\n", "true", "0x1", "1e400"};
  const std::size_t edits = 1 + below(3);
  for (std::size_t i = 0; i < edits && !text.empty(); ++i) {
    const std::size_t at = below(text.size());
    const std::size_t length = std::min(text.size() - at, 1 + below(12));
    const std::string piece = text.substr(at, length);
    switch (below(4)) {
      case 0:
        text.erase(at, length);
        break;
      case 1:
        text.insert(at, piece);
        break;
      case 2:
        text.insert(below(text.size()), piece);
        break;
      case 3:
        text.replace(at, 1, pieces[below(pieces.size())]);
        break;
    }
  }
  return text;
}

TEST(Total, MutatedCasesAreReadOrRefused) {
  std::mt19937 random(20240711);
  const auto texts = seeds();
  ASSERT_GE(texts.size(), 8u);
  int right = 0, wrong = 0;
  for (int round = 0; round < 1000; ++round)
    for (const std::string& text : texts) {
      const std::string input = mutated(text, random);
      try {
        const model::Definition definition = io::read_case_text(input, "case.toml");
        // What could be read has a resolved form that says the same.
        const std::string resolved = io::resolved_toml(definition);
        EXPECT_EQ(io::resolved_toml(io::read_case_text(resolved, "resolved.toml")), resolved) << input;
        ++right;
      } catch (const InputError& error) {
        // The place is in the file, the message says something after it.
        EXPECT_EQ(error.place().file, "case.toml") << error.what();
        EXPECT_GE(error.place().line, 1) << error.what() << input;
        EXPECT_GE(error.place().column, 1) << error.what();
        EXPECT_GT(error.message().size(), 10u);
        ++wrong;
      }
    }
  // Both happen often: edits of comments and titles do no harm, most others do.
  EXPECT_GT(right, 300);
  EXPECT_GT(wrong, 3000);
}

TEST(Total, OverridesOfAnyShape) {
  std::mt19937 random(7);
  const std::string letters = "abx.=[]{}\"0123 -e";
  int refused = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string text = i % 2 ? "lattice.spacing=" : "";
    for (int k = 0; k < 12; ++k) text += letters[random() % letters.size()];
    refused += !message_of(right_case, std::vector<std::string>{text}).empty();
  }
  EXPECT_GT(refused, 2500);
}

// Nesting without end would exhaust the stack of any reader that recurses.
TEST(Total, DeepNesting) {
  std::string keys = "a", header = "[a", arrays = "a = ", tables = "a = ";
  for (int i = 0; i < 300000; ++i) {
    keys += ".a";
    header += ".\"a\"";
    arrays += "[";
    tables += "{a=";
  }
  EXPECT_EQ(message_of(keys + " = 1"), "case.toml:1:202: error: more than 100 dots in a row; keys have a few");
  EXPECT_NE(message_of(header + "]"), "");
  EXPECT_NE(message_of(arrays), "");
  EXPECT_NE(message_of(tables), "");
}

// Dots of a text are no keys, whatever quotes it has; those of a key behind it count.
TEST(Total, DotsInTexts) {
  const std::string dots(300, '.');
  std::string keys = "b";
  for (int i = 0; i < 300; ++i) keys += ".b";
  const std::vector<std::string> texts{
      "\"" + dots + "\"",
      "'" + dots + "\\'",
      "\"\\\"" + dots + "\"",
      "\"\"\"\n" + dots + "\"\"\"",
      "\"\"\"\\\"\"" + dots + "\"\"\"\"\"",
      "'''" + dots + "\n''''",
  };
  for (const std::string& text : texts) {
    const std::string refused = "100 dots in a row";
    EXPECT_EQ(message_of("title = " + text + " # it's " + dots).find(refused), std::string::npos) << text;
    EXPECT_NE(message_of("title = " + text + "\n" + keys + " = 1").find(refused), std::string::npos) << text;
    EXPECT_NE(message_of("a = [" + text + ", {" + keys + " = 1}]").find(refused), std::string::npos) << text;
  }
}

// Many tables of a list take time in proportion.
TEST(Total, ManyTables) {
  std::string text = right_case;
  for (int i = 0; i < 20000; ++i) text += "[[probe]]\nname = \"p" + std::to_string(i) + "\"\npoint = [0, 0, 0]\n";
  EXPECT_EQ(io::read_case_text(text, "case.toml").probes.size(), 20001u);
}

}  // namespace
}  // namespace koshi::tests
