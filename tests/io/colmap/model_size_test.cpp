#include "io/colmap/model_size.h"
#include "support/temporary_folder.h"

#include <gtest/gtest.h>

namespace vcarve::model_size_test {
namespace {

std::string count_bytes(char count)
{
    return std::string(1, count) + std::string(7, '\0');
}

class SizeBeforeReading : public ::testing::Test {
  protected:
    /// A folder whose files begin with these counts; the rest is zeros.
    std::optional<SceneSize> size_of_files(char views, char points, std::size_t rest_bytes)
    {
        folder.write("images.bin", count_bytes(views));
        folder.write("points3D.bin", count_bytes(points) + std::string(rest_bytes, '\0'));
        return size_before_reading(folder.path(), ModelFormat::binary);
    }

    TemporaryFolder folder;
};

TEST_F(SizeBeforeReading, CountsPointsViewsAndWhatIsLeftForSights)
{
    const auto size = size_of_files(3, 2, 2 * 51 + 5 * 8);
    ASSERT_TRUE(size);
    EXPECT_EQ(size->points, 2U);
    EXPECT_EQ(size->views, 3U);
    EXPECT_EQ(size->sights, 5U);
}

TEST_F(SizeBeforeReading, SaysNothingOfFilesTooShortForTheirCount)
{
    EXPECT_FALSE(size_of_files(3, 2, 2 * 51 - 1));
    EXPECT_TRUE(size_of_files(3, 2, 2 * 51));
    folder.write("points3D.bin", std::string(16, '\xff'));
    EXPECT_FALSE(size_before_reading(folder.path(), ModelFormat::binary));
}

TEST_F(SizeBeforeReading, SaysNothingOfTextAndOfMissingFiles)
{
    EXPECT_FALSE(size_before_reading(folder.path(), ModelFormat::binary));
    EXPECT_TRUE(size_of_files(3, 2, 2 * 51));
    EXPECT_FALSE(size_before_reading(folder.path(), ModelFormat::text));
}

} // namespace
} // namespace vcarve::model_size_test
