// The Python program that draws figures and fills pages (tools/python/warmjoint/figures), called once a command.
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "models/foundation/serialize.h"
#include "tools/shown/shown_data.h"

namespace warmjoint {

enum class PictureFormat { png, svg, pdf };

inline std::span<const Word<PictureFormat>> WordsOf(PictureFormat) {
  static constexpr std::array words{Word{"png", PictureFormat::png},
                                    Word{"svg", PictureFormat::svg},
                                    Word{"pdf", PictureFormat::pdf}};
  return words;
}

/// The format that the name of a file asks for by its end. Throws BadInput for any other.
PictureFormat PictureFormatOf(const std::string& path);

/// How figures become files.
struct PictureSetting {
  PictureFormat format = PictureFormat::png;
  std::string style = "screen";  // of style.py
  double width = 0;              // mm; 0: the style's
  double height = 0;             // mm; 0: what the figure needs
  double dpi = 0;                // pixels an inch; 0: the style's
  bool titled = true;

  template <class A>
  void Serialize(A* a) {
    a->Field("format", &format);
    a->Field("style", &style);
    a->Field("width", &width);
    a->Field("height", &height);
    a->Field("dpi", &dpi);
    a->Field("titled", &titled);
  }
};

/// What is drawn.
struct DrawRequest {
  Tree sources = Tree::array();        // [{kind, name, ...facts}], whose arrays `data` holds
  shown::ShownData data{};             // its facts are not used
  std::vector<std::string> figures{};  // by name or by the paper's number; empty: all
  bool with_data = false;              // also what they show, as CSV
};

struct DrawnFile {
  std::size_t source = 0;  // position in the request; its size: of all sources together
  std::string name;        // with its end
  std::string finding;     // one sentence
  std::string bytes;
  bool is_data = false;
};

struct Drawn {
  std::vector<DrawnFile> files;
  std::vector<std::string> left_out;  // a line each
};

/// A Python that has what drawing needs: the environment variable WARMJOINT_PYTHON, else python3 in PATH, else
/// /usr/bin/python3.
class Backend {
 public:
  /// Throws OutputFailed, with what is to be installed, where there is none.
  Backend();

  /// The same request and setting give the same bytes. Throws BadInput for a figure that a source cannot give, or that has no room in
  /// the size that is asked for, where it was asked for by name; OutputFailed where the backend fails.
  Drawn Draw(DrawRequest request, const PictureSetting& setting) const;

  /// A page of one of the templates, self-contained HTML. Throws OutputFailed.
  std::string FillPage(const std::string& page, shown::ShownData data) const;

 private:
  std::string Ask(const shown::ShownData& request) const;

  std::filesystem::path folder_;
  std::string python_;
};

/// One figure of one source in the format that the end of `path` names. Throws OutputFailed, and BadInput as PictureFormatOf does.
std::string PictureFor(const std::string& path, const Backend& backend, DrawRequest request);

}  // namespace warmjoint
