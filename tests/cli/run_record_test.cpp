#include "base/stage_counts.h"
#include "cli/run_record.h"
#include "support/sample_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mman.h>

#include <cstring>
#include <string>
#include <vector>

namespace vcarve::cli::run_record_test {
namespace {

Json recorded(SampleOptions options)
{
    return options_json(options_of(options));
}

TEST(OptionsJson, RecordsEveryOptionByItsName)
{
    EXPECT_EQ(recorded({.spacing = kUnlimited}).dump(),
              R"({"angle":10.5,"spacing":"inf","min-views":3,"closed":false,)"
              R"("shape":"round","memory":3145728,"place":"here","part":"none",)"
              R"("factor":7.0,"secret":1})");
    SampleOptions options;
    options.place = {.word = WordOrVector::kNoWord, .vector = {1.5, -2.0, 0.1}};
    EXPECT_EQ(recorded(options)["place"].dump(), "[1.5,-2.0,0.1]");
}

TEST(OptionsJson, RecordsRegionsAsWordsNumbersOrPaths)
{
    const auto recorded_part = [](const RegionChoice& part) {
        return recorded({.part = part})["part"].dump();
    };
    EXPECT_EQ(recorded_part({.kind = RegionChoice::Kind::looked_at}), R"("auto")");
    EXPECT_EQ(
        recorded_part({.kind = RegionChoice::Kind::box, .low = {0, -1, 0.5}, .high = {1, 2, 3}}),
        "[0.0,-1.0,0.5,1.0,2.0,3.0]");
    EXPECT_EQ(recorded_part({.kind = RegionChoice::Kind::file, .file = "a/b.ply"}), R"("a/b.ply")");
}

TEST(StageRecorder, RecordsCountsOfEveryStageAndNotes)
{
    Log nothing;
    StageRecorder recorder(nothing);
    Stage(recorder, "filter").end({{counts::kFilter.points, 3, 5}, {counts::kFilter.few_views, 2}});
    recorder.note("a sentence");
    Stage(recorder, "measure").end({{counts::kCompare.faces, 7, 8, "a.ply"}});

    const Json json = recorder.json();
    ASSERT_EQ(json["stages"].size(), 2U);
    EXPECT_EQ(json["stages"][0]["name"], "filter");
    EXPECT_EQ(json["stages"][0]["counts"].dump(), R"({"points":3,"of points":5,"few views":2})");
    EXPECT_EQ(json["stages"][1]["counts"].dump(), R"({"faces of a.ply":7,"of faces of a.ply":8})");
    EXPECT_EQ(json["notes"].dump(), R"(["a sentence"])");
}

TEST(StageRecorder, AssignsMemoryToTheStageThatHeldIt)
{
    constexpr std::int64_t kBytes = 64 << 20;
    reset_peak_memory(); // of earlier tests in this process
    Log nothing;
    StageRecorder recorder(nothing);
    Stage large(recorder, "large");
    // Mapped directly, because an allocator may not return freed memory to the system.
    void* memory =
        mmap(nullptr, kBytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    ASSERT_NE(memory, MAP_FAILED);
    std::memset(memory, 1, kBytes);
    munmap(memory, kBytes);
    large.end({});
    Stage(recorder, "small").end({});

    const Json json = recorder.json();
    if (!reset_peak_memory()) { // some systems do not permit it, and the record shows that
        EXPECT_FALSE(json["peak_memory_is_per_stage"]);
        return;
    }
    const std::int64_t at_large = json["stages"][0]["peak_memory_bytes"];
    const std::int64_t at_small = json["stages"][1]["peak_memory_bytes"];
    EXPECT_GT(at_large - at_small, kBytes / 2);
    EXPECT_EQ(json["total"]["peak_memory_bytes"], at_large);
    EXPECT_TRUE(json["peak_memory_is_per_stage"]);
}

TEST(StageRecorder, AssignsCpuTimeToTheStageThatUsedIt)
{
    Log nothing;
    StageRecorder recorder(nothing);
    Stage busy(recorder, "busy");
    const double began = process_usage().cpu_seconds;
    while (process_usage().cpu_seconds < began + 0.02) {
    }
    busy.end({});
    EXPECT_GE(recorder.json()["stages"][0]["cpu_seconds"], 0.02);
}

TEST(StageRecorder, ForwardsEverything)
{
    struct Listener : Log {
        std::string heard;
        void stage_begins(std::string_view name) override { heard += "begin " + std::string(name); }
        void stage_progresses(double share) override { heard += share == 0.5 ? ", half" : ", all"; }
        void stage_ends(std::string_view name, const Counts& counts) override
        {
            heard += ", end " + std::string(name) + " " + counts.at(0).name();
        }
        void note(std::string_view sentence) override { heard += ", " + std::string(sentence); }
        bool should_stop() const override { return stops; }
        bool stops = false;
    } listener;
    StageRecorder recorder(listener);
    Stage stage(recorder, "cut");
    stage.progress(0.5);
    recorder.note("hm");
    stage.end({{counts::kCells.all, 1}});
    EXPECT_EQ(listener.heard, "begin cut, half, hm, all, end cut cells");
    EXPECT_FALSE(recorder.should_stop());
    listener.stops = true;
    EXPECT_TRUE(recorder.should_stop());
}

TEST(JsonText, ReplacesBytesThatAreNotUtf8)
{
    EXPECT_EQ(json_text({{"path", "a\xff"}}), "{\n  \"path\": \"a\uFFFD\"\n}\n");
}

} // namespace
} // namespace vcarve::cli::run_record_test
