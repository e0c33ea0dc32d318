#include "film/legal/judge_images.hpp"

#include <utility>

namespace quadrel {
namespace {

/// Rounds `film`, of the reference, and the test image's floats to what an encoding holds.
std::map<std::string, Encoding> encode_film(Film& film, const ComparableImage& reference,
                                            const ComparableImage& test, Encoding encoding,
                                            Film& encoded) {
    const auto is_float = [&](const Plane& plane) {
        const Plane* other = test.film.find(plane.name);
        const Plane* value = reference.film.find(plane.name);
        return value->type == ChannelType::float32 && other != nullptr &&
               other->type == ChannelType::float32;
    };
    ComparableImage own{reference.file, {film.frame, film.window, {}}, reference.stored, {}};
    ComparableImage others{test.file, {film.frame, film.window, {}}, test.stored, {}};
    for (const Plane& plane : film.planes)
        if (is_float(plane)) {
            own.film.planes.push_back(plane);
            others.film.planes.push_back(*test.film.find(plane.name));
        }
    const auto encodings = encode_both(own, others, encoding);
    for (Plane& plane : own.film.planes) *film.find(plane.name) = std::move(plane);
    for (Plane& plane : others.film.planes) *encoded.find(plane.name) = std::move(plane);
    return encodings;
}

}  // namespace

ImageJudgement judge_images(ComparableImage reference, const ComparableImage& test,
                            const LegalRules& rules, Encoding encoding) {
    ImageJudgement judgement{take_apart(reference.film, reference.file.string()), test.film, {}};
    LegalReference& parts = judgement.reference;
    reference.film = parts.values;
    std::map<std::string, Encoding> encodings;
    for (Film* film : {&parts.values, &parts.lo, &parts.hi, &parts.gap_lo, &parts.gap_hi})
        encodings = encode_film(*film, reference, test, encoding, judgement.test);
    judgement.report = judge(parts, judgement.test, rules);
    for (LegalChannelReport& channel : judgement.report.channels)
        if (const auto found = encodings.find(channel.name); found != encodings.end())
            channel.encoding = found->second;
    return judgement;
}

}  // namespace quadrel
