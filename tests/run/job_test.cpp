#include "base/version.h"
#include "options/declared.h"
#include "run/job.h"
#include "support/recording_log.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"
#include "vcarve/options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <utility>

namespace vcarve::job_test {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::Not;

/// Sets an option to another value in its range.
void change(const Option& option)
{
    if (auto* const* number = std::get_if<double*>(&option.value)) {
        **number = **number == 1.0 ? 0.5 : 1.0;
    } else if (auto* const* count = std::get_if<int*>(&option.value)) {
        ++**count;
    } else if (auto* const* bytes = std::get_if<std::int64_t*>(&option.value)) {
        ++**bytes;
    } else if (auto* const* flag = std::get_if<bool*>(&option.value)) {
        **flag = !**flag;
    } else if (auto* const* path = std::get_if<fs::path*>(&option.value)) {
        **path = "folder";
    } else if (auto* const* region = std::get_if<RegionChoice*>(&option.value)) {
        (*region)->kind = RegionChoice::Kind::looked_at;
    } else {
        const auto& choice = std::get<EnumValue>(option.value);
        choice.set((choice.get() + 1) % static_cast<int>(option.info.words.size()));
    }
}

FoundInput model_in(const fs::path& folder)
{
    FoundInput input;
    input.model.folder = folder;
    return input;
}

void write_model(const TemporaryFolder& folder, const std::string& points)
{
    folder.write("cameras.bin", "some cameras");
    folder.write("images.bin", "some images");
    folder.write("points3D.bin", points);
}

} // namespace

TEST(Job, DependsOnEveryOptionThatChangesKeptFiles)
{
    const Job usual = option_facts(Options());
    std::vector<std::string> without;
    Options all;
    for (std::size_t i = 0; i < options_of(all).size(); ++i) {
        Options options;
        const Option option = options_of(options)[i];
        change(option);
        if (option_facts(options) == usual) without.push_back(option.info.name);
    }
    EXPECT_THAT(without, ElementsAre("dense-size", "refine-size", "texture", "texture-scale",
                                     "images", "masks", "threads", "max-memory"));
    Options dense;
    dense.dense.dense = true;
    Options finer = dense;
    finer.dense.size_px = 1000;
    EXPECT_NE(option_facts(finer), option_facts(dense));
}

TEST(Job, DistinguishesNumbersToTheLastBit)
{
    Options options;
    options.labels.cut.quality = std::nextafter(1.0, 2.0);
    EXPECT_NE(option_facts(options), option_facts(Options()));
}

TEST(Job, DependsOnTheContentOfFilesButNotOnPathOrTime)
{
    const TemporaryFolder here;
    const TemporaryFolder there;
    write_model(here, "some points");
    write_model(there, "some points");
    fs::last_write_time(there / "images.bin",
                        fs::file_time_type::clock::now() - std::chrono::hours(48));
    EXPECT_EQ(input_facts(model_in(here.path())), input_facts(model_in(there.path())));
    write_model(there, "some pointS");
    const Job before = input_facts(model_in(here.path()));
    const Job after = input_facts(model_in(there.path()));
    EXPECT_EQ(before[0], after[0]);
    EXPECT_EQ(before[1], after[1]);
    EXPECT_EQ(before[2].name, "points3D.bin");
    EXPECT_THAT(before[2].value, HasSubstr("11 bytes with the digest "));
    EXPECT_NE(before[2], after[2]);
}

TEST(Job, DependsOnTheCloudButNotOnUnreadPoints)
{
    const TemporaryFolder folder;
    write_model(folder, "some points");
    FoundInput input = model_in(folder.path());
    input.dense = DenseFiles{.model = folder.path(),
                             .format = ModelFormat::binary,
                             .cloud = folder.write("a.ply", "a cloud"),
                             .visibility = folder.write("a.ply.vis", "rays")};
    const Job before = input_facts(input);
    write_model(folder, "other points");
    EXPECT_EQ(input_facts(input), before);
    folder.write("a.ply.vis", "Rays");
    EXPECT_NE(input_facts(input), before);
    input.dense->visibility.clear();
    EXPECT_THAT(input_facts(input), Contains(JobFact{"--rays", "nearest"}));
    folder.write("a.ply", "A cloud");
    EXPECT_THAT(input_facts(input), Not(IsSupersetOf({before[2]})));
}

TEST(Job, DependsOnThePositionOfTheScanner)
{
    const TemporaryFolder folder;
    FoundInput input;
    input.scan = ScanFile{folder.write("scan.ply", "points"), std::nullopt};
    const Job before = input_facts(input);
    EXPECT_THAT(before, Contains(JobFact{"--scanner", "file"}));
    input.scan->scanner = Eigen::Vector3d(1.0, 2.5, -3.0);
    EXPECT_THAT(input_facts(input), Contains(JobFact{"--scanner", "1,2.5,-3"}));
}

TEST(Job, DependsOnTheContentOfARegionsFile)
{
    const TemporaryFolder folder;
    Options options;
    options.crop.region.kind = RegionChoice::Kind::file;
    options.crop.region.file = folder.write("polygon.txt", "0 0\n1 0\n1 1\n");
    const Job before = option_facts(options);
    folder.write("polygon.txt", "0 0\n1 0\n1 2\n");
    EXPECT_NE(option_facts(options), before);
}

TEST(Job, NamesTheProgram)
{
    EXPECT_THAT(program_fact().value, HasSubstr(program_version()));
}

TEST(Job, HasOneLinePerFact)
{
    EXPECT_EQ(job_text({{"--quality", "1"}, {"--closed", "no"}}), "--quality\t1\n--closed\tno\n");
    EXPECT_NE(digest_of(Job{{"--quality", "1"}}), digest_of(Job{{"--quality", "2"}}));
}

namespace {

Scene two_points()
{
    Scene scene;
    scene.cameras.resize(1);
    scene.views.resize(2);
    scene.positions = {{1, 2, 3}, {4, 5, 6}};
    scene.colors = {{1, 2, 3}, {4, 5, 6}};
    scene.errors_px = {0.5, 0.25};
    scene.point_ids = {7, 8};
    scene.tracks.push_back(std::array{0U, 1U});
    scene.tracks.push_back(std::array{1U});
    return scene;
}

TEST(DigestOfScene, ChangesWithEveryNumber)
{
    const Scene scene = two_points();
    const Digest before = digest_of(scene);
    EXPECT_EQ(digest_of(scene), before);
    Scene moved = scene;
    moved.positions[0].z() += 1e-15;
    EXPECT_NE(digest_of(moved), before);
    Scene turned = scene;
    turned.views[0].cam_from_world.w() = -1.0;
    EXPECT_NE(digest_of(turned), before);
    Scene seen = scene;
    seen.tracks.views[2] = 0;
    EXPECT_NE(digest_of(seen), before);
    Scene colored = scene;
    colored.colors[1][0] = 5;
    EXPECT_NE(digest_of(colored), before);
}

TEST(DigestOfScene, DoesNotDependOnTheOrderOfThePoints)
{
    const Scene scene = two_points();
    Scene turned = scene;
    std::swap(turned.positions[0], turned.positions[1]);
    std::swap(turned.colors[0], turned.colors[1]);
    std::swap(turned.errors_px[0], turned.errors_px[1]);
    turned.tracks = Tracks();
    turned.tracks.push_back(scene.tracks[1]);
    turned.tracks.push_back(scene.tracks[0]);
    EXPECT_NE(digest_of(turned), digest_of(scene)) << "the points have other ids";
    std::swap(turned.point_ids[0], turned.point_ids[1]);
    EXPECT_EQ(digest_of(turned), digest_of(scene));
}

TEST(ImageFacts, HaveTheContentOfThePhotographsOfViewsOnly)
{
    const TemporaryFolder folder;
    Photographs photos;
    photos.folder = folder.path();
    photos.of_view = {folder.write("a.jpg", "1"), {}, folder.write("b/c.jpg", "2")};
    folder.write("other.jpg", "3");
    RecordingLog log;
    Stage stage(log, "digest");
    const Job facts = image_facts("photograph", photos, stage);
    ASSERT_EQ(facts.size(), 2U);
    EXPECT_EQ(facts[0].name, "photograph a.jpg");
    EXPECT_EQ(facts[1].name, "photograph b/c.jpg");
    EXPECT_NE(facts[0].value, facts[1].value);
    EXPECT_THAT(log.shares()["digest"], ElementsAre(1.0 / 3.0, 2.0 / 3.0))
        << "the work is not over before the last photograph";
}

} // namespace

} // namespace vcarve::job_test
