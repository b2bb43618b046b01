'use strict';
// Sorts the table of runs by the column whose heading is clicked; a second click turns the order round. Cells
// without a value stay last.
(() => {
  const table = document.querySelector('table.runs'), body = table.tBodies[0];
  const headings = [...table.tHead.rows[0].cells];

  const valueOf = (row, column) => row.cells[column]?.dataset.value;

  function compare(a, b, sign) {
    if (a === undefined || b === undefined) return (a === undefined) - (b === undefined);
    return sign * (isNaN(a) || isNaN(b) ? a.localeCompare(b, 'en', {numeric: true}) : a - b);
  }

  function sortBy(column) {
    const descending = headings[column].getAttribute('aria-sort') === 'ascending', sign = descending ? -1 : 1;
    const rows = [...body.rows].sort((a, b) => compare(valueOf(a, column), valueOf(b, column), sign));
    body.append(...rows);
    for (const heading of headings) heading.removeAttribute('aria-sort');
    headings[column].setAttribute('aria-sort', descending ? 'descending' : 'ascending');
  }

  headings.forEach(
      (heading, column) => heading.querySelector('button')?.addEventListener('click', () => sortBy(column)));
})();
