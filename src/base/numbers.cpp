#include "base/numbers.h"

#include "vcarve/error.h"

#include <fmt/format.h>

namespace vcarve {

namespace {

constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15U; ///< 2^64 / golden ratio

} // namespace

std::uint64_t mix(std::uint64_t z)
{
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
}

void require_indexable(std::uint64_t count, std::uint64_t most, const char* what)
{
    if (count <= most) return;
    throw InputError(fmt::format("the model results in {} {}, but 32-bit indices allow at most {}",
                                 count, what, most));
}

double random_number(std::uint64_t seed, std::uint64_t index)
{
    const std::uint64_t bits = mix(mix(seed + kGolden) + (index + 1) * kGolden);
    return static_cast<double>(bits >> 11U) * 0x1p-53;
}

} // namespace vcarve
