'use strict';
// Sorts the table of runs by the column whose heading is clicked; a second click reverses the order. Cells
// without a value stay last. Of a long table only the first rows are shown, and as many more at each click below it:
// a browser would take a minute to lay out ten thousand rows with pictures.
(() => {
  const table = document.querySelector('table.runs'), body = table.tBodies[0];
  const headings = [...table.tHead.rows[0].cells];
  const more = document.querySelector('button.more'), page = Number(table.dataset.shown);
  let shown = page;

  const valueOf = (row, column) => row.cells[column]?.dataset.value;

  function compare(a, b, sign) {
    if (a === undefined || b === undefined) return (a === undefined) - (b === undefined);
    return sign * (isNaN(a) || isNaN(b) ? a.localeCompare(b, 'en', {numeric: true}) : a - b);
  }

  // In the file, all but the first rows are hidden.
  function show() {
    [...body.rows].forEach((row, i) => row.hidden = i >= shown);
    if (!more) return;
    more.hidden = shown >= body.rows.length;
    more.textContent = `${shown} of ${body.rows.length} runs are shown: show more`;
  }

  function sortBy(column) {
    const descending = headings[column].getAttribute('aria-sort') === 'ascending', sign = descending ? -1 : 1;
    const rows = [...body.rows].sort((a, b) => compare(valueOf(a, column), valueOf(b, column), sign));
    body.replaceChildren(...rows);
    show();
    for (const heading of headings) heading.removeAttribute('aria-sort');
    headings[column].setAttribute('aria-sort', descending ? 'descending' : 'ascending');
  }

  more?.addEventListener('click', () => {
    shown += page;
    show();
  });
  show();
  headings.forEach(
      (heading, column) => heading.querySelector('button')?.addEventListener('click', () => sortBy(column)));
})();
