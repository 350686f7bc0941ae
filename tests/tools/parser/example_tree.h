// A command line for tests of what is made from its tree.
#pragma once

#include "tools/parser/choice.h"
#include "tools/parser/command_tree.h"

namespace warmjoint {

/// Two commands: `brew KIND [CUP...] --size small|large -o FILE --hot`, and `stop`.
class ExampleParser {
 public:
  ExampleParser() {
    CLI::App* brew = app.add_subcommand("brew", "Make a \\cup: tea [green] or coffee");
    AddChoice(*brew, "KIND", kind, {"tea", "coffee"}, "what to make")->required();
    brew->add_option("CUP", cups, "cups\nto fill")->type_name("FILE");
    AddChoice(*brew, "--size", size, {"small", "large"}, "of the cup");
    brew->add_option("-o,--output", output, "where it's put")->type_name("FILE")->required();
    brew->add_flag("--hot", hot, "not cold")->group("Heat");
    app.add_subcommand("stop", "Stop");
    app.require_subcommand(1);
  }

  CLI::App app{"Tea and coffee", "warmjoint"};
  std::string kind, size = "small", output;
  std::vector<std::string> cups;
  bool hot = false;
};

}  // namespace warmjoint
