#include "tools/python/trees.h"

#include <nanobind/ndarray.h>
#include <nanobind/stl/string.h>

#include <utility>

#include "models/foundation/bad_input.h"

namespace warmjoint::python {

namespace nb = nanobind;

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

Tree ToTree(nb::handle value, const std::string& name) {
  // what JSON has, too
  if (value.is_none()) return nullptr;
  if (nb::isinstance<nb::bool_>(value)) return nb::cast<bool>(value);
  if (nb::isinstance<nb::int_>(value)) return nb::cast<std::int64_t>(value);
  if (nb::isinstance<nb::float_>(value)) return nb::cast<double>(value);
  if (nb::isinstance<nb::str>(value)) return nb::cast<std::string>(value);
  if (nb::isinstance<nb::dict>(value)) {
    Tree map = Tree::object();
    for (const auto& [key, entry] : nb::borrow<nb::dict>(value)) {
      const std::string text = nb::cast<std::string>(nb::str(key));
      map[text] = ToTree(entry, name + "." + text);
    }
    return map;
  }
  if (nb::isinstance<nb::list>(value) || nb::isinstance<nb::tuple>(value)) {
    Tree list = Tree::array();
    for (const nb::handle entry : value) list.push_back(ToTree(entry, name));
    return list;
  }

  // what tells how to become one of these: NumPy's arrays and numbers, paths
  for (const char* method : {"tolist", "__fspath__"}) {
    if (nb::hasattr(value, method)) return ToTree(value.attr(method)(), name);
  }
  Refuse({name}, "is a {}; give numbers, texts, lists and dicts",
         nb::cast<std::string>(value.type().attr("__name__")));
}

}  // namespace warmjoint::python
