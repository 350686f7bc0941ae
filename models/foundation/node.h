// JSON files, and a value of a JSON or YAML document that knows where it stands, so that every refusal can say so.
#pragma once

#include <warmjoint/field.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "models/foundation/bad_input.h"

namespace warmjoint {

/// What a document holds; keys keep their order.
using Tree = nlohmann::ordered_json;

/// Whether a text that reads as a number is one: in YAML, where scalars have no type, but not in JSON.
enum class Scalars { typed, texts };

/// Whether keys that nobody knows are refused, or left alone as in a file of others.
enum class UnknownKeys { refused, ignored };

/// Where the values of a document stand, by dotted key: those that do not stand where the value around them does.
using Places = std::map<std::string, Place, std::less<>>;

class Node {
 public:
  /// The root of a document. file: what refusals name where `places` say nothing.
  Node(Tree root, const std::string& file, Places places = {}, Scalars scalars = Scalars::typed);

  /// Dotted path from the root of the document, empty for the root.
  const std::string& key() const { return key_; }
  const std::string& file() const { return document_->file; }
  /// file:line, or the setting that the value came from.
  Place place() const { return PlaceOf(key_); }
  const Tree& tree() const { return *tree_; }
  /// The value in few words, for messages.
  std::string Shown() const;

  bool IsMap() const { return tree_->is_object(); }
  bool IsList() const { return tree_->is_array(); }
  bool IsScalar() const { return !IsMap() && !IsList() && !tree_->is_null(); }

  /// Refuses a value that is no map, and keys that are not among `known`, with the nearest.
  void RequireKnownKeys(const std::vector<std::string>& known) const;
  /// The same, and keys without a value.
  void RequireKeys(const std::vector<std::string>& known) const;
  /// Names of the keys, in their order in the file. Refuses a value that is no map.
  std::vector<std::string> Keys() const;
  /// The entry of that name; nothing where it is absent or null, and in what is no map.
  std::optional<Node> Find(std::string_view name) const;
  /// Whether the entry of that name is there and JSON's null.
  bool HoldsNull(std::string_view name) const;
  /// The same; refuses its absence. what: the remedy, for example "give its duration in s".
  Node Require(std::string_view name, std::string_view what) const;
  /// The entries of a list that is not empty; refuses other values. what: of the remedy.
  std::vector<Node> List(std::string_view what) const;
  /// The entries of a list of any length.
  std::vector<Node> Entries(std::string_view what) const;

  double Number(const Bounds& bounds = {}) const;
  /// A whole number from `lowest` to `highest`.
  std::int64_t Whole(std::int64_t lowest, std::int64_t highest) const;
  /// A whole number from 0 to 2^64 - 1.
  std::uint64_t Seed() const;
  std::string Text() const;
  /// The same of any scalar, as the file has it.
  std::string ScalarText() const;
  /// Two numbers, the first below the second.
  std::pair<double, double> Interval(const Bounds& bounds = {}) const;

  /// The same place in the document with another value there.
  Node With(Tree tree) const;
  /// The same value, in which unknown keys are treated so, down to its last entry.
  Node With(UnknownKeys keys) const;

  /// Refuses this value: "key is shown; it must be ...".
  [[noreturn]] void RefuseValue(std::string_view must_be) const;

 private:
  struct Document {
    std::string file;
    Places places;
    Scalars scalars;
  };

  std::string KeyOf(std::string_view name) const;
  Place PlaceOf(std::string_view key) const;
  Node Child(const Tree& tree, std::string_view name) const;
  /// The number that stands here, if one does.
  std::optional<double> AsNumber() const;

  std::shared_ptr<const Tree> tree_;  // keeps the whole document
  std::string key_;
  std::shared_ptr<const Document> document_;
  UnknownKeys unknown_ = UnknownKeys::refused;
};

/// Refuses a word that is none of those known, with the nearest.
[[noreturn]] void RefuseWord(const Node& node, const std::string& word,
                             const std::vector<std::string>& known);

/// The root of a JSON file. Throws BadInput as ReadJsonFile does.
Node ReadJsonNode(const std::filesystem::path& path);

/// The root of a JSON text. file: what refusals name.
Node ParseJsonNode(const std::string& text, const std::string& file);

/// Bounds of a JSON file: bytes, and levels of brackets within brackets.
inline constexpr std::size_t kLargestJson = std::size_t{512} << 20;
inline constexpr int kDeepestJson = 64;

/// The whole of a JSON file. Throws BadInput naming the file, and for what is no JSON the line.
Tree ReadJsonFile(const std::filesystem::path& path);

/// The same from a text, whose refusals name `file`. Refused besides what is no JSON: bytes that are
/// no UTF-8, numbers that no double holds, more levels than kDeepestJson.
Tree ParseJson(const std::string& text, const std::string& file);

/// Where a byte of a text stands: file and line.
Place PlaceOfByte(const std::string& text, std::size_t byte, const std::string& file);

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
