// What Python hands to the package: bytes build a value on a stack, an operation each; what is on top becomes a tree.
#include "tools/python/trees.h"

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <cstring>
#include <string>
#include <vector>

#include "tests/fuzz/fuzz.h"

NB_MODULE(fuzz_trees, module) { (void)module; }

namespace {

namespace nb = nanobind;
using namespace warmjoint;

/// Python, which ends with the process.
void Begin() {
  static const bool begun = [] {
    PyImport_AppendInittab("fuzz_trees", PyInit_fuzz_trees);
    Py_Initialize();
    nb::module_::import_("fuzz_trees").release();
    nb::set_leak_warnings(false);  // of values that hold themselves
    return true;
  }();
  (void)begun;
}

/// Takes up to `size` bytes off the front.
std::string_view Take(std::string_view& bytes, std::size_t size) {
  const std::string_view taken = bytes.substr(0, size);
  bytes.remove_prefix(taken.size());
  return taken;
}

std::size_t Count(std::string_view& bytes) {
  const std::string_view one = Take(bytes, 1);
  return one.empty() ? 0 : static_cast<unsigned char>(one[0]) % 9;
}

template <typename T>
T Number(std::string_view& bytes) {
  T number{};
  const std::string_view taken = Take(bytes, sizeof number);
  std::memcpy(&number, taken.data(), taken.size());
  return number;
}

/// A text with the surrogates that stand for bytes that are no UTF-8.
nb::object Text(std::string_view bytes) {
  return nb::steal(
      PyUnicode_DecodeUTF8(bytes.data(), static_cast<Py_ssize_t>(bytes.size()), "surrogateescape"));
}

class Machine {
 public:
  nb::object Run(std::string_view bytes) {
    while (!bytes.empty() && stack_.size() < 1000) Step(Take(bytes, 1)[0], bytes);
    return Pop();
  }

 private:
  nb::object Pop() {
    if (stack_.empty()) return nb::none();
    nb::object top = stack_.back();
    stack_.pop_back();
    return top;
  }

  nb::list List(std::size_t count) {
    nb::list list;
    for (std::size_t i = 0; i < count; ++i) list.append(Pop());
    return list;
  }

  nb::dict Dict(std::size_t count, std::string_view& bytes) {
    nb::dict dict;
    for (std::size_t i = 0; i < count; ++i) dict[Text(Take(bytes, Count(bytes)))] = Pop();
    return dict;
  }

  void Step(char operation, std::string_view& bytes) {
    switch (operation) {
      case 't':
        stack_.push_back(nb::bool_(Count(bytes) % 2 == 0));
        break;
      case 'i':
        stack_.push_back(nb::int_(Number<std::int64_t>(bytes)));
        break;
      case 'I':
        stack_.push_back(nb::int_(1) << nb::int_(16 * Count(bytes)));
        break;
      case 'f':
        stack_.push_back(nb::float_(Number<double>(bytes)));
        break;
      case 's':
        stack_.push_back(Text(Take(bytes, Count(bytes))));
        break;
      case 'l':
        stack_.push_back(List(Count(bytes)));
        break;
      case 'u':
        stack_.push_back(nb::tuple(List(Count(bytes))));
        break;
      case 'd':
        stack_.push_back(Dict(Count(bytes), bytes));
        break;
      case 'c':
        if (!stack_.empty()) stack_.push_back(stack_.back());
        break;
      case 'h':
        Hold();
        break;
      case 'o': {
        nb::object inside = Pop();
        stack_.push_back(nb::module_::import_("types").attr("SimpleNamespace")());
        stack_.back().attr("tolist") = nb::cpp_function([inside] { return inside; });
        break;
      }
      default:
        stack_.push_back(nb::none());
    }
  }

  /// Puts what is on top into itself.
  void Hold() {
    if (stack_.empty()) return;
    nb::object top = stack_.back();
    if (nb::isinstance<nb::list>(top)) nb::borrow<nb::list>(top).append(top);
    if (nb::isinstance<nb::dict>(top)) nb::borrow<nb::dict>(top)["itself"] = top;
  }

  std::vector<nb::object> stack_;
};

}  // namespace

void warmjoint::fuzz::Read(std::string_view bytes) {
  Begin();
  const nb::object value = Machine().Run(bytes);
  const Tree tree = python::ToTree(value, "fuzz");
  // texts of a tree are UTF-8, and it comes back as it went
  const std::string text = tree.dump();
  fuzz::Require(python::ToTree(python::ToPython(tree), "again").dump() == text);
}
