#pragma once

#include "vcarve/scene.h"

#include <fmt/format.h>

#include <cstring>
#include <string>

namespace vcarve {

/// The bytes of a number on a little-endian machine.
template <typename Number>
std::string raw(Number value)
{
    std::string bytes(sizeof(value), '\0');
    std::memcpy(bytes.data(), &value, sizeof(value));
    return bytes;
}

/// The bytes of a .vis file with these rows, written from the description of the format.
template <typename Rows>
std::string visibility_bytes(const Rows& rows)
{
    std::string bytes = raw(static_cast<std::uint64_t>(rows.size()));
    for (std::size_t i = 0; i < rows.size(); ++i) {
        bytes += raw(static_cast<std::uint32_t>(rows[i].size()));
        for (const std::uint32_t image : rows[i]) {
            bytes += raw(image);
        }
    }
    return bytes;
}

enum class CloudEncoding { binary, ascii };

/// The points of a scene as stereo_fusion writes them, in floats. Text has all digits. Normals are
/// written if the scene has them.
inline std::string cloud_bytes(const Scene& scene, CloudEncoding encoding)
{
    const bool is_ascii = encoding == CloudEncoding::ascii;
    const auto number = [&](auto value) {
        return is_ascii ? fmt::format("{} ", static_cast<double>(value)) : raw(value);
    };
    std::string bytes = fmt::format(
        "ply\nformat {} 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float "
        "z\n{}property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n",
        is_ascii ? "ascii" : "binary_little_endian", scene.num_points(),
        scene.normals.empty() ? "" : "property float nx\nproperty float ny\nproperty float nz\n");
    for (std::size_t i = 0; i < scene.num_points(); ++i) {
        for (const double coordinate : scene.positions[i]) {
            bytes += number(static_cast<float>(coordinate));
        }
        for (int axis = 0; axis < 3 && !scene.normals.empty(); ++axis) {
            bytes += number(scene.normals[i][axis]);
        }
        for (const std::uint8_t channel : scene.colors[i]) {
            bytes += number(channel);
        }
        if (is_ascii) bytes += "\n";
    }
    return bytes;
}

} // namespace vcarve
