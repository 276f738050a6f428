// Shows that ThreadSanitizer observes our parallel loops. With the argument "race", two bodies race
// and ThreadSanitizer must report them. With "none" it must report nothing.
#include "base/parallel.h"

#include <tbb/task_arena.h>

#include <cstdint>
#include <cstdio>
#include <functional>
#include <latch>
#include <numeric>
#include <string_view>
#include <vector>

namespace vcarve {
namespace {

constexpr std::size_t kCount = 1U << 18U;

/// Nested loops, each of which reads the results of the previous one.
std::int64_t without_a_race()
{
    std::vector<std::int64_t> values(kCount);
    parallel_for(kCount, [&](std::size_t i) { values[i] = static_cast<std::int64_t>(i); });
    std::vector<std::int64_t> halves(2);
    parallel_invoke([&] { halves[0] = std::accumulate(values.begin(), values.end(), 0LL); },
                    [&] { halves[1] = std::accumulate(values.begin(), values.end(), 0LL); });
    const auto odd = parallel_collect<std::int64_t>(kCount, [&](std::size_t i, auto& found) {
        if (values[i] % 2 == 1) found.push_back(values[i]);
    });
    std::vector<std::int64_t> sorted = odd;
    parallel_sort(sorted, std::greater<>());
    std::vector<std::int64_t> sums(64);
    parallel_for(
        sums.size(),
        [&](std::size_t k) {
            sums[k] =
                parallel_sum(kCount, std::int64_t{0}, [&](std::size_t i) { return values[i]; });
        },
        1);
    return halves[0] + halves[1] + sorted.front() + sums.back();
}

/// Two bodies add to the same non-atomic number. They wait for each other, so one thread cannot run
/// both.
std::int64_t with_a_race()
{
    std::int64_t sum = 0;
    std::latch both(2);
    parallel_for(
        2,
        [&](std::size_t i) {
            both.arrive_and_wait();
            sum += static_cast<std::int64_t>(i);
        },
        1);
    return sum;
}

} // namespace
} // namespace vcarve

int main(int count, char** words)
{
    const bool plants = count == 2 && std::string_view(words[1]) == "race";
    tbb::task_arena arena(4);
    const std::int64_t sum =
        arena.execute([&] { return plants ? vcarve::with_a_race() : vcarve::without_a_race(); });
    std::printf("%lld\n", static_cast<long long>(sum));
    return 0;
}
