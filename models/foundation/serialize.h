// One description of a struct's members for all that reads, writes or lists them.
//
//   struct Noise {
//     double torque = 0;  // N.m or N
//
//     template <class A>
//     void Serialize(A* a) {
//       a->Field("torque", &torque, {.unit = "N.m", .bounds = {.at_least = 0}, .meaning = "standard deviation"});
//     }
//   };
//
//   ReadFields(node, &noise);       reads from JSON or YAML; refuses unknown keys and values out of their bounds
//   WriteFields(noise);             as JSON
//
// A value of a type that is none of those below, and has no Serialize, has functions of its own beside it:
//   void ReadValue(const Node& node, T* value, const FieldInfo& info);     Tree WriteValue(const T& value);
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <concepts>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "models/foundation/node.h"

namespace warmjoint {

/// The choice of a word; refuses others, with the nearest.
template <typename E>
E ChoiceOf(const Node& node) {
  const std::string text = node.Text();
  std::vector<std::string> known;
  for (const Word<E>& word : WordsOf(E{})) {
    if (word.name == text) return word.value;
    known.emplace_back(word.name);
  }
  RefuseWord(node, text, known);
}

/// The names of a struct's members.
struct FieldNames {
  std::vector<std::string> names;

  template <class T>
  void Field(std::string_view name, T*, const FieldInfo& = {}) {
    names.emplace_back(name);
  }
  template <class T>
  void Named(std::string_view name, std::vector<T>*, const FieldInfo& = {}) {
    names.emplace_back(name);
  }
  void Flag(std::string_view name, bool*, std::string_view = {}) { names.emplace_back(name); }
  void Require(bool, std::string_view, std::string_view) {}
  void Check(bool, std::string_view, std::string_view) {}
};

template <class T>
concept Described = requires(T value, FieldNames* names) {
  value.Serialize(names);
};

/// What a file has as "name=value" pairs.
template <class T>
concept Paired = requires(T value, const std::string& text) {
  { value.Take(text, text) } -> std::same_as<bool>;
  { value.Pairs() } -> std::same_as<std::vector<std::string>>;
};

/// Reads a struct from a map; members that are not given keep their values. Throws BadInput with place, key, value and
/// bound, and for unknown keys with the nearest known one.
template <Described T>
void ReadFields(const Node& node, T* value);

template <Described T>
Tree WriteFields(T value);

// Values that a member may have.

template <typename T>
void ReadValue(const Node& node, std::vector<T>* value, const FieldInfo& info);
template <typename T>
void ReadValue(const Node& node, std::map<std::string, T>* value, const FieldInfo& info);
template <typename T>
Tree WriteValue(const std::vector<T>& value);
template <typename T>
Tree WriteValue(const std::map<std::string, T>& value);

inline void ReadValue(const Node& node, double* value, const FieldInfo& info) {
  *value = node.Number(info.bounds);
}
inline void ReadValue(const Node& node, std::array<double, 2>* value, const FieldInfo& info) {
  std::vector<double> ends;
  ReadValue(node, &ends, info);
  if (ends.size() != 2) node.RefuseValue("[lower, upper]");
  *value = {ends[0], ends[1]};
}
/// Numbers by name, in the order of the file; null is NaN.
inline void ReadValue(const Node& node, std::vector<std::pair<std::string, double>>* value,
                      const FieldInfo& info) {
  value->clear();
  for (const std::string& name : node.Keys()) {
    const auto entry = node.Find(name);
    value->emplace_back(name, entry ? entry->Number(info.bounds) : std::nan(""));
  }
}
inline void ReadValue(const Node& node, int* value, const FieldInfo& info) {
  using Limits = std::numeric_limits<int>;
  const auto end = [](double bound, int limit) {
    return std::isfinite(bound) ? static_cast<std::int64_t>(bound) : limit;
  };
  *value = static_cast<int>(node.Whole(end(info.bounds.at_least, Limits::min()),
                                       end(info.bounds.at_most, Limits::max())));
}
inline void ReadValue(const Node& node, std::uint64_t* value, const FieldInfo&) {
  *value = node.Seed();
}
inline void ReadValue(const Node& node, std::string* value, const FieldInfo&) {
  *value = node.Text();
}
inline void ReadValue(const Node& node, bool* value, const FieldInfo&) {
  const std::string text = node.IsScalar() ? node.tree().dump() : "";
  // a text in YAML, a word of its own in JSON
  if (text != "true" && text != "false" && text != "\"true\"" && text != "\"false\"") {
    node.RefuseValue("true or false");
  }
  *value = text.find("true") != std::string::npos;
}
inline void ReadValue(const Node& node, std::pair<double, double>* value, const FieldInfo& info) {
  *value = node.Interval(info.bounds);
}
template <typename E>
requires std::is_enum_v<E>
void ReadValue(const Node& node, E* value, const FieldInfo&) { *value = ChoiceOf<E>(node); }
template <Described T>
void ReadValue(const Node& node, T* value, const FieldInfo&) {
  ReadFields(node, value);
}
/// A map, in which a name without a value has an empty one, or a list of pairs.
template <Paired T>
void ReadValue(const Node& node, T* value, const FieldInfo&) {
  if (node.IsMap()) {
    for (const std::string& name : node.Keys()) {
      const auto entry = node.Find(name);
      if (!value->Take(name, entry ? entry->ScalarText() : "")) {
        entry.value_or(node).RefuseValue("a finite number");
      }
    }
    return;
  }
  for (const Node& entry : node.Entries("a list of column=value")) {
    const std::string pair = entry.Text();
    const std::size_t equals = pair.find('=');
    if (equals == 0 || equals == std::string::npos) entry.RefuseValue("column=value");
    if (!value->Take(pair.substr(0, equals), pair.substr(equals + 1))) {
      entry.RefuseValue("a finite number");
    }
  }
}
template <typename T>
void ReadValue(const Node& node, std::optional<T>* value, const FieldInfo& info) {
  T read{};
  ReadValue(node, &read, info);
  *value = std::move(read);
}
template <typename T>
void ReadValue(const Node& node, std::vector<T>* value, const FieldInfo& info) {
  value->clear();
  for (const Node& entry : node.Entries("a list")) ReadValue(entry, &value->emplace_back(), info);
}
template <typename T>
void ReadValue(const Node& node, std::map<std::string, T>* value, const FieldInfo& info) {
  value->clear();
  for (const std::string& name : node.Keys()) {
    if (const auto entry = node.Find(name)) ReadValue(*entry, &(*value)[name], info);
  }
}

inline void ReadValue(const Node& node, std::vector<double>* value, const FieldInfo& info) {
  if (!node.IsList()) node.RefuseValue("a list of numbers");
  value->clear();
  value->reserve(node.tree().size());
  // numbers as they are; a node of its own only where one has to be refused or read from a text
  bool typed = true;
  for (const Tree& entry : node.tree()) {
    // null is a number that is not known
    const bool null = entry.is_null();
    typed = typed && (null || (entry.is_number() && info.bounds.Hold(entry.get<double>())));
    if (typed) value->push_back(null ? std::nan("") : entry.get<double>());
  }
  if (typed) return;
  value->clear();
  for (const Node& entry : node.Entries("a list")) value->push_back(entry.Number(info.bounds));
}
inline void ReadValue(const Node& node, Eigen::VectorXd* value, const FieldInfo& info) {
  std::vector<double> numbers;
  ReadValue(node, &numbers, info);
  *value = Eigen::VectorXd::Map(numbers.data(), std::ssize(numbers));
}

/// A list of rows, row by row; null is NaN.
inline void ReadValue(const Node& node, Eigen::MatrixXd* value, const FieldInfo&) {
  const std::vector<Node> rows = node.Entries("a matrix: a list of rows");
  const auto n = static_cast<Eigen::Index>(rows.size());
  const auto columns = n > 0 ? static_cast<Eigen::Index>(rows[0].tree().size()) : 0;
  value->resize(n, columns);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Node& row = rows[static_cast<std::size_t>(i)];
    const std::vector<Node> numbers = row.Entries("a row of numbers");
    if (static_cast<Eigen::Index>(numbers.size()) != columns)
      row.RefuseValue("as long as the first row");
    for (Eigen::Index j = 0; j < columns; ++j) {
      const Node& number = numbers[static_cast<std::size_t>(j)];
      (*value)(i, j) = number.tree().is_null() ? std::nan("") : number.Number();
    }
  }
}

template <typename T>
requires std::is_arithmetic_v<T> Tree WriteValue(T value) {
  // what is no finite number is null
  if constexpr (std::is_floating_point_v<T>) {
    if (!std::isfinite(value)) return nullptr;
  }
  return value;
}
inline Tree WriteValue(const Eigen::VectorXd& value) {
  return std::vector<double>(value.begin(), value.end());
}
inline Tree WriteValue(const Eigen::MatrixXd& value) {
  Tree rows = Tree::array();
  for (const auto& row : value.rowwise()) {
    rows.push_back(std::vector<double>(row.begin(), row.end()));
  }
  return rows;
}
inline Tree WriteValue(const std::array<double, 2>& value) { return {value[0], value[1]}; }
inline Tree WriteValue(const std::vector<std::pair<std::string, double>>& value) {
  Tree map = Tree::object();
  for (const auto& [name, number] : value) map[name] = number;
  return map;
}
inline Tree WriteValue(const std::string& value) { return value; }
inline Tree WriteValue(const std::pair<double, double>& value) {
  return {value.first, value.second};
}
template <typename E>
requires std::is_enum_v<E> Tree WriteValue(E value) { return NameOf(value); }
template <Described T>
Tree WriteValue(const T& value) {
  return WriteFields(value);
}
template <Paired T>
Tree WriteValue(const T& value) {
  return value.Pairs();
}
template <typename T>
Tree WriteValue(const std::optional<T>& value) {
  return value ? WriteValue(*value) : Tree();
}
template <typename T>
Tree WriteValue(const std::vector<T>& value) {
  Tree list = Tree::array();
  for (const T& entry : value) list.push_back(WriteValue(entry));
  return list;
}
template <typename T>
Tree WriteValue(const std::map<std::string, T>& value) {
  Tree map = Tree::object();
  for (const auto& [name, entry] : value) map[name] = WriteValue(entry);
  return map;
}

/// Reads the members of a struct from a map.
class FieldReader {
 public:
  explicit FieldReader(const Node& node) : node_(node) {}

  template <class T>
  void Field(std::string_view name, T* value, const FieldInfo& info = {}) {
    // a number that is not known is null in JSON
    if constexpr (std::is_same_v<T, double>) {
      if (node_.HoldsNull(name)) {
        *value = std::nan("");
        return;
      }
    }
    const auto found = FindOrRequire(name, info);
    if (found) ReadValue(*found, value, info);
  }

  /// Values that are known by a name of their own, a map from it.
  template <class T>
  void Named(std::string_view name, std::vector<T>* values, const FieldInfo& info = {}) {
    const auto found = FindOrRequire(name, info);
    if (!found) return;
    values->clear();
    for (const std::string& key : found->Keys()) {
      const Node entry = found->Require(key, "give it, or leave its name out");
      ReadValue(entry, &values->emplace_back(), {});
      values->back().name = key;
    }
  }

  /// What is there, as an empty map, or not. Its meaning is for lists alone.
  void Flag(std::string_view name, bool* value, std::string_view = {}) {
    const auto found = node_.Find(name);
    if (found) found->RequireKeys({});
    *value = found.has_value();
  }

  /// Refuses the absence of what the others need. what: the remedy.
  void Require(bool needed, std::string_view name, std::string_view what) {
    if (needed) node_.Require(name, what);
  }

  /// Refuses a value that cannot stand beside the others: "name is shown; it must be ...". name: empty for the whole.
  void Check(bool good, std::string_view name, std::string_view must_be) {
    if (!good) node_.Find(name).value_or(node_).RefuseValue(must_be);
  }

 private:
  std::optional<Node> FindOrRequire(std::string_view name, const FieldInfo& info) const {
    return info.needed.empty() ? node_.Find(name) : node_.Require(name, info.needed);
  }

  const Node& node_;
};

/// Writes the members of a struct.
class FieldWriter {
 public:
  template <class T>
  void Field(std::string_view name, T* value, const FieldInfo& info = {}) {
    Tree tree = WriteValue(*value);
    bool absent = tree.is_null() && !std::is_same_v<T, double>;
    if (info.at_default != AtDefault::written) absent = absent || tree == WriteValue(T{});
    if (!absent) tree_[std::string(name)] = std::move(tree);
    if (absent && info.at_default == AtDefault::null) tree_[std::string(name)] = nullptr;
  }
  template <class T>
  void Named(std::string_view name, std::vector<T>* values, const FieldInfo& info = {}) {
    Tree map = Tree::object();
    for (const T& one : *values) map[one.name] = WriteValue(one);
    if (!map.empty() || info.at_default == AtDefault::written)
      tree_[std::string(name)] = std::move(map);
  }
  void Flag(std::string_view name, const bool* value, std::string_view = {}) {
    if (*value) tree_[std::string(name)] = Tree::object();
  }
  void Require(bool, std::string_view, std::string_view) {}
  void Check(bool, std::string_view, std::string_view) {}

  Tree Take() { return std::move(tree_); }

 private:
  Tree tree_ = Tree::object();
};

template <Described T>
void ReadFields(const Node& node, T* value) {
  FieldNames fields;
  value->Serialize(&fields);
  node.RequireKeys(fields.names);
  FieldReader reader(node);
  value->Serialize(&reader);
}

template <Described T>
T ReadAs(const Node& node) {
  T value{};
  ReadFields(node, &value);
  return value;
}

template <Described T>
Tree WriteFields(T value) {
  FieldWriter writer;
  value.Serialize(&writer);
  return writer.Take();
}

}  // namespace warmjoint
