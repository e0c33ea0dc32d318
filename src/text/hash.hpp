// Content hashes.
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace quadrel {

/// SHA-256 (FIPS 180-4) of the bytes, as 64 lower-case hexadecimal digits.
std::string sha256_hex(std::string_view bytes);

/// SHA-256 of bytes that come in parts.
class Sha256 {
  public:
    Sha256();
    ~Sha256();
    Sha256(const Sha256&) = delete;
    Sha256& operator=(const Sha256&) = delete;

    void update(std::string_view bytes);
    /// The digest of everything given so far, in hexadecimal. Call once, last.
    std::string hex();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace quadrel
