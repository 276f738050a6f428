#pragma once

#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <string>

namespace vcarve {

/// Bytes as text of letters, digits, "+", "/" and at the end "=" (RFC 4648).
std::string base64(std::span<const std::uint8_t> bytes);

/// Positions as whole multiples of a quantum from the low corner of their box, three bytes a
/// coordinate, the lowest first: 2^24 steps along each axis are as fine as floats are, so that a
/// room keeps its details beside points that lie a thousand times farther out.
struct PackedPositions {
    Eigen::Vector3d low = Eigen::Vector3d::Zero();
    Eigen::Vector3d quantum = Eigen::Vector3d::Zero(); ///< per axis; a decoded place is off by half
    std::string data;                                  ///< base64
};

PackedPositions pack_positions(std::span<const Eigen::Vector3d> positions);

/// The corners of faces, three bytes a number, the lowest first. Every index must be below 2^24.
std::string pack_faces(std::span<const Face> faces);

/// Colours, three bytes each.
std::string pack_colors(std::span<const Color> colors);

/// Numbers from 0 to 255, a byte each; larger ones as 255.
std::string pack_bytes(std::span<const std::int32_t> numbers);

/// Numbers, two bytes each, the lower first.
std::string pack_two_bytes(std::span<const std::uint16_t> numbers);

/// What stands for an error that is not known.
inline constexpr std::uint16_t kNoError = 65535;

/// Errors in thousandths of a pixel, rounded, two bytes each, the lower first; larger ones as
/// kNoError - 1, negative ones, which are not known, as kNoError.
std::string pack_errors(std::span<const double> errors_px);

} // namespace vcarve
