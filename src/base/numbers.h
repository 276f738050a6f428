#pragma once

#include <cstdint>
#include <limits>

namespace vcarve {

/// The bound of an unbounded range.
inline constexpr double kUnlimited = std::numeric_limits<double>::infinity();

/// The maximum number of points, and of cells. Their indices have 32 bits, and one value means
/// "none".
inline constexpr std::uint64_t kMostIndices = 0xffffffffU;

/// The maximum number of faces of a surface. OpenMesh numbers half-edges with the 31 bits of an
/// int, and has six half-edges per face if no two faces share an edge.
inline constexpr std::uint64_t kMostFaces = 0x7fffffffU / 6;

/// Throws InputError if `count` exceeds `most`. `what` is a plural noun: "the model results in
/// 5000000000 points, ...".
void require_indexable(std::uint64_t count, std::uint64_t most, const char* what);

/// The result of std::lround for numbers from 0 to 2^31 - 1, without a function call.
inline std::int32_t round_half_up(double number)
{
    const auto whole = static_cast<std::int32_t>(number);
    return whole + (number - whole >= 0.5 ? 1 : 0);
}

/// Random number `index` in [0, 1) of the sequence of `seed`. It depends only on the arguments, so
/// random choices do not depend on the thread count.
double random_number(std::uint64_t seed, std::uint64_t index);

/// Mixes the bits of a number (SplitMix64; Steele, Lea, Flood 2014), so that remainders of
/// consecutive numbers look random.
std::uint64_t mix(std::uint64_t z);

} // namespace vcarve
