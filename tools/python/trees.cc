#include "tools/python/trees.h"

#include <nanobind/ndarray.h>
#include <nanobind/stl/string.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "models/foundation/bad_input.h"

namespace warmjoint::python {

namespace nb = nanobind;

namespace {

constexpr std::size_t kDeepest = 64;  // why: no file of ours nests a tenth as deep
// why: a list that holds another twice, and so on, doubles with each level; no file of ours holds a thousandth of these
constexpr std::size_t kMostContainers = 1'000'000;
constexpr std::size_t kMostEntries = 250'000'000;  // why: five columns of the longest recording

/// Makes trees of what Python hands over, which may hold itself, or be of any depth.
class TreeMaker {
 public:
  Tree Make(nb::handle value, const std::string& name);

 private:
  /// Make of a list, a map or what tells how to become one.
  Tree MakeInside(nb::handle value, const std::string& name);
  static nb::object Called(nb::handle value, const char* method, const std::string& name);
  static Tree Whole(nb::handle value, const std::string& name);

  std::vector<PyObject*> around_;  // what is being made, from the outside in
  std::size_t entries_ = 0, containers_ = 0;
};

Tree TreeMaker::Make(nb::handle value, const std::string& name) {
  if (++entries_ > kMostEntries) Refuse({name}, "holds more than {} values", kMostEntries);
  // what JSON has, too
  if (value.is_none()) return nullptr;
  if (nb::isinstance<nb::bool_>(value)) return nb::cast<bool>(value);
  if (nb::isinstance<nb::int_>(value)) return Whole(value, name);
  if (nb::isinstance<nb::float_>(value)) return nb::cast<double>(value);
  if (nb::isinstance<nb::str>(value)) return TextOf(value, name);
  if (std::ranges::find(around_, value.ptr()) != around_.end()) {
    Refuse({name}, "holds itself; give values that end");
  }
  if (around_.size() == kDeepest) {
    Refuse({name}, "is nested more than {} levels deep", kDeepest);
  }
  if (++containers_ > kMostContainers) {
    Refuse({name}, "holds more than {} lists and maps, one in the other", kMostContainers);
  }
  around_.push_back(value.ptr());
  Tree made = MakeInside(value, name);
  around_.pop_back();
  return made;
}

Tree TreeMaker::MakeInside(nb::handle value, const std::string& name) {
  if (nb::isinstance<nb::dict>(value)) {
    Tree map = Tree::object();
    // of a copy, since the methods of what is inside may change it
    const nb::dict copy = nb::steal<nb::dict>(PyDict_Copy(value.ptr()));
    for (const auto& [key, entry] : copy) {
      const std::string text = TextOf(nb::str(key), name);
      map[text] = Make(entry, name + "." + text);
    }
    return map;
  }
  if (nb::isinstance<nb::list>(value) || nb::isinstance<nb::tuple>(value)) {
    Tree list = Tree::array();
    const auto items = nb::steal<nb::tuple>(PySequence_Tuple(value.ptr()));
    if (!items.is_valid()) throw nb::python_error();
    for (const nb::handle entry : items) list.push_back(Make(entry, name));
    return list;
  }

  // what tells how to become one of these: NumPy's arrays and numbers, paths
  for (const char* method : {"tolist", "__fspath__"}) {
    if (nb::hasattr(value, method)) return Make(Called(value, method, name), name);
  }
  Refuse({name}, "is a {}; give numbers, texts, lists and dicts",
         nb::cast<std::string>(value.type().attr("__name__")));
}

nb::object TreeMaker::Called(nb::handle value, const char* method, const std::string& name) {
  try {
    return value.attr(method)();
  } catch (const nb::python_error& raised) {
    if (!raised.matches(PyExc_Exception)) throw;  // Ctrl-C
    Refuse({name}, "cannot be read: its {} raises {}", method,
           nb::cast<std::string>(raised.type().attr("__name__")));
  }
}

Tree TreeMaker::Whole(nb::handle value, const std::string& name) {
  int overflow = 0;
  const long long number = PyLong_AsLongLongAndOverflow(value.ptr(), &overflow);
  if (overflow == 0) return static_cast<std::int64_t>(number);
  if (overflow > 0) {
    const unsigned long long large = PyLong_AsUnsignedLongLong(value.ptr());
    if (!PyErr_Occurred()) return static_cast<std::uint64_t>(large);
    PyErr_Clear();
  }
  Refuse({name}, "is a whole number beyond 64 bits; give it as a float");
}

}  // namespace

nb::object ToPython(const Tree& tree) {
  switch (tree.type()) {
    case Tree::value_t::boolean:
      return nb::bool_(tree.get<bool>());
    case Tree::value_t::number_integer:
      return nb::int_(tree.get<std::int64_t>());
    case Tree::value_t::number_unsigned:
      return nb::int_(tree.get<std::uint64_t>());
    case Tree::value_t::number_float:
      return nb::float_(tree.get<double>());
    case Tree::value_t::string:
      return nb::cast(tree.get<std::string>());
    case Tree::value_t::array: {
      nb::list list;
      for (const Tree& entry : tree) list.append(ToPython(entry));
      return list;
    }
    case Tree::value_t::object: {
      nb::dict dict;
      for (const auto& [key, entry] : tree.items()) dict[nb::cast(key)] = ToPython(entry);
      return dict;
    }
    default:
      return nb::none();
  }
}

nb::object ToPython(Eigen::VectorXd column) {
  auto* owned = new Eigen::VectorXd(std::move(column));
  const nb::capsule owner(
      owned, [](void* memory) noexcept { delete static_cast<Eigen::VectorXd*>(memory); });
  return nb::cast(nb::ndarray<nb::numpy, double, nb::ndim<1>>(
      owned->data(), {static_cast<std::size_t>(owned->size())}, owner));
}

Tree ToTree(nb::handle value, const std::string& name) { return TreeMaker().Make(value, name); }

std::string TextOf(nb::handle text, const std::string& name) {
  Py_ssize_t size = 0;
  if (const char* bytes = PyUnicode_AsUTF8AndSize(text.ptr(), &size)) {
    return {bytes, static_cast<std::size_t>(size)};
  }
  PyErr_Clear();
  Refuse({name},
         "holds a text with surrogates, as Python spells bytes that are no UTF-8; give a text "
         "without");
}

}  // namespace warmjoint::python
