#include "steps/3_cells/insertion_order.h"

#include "base/parallel_rows.h"
#include "base/random_number.h"

namespace vcarve {

namespace {

/// In which round a point is inserted: the last one takes three quarters of all points, the one
/// before three quarters of the rest, and so on, by chance.
std::uint32_t insertion_round(std::size_t point, std::uint32_t num_rounds)
{
    std::uint32_t round = num_rounds - 1;
    for (double chance = random_number(0, point); chance < 0.25 && round > 0; chance *= 4.0)
        --round;
    return round;
}

} // namespace

UnsetArray<std::uint32_t> insertion_order(std::size_t count)
{
    constexpr std::size_t kFirstRound = 16; // points or more
    std::uint32_t num_rounds = 1;
    while (count >> (2 * num_rounds) >= kFirstRound)
        ++num_rounds;
    return gather_rows(count, num_rounds,
                       [&](std::size_t i, const auto& visit) {
                           visit(insertion_round(i, num_rounds), static_cast<std::uint32_t>(i));
                       })
        .items;
}

} // namespace vcarve
