// Options of identifiers, `--set key=value`, as typed values.
//
// A struct of options states the name, bounds and meaning of each in its Serialize (serialize.h). An identifier has groups of
// options, some of which it shares with others:
//
//   struct KalmanOptions {
//     int passes = 10;
//
//     template <class A>
//     void Serialize(A* a) {
//       a->Field("passes", &passes, {.bounds = {.at_least = 1, .at_most = 100}, .meaning = "most passes over the recording"});
//     }
//   };
//
//   OptionGroups<LawOption, KalmanOptions>
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <concepts>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "models/foundation/serialize.h"

namespace warmjoint {

/// One option, as tables and readers of texts see it.
struct OptionInfo {
  std::string name;
  std::string value;
  /// "text", "range", words separated by |, or "number" or "integer" and bounds: "number > 0 <= 1".
  std::string allowed;
  std::string meaning;
};

/// "lower:upper", two finite numbers; lower <= upper.
struct OptionRange {
  double lower = 0;
  double upper = 0;
};
void ReadValue(const Node& node, OptionRange* value, const FieldInfo& info);
Tree WriteValue(const OptionRange& value);

/// A type whose values have words: an enum, or a struct that represents one of a list.
template <typename E>
concept HasWords = requires(const E& value) {
  { WordsOf(value) } -> std::same_as<std::span<const Word<E>>>;
};
template <HasWords E>
requires std::is_class_v<E>
void ReadValue(const Node& node, E* value, const FieldInfo&) { *value = ChoiceOf<E>(node); }
template <HasWords E>
requires std::is_class_v<E> Tree WriteValue(const E& value) { return NameOf(value); }

/// Whether a part of the model is estimated: warming, friction by load, a lag or delay of the torque, damping, inertia.
enum class PartFit { none, estimated };
inline std::span<const Word<PartFit>> WordsOf(PartFit) {
  static constexpr std::array words{Word{"none", PartFit::none},
                                    Word{"estimated", PartFit::estimated}};
  return words;
}

/// Lists the options of a struct.
class OptionLister {
 public:
  template <class T>
  void Field(std::string_view name, T* value, const FieldInfo& info = {}) {
    rows_.push_back({std::string(name), TextOf(WriteValue(*value)), Allowed(*value, info.bounds),
                     std::string(info.meaning)});
  }

  std::vector<OptionInfo> Take() { return std::move(rows_); }

 private:
  static std::string TextOf(const Tree& value);
  /// "number > 0 <= 1"
  static std::string KindWithin(std::string kind, const Bounds& bounds);
  static std::string Allowed(double, const Bounds& bounds) { return KindWithin("number", bounds); }
  static std::string Allowed(int, const Bounds& bounds) { return KindWithin("integer", bounds); }
  static std::string Allowed(const std::string&, const Bounds&) { return "text"; }
  static std::string Allowed(const OptionRange&, const Bounds&) { return "range"; }
  /// Of other types: their own words.
  template <class T>
  requires requires { T::kAllowed; }
  static std::string Allowed(const T&, const Bounds&) { return T::kAllowed; }
  template <HasWords E>
  static std::string Allowed(const E& choice, const Bounds&) {
    std::vector<std::string_view> words;
    for (const Word<E>& word : WordsOf(choice)) words.push_back(word.name);
    return fmt::format("{}", fmt::join(words, "|"));
  }

  std::vector<OptionInfo> rows_;
};

/// The rows of a struct of options.
template <Described T>
std::vector<OptionInfo> ListOptions(T options) {
  OptionLister lister;
  options.Serialize(&lister);
  return lister.Take();
}

/// Groups of options as one, in that order.
template <Described... Groups>
struct OptionGroups : Groups... {
  template <class A>
  void Serialize([[maybe_unused]] A* a) {
    (Groups::Serialize(a), ...);
  }
};

/// The options of any identifier. Cheap to copy.
class Options {
 public:
  template <Described T>
  Options(const T& options) : held_(std::make_shared<HeldAs<T>>(options)) {}  // NOLINT
  /// No options.
  Options() : Options(OptionGroups<>{}) {}

  /// A group of them; null where they have none of that type.
  template <class T>
  const T* Find() const {
    return dynamic_cast<const T*>(held_.get());
  }
  /// The same; its absence is a bug of the identifier, which throws in every build.
  template <class T>
  const T& Get() const {
    return dynamic_cast<const T&>(*held_);
  }
  /// The same; where they have none of that type, as it is by default.
  template <class T>
  T OrDefault() const {
    const T* found = Find<T>();
    return found ? *found : T{};
  }
  /// Whether one of them has that name, in whichever group.
  bool Has(std::string_view name) const;
  /// The same with another group of that type.
  template <class T>
  Options With(const T& group) const {
    Options other = *this;
    const std::shared_ptr<Held> copy = held_->Copy();
    dynamic_cast<T&>(*copy) = group;
    other.held_ = copy;
    return other;
  }

  /// These options, some of them replaced by the values in texts. Throws BadInput from `place` for an unknown name, with the
  /// nearest, and for values that are not allowed.
  Options Read(const std::map<std::string, std::string>& given, const Place& place = {}) const;

  std::vector<OptionInfo> List() const { return held_->List(); }
  /// The texts of the options that are not at their defaults, by name.
  std::map<std::string, std::string> Changed() const;

 private:
  struct Held {
    virtual ~Held() = default;
    virtual std::shared_ptr<Held> Copy() const = 0;
    virtual void Read(const Node& node) = 0;
    virtual std::vector<OptionInfo> List() const = 0;
    virtual std::vector<OptionInfo> Defaults() const = 0;
  };

  template <class T>
  struct HeldAs final : Held, T {
    explicit HeldAs(const T& options) : T(options) {}
    std::shared_ptr<Held> Copy() const override { return std::make_shared<HeldAs>(*this); }
    void Read(const Node& node) override { ReadFields(node, static_cast<T*>(this)); }
    std::vector<OptionInfo> List() const override { return ListOptions<T>(*this); }
    std::vector<OptionInfo> Defaults() const override { return ListOptions(T{}); }
  };

  std::shared_ptr<const Held> held_;
};

/// Values in texts by name, for readers of fields; refusals name the place.
Node NodeOf(const std::map<std::string, std::string>& given, const Place& place);

}  // namespace warmjoint
