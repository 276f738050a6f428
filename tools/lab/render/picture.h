#pragma once

#include "vcarve/scene.h"

#include <Eigen/Core>

#include <filesystem>
#include <vector>

namespace vcarve::render {

/// An image in memory, row by row from the top; channels from 0 to 255.
struct Picture {
    int width_px = 0;
    int height_px = 0;
    std::vector<Eigen::Array3f> pixels;
};

/// Every square of `factor` x `factor` pixels made one.
Picture shrunk(const Picture& picture, int factor);

/// Writes 8 bits a channel. Throws UsageError where the file cannot be written.
void write_png(const std::filesystem::path& path, const Picture& picture);

} // namespace vcarve::render
