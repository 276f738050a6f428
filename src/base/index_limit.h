#pragma once

#include <cstdint>

namespace vcarve {

/// How many points, and how many cells, there may be: their indices have 32 bits, and one value
/// stands for none.
inline constexpr std::uint64_t kMostIndices = 0xffffffffU;

/// How many faces a surface may have: OpenMesh numbers half-edges, six a face where no two faces
/// meet, with the 31 bits of an int.
inline constexpr std::uint64_t kMostFaces = 0x7fffffffU / 6;

/// Throws InputError where there are more than `most` of something: "the model makes 5000000000
/// points, ...". `what` is a plural.
void require_indexable(std::uint64_t count, std::uint64_t most, const char* what);

} // namespace vcarve
