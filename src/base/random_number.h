#pragma once

#include <cstdint>

namespace vcarve {

/// A number in [0, 1) that depends on nothing but its arguments: number `index` of the sequence
/// that `seed` begins. So what is chosen by chance does not depend on the number of threads.
double random_number(std::uint64_t seed, std::uint64_t index);

} // namespace vcarve
