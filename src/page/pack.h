#pragma once

#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <string>

namespace vcarve {

/// Encodes bytes as base64 (RFC 4648).
std::string base64(std::span<const std::uint8_t> bytes);

/// Positions as integer multiples of a quantum from the low corner of their box: three bytes per
/// coordinate, little-endian. 2^24 steps per axis are as fine as floats, so a room keeps its
/// details beside points that are a thousand times farther out.
struct PackedPositions {
    Eigen::Vector3d low = Eigen::Vector3d::Zero();
    Eigen::Vector3d quantum = Eigen::Vector3d::Zero(); ///< per axis; maximum error: half of it
    std::string data;                                  ///< base64
};

PackedPositions pack_positions(std::span<const Eigen::Vector3d> positions);

/// Packs the corners of faces, three bytes each, little-endian. Indices must be below 2^24.
std::string pack_faces(std::span<const Face> faces);

/// Packs colors, three bytes each.
std::string pack_colors(std::span<const Color> colors);

/// Packs numbers, a byte each, clamped to 0 to 255.
std::string pack_bytes(std::span<const std::int32_t> numbers);

/// Packs numbers, two bytes each, little-endian.
std::string pack_two_bytes(std::span<const std::uint16_t> numbers);

/// The number of an unknown error.
inline constexpr std::uint16_t kNoError = 65535;

/// Packs errors in rounded thousandths of a pixel, two bytes each, little-endian. Larger errors
/// become kNoError - 1; negative errors are unknown and become kNoError.
std::string pack_errors(std::span<const double> errors_px);

} // namespace vcarve
