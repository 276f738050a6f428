#include "paper/write_fixture.h"
#include "support/places.h"
#include "support/temporary_folder.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace vcarve::paper::paper_test {

namespace {

class EveryPaperObject : public ::testing::TestWithParam<Object> {};

} // namespace

TEST_P(EveryPaperObject, IsReproducedByteForByteAndCarvedExactly)
{
    const Fixture fixture = make_fixture(GetParam());
    EXPECT_NO_THROW(check_carving(fixture));

    const TemporaryFolder folder;
    write_fixture(folder / "made", fixture);
    const std::filesystem::path committed = fixtures_folder() / "paper" / GetParam().name;
    for (const char* file : {"cameras.txt", "images.txt", "points3D.txt", "solid.ply"}) {
        EXPECT_FALSE(bytes_of(committed / file).empty()) << committed / file;
        EXPECT_EQ(bytes_of(folder / "made" / file), bytes_of(committed / file)) << file;
    }
}

INSTANTIATE_TEST_SUITE_P(All, EveryPaperObject, ::testing::ValuesIn(objects()),
                         [](const auto& object) { return object.param.name; });

TEST(PaperObject, CheckThrowsIfCarvingDiffersFromTheTrueSolid)
{
    Fixture fixture = make_fixture(objects().front());
    // No ray crosses a solid cell that is declared empty.
    fixture.cells.empty.push_back(fixture.cells.solid.back());
    fixture.cells.solid.pop_back();
    EXPECT_THROW(check_carving(fixture), std::logic_error);
}

} // namespace vcarve::paper::paper_test
