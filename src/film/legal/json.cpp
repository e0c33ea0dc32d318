// A judgement for tools.
#include "film/compare/preparation.hpp"
#include "quadrel/film/legal.hpp"

namespace quadrel {
namespace {

using Json = nlohmann::ordered_json;

Json range_json(const LegalRange& range) {
    Json json = {
        {"lo", number_json(range.lo)}, {"hi", number_json(range.hi)}, {"paths", range.paths}};
    if (range.gap_lo < range.gap_hi)
        json["gap"] = {number_json(range.gap_lo), number_json(range.gap_hi)};
    return json;
}

Json pixel_json(const LegalChannelReport& channel, const LegalPixel& pixel) {
    return {{"x", pixel.x},
            {"y", pixel.y},
            {"reference", value_json(channel.reference_type, pixel.reference)},
            {"test", pixel.test ? value_json(channel.test_type, *pixel.test) : Json()},
            {"range", range_json(pixel.range)},
            {"covered_alone", pixel.covered_alone}};
}

Json channel_json(const LegalChannelReport& channel) {
    Json json = {{"name", channel.name},
                 {"encoding", encoding_name(channel.encoding)},
                 {"passes", channel.passes()},
                 {"extent", channel.extent},
                 {"pixels", channel.pixels}};
    for (const LegalVerdict verdict : {LegalVerdict::pass, LegalVerdict::ambiguous,
                                       LegalVerdict::unconstrained, LegalVerdict::fail})
        json[legal_verdict_name(verdict)] = channel.count(verdict);
    json["nan"] = channel.nan;
    json["missing"] = channel.missing;
    json["too_ambiguous"] = channel.too_ambiguous;
    json["too_unconstrained"] = channel.too_unconstrained;
    json["empty_ranges"] = channel.empty_ranges;
    json["reference_outside"] = channel.reference_outside;
    json["worst"] = Json::array();
    for (const LegalPixel& pixel : channel.worst)
        json["worst"].push_back(pixel_json(channel, pixel));
    return json;
}

}  // namespace

std::string to_json(const LegalReport& report) {
    Json json = {{"legal", report.passes()}};
    if (report.preparation) json["preparation"] = preparation_json(*report.preparation);
    json["widest"] = report.rules.widest;
    json["most_ambiguous"] = report.rules.most_ambiguous;
    json["most_unconstrained"] = report.rules.most_unconstrained;
    json["structure"] = report.structure;
    json["notes"] = report.notes;
    json["left_out"] = report.left_out;
    json["covered_alone"] = {{"undecided", report.alone_undecided},
                             {"decided", report.alone_decided},
                             {"unknown", report.alone_unknown}};
    json["channels"] = Json::array();
    for (const LegalChannelReport& channel : report.channels)
        json["channels"].push_back(channel_json(channel));
    // A file name may hold bytes that are no UTF-8.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace quadrel
