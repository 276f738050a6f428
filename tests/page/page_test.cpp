#include "page/page.h"
#include "page/page_files.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sstream>

namespace vcarve::page_test {
namespace {

using Json = nlohmann::ordered_json;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string kNasty = "a</script><script>x()</script><img src=x onerror=y()>&amp;{{three}}";

TEST(PageName, MustEndWithHtml)
{
    EXPECT_NO_THROW(require_page_name("a/out.html"));
    EXPECT_NO_THROW(require_page_name("OUT.HTM"));
    EXPECT_EQ(refusal<UsageError>([] { require_page_name("a/out.pdf"); }),
              "cannot write a/out.pdf: the name of a report must end with .html or .htm");
    EXPECT_NE(refusal<UsageError>([] { require_page_name("html"); }), "");
}

TEST(JsonForHtml, ContainsNoHtmlSyntax)
{
    const std::string text = json_for_html({{"name", kNasty}, {kNasty, 1}});
    EXPECT_EQ(text.find_first_of("<>&"), std::string::npos);
    EXPECT_EQ(Json::parse(text), Json({{"name", kNasty}, {kNasty, 1}}));
}

TEST(JsonForHtml, ReplacesInvalidUtf8)
{
    EXPECT_EQ(json_for_html({{"name", "a\xff"}}), "{\"name\":\"a\xef\xbf\xbd\"}");
}

std::string page_of(const Json& record)
{
    std::ostringstream out;
    write_page(out, record, {{"views", {kNasty}}});
    return out.str();
}

TEST(Page, ContainsEachPartOnceAndNoPlaceholders)
{
    const std::string page = page_of({{"output", "mesh.ply"}});
    const std::string bare = page_of({{"output", ""}});
    EXPECT_THAT(page, HasSubstr("{\"output\":\"mesh.ply\"}"));
    for (const std::string_view part : {kPageCss, kThreeJs, kViewJs, kDistanceJs, kReportJs,
                                        kComparisonJs, kPageJs, kThreeLicence}) {
        EXPECT_THAT(page, HasSubstr(std::string(part)));
    }
    for (const char* mark : {"{{record}}", "{{view}}", "{{style}}", "{{scene}}", "{{page}}"}) {
        EXPECT_THAT(page, Not(HasSubstr(mark)));
    }
    EXPECT_EQ(page.size(), bare.size() + 8);
}

TEST(Page, EscapesNamesFromFiles)
{
    const std::string page = page_of({{"output", kNasty}, {"command", kNasty}});
    EXPECT_THAT(page, Not(HasSubstr("<img src")));
    EXPECT_THAT(page, Not(HasSubstr("<script>x()")));
}

TEST(Page, RequestsNothingFromTheNetwork)
{
    std::string own;
    for (const std::string_view part :
         {kPageHtml, kPageCss, kViewJs, kDistanceJs, kReportJs, kComparisonJs, kPageJs}) {
        own += part;
    }
    for (const char* call :
         {"src=\"", "url(", "@import", "fetch(", "XMLHttpRequest", "<link rel=\"s"}) {
        EXPECT_THAT(own, Not(HasSubstr(call)));
    }
    EXPECT_THAT(own, HasSubstr("default-src 'none'"));
}

} // namespace
} // namespace vcarve::page_test
