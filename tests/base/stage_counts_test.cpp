#include "base/stage_counts.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <set>
#include <string_view>
#include <vector>

namespace vcarve::stage_counts_test {
namespace {

using Group = std::vector<CountKind>;

/// The members of a group.
template <typename Members>
Group group(const Members& members)
{
    constexpr std::size_t kSize = sizeof(Members) / sizeof(CountKind);
    static_assert(sizeof(Members) == kSize * sizeof(CountKind), "a member is no kind of count");
    const auto kinds = std::bit_cast<std::array<CountKind, kSize>>(members);
    return Group(kinds.begin(), kinds.end());
}

std::vector<Group> all_groups()
{
    using namespace counts;
    return {group(kPlan),    group(kRead),     group(kDense),   group(kMerge),      group(kFilter),
            group(kPoints),  group(kDenoise),  group(kCells),   group(kViewpoints), group(kSurface),
            group(kMesh),    group(kSmooth),   group(kTexture), group(kJoin),       group(kOutput),
            group(kCompare), group(kTileFiles)};
}

TEST(StageCounts, HaveUniqueKeysWithinAGroupOfStages)
{
    for (const Group& group : all_groups()) {
        std::set<std::string_view> keys;
        for (const CountKind& kind : group) {
            EXPECT_TRUE(keys.insert(kind.key).second) << kind.key;
        }
    }
}

TEST(StageCounts, HaveKeysUnlikeThoseOfTotals)
{
    for (const Group& group : all_groups()) {
        for (const CountKind& kind : group) {
            EXPECT_FALSE(kind.key.empty() || kind.key.starts_with("of ")) << kind.key;
        }
    }
}

TEST(StageCounts, HaveMeanings)
{
    for (const Group& group : all_groups()) {
        for (const CountKind& kind : group) {
            EXPECT_FALSE(kind.meaning.empty()) << kind.key;
        }
    }
}

TEST(FindCount, ComparesKeys)
{
    const Counts counts = {{counts::kFilter.points, 3, 5}, {counts::kFilter.few_views, 2}};
    const CountKind renamed = {"few views", "another text", "another meaning"};
    ASSERT_NE(find_count(counts, renamed), nullptr);
    EXPECT_EQ(find_count(counts, renamed)->value, 2);
    EXPECT_EQ(find_count(counts, counts::kFilter.points)->of, 5);
    EXPECT_EQ(find_count(counts, counts::kFilter.stray), nullptr);
}

} // namespace
} // namespace vcarve::stage_counts_test
