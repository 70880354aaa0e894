// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/mapping/picture/stroke_font.hpp"

#include <cmath>
#include <map>

#include "core/geometry/angle.hpp"

namespace swiftlet::stroke_font {

namespace {

/// Part of an ellipse around (x, y), from one angle to another in degrees (counter-clockwise when rising).
Stroke arc(double x, double y, double radius_x, double radius_y, double from_deg, double to_deg) {
  const int steps = static_cast<int>(std::ceil(std::abs(to_deg - from_deg) / 15.0));
  Stroke stroke;
  for (int i = 0; i <= steps; ++i) {
    const double angle = radians(from_deg + (to_deg - from_deg) * i / steps);
    stroke.push_back({x + radius_x * std::cos(angle), y + radius_y * std::sin(angle)});
  }
  return stroke;
}

Stroke bowl() { return arc(2.2, 2.5, 2.2, 2.5, 0, 360); }

using Glyphs = std::map<char, Glyph>;

void add_letters_a_to_m(Glyphs& g) {
  g['a'] = {4.4, {bowl(), {{4.4, 5}, {4.4, 0}}}};
  g['b'] = {4.4, {bowl(), {{0, 8}, {0, 0}}}};
  g['c'] = {4.0, {arc(2.2, 2.5, 2.2, 2.5, 45, 315)}};
  g['d'] = {4.4, {bowl(), {{4.4, 8}, {4.4, 0}}}};
  g['e'] = {4.4, {{{0, 2.6}, {4.4, 2.6}}, arc(2.2, 2.5, 2.2, 2.5, 0, 315)}};
  g['f'] = {2.8, {{{0.9, 0}, {0.9, 6.4}}, arc(2.4, 6.4, 1.5, 1.6, 180, 75), {{0, 5}, {2.6, 5}}}};
  g['g'] = {4.4, {bowl(), {{4.4, 5}, {4.4, -0.6}}, arc(2.2, -0.6, 2.2, 1.9, 0, -145)}};
  g['h'] = {4.0, {{{0, 8}, {0, 0}}, arc(2, 3, 2, 2, 180, 0), {{4, 3}, {4, 0}}}};
  g['i'] = {0.0, {{{0, 5}, {0, 0}}, {{0, 7.2}}}};
  g['j'] = {1.2, {{{1.2, 5}, {1.2, -1}}, arc(-0.3, -1, 1.5, 1.5, 0, -90), {{1.2, 7.2}}}};
  g['k'] = {3.8, {{{0, 8}, {0, 0}}, {{3.5, 5}, {0, 1.9}}, {{1.4, 3.1}, {3.8, 0}}}};
  g['l'] = {0.0, {{{0, 8}, {0, 0}}}};
  g['m'] = {6.6,
            {{{0, 5}, {0, 0}},
             arc(1.65, 3.3, 1.65, 1.7, 180, 0),
             {{3.3, 3.3}, {3.3, 0}},
             arc(4.95, 3.3, 1.65, 1.7, 180, 0),
             {{6.6, 3.3}, {6.6, 0}}}};
}

void add_letters_n_to_z(Glyphs& g) {
  g['n'] = {4.0, {{{0, 5}, {0, 0}}, arc(2, 3, 2, 2, 180, 0), {{4, 3}, {4, 0}}}};
  g['o'] = {4.4, {bowl()}};
  g['p'] = {4.4, {bowl(), {{0, 5}, {0, -2.4}}}};
  g['q'] = {4.4, {bowl(), {{4.4, 5}, {4.4, -2.4}}}};
  g['r'] = {2.6, {{{0, 5}, {0, 0}}, arc(2, 3, 2, 2, 180, 70)}};
  g['s'] = {3.7, {arc(1.85, 3.8, 1.7, 1.2, 30, 270), arc(1.85, 1.3, 1.85, 1.3, 90, -155)}};
  g['t'] = {2.6, {{{0.9, 7}, {0.9, 1.4}}, arc(2.3, 1.4, 1.4, 1.4, 180, 285), {{0, 5}, {2.5, 5}}}};
  g['u'] = {4.0, {{{0, 5}, {0, 2}}, arc(2, 2, 2, 2, 180, 360), {{4, 5}, {4, 0}}}};
  g['v'] = {4.0, {{{0, 5}, {2, 0}, {4, 5}}}};
  g['w'] = {6.0, {{{0, 5}, {1.5, 0}, {3, 5}, {4.5, 0}, {6, 5}}}};
  g['x'] = {3.8, {{{0, 5}, {3.8, 0}}, {{0, 0}, {3.8, 5}}}};
  g['y'] = {4.0, {{{0, 5}, {2, 0}}, {{4, 5}, {1, -2.4}}}};
  g['z'] = {3.6, {{{0, 5}, {3.6, 5}, {0, 0}, {3.6, 0}}}};
}

void add_digits(Glyphs& g) {
  g['0'] = {4.6, {arc(2.3, 4, 2.3, 4, 0, 360)}};
  g['1'] = {2.2, {{{0, 6.4}, {1.9, 8}, {1.9, 0}}}};
  Stroke two = arc(2.2, 5.7, 2.2, 2.3, 165, -38);
  two.insert(two.end(), {{0, 0}, {4.6, 0}});
  g['2'] = {4.6, {two}};
  g['3'] = {4.4, {arc(2.1, 6.1, 2.0, 1.9, 150, -90), arc(2.1, 2.1, 2.3, 2.1, 90, -155)}};
  g['4'] = {4.6, {{{3.5, 0}, {3.5, 8}, {0, 2.4}, {4.6, 2.4}}}};
  g['5'] = {4.4, {{{4.1, 8}, {0.8, 8}, {0.4, 4.5}}, arc(2.1, 2.65, 2.3, 2.65, 137, -150)}};
  g['6'] = {4.6, {arc(2.3, 2.6, 2.3, 2.6, 0, 360), arc(4.6, 2.6, 4.6, 5.4, 180, 102)}};
  g['7'] = {4.4, {{{0, 8}, {4.4, 8}, {1.5, 0}}}};
  g['8'] = {4.6, {arc(2.3, 6.1, 1.9, 1.9, 0, 360), arc(2.3, 2.1, 2.3, 2.1, 0, 360)}};
  g['9'] = {4.6, {arc(2.3, 5.4, 2.3, 2.6, 0, 360), arc(0, 5.4, 4.6, 5.4, 0, -78)}};
}

void add_signs(Glyphs& g) {
  g[' '] = {1.6, {}};
  g['.'] = {0.0, {{{0, 0}}}};
  g[','] = {0.4, {{{0.4, 0.2}, {0, -1.4}}}};
  g[':'] = {0.0, {{{0, 0.2}}, {{0, 4.4}}}};
  g['-'] = {2.8, {{{0, 3}, {2.8, 3}}}};
  g['+'] = {4.0, {{{0, 3}, {4, 3}}, {{2, 5}, {2, 1}}}};
  g['/'] = {3.0, {{{0, -1}, {3, 8.4}}}};
  g['_'] = {4.4, {{{0, -1}, {4.4, -1}}}};
  g['='] = {4.0, {{{0, 4}, {4, 4}}, {{0, 2}, {4, 2}}}};
  g['?'] = {3.6, {arc(1.8, 6.2, 1.8, 1.8, 170, -60), {{2.7, 4.6}, {1.8, 3.6}, {1.8, 2.4}}, {{1.8, 0}}}};
  g['@'] = {7.0,
            {arc(3.5, 2.9, 1.5, 1.8, 0, 360),
             {{5, 4.7}, {5, 2}},
             arc(6, 2, 1, 0.9, 180, 360),
             arc(3.5, 2.9, 3.5, 4.1, 0, 300),
             {{7, 2.9}, {7, 2}}}};
  g['('] = {1.6, {arc(4, 3.6, 4, 6.4, 130, 230)}};
  g[')'] = {1.6, {arc(-2.4, 3.6, 4, 6.4, 50, -50)}};
  g['%'] = {6.0, {arc(1.3, 6.4, 1.3, 1.6, 0, 360), arc(4.7, 1.6, 1.3, 1.6, 0, 360), {{5, 8}, {1, 0}}}};
}

Glyphs make_glyphs() {
  Glyphs glyphs;
  add_letters_a_to_m(glyphs);
  add_letters_n_to_z(glyphs);
  add_digits(glyphs);
  add_signs(glyphs);
  return glyphs;
}

}  // namespace

const Glyph& glyph_of(char letter) {
  static const Glyphs kGlyphs = make_glyphs();
  const bool upper = letter >= 'A' && letter <= 'Z';
  const auto found = kGlyphs.find(upper ? static_cast<char>(letter - 'A' + 'a') : letter);
  return found != kGlyphs.end() ? found->second : kGlyphs.at(' ');
}

}  // namespace swiftlet::stroke_font
