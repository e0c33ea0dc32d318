#include "film/compare/compared_images.hpp"

namespace quadrel {

void prepare_comparison(std::span<const ToleranceRule> tolerances, const std::string& option,
                        const std::vector<std::string>& channels, ComparedImages& images) {
    Film &reference = images.reference.film, &test = images.test.film;
    std::vector<bool> left_out = std::move(images.rules.left_out);
    images.rules = match_tolerances(tolerances, reference, test);
    images.rules.left_out = std::move(left_out);
    if (!channels.empty()) keep_channels(option, channels, reference, test);
    Preparation& preparation = images.preparation;
    preparation.reference_storage = storage_text(images.reference);
    preparation.test_storage = storage_text(images.test);
    preparation.by_value = compare_by_value(reference, test);
    // They stay integers in what is allowed: no tolerance for all channels is for them.
    for (const std::string& name : preparation.by_value)
        images.rules.channels[name] = images.rules.tolerance_of(name, ChannelType::uint32);
    images.rules.encodings = encode_both(images.reference, images.test, preparation.encoding);
}

}  // namespace quadrel
