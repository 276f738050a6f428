#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace vcarve {

/// An image in memory, with rows from the top and channels from 0 to 255.
struct Picture {
    int width_px = 0;
    int height_px = 0;
    std::vector<Eigen::Array3f> pixels;
};

/// Returns a picture of one color.
Picture even_picture(int width_px, int height_px, const Eigen::Array3f& color);

/// Copies `part` into `whole` with its upper left corner at the given pixel. It must fit.
void paste(const Picture& part, int left_px, int top_px, Picture& whole);

/// Averages squares of `factor` x `factor` pixels. Incomplete squares are dropped.
Picture shrunk(const Picture& picture, int factor);

/// Writes a PNG with 8 bits per channel. The file appears complete or not at all. Throws UsageError
/// if it cannot be written.
void write_png(const std::filesystem::path& path, const Picture& picture);

/// The line height in px at scale 1.
inline constexpr int kTextHeight = 14;

/// The width of a text in px at scale 1.
int text_width(const std::string& text);

/// Draws a line of text with its upper left corner at the given pixel, in the font of
/// stb_easy_font. Each dot is `scale` x `scale` pixels. Characters other than ASCII become question
/// marks. Text is clipped at the picture's edges. At most 400 letters are drawn.
void draw_text(const std::string& text, const Eigen::Array2i& at_px, int scale,
               const Eigen::Array3f& color, Picture& picture);

/// Fills a rectangle, clipped at the picture's edges.
void fill_box(const Eigen::Array2i& from_px, const Eigen::Array2i& to_px,
              const Eigen::Array3f& color, Picture& picture);

} // namespace vcarve
