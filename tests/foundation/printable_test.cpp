// Text for a terminal: nothing in it is obeyed.

#include <gtest/gtest.h>

#include <string>

#include "slipfront/error.hpp"
#include "text/characters.hpp"

namespace {

using slipfront::printable;

TEST(Printable, KeepsWhatIsShown) {
  for (const char* text : {"", "plain", "Sumatra–Andamán 2004", "東北", "\xf0\x9f\x8c\x8a"})
    EXPECT_EQ(printable(text), text);
  EXPECT_EQ(slipfront::printable_lines("a\tb\nc\n"), "a\tb\nc\n");
}

TEST(Printable, ReplacesWhatIsObeyed) {
  EXPECT_EQ(printable("a\x1b[31mb\a\n\t\x7f"), "a?[31mb????");
  EXPECT_EQ(printable("\xc2\x9b"
                      "2J"),
            "?2J");                                                                  // CSI as one character
  EXPECT_EQ(printable("\xe2\x80\xae\xe2\x81\xa6\xe2\x80\x8b\xef\xbb\xbf"), "????");  // override, isolate, no width
  EXPECT_EQ(printable("\xff\xc0\x80\xed\xa0\x80\xe2\x82"), "????????");              // not UTF-8
  EXPECT_EQ(slipfront::printable_lines("a\rb\x1b"), "a?b?");
  EXPECT_EQ(printable(std::string("a\0b", 3)), "a?b");
}

TEST(Printable, IsCutBetweenCharacters) {
  EXPECT_EQ(printable("abcdef", 3), "abc...");
  EXPECT_EQ(printable("abc", 3), "abc");
  EXPECT_EQ(printable("a\xc3\xa9z", 2), "a...");
}

TEST(Printable, AMessageKeepsItsBeginAndItsEnd) {
  const std::string name(1000000, 'x'), cut = slipfront::printable_message("/tmp/" + name + "\xc3\xa9: is missing");
  EXPECT_LT(cut.size(), 2000u);
  EXPECT_EQ(cut.substr(0, 6), "/tmp/x");
  EXPECT_EQ(cut.substr(cut.size() - 15), "x\xc3\xa9: is missing");
  EXPECT_NE(cut.find("x...x"), std::string::npos);
  std::string accents;
  for (int i = 0; i < 2000; ++i) accents += "\xc3\xa9";
  for (const std::string& text : {accents, accents + "x"})
    EXPECT_EQ(slipfront::printable_message(text).find('?'), std::string::npos);
  EXPECT_EQ(slipfront::printable_message("a: b"), "a: b");
  EXPECT_LT(slipfront::one_line({.file = name, .key = name, .value = name, .problem = name, .allowed = name}).size(),
            4000u);
}

TEST(Printable, EveryFieldOfAComplaint) {
  const std::string bad = "\x1b[2J";
  EXPECT_EQ(slipfront::one_line({.file = bad, .line = 1, .key = bad, .value = bad, .problem = bad, .allowed = bad})
                .find('\x1b'),
            std::string::npos);
}

}  // namespace
