// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/mapping/picture/stroke_font.hpp"

#include <gmock/gmock.h>

#include <string>

namespace swiftlet::stroke_font {
namespace {

TEST(StrokeFont, HasLettersDigitsAndSigns) {
  for (const char letter : std::string("abcdefghijklmnopqrstuvwxyz0123456789.,:-+/()%_=?@"))
    EXPECT_FALSE(glyph_of(letter).strokes.empty()) << letter;
  EXPECT_TRUE(glyph_of(' ').strokes.empty());
}

TEST(StrokeFont, StrokesStayInTheirLetter) {
  for (char letter = '!'; letter <= '~'; ++letter) {
    const Glyph& glyph = glyph_of(letter);
    for (const Stroke& stroke : glyph.strokes) {
      EXPECT_FALSE(stroke.empty()) << letter;
      for (const Point& p : stroke) {
        EXPECT_GE(p.x, -0.5 * kSpacing) << letter;
        EXPECT_LE(p.x, glyph.width + 0.5 * kSpacing) << letter;
        EXPECT_GE(p.y, -3.0) << letter;
        EXPECT_LE(p.y, kHeight + 0.6) << letter;
      }
    }
  }
}

}  // namespace
}  // namespace swiftlet::stroke_font
