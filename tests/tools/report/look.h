// How tests look at pictures: through the record of the drawing and through its pixels.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "tools/report/draw/draw_figure.h"

namespace warmjoint::report {

/// The plot of that title.
inline const DrawnPlot& PlotNamed(const Drawn& drawn, const std::string& title) {
  for (const DrawnPlot& plot : drawn.plots) {
    if (plot.title == title) return plot;
  }
  ADD_FAILURE() << "no plot '" << title << "'";
  static const DrawnPlot none;
  return none;
}

/// The series of that label.
inline const DrawnSeries& SeriesNamed(const DrawnPlot& plot, const std::string& label) {
  for (const DrawnSeries& series : plot.series) {
    if (series.label == label) return series;
  }
  ADD_FAILURE() << "no series '" << label << "' in '" << plot.title << "'";
  static const DrawnSeries none;
  return none;
}

/// Pixel of a data point, worked out from the plot's rectangle and limits alone: x to the right,
/// y upwards.
struct Pixel {
  int x, y;
};

inline double Share(double value, std::pair<double, double> limits, Scale scale) {
  if (scale == Scale::logarithmic) {
    return std::log(value / limits.first) / std::log(limits.second / limits.first);
  }
  return (value - limits.first) / (limits.second - limits.first);
}

inline Pixel PixelOf(const DrawnPlot& plot, double x, double y, Scale x_scale = Scale::linear,
                     Scale y_scale = Scale::linear) {
  const double left = plot.area.left + plot.area.width() * Share(x, plot.x, x_scale);
  const double top = plot.area.bottom - plot.area.height() * Share(y, plot.y, y_scale);
  return {static_cast<int>(kPixelsPerPoint * left), static_cast<int>(kPixelsPerPoint * top)};
}

/// Largest difference of two colours in a channel, 0 ... 255.
inline int Distance(Rgb a, Rgb b) {
  return std::max(
      {std::abs(a.red - b.red), std::abs(a.green - b.green), std::abs(a.blue - b.blue)});
}

/// Whether a pixel within `reach` of `at` has the colour.
inline bool HasColourNear(const Image& image, Pixel at, Rgb colour, int reach = 2) {
  for (int y = std::max(0, at.y - reach); y <= std::min(image.height - 1, at.y + reach); ++y) {
    for (int x = std::max(0, at.x - reach); x <= std::min(image.width - 1, at.x + reach); ++x) {
      if (Distance(image.At(x, y), colour) < 24) return true;
    }
  }
  return false;
}

/// Share of pixels in a rectangle (points) that differ from the background.
inline double Ink(const Image& image, const Rectangle& place, Rgb background) {
  const auto pixel = [](double points) { return static_cast<int>(kPixelsPerPoint * points); };
  int inked = 0, all = 0;
  for (int y = pixel(place.top); y < pixel(place.bottom); ++y) {
    for (int x = pixel(place.left); x < pixel(place.right); ++x) {
      if (x < 0 || y < 0 || x >= image.width || y >= image.height) continue;
      ++all;
      inked += Distance(image.At(x, y), background) > 60;
    }
  }
  return all ? static_cast<double>(inked) / all : 0;
}

/// What a person would complain of in any figure: text outside the page, on top of other text, or
/// not there; a plot without data inside its axes.
inline void ExpectTidy(const Figure& figure, const Drawn& drawn, const Theme& theme) {
  for (std::size_t i = 0; i < drawn.texts.size(); ++i) {
    const auto& [text, a] = drawn.texts[i];
    EXPECT_TRUE(a.left >= 0 && a.top >= 0 && a.right <= figure.width &&
                kPixelsPerPoint * a.bottom <= drawn.image.height)
        << figure.name << ": '" << text << "' leaves the page";
    const bool blank = text.find_first_not_of(' ') == std::string::npos;
    EXPECT_TRUE(blank || Ink(drawn.image, a, theme.background) > 0.01)
        << figure.name << ": '" << text << "' is not there";
    for (std::size_t j = i + 1; j < drawn.texts.size(); ++j) {
      const Rectangle& b = drawn.texts[j].place;
      const bool apart = a.right <= b.left + 1 || b.right <= a.left + 1 || a.bottom <= b.top + 2 ||
                         b.bottom <= a.top + 2;
      EXPECT_TRUE(apart || blank) << figure.name << ": '" << text << "' and '"
                                  << drawn.texts[j].text << "' overlap";
    }
  }
  for (const DrawnPlot& plot : drawn.plots) {
    bool any = false;
    for (const DrawnSeries& series : plot.series) {
      any = any || (series.points > 0 && series.x.first <= plot.x.second &&
                    series.x.second >= plot.x.first && series.y.first <= plot.y.second &&
                    series.y.second >= plot.y.first);
    }
    EXPECT_TRUE(any) << figure.name << ": '" << plot.title << "' shows no data";
    EXPECT_GT(Ink(drawn.image, plot.area, theme.background), 0.0005)
        << figure.name << ": '" << plot.title << "' is empty";
  }
  for (const std::string& text : drawn.unreadable) {
    ADD_FAILURE() << figure.name << ": the typeface lacks a character of '" << text << "'";
  }
  EXPECT_FALSE(figure.finding.empty()) << figure.name << " has no alt text";
}

/// Draws the figure in the light theme and checks that it is tidy.
inline Drawn DrawLight(const Figure& figure) {
  Drawn light = DrawFigure(figure, LightTheme());
  ExpectTidy(figure, light, LightTheme());
  return light;
}

/// Draws the figure in both themes and checks that it is tidy; returns the light one.
inline Drawn DrawTidy(const Figure& figure) {
  ExpectTidy(figure, DrawFigure(figure, DarkTheme()), DarkTheme());
  return DrawLight(figure);
}

}  // namespace warmjoint::report
