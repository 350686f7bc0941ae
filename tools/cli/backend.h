// The Python programs that draw figures and fill pages (tools/python/warmjoint), called once a command.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/figures/figure.h"

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
  std::string style = "screen";  // of draw.py
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

/// A file, or why the figure has no room in the size that is asked for.
struct DrawnFigure {
  std::string bytes;
  std::string refusal;
};

/// A Python that has what drawing needs: the environment variable WARMJOINT_PYTHON, else python3 in PATH, else
/// /usr/bin/python3.
class Backend {
 public:
  /// Throws OutputFailed, with what is to be installed, where there is none.
  Backend();

  /// In the order of the figures. The same figure and setting give the same bytes. Throws OutputFailed where the backend
  /// fails.
  std::vector<DrawnFigure> Draw(const std::vector<figures::Figure>& figures,
                                const PictureSetting& setting) const;

  /// A page of one of the templates, self-contained HTML. data: of FigureJson and texts. Throws OutputFailed.
  std::string FillPage(const std::string& page, const Tree& data) const;

 private:
  std::string Ask(const Tree& request) const;

  std::filesystem::path script_;
  std::string python_;
};

/// Draws one figure into a file of the format that its end names. Throws OutputFailed, and BadInput as PictureFormatOf does.
void WritePicture(const Backend& backend, const figures::Figure& figure, const std::string& path);

}  // namespace warmjoint
