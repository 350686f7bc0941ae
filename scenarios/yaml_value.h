// A value of a YAML file that knows where it stands, so that every refusal can say so.
#pragma once

#include <yaml-cpp/yaml.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "models/foundation/bad_input.h"
#include "scenarios/setting.h"

namespace warmjoint::inline scenarios {

/// What a number must satisfy; every number must be finite besides.
enum class Bound { any, not_negative, positive };

/// Bounds of a document: bytes; levels within levels; values, those of aliases counted each time.
inline constexpr std::size_t kLargestDocument = std::size_t{16} << 20;
inline constexpr int kDeepestDocument = 64;
inline constexpr int kMostValues = 1'000'000;

/// A node of a YAML tree with its file, line and dotted key.
class YamlValue {
 public:
  /// Parses text and changes entries of it; refusals of what a setting changed name the setting
  /// instead of a line. file: for messages. Throws BadInput where text or setting is no YAML (with
  /// the line), holds itself by an alias, exceeds the bounds above, and where the key of a setting
  /// leads through a value that holds no keys.
  static YamlValue Parse(const std::string& text, const std::string& file,
                         const Settings& settings = {});

  /// Dotted path from the root of the document, empty for the root.
  const std::string& key() const { return key_; }
  /// The file that the document came from.
  const std::string& file() const { return document_->file; }
  /// file:line, or the setting that the value came from.
  Place place() const;
  /// The value in few words, for messages.
  std::string Shown() const;

  bool IsMap() const { return node_.IsMap(); }
  bool IsList() const { return node_.IsSequence(); }
  bool IsScalar() const { return node_.IsScalar(); }
  const YAML::Node& node() const { return node_; }

  /// Refuses a value that is no map, keys that stand twice, and keys that are not among `known`, with the nearest.
  void RequireKnownKeys(const std::vector<std::string>& known) const;

  /// Refuses a value that is no map, keys that stand twice or have no value, and keys that are not among
  /// `known`, with the nearest.
  void RequireKeys(const std::vector<std::string>& known) const;
  /// Refuses a value that is no map, and keys that stand twice.
  void RequireDistinctKeys() const;
  /// Names of the keys, in their order in the file. Refuses a value that is no map.
  std::vector<std::string> Keys() const;
  /// The entry of that name; nothing where it is absent or null. The value must be a map.
  std::optional<YamlValue> Find(std::string_view name) const;
  /// The same; refuses its absence. what: the remedy, for example "give its duration in s".
  YamlValue Require(std::string_view name, std::string_view what) const;
  /// The entries of a list; refuses other values. what: of the remedy.
  std::vector<YamlValue> List(std::string_view what) const;

  double Number(Bound bound = Bound::any) const;
  /// A whole number from `lowest` to `highest`.
  std::int64_t Whole(std::int64_t lowest, std::int64_t highest) const;
  /// A whole number from 0 to 2^64 - 1.
  std::uint64_t Seed() const;
  std::string Text() const;
  /// Two numbers, the first below the second.
  std::pair<double, double> Interval(Bound bound = Bound::any) const;

  /// Refuses this value: "key is shown; it must be ...".
  [[noreturn]] void RefuseValue(std::string_view must_be) const;

 private:
  struct Document {
    std::string file;
    Settings settings;
  };

  YamlValue(YAML::Node node, std::string key, std::shared_ptr<const Document> document)
      : node_(std::move(node)), key_(std::move(key)), document_(std::move(document)) {}

  std::string KeyOf(std::string_view name) const;

  YAML::Node node_;
  std::string key_;
  std::shared_ptr<const Document> document_;
};

/// The YAML of a node on one line.
std::string FlowYaml(const YAML::Node& node);

}  // namespace warmjoint::inline scenarios
