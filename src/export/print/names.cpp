#include "export/print/names.hpp"

#include <cctype>

#include "export/print/dialect.hpp"

namespace quadrel::recorded {

std::string local_name(const std::string& text) {
    std::string from = text, name;
    if (from.rfind("this->", 0) == 0) from.erase(0, 6);
    for (const char c : from) {
        if (std::isalnum(static_cast<unsigned char>(c)) != 0)
            name += c;
        else if (!name.empty() && name.back() != '_')
            name += '_';
    }
    while (!name.empty() && name.back() == '_') name.pop_back();
    return name;
}

std::string unique_name(const std::string& hint, const char* otherwise,
                        std::set<std::string>& taken) {
    std::string name = local_name(hint);
    if (name.empty()) name = otherwise;
    if (is_reserved(name)) name += '_';
    std::string result = name;
    for (int i = 1; taken.count(result) != 0; ++i)
        result = name + (name.back() == '_' ? "" : "_") + std::to_string(i);
    taken.insert(result);
    return result;
}

}  // namespace quadrel::recorded
