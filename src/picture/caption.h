#pragma once

#include "picture/picture.h"

#include <string>

namespace vcarve {

/// Height of the letters with their surroundings at a scale of 1, px.
inline constexpr int kTextHeight = 14;

/// How wide a text is at a scale of 1, px.
int text_width(const std::string& text);

/// Draws a line of text with its upper left corner at a pixel, in stb_easy_font's letters, each dot
/// of which is `scale` pixels a side. What is not ASCII becomes question marks, and what reaches
/// over the picture's edge is cut off. At most 400 letters are drawn.
void draw_text(const std::string& text, const Eigen::Array2i& at_px, int scale,
               const Eigen::Array3f& color, Picture& picture);

/// Fills a rectangle, cut off at the picture's edge.
void fill_box(const Eigen::Array2i& from_px, const Eigen::Array2i& to_px,
              const Eigen::Array3f& color, Picture& picture);

} // namespace vcarve
