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
