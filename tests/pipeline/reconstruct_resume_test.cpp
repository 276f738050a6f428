// Runs that are stopped after each of their stages, and resumed.
#include "pipeline/thinned_scene.h"
#include "support/scene_checks.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

namespace vcarve::reconstruct_resume_test {
namespace {

using ::testing::ElementsAre;

/// Records ends of stages, except the checkpoints' own, one line each. Ends the run when it has
/// saved `most` stages.
class EndingLog final : public Log {
  public:
    explicit EndingLog(std::size_t most) : most_(most) {}

    void stage_begins(std::string_view name) override
    {
        if (kept.size() == most_) throw std::runtime_error("killed");
        begun.emplace_back(name);
    }
    void stage_ends(std::string_view name, const Counts& counts) override
    {
        if (name == "keep") kept.push_back(counts[0].first);
        if (name == "keep" || name == "resume") return;
        lines.emplace_back(name);
        for (const auto& [what, count] : counts) {
            lines.back() += fmt::format(" {} {}", count, what);
        }
    }

    std::vector<std::string> kept;
    std::vector<std::string> begun;
    std::vector<std::string> lines;

  private:
    std::size_t most_;
};

constexpr std::size_t kNever = 1000;

struct Trial {
    Reconstruction made;
    RemovedFaces removed;
    EndingLog log{kNever};
};

struct Case {
    std::string name;
    Options options = {};
    bool is_dense = false;
    bool wants_removed = false;
    std::vector<std::string> kept = {}; ///< the saved stages
};

Scene scene_of(const Case& some)
{
    Scene scene = bumpy_sphere(1500, 3);
    scene.is_dense = some.is_dense;
    return scene;
}

Trial run(const Case& some, WorkFolder* work, std::size_t most = kNever)
{
    Trial trial;
    trial.log = EndingLog(most);
    const Scene scene = scene_of(some);
    trial.made = reconstruct_thinned(
        scene, size_of(scene), some.options, trial.log,
        {.removed = some.wants_removed ? &trial.removed : nullptr, .work = work});
    return trial;
}

void expect_equal(const TriMesh& a, const TriMesh& b)
{
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(a.faces, b.faces);
    EXPECT_EQ(a.colors, b.colors);
    EXPECT_EQ(a.normals, b.normals);
    EXPECT_EQ(a.points, b.points);
    EXPECT_EQ(a.offset, b.offset);
}

void expect_equal(const Trial& a, const Trial& b)
{
    expect_equal(a.made.mesh, b.made.mesh);
    expect_equal_scenes(a.made.scene, b.made.scene);
    expect_equal(a.removed.mesh, b.removed.mesh);
    EXPECT_EQ(a.removed.reasons, b.removed.reasons);
    EXPECT_EQ(a.log.lines, b.log.lines);
}

std::vector<Case> cases()
{
    Case usual{.name = "Usual", .kept = {"points", "cells", "rays", "surface"}};
    Case looked_around{.name = "VirtualViews", .kept = usual.kept};
    looked_around.options.labels.virtual_views.count = 20;
    Case strict{.name = "Strict", .kept = usual.kept};
    strict.options.labels.method = Method::strict;
    Case strict_around{.name = "StrictVirtualViews", .kept = usual.kept};
    strict_around.options.labels = strict.options.labels;
    strict_around.options.labels.virtual_views.count = 20;
    Case cropped{.name = "CroppedDenseWithRemoved",
                 .is_dense = true,
                 .wants_removed = true,
                 .kept = {"points", "cells", "rays", "surface-and-removed"}};
    cropped.options.crop.region.kind = RegionChoice::Kind::looked_at;
    Case refined{.name = "ClosedAndRefined", .kept = usual.kept};
    refined.options.surface.closed = true;
    refined.options.refine.smooth.iterations = 2;
    refined.options.refine.simplify.faces = 2000;
    return {usual, looked_around, strict, strict_around, cropped, refined};
}

class Resumed : public ::testing::TestWithParam<Case> {
  protected:
    /// Starts a run in the folder that ends after `stages` saved stages.
    void end_after(std::size_t stages) const
    {
        WorkFolder work(folder.path());
        work.begin(job);
        EXPECT_EQ(refusal<std::runtime_error>([&] { run(GetParam(), &work, stages); }), "killed");
    }
    Trial go_on() const
    {
        WorkFolder work(folder.path());
        work.begin(job);
        Trial made = run(GetParam(), &work);
        work.clear();
        return made;
    }

    TemporaryFolder folder;
    Job job = {{"a", "b"}};
};

std::string name_of(const ::testing::TestParamInfo<Case>& info)
{
    return info.param.name;
}

} // namespace

TEST_P(Resumed, MakesTheSameSurfaceAfterAnyStage)
{
    const Trial alone = run(GetParam(), nullptr);
    ASSERT_FALSE(alone.made.mesh.faces.empty());
    EXPECT_TRUE(alone.log.kept.empty());
    const Trial undisturbed = go_on();
    expect_equal(undisturbed, alone);
    std::vector<std::string> kept;
    for (const std::string& stage : GetParam().kept) {
        kept.push_back("MiB of " + stage);
    }
    EXPECT_EQ(undisturbed.log.kept, kept);
    for (std::size_t stages = 1; stages <= kept.size(); ++stages) {
        end_after(stages);
        const Trial resumed = go_on();
        expect_equal(resumed, alone);
        EXPECT_EQ(resumed.log.kept,
                  std::vector(kept.begin() + static_cast<std::ptrdiff_t>(stages), kept.end()));
    }
    EXPECT_EQ(folder.num_entries(), 0U);
}

INSTANTIATE_TEST_SUITE_P(Runs, Resumed, ::testing::ValuesIn(cases()), name_of);

TEST(ResumedRun, RecomputesTheSurfaceIfRemovedFacesAreRequestedLater)
{
    const TemporaryFolder folder;
    Case some = cases()[0];
    {
        WorkFolder work(folder.path());
        work.begin({});
        run(some, &work);
    }
    some.wants_removed = true;
    WorkFolder work(folder.path());
    work.begin({});
    const Trial resumed = run(some, &work);
    EXPECT_THAT(resumed.log.kept, ElementsAre("MiB of surface-and-removed"));
    expect_equal(resumed, run(some, nullptr));
    EXPECT_FALSE(resumed.removed.reasons.empty());
}

} // namespace vcarve::reconstruct_resume_test
