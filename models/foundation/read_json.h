// JSON files.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace warmjoint::inline models {

/// The whole of a JSON file. Throws BadInput naming the file, and for what is no JSON the line.
nlohmann::json ReadJsonFile(const std::filesystem::path& path);

}  // namespace warmjoint::inline models
