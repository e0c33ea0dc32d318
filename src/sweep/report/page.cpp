#include "sweep/report/page.hpp"

#include "file/data_path.hpp"
#include "file/read_file.hpp"

namespace quadrel::sweep {
namespace {

std::string part(const char* name) {
    return read_whole_file(find_data_file(std::filesystem::path("sweep") / name));
}

/// In the one place of `mark`.
void fill(std::string& page, const std::string& mark, const std::string& text) {
    const std::size_t at = page.find(mark);
    if (at == std::string::npos)
        throw InputError("sweep/page.html", "", "no " + mark, "it, where the page gets its parts");
    page.replace(at, mark.size(), text);
}

/// No text in it can end the element that it stands in.
std::string embedded(const Json& json) {
    std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace), safe;
    safe.reserve(text.size());
    for (const char c : text) c == '<' ? safe += "\\u003c" : safe += c;
    return safe;
}

std::string escaped(const std::string& text) {
    std::string safe;
    for (const char c : text) {
        if (c == '<')
            safe += "&lt;";
        else if (c == '&')
            safe += "&amp;";
        else
            safe += c;
    }
    return safe;
}

/// What the page shows of the results: thousands of command lines would be most of it.
Json shown(Json results) {
    for (Json& run : results["runs"])
        for (const char* key : {"command", "plan", "processor", "host", "processors", "load",
                                "published_on", "maps", "repeats", "order", "look_ups_by_kind"})
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
    std::string page = part("page.html");
    // From the last mark to the first, so that none is looked for in what was filled in.
    fill(page, "/*{{SCRIPT}}*/", part("page.js"));
    fill(page, "{{PICTURES}}", embedded(pictures_of(records)));
    fill(page, "{{RESULTS}}", embedded(shown(results)));
    fill(page, "/*{{STYLE}}*/", part("page.css"));
    fill(page, "{{HEADING}}", escaped(results["title"].get<std::string>()));
    fill(page, "{{TITLE}}", escaped(results["title"].get<std::string>()));
    return page;
}

}  // namespace quadrel::sweep
