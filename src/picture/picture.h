#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace vcarve {

/// An image in memory, row by row from the top; channels from 0 to 255.
struct Picture {
    int width_px = 0;
    int height_px = 0;
    std::vector<Eigen::Array3f> pixels;
};

/// One of an even colour.
Picture even_picture(int width_px, int height_px, const Eigen::Array3f& color);

/// Puts `part` into `whole` with its upper left corner at a pixel. It must fit.
void paste(const Picture& part, int left_px, int top_px, Picture& whole);

/// Every square of `factor` x `factor` pixels made one.
Picture shrunk(const Picture& picture, int factor);

/// Writes 8 bits a channel as PNG. The file appears whole or not at all. Throws UsageError where it
/// cannot be written.
void write_png(const std::filesystem::path& path, const Picture& picture);

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
