// JSON files, and numbers in them.
#pragma once

#include <cmath>
#include <filesystem>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>

#include "models/foundation/bad_input.h"

namespace warmjoint {

/// Bounds of a JSON file: bytes, and levels of brackets within brackets.
inline constexpr std::size_t kLargestJson = std::size_t{512} << 20;
inline constexpr int kDeepestJson = 64;

/// The whole of a JSON file. Throws BadInput naming the file, and for what is no JSON the line. Json: nlohmann::json, or
/// nlohmann::ordered_json, whose keys keep their order.
template <typename Json = nlohmann::json>
Json ReadJsonFile(const std::filesystem::path& path);

/// The same from a text, whose refusals name `file`. Refused besides what is no JSON: bytes that are
/// no UTF-8, numbers that no double holds, more levels than kDeepestJson.
template <typename Json = nlohmann::json>
Json ParseJson(const std::string& text, const std::string& file);

/// The turn of a thread to read or write JSON: held while nlohmann's parser or writer works on a thread of several.
/// Both ask localeconv() for the decimal point, which glibc calls unsafe for threads.
inline std::unique_lock<std::mutex> JsonTurn() {
  static std::mutex turn;
  return std::unique_lock(turn);
}

/// The number; null where it is not finite.
inline nlohmann::json NumberOrNull(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

}  // namespace warmjoint
