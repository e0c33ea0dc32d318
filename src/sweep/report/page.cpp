#include "sweep/report/page.hpp"

#include "page/template.hpp"

namespace quadrel::sweep {
namespace {

/// What the page shows of the results: thousands of command lines would be most of it.
Json shown(Json results) {
    for (Json& run : results["runs"])
        for (const char* key :
             {"command", "plan", "processor", "host", "processors", "load", "published_on", "maps",
              "repeats", "order", "plan_id", "look_ups_by_kind"})
            run.erase(key);
    return results;
}

Json pictures_of(const std::vector<Json>& records) {
    Json pictures = Json::object();
    for (const Json& record : records)
        if (record.contains("picture"))
            pictures[record["key"].get<std::string>()] =
                Json::array({record["picture"], record["error_picture"]});
    return pictures;
}

}  // namespace

std::string page_html(const Json& results, const std::vector<Json>& records) {
    const std::string title = page::escaped_text(results["title"].get<std::string>());
    page::PageTemplate page("sweep/page.html");
    page.fill("/*{{SCRIPT}}*/", page::page_parts({"page/base.js", "sweep/page.js"}));
    page.fill("{{PICTURES}}", page::embedded_json(pictures_of(records)));
    page.fill("{{RESULTS}}", page::embedded_json(shown(results)));
    page.fill("/*{{STYLE}}*/", page::page_parts({"page/base.css", "sweep/page.css"}));
    page.fill("{{HEADING}}", title);
    page.fill("{{TITLE}}", title);
    return page.text();
}

}  // namespace quadrel::sweep
