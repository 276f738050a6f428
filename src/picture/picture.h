#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <filesystem>
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

} // namespace vcarve
