#include "tools/report/page/log_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <vector>

#include "tools/report/draw/escape.h"
#include "tools/report/draw/reduce.h"

namespace warmjoint::report {
namespace {

/// What draws the charts of a log in a browser, moves them together and saves their numbers.
constexpr std::string_view kLogChartScript = R"(
(function () {
  'use strict';
  var samples = JSON.parse(document.getElementById('samples').textContent);
  var box = document.getElementById('charts');
  box.hidden = false;
  var dark = window.matchMedia('(prefers-color-scheme: dark)').matches;
  var colours = dark ? ['#929ca2', '#4ca6e2', '#f0803c'] : ['#80868f', '#0072b2', '#d55e00'];
  var graphs = [], busy = false;
  function words(data) {
    var line = document.createElement('span');
    line.textContent = data.x === undefined ? '' : data.series.filter(function (s) { return s.y !== undefined && s.y !== null && s.isVisible; })
      .map(function (s) { return s.label + ' ' + s.yHTML; }).join(', ') + ' at ' + Number(data.x).toPrecision(6) + ' s';
    return line;
  }
  function draw(place) {
    var column = Number(place.dataset.column), torque = column === 3;
    var rows = samples.map(function (s) {
      var row = [s[0], s[column], s[5] ? s[column] : null];
      if (torque) row.push(s[4]);
      return row;
    });
    var labels = ['time', 'measured', 'kept'];
    if (torque) labels.push('fit');
    return new Dygraph(place, rows, {
      labels: labels, colors: colours, ylabel: place.dataset.name, xlabel: torque ? 'time (s)' : '',
      strokeWidth: 1.2, legend: 'follow', legendFormatter: words, animatedZooms: false,
      axisLineColor: colours[0], gridLineColor: dark ? '#32373f' : '#e2e5ea',
      drawCallback: function (graph, first) {
        if (busy || first) return;
        busy = true;
        graphs.forEach(function (other) {
          if (other !== graph) other.updateOptions({dateWindow: graph.xAxisRange()});
        });
        busy = false;
      }
    });
  }
  Array.prototype.forEach.call(document.querySelectorAll('.chart'), function (place) { graphs.push(draw(place)); });
  // the same by keyboard and finger: the middle moves by `shift` of what is shown, which grows by `factor`
  var whole = [samples[0][0], samples[samples.length - 1][0]];
  function show(factor, shift) {
    var range = graphs[0].xAxisRange(), length = range[1] - range[0];
    var middle = (range[0] + range[1]) / 2 + shift * length, half = Math.min(length * factor, whole[1] - whole[0]) / 2;
    middle = Math.min(Math.max(middle, whole[0] + half), whole[1] - half);
    graphs[0].updateOptions({dateWindow: [middle - half, middle + half]});
  }
  function press(name, act) { document.getElementById(name).addEventListener('click', act); }
  press('zoom-whole', function () { graphs[0].updateOptions({dateWindow: whole}); });
  press('zoom-in', function () { show(0.5, 0); });
  press('zoom-out', function () { show(2, 0); });
  press('zoom-earlier', function () { show(1, -0.5); });
  press('zoom-later', function () { show(1, 0.5); });
  ['show-all', 'show-kept', 'show-fit'].forEach(function (name, series) {
    document.getElementById(name).addEventListener('change', function (event) {
      graphs.forEach(function (graph) {
        if (series < graph.visibility().length) graph.setVisibility(series, event.target.checked);
      });
    });
  });
  document.getElementById('download').addEventListener('click', function () {
    var text = 'time,position,velocity,torque,fit,kept\n' + samples.map(function (s) { return s.join(','); }).join('\n') + '\n';
    var link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob([text], {type: 'text/csv'}));
    link.download = 'samples.csv';
    link.click();
    URL.revokeObjectURL(link.href);
  });
}());
)";

using Eigen::Index;

constexpr int kParts = 2500;

/// Samples that show every extreme of every column.
std::vector<Index> Thinned(const FitView& view) {
  const CellSpan parts{view.time[0], view.time.tail(1)[0], kParts};
  std::vector<Index> chosen;
  for (const Eigen::VectorXd* column : {&view.position, &view.velocity, &view.torque}) {
    const std::vector<Index> own = ReduceCurve(view.time, *column, parts);
    std::vector<Index> both;
    std::set_union(chosen.begin(), chosen.end(), own.begin(), own.end(), std::back_inserter(both));
    chosen = std::move(both);
  }
  return chosen;
}

std::string Number(double value) {
  return std::isfinite(value) ? fmt::format("{:.5g}", value) : "null";
}

}  // namespace

std::string MakeLogChart(const FitView& view) {
  // no more samples than a page can carry
  const std::vector<Index> chosen = Thinned(view);
  const bool thinned = static_cast<Index>(chosen.size()) < view.time.size();
  std::string rows;
  // a row for each sample: time, position, velocity, torque, fit, kept
  for (Index i : chosen) {
    const bool kept = view.selection.keep[i];
    const double fit = view.has_fit && kept ? view.fitted[i] : std::nan("");
    rows += fmt::format("{}[{:.7g},{},{},{},{},{}]", rows.empty() ? "" : ",", view.time[i],
                        Number(view.position[i]), Number(view.velocity[i]), Number(view.torque[i]),
                        Number(fit), kept ? 1 : 0);
  }
  // the charts with their buttons; the numbers follow as data
  return fmt::format(
      "<noscript><p>The charts need JavaScript; the pictures below show the same.</p></noscript>\n"
      "<div id=\"charts\" hidden>\n{}<p>Drag across to zoom, double-click to see all, hold Shift "
      "and "
      "drag "
      "to move. <label><input type=\"checkbox\" id=\"show-all\" checked> all samples</label> "
      "<label><input type=\"checkbox\" id=\"show-kept\" checked> kept samples</label> "
      "<label><input type=\"checkbox\" id=\"show-fit\" checked> fit</label> "
      "<button type=\"button\" id=\"download\">Download these numbers (CSV)</button></p>\n"
      "<p role=\"group\" aria-label=\"Part of the log that is shown\">"
      "<button type=\"button\" id=\"zoom-whole\">Whole log</button> "
      "<button type=\"button\" id=\"zoom-in\">Zoom in</button> "
      "<button type=\"button\" id=\"zoom-out\">Zoom out</button> "
      "<button type=\"button\" id=\"zoom-earlier\">Earlier</button> "
      "<button type=\"button\" id=\"zoom-later\">Later</button></p>\n"
      "<div class=\"chart\" data-column=\"1\" data-name=\"{}\"></div>\n"
      "<div class=\"chart\" data-column=\"2\" data-name=\"{}\"></div>\n"
      "<div class=\"chart\" data-column=\"3\" data-name=\"{}\"></div>\n</div>\n"
      "<script type=\"application/json\" id=\"samples\">[{}]</script>\n",
      thinned ? "<p>Thinned for this page without losing an extreme.</p>\n" : "",
      Escape(PositionLabel(view)), Escape(SpeedLabel(view)), Escape(TorqueLabel(view, "torque")),
      rows);
}

std::string_view LogChartStyle() {
  return R"(
.chart { width: 100%; height: 14rem; margin: .6rem 0 1.4rem; }
#charts label { white-space: nowrap; margin-right: .8rem; }
button { font: inherit; color: var(--ink); background: var(--soft); border: 1px solid var(--rule); border-radius: .3rem; padding: .2rem .7rem; }
.dygraph-axis-label, .dygraph-label { color: var(--ink); font-size: .85rem; }
.dygraph-legend { background: var(--paper); color: var(--ink); width: auto; font-size: .85rem; }
.void { border-left-color: #d55e00; }
@media print { #recording { display: none; } }
)";
}

std::string_view LogChartScript() { return kLogChartScript; }

}  // namespace warmjoint::report
