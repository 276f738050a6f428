#include "page/page.h"
#include "page/page_files.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace vcarve::page_test {
namespace {

using Json = nlohmann::ordered_json;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string kNasty = "a</script><script>x()</script><img src=x onerror=y()>&amp;{{three}}";

TEST(PageName, EndsAsHtml)
{
    EXPECT_NO_THROW(require_page_name("a/out.html"));
    EXPECT_NO_THROW(require_page_name("OUT.HTM"));
    EXPECT_EQ(refusal<UsageError>([] { require_page_name("a/out.pdf"); }),
              "cannot write a/out.pdf: the name of a report must end with .html or .htm");
    EXPECT_NE(refusal<UsageError>([] { require_page_name("html"); }), "");
}

TEST(JsonForHtml, HoldsNothingThatHtmlReads)
{
    const std::string text = json_for_html({{"name", kNasty}, {kNasty, 1}});
    EXPECT_EQ(text.find_first_of("<>&"), std::string::npos);
    EXPECT_EQ(Json::parse(text), Json({{"name", kNasty}, {kNasty, 1}}));
}

TEST(JsonForHtml, ReplacesWhatIsNoUtf8)
{
    EXPECT_EQ(json_for_html({{"name", "a\xff"}}), "{\"name\":\"a\xef\xbf\xbd\"}");
}

std::string page_of(const Json& record)
{
    std::ostringstream out;
    write_page(out, record, {{"views", {kNasty}}});
    return out.str();
}

TEST(Page, HoldsItsPartsOnceAndNoMarks)
{
    const std::string page = page_of({{"output", "mesh.ply"}});
    const std::string bare = page_of({{"output", ""}});
    EXPECT_THAT(page, HasSubstr("{\"output\":\"mesh.ply\"}"));
    EXPECT_THAT(page, HasSubstr(std::string(kThreeJs)));
    EXPECT_THAT(page, HasSubstr(std::string(kViewJs)));
    EXPECT_THAT(page, HasSubstr(std::string(kReportJs)));
    EXPECT_THAT(page, HasSubstr(std::string(kThreeLicence)));
    for (const char* mark : {"{{record}}", "{{view}}", "{{style}}", "{{scene}}", "{{script}}"}) {
        EXPECT_THAT(page, Not(HasSubstr(mark)));
    }
    EXPECT_EQ(page.size(), bare.size() + 8);
}

std::string comparison_page_of(const Json& record)
{
    std::ostringstream out;
    write_comparison_page(out, record, {{"surfaces", {kNasty}}});
    return out.str();
}

TEST(Page, OfAComparisonHoldsItsPartsOnceAndNoMarks)
{
    const std::string page = comparison_page_of({{"command", "compare"}});
    const std::string bare = comparison_page_of({{"command", ""}});
    for (const std::string_view part : {kThreeJs, kViewJs, kDistanceJs, kCommonJs, kComparisonJs,
                                        kReportCss, kComparisonCss, kThreeLicence}) {
        EXPECT_THAT(page, HasSubstr(std::string(part)));
    }
    for (const char* mark : {"{{record}}", "{{view}}", "{{style}}", "{{scene}}", "{{script}}"}) {
        EXPECT_THAT(page, Not(HasSubstr(mark)));
    }
    EXPECT_EQ(page.size(), bare.size() + 7);
    EXPECT_THAT(comparison_page_of({{"command", kNasty}}), Not(HasSubstr("<img src")));
}

TEST(Page, LetsNoNameFromAFileBreakOut)
{
    const std::string page = page_of({{"output", kNasty}, {"command", kNasty}});
    EXPECT_THAT(page, Not(HasSubstr("<img src")));
    EXPECT_THAT(page, Not(HasSubstr("<script>x()")));
}

TEST(Page, AsksTheNetworkForNothing)
{
    const std::string own =
        std::string(kReportHtml) + std::string(kReportCss) + std::string(kViewJs) +
        std::string(kReportJs) + std::string(kComparisonHtml) + std::string(kComparisonCss) +
        std::string(kComparisonJs) + std::string(kCommonJs) + std::string(kDistanceJs);
    for (const char* call :
         {"src=\"", "url(", "@import", "fetch(", "XMLHttpRequest", "<link rel=\"s"}) {
        EXPECT_THAT(own, Not(HasSubstr(call)));
    }
    EXPECT_THAT(own, HasSubstr("default-src 'none'"));
}

} // namespace
} // namespace vcarve::page_test
