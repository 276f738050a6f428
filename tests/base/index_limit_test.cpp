#include "base/index_limit.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <gtest/gtest.h>

namespace vcarve::index_limit_test {
namespace {

std::string refusal_of(std::uint64_t count, std::uint64_t most)
{
    return refusal<InputError>([&] { require_indexable(count, most, "points"); });
}

TEST(RequireIndexable, TakesAsManyAsThereAreIndices)
{
    EXPECT_EQ(refusal_of(4'294'967'295, kMostIndices), "no exception");
    EXPECT_EQ(refusal_of(4'294'967'296, kMostIndices),
              "the model makes 4294967296 points, and 32-bit indices allow 4294967295");
}

TEST(RequireIndexable, LeavesEveryFaceItsSixHalfEdges)
{
    EXPECT_EQ(refusal_of(357'913'941, kMostFaces), "no exception");
    EXPECT_EQ(refusal_of(357'913'942, kMostFaces),
              "the model makes 357913942 points, and 32-bit indices allow 357913941");
}

} // namespace
} // namespace vcarve::index_limit_test
