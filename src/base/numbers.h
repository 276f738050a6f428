#pragma once

#include <cstdint>
#include <limits>

namespace vcarve {

/// The end of a range that has none.
inline constexpr double kUnlimited = std::numeric_limits<double>::infinity();

/// How many points, and how many cells, there may be: their indices have 32 bits, and one value
/// stands for none.
inline constexpr std::uint64_t kMostIndices = 0xffffffffU;

/// How many faces a surface may have: OpenMesh numbers half-edges, six a face where no two faces
/// meet, with the 31 bits of an int.
inline constexpr std::uint64_t kMostFaces = 0x7fffffffU / 6;

/// Throws InputError where there are more than `most` of something: "the model makes 5000000000
/// points, ...". `what` is a plural.
void require_indexable(std::uint64_t count, std::uint64_t most, const char* what);

/// What std::lround gives for numbers from 0 to 2^31 - 1, without its call.
inline std::int32_t round_half_up(double number)
{
    const auto whole = static_cast<std::int32_t>(number);
    return whole + (number - whole >= 0.5 ? 1 : 0);
}

/// A number in [0, 1) that depends on nothing but its arguments: number `index` of the sequence
/// that `seed` begins. So what is chosen by chance does not depend on the number of threads.
double random_number(std::uint64_t seed, std::uint64_t index);

} // namespace vcarve
