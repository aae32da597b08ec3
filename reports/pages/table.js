// Tables: built from rows, sorted by a press on a column's head, and one tab stop each, within which the arrow keys move
// from cell to cell (the grid pattern of the W3C's ARIA Authoring Practices Guide).

// A head is a string or a cell; a row is an element or a list of strings and cells. A string takes the class of its
// column's head.
const column = (text, attributes = {}) => element('th', {scope: 'col', ...attributes}, text);
const textColumn = text => column(text, {class: 'text'});
const rowHead = (...children) => element('th', {scope: 'row'}, ...children);
function table(heads, rows, caption, isSortable = rows.length > 2) {  // two rows are compared at a glance
  const columns = heads.map(h => h instanceof Element ? h : column(h));
  const cell = (c, i) => c instanceof HTMLTableCellElement ? c : element('td', {class: columns[i].className}, c);
  const made = element('table', {}, caption && element('caption', {}, element('span', {}, caption)),
      element('thead', {}, element('tr', {}, ...columns)),
      element('tbody', {}, ...rows.map(r => r instanceof Element ? r : element('tr', {}, ...r.map(cell)))));
  if (isSortable) makeSortable(made);
  if (isSortable || made.querySelector('.explained')) makeGrid(made);
  new ResizeObserver(() => showMore(made.parentElement)).observe(made);
  return made;
}
// A table wider than its place fades out on the side where there is more of it.
function showMore(place) {
  if (place && place.classList.contains('scroll')) place.classList.toggle('more', place.scrollLeft + place.clientWidth < place.scrollWidth - 1);
}
document.addEventListener('scroll', e => { if (e.target instanceof Element) showMore(e.target); }, true);
const outcomeCell = outcome => element('td', {class: isFailure(outcome) ? 'text bad' : 'text'}, swatch(outcome), outcome);
// The background of a cell: pale at 0, full at 1.
const heated = level => `background: color-mix(in srgb, var(--heat) ${Math.round(70 * Math.min(1, Math.max(0, level)))}%, transparent)`;

// What a cell is sorted by: `data-value`, else the number that its text begins with, else the text; null where there is
// nothing. A count below the number is no part of it.
function sortKey(cell) {
  const text = (cell.dataset.value ?? (cell.firstChild instanceof Text ? cell.firstChild.data : cell.textContent)).trim();
  const number = /^[~≤×+ ]*(-?(?:[\d,]+(?:\.\d*)?(?:e-?\d+)?|Infinity))(?![\w:])/.exec(text.replaceAll(/(\d)%/g, '$1 '));
  return text === '' || text === '–' ? null : number ? Number(number[1].replaceAll(',', '')) : text;
}
// Numbers come before texts, and what is missing comes last whichever way a table is sorted.
function compareKeys(a, b, way) {
  if (a === null || b === null) return (a === null) - (b === null);
  if (typeof a !== typeof b) return typeof a === 'number' ? -1 : 1;
  return way * (typeof a === 'number' ? (a > b) - (a < b) : a.localeCompare(b, 'en', {numeric: true}));
}
// Rows of the class `pinned` stay on top. A table that is built anew, with the same heads, is sorted as it was.
const sorts = new Map();
function makeSortable(made) {
  const heads = [...made.tHead.rows[0].cells], [body] = made.tBodies, rows = [...body.rows];
  const pinned = rows.filter(r => r.classList.contains('pinned')), free = rows.filter(r => !pinned.includes(r));
  const name = heads.map(h => h.textContent).join('|');
  const sort = (head, way) => {
    const i = heads.indexOf(head), keys = new Map(free.map(r => [r, way ? sortKey(r.cells[Math.min(i, r.cells.length - 1)]) : null]));
    body.append(...pinned, ...[...free].sort((a, b) => compareKeys(keys.get(a), keys.get(b), way)));
    for (const h of heads) h.setAttribute('aria-sort', h !== head || !way ? 'none' : way > 0 ? 'ascending' : 'descending');
  };
  const next = {none: 1, ascending: -1, descending: 0};
  for (const head of heads) {
    whenPressed(head, () => {
      const way = next[head.getAttribute('aria-sort')];
      sorts.set(name, [heads.indexOf(head), way]);
      sort(head, way);
    });
  }
  const [i, way] = sorts.get(name) ?? [0, 0];
  sort(heads[i], way);
}
function makeGrid(made) {
  made.setAttribute('role', 'grid');
  for (const c of made.querySelectorAll('th, td')) c.tabIndex = -1;  // a click makes it the one that Tab reaches
  const first = list => [...list].find(c => c.checkVisibility()), last = list => first([...list].reverse());  // phones hide columns
  const cells = c => [...c.parentElement.cells];
  const below = (c, way) => { const all = [...made.rows], row = all[all.indexOf(c.parentElement) + way]; return row && row.cells[Math.min(c.cellIndex, row.cells.length - 1)]; };
  rove(made, made.rows[0].cells[0], (c, key) => {
    switch (key) {
      case 'ArrowLeft': return last(cells(c).slice(0, c.cellIndex));
      case 'ArrowRight': return first(cells(c).slice(c.cellIndex + 1));
      case 'ArrowUp': return below(c, -1);
      case 'ArrowDown': return below(c, 1);
      case 'Home': return first(cells(c));
      case 'End': return last(cells(c));
      default: return null;
    }
  });
}

// Candidates against pairs. A press on a pair's head chooses it: rows are sorted by it. Touchstone's own routine, the
// yardstick, is set apart. `cell(pair, name)` gives a cell.
function matrix(host, pairs, names, cell, caption) {
  const wasFocused = host.contains(document.activeElement);
  const heads = pairs.map(pair => column(otherShape(pair),
      {'aria-sort': pair === chosen.pair ? 'descending' : 'none'}));
  heads.forEach((head, i) => whenPressed(head, () => choose({pair: pairs[i]})));
  const head = name => {
    const made = rowHead(named(name), own(name) && element('small', {}, own(name)));
    if (meaningOf(name)) explain(made, meaningOf(name));
    return made;
  };
  const row = name => element('tr', own(name) ? {class: 'yardstick'} : {}, head(name), ...pairs.map(pair => cell(pair, name)));
  host.replaceChildren(table([textColumn('candidate'), ...heads], [...names.filter(own), ...names.filter(n => !own(n))].map(row), caption, false));
  if (wasFocused) heads[pairs.indexOf(chosen.pair)].focus();
}
