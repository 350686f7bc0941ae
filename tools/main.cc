// The program warmjoint: one subcommand a file, one catch for all of them.
#include <CLI/CLI.hpp>

int main(int argc, char** argv) {
  CLI::App app{"warmjoint: friction of robot joints that warm up"};
  CLI11_PARSE(app, argc, argv);
  return 0;
}
