(function () {
  'use strict';
  var table = document.querySelector('#list table'), body = table.tBodies[0];
  var heads = Array.prototype.slice.call(table.tHead.rows[0].cells), rows = Array.prototype.slice.call(body.rows);
  var choose = document.getElementById('choose'), shown = document.getElementById('shown'), wanted = {};
  function text(row, column) { return row.cells[column].textContent; }
  function compare(a, b) {
    var x = parseFloat(a), y = parseFloat(b);
    if (isNaN(x) || isNaN(y)) return isNaN(x) && isNaN(y) ? a.localeCompare(b) : isNaN(x) ? 1 : -1;
    return x - y || a.localeCompare(b);
  }
  function filter() {
    var count = 0;
    rows.forEach(function (row) {
      row.hidden = Object.keys(wanted).some(function (column) { return wanted[column] && text(row, column) !== wanted[column]; });
      count += row.hidden ? 0 : 1;
    });
    shown.textContent = count + ' of ' + rows.length + ' rows are shown.';
  }
  function choice(column) {
    var values = rows.map(function (row) { return text(row, column); })
      .filter(function (value, i, all) { return all.indexOf(value) === i; });
    if (values.length < 2) return;
    var label = document.createElement('label'), list = document.createElement('select');
    label.textContent = heads[column].textContent + ' ';
    [''].concat(values).forEach(function (value) {
      var option = document.createElement('option');
      option.value = value;
      option.textContent = value || 'all';
      list.appendChild(option);
    });
    list.addEventListener('change', function () { wanted[column] = list.value; filter(); });
    label.appendChild(list);
    choose.appendChild(label);
    choose.hidden = false;
  }
  heads.forEach(function (head, column) {
    var button = document.createElement('button'), name = head.textContent;
    if (['variant', 'identifier', 'answer'].indexOf(name) >= 0) choice(column);
    button.type = 'button';
    button.textContent = name;
    head.textContent = '';
    head.appendChild(button);
    button.addEventListener('click', function () {
      var sign = head.getAttribute('aria-sort') === 'ascending' ? -1 : 1;
      heads.forEach(function (other) { other.removeAttribute('aria-sort'); });
      head.setAttribute('aria-sort', sign > 0 ? 'ascending' : 'descending');
      // cells without a number stay last
      rows.sort(function (a, b) {
        var x = text(a, column), y = text(b, column);
        return x === '-' || y === '-' ? (x === '-') - (y === '-') : sign * compare(x, y);
      });
      rows.forEach(function (row) { body.appendChild(row); });
    });
  });
  filter();
}());
