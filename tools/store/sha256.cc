#include "tools/store/sha256.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <stdexcept>

namespace warmjoint::inline tools {

std::string Sha256(std::string_view bytes) {
  std::array<unsigned char, 32> digest;
  std::size_t size = digest.size();
  if (EVP_Q_digest(nullptr, "SHA256", nullptr, bytes.data(), bytes.size(), digest.data(), &size) !=
      1) {
    throw std::runtime_error("the system's cryptography has no SHA-256");
  }
  return fmt::format("{:02x}", fmt::join(digest, ""));
}

}  // namespace warmjoint::inline tools
