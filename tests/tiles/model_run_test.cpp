#include "support/places.h"
#include "support/temporary_folder.h"
#include "tiles/model_run.h"
#include "vcarve/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>
#include <thread>

namespace vcarve::model_run_test {
namespace {

using ::testing::HasSubstr;

class TwoRuns : public ::testing::Test {
  protected:
    TemporaryFolder folder;
    Log log;
    Options options;
    RunInput input = resolve_input(fixtures_folder() / "scene/sparse/0", {}, options, false, log);
    RunPlan plan(std::size_t tile_points = 2000) const
    {
        return {.work = std::make_unique<WorkFolder>(folder.path() / "work"),
                .tile_points = tile_points};
    }
    std::filesystem::path out = folder / "out.ply";
};

TEST_F(TwoRuns, FailTogetherIfTheLeadingOneWritesNoMesh)
{
    std::optional<ModelRun> leading(std::in_place, input, options, plan(), log);
    ModelRun helping(input, options, plan(), log);
    std::string error;
    std::thread other(
        [&] { error = refusal<InputError>([&] { helping.is_made_by_another(out); }); });
    leading.reset(); // as after an error
    other.join();
    EXPECT_EQ(error, out.string() + ": the process that led the run has ended without it; its "
                                    "messages say why");
}

TEST_F(TwoRuns, EndTogetherIfTheLeadingOneWritesTheMesh)
{
    std::optional<ModelRun> leading(std::in_place, input, options, plan(), log);
    ModelRun helping(input, options, plan(), log);
    bool is_made = false;
    std::thread other([&] { is_made = helping.is_made_by_another(out); });
    folder.write("out.ply", "mesh");
    leading->end();
    leading.reset();
    other.join();
    EXPECT_TRUE(is_made);
}

TEST_F(TwoRuns, AreRefusedWithoutTiles)
{
    const ModelRun first(input, options, plan(0), log);
    EXPECT_THAT(refusal<InputError>([&] { ModelRun(input, options, plan(0), log); }),
                HasSubstr("another run uses the work folder"));
}

} // namespace
} // namespace vcarve::model_run_test
