// SPDX-License-Identifier: MIT
// What a report's widgets do. Without it the page shows every picture in its order; controls come with `hidden` and
// are shown here, since they do nothing without it.
#include "viewer/report/html.h"

namespace sidelight {

const std::string_view kPageScript = R"js(
'use strict';

// Two pictures: beside each other, under a slider, or flipped in place (the button, F, or a click on the picture). A key
// without a modifier may be what someone says or hits by chance: F counts where the focus is in the pair, which a click
// on the picture gives it too.
for (const pair of document.querySelectorAll('.pair')) {
  const modes = [...pair.querySelectorAll('input[type=radio]')];
  const range = pair.querySelector('input[type=range]');
  const stage = pair.querySelector('.stage');

  const show = (mode, shown) => {
    pair.dataset.mode = mode;
    pair.dataset.shown = shown;
    for (const radio of modes) radio.checked = radio.value === mode;
  };
  const flip = () => {
    const flipping = pair.dataset.mode === 'flip';
    show('flip', flipping && pair.dataset.shown === 'left' ? 'right' : 'left');
  };
  const swipe = () => {
    const at = range.value / 10 + '%';
    pair.style.setProperty('--at', at);
    range.setAttribute('aria-valuetext', at);
  };

  for (const radio of modes) radio.addEventListener('change', () => show(radio.value, 'left'));
  range.addEventListener('input', swipe);
  pair.querySelector('.flip').addEventListener('click', flip);
  stage.addEventListener('click', () => { if (pair.dataset.mode === 'flip') flip(); });
  pair.tabIndex = -1;
  pair.addEventListener('keydown', event => {
    if (event.key.toLowerCase() !== 'f' || event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.target.tagName === 'SELECT') return;
    flip();
    if (event.target === range) pair.querySelector('.flip').focus({ preventScroll: true });   // the slider is hidden now
  });
  for (const select of pair.querySelectorAll('select')) {
    const figure = stage.querySelectorAll('figure')[select.dataset.side === 'left' ? 0 : 1];
    select.addEventListener('change', () => {
      const chosen = document.getElementById(select.value), img = figure.querySelector('img');
      img.src = chosen.src;
      img.alt = chosen.alt;
      figure.querySelector('figcaption').textContent = select.selectedOptions[0].label;
    });
  }
  swipe();
  show('two-up', 'left');
  pair.querySelector('.controls').hidden = false;
}

// Steps: one at a time, by its button or by Back and Next, which go round.
for (const steps of document.querySelectorAll('.steps')) {
  const radios = [...steps.querySelectorAll('input[type=radio]')];
  const items = [...steps.querySelectorAll('li')];
  let at = 0;

  const show = to => {
    at = (to + items.length) % items.length;
    items.forEach((item, i) => item.classList.toggle('shown', i === at));
    radios[at].checked = true;
    mark_enlarged();
  };
  radios.forEach((radio, i) => radio.addEventListener('change', () => show(i)));
  steps.querySelector('.back').addEventListener('click', () => show(at - 1));
  steps.querySelector('.next').addEventListener('click', () => show(at + 1));
  steps.classList.add('one');
  steps.querySelector('.controls').hidden = false;
  show(0);
}

// A plot whose marks show their pictures beside it: under the mouse, or by Tab and then the arrow keys, from fast to slow.
for (const explore of document.querySelectorAll('.explore')) {
  const panel = explore.querySelector('.pointed');
  const x = mark => mark.transform.baseVal.getItem(0).matrix.e;
  const marks = [...explore.querySelectorAll('.mark')].sort((a, b) => x(a) - x(b));
  if (marks.length === 0) continue;

  const picture = id => {
    const img = document.getElementById(id)?.cloneNode();
    if (!img) return [];
    img.removeAttribute('id');
    const figure = document.createElement('figure'), caption = document.createElement('figcaption');
    caption.textContent = img.alt;
    figure.append(img, caption);
    return [figure];
  };
  const show = shown => {
    for (const mark of marks) {
      mark.classList.toggle('shown', mark === shown);
      mark.setAttribute('tabindex', mark === shown ? 0 : -1);
    }
    panel.querySelector('p').textContent = shown.querySelector('title').textContent;
    const { picture: first, difference: second } = document.getElementById('point-' + shown.dataset.point).dataset;
    panel.querySelector('.columns').replaceChildren(...picture(first), ...picture(second));
    mark_enlarged();
  };
  marks.forEach((mark, i) => {
    mark.setAttribute('role', 'img');
    for (const event of ['pointerenter', 'focus', 'click']) mark.addEventListener(event, () => show(mark));
    mark.addEventListener('keydown', event => {
      const to = { ArrowRight: i + 1, ArrowDown: i + 1, ArrowLeft: i - 1, ArrowUp: i - 1, Home: 0, End: -1 }[event.key];
      if (to === undefined) return;
      event.preventDefault();
      marks.at(to % marks.length).focus();
    });
  });
  panel.hidden = false;
  show(marks.find(mark => mark.classList.contains('good')) ?? marks[0]);
}

// Tables that a click on a heading sorts: upwards, and downwards when they were. A cell counts as the number that it
// begins with, if it does.
for (const table of document.querySelectorAll('table.sortable')) {
  const headings = [...table.tHead.rows[0].cells], body = table.tBodies[0];
  const value = (row, column) => {
    const text = row.cells[column].textContent.replaceAll('\u202F', '');
    const number = parseFloat(text);
    return Number.isNaN(number) ? text : number;
  };
  const before = (a, b) => typeof a !== typeof b ? (typeof a === 'number' ? -1 : 1)
    : typeof a === 'number' ? a - b : a.localeCompare(b);
  headings.forEach((heading, column) => {
    const button = document.createElement('button');
    button.type = 'button';
    button.append(...heading.childNodes);
    heading.append(button);
    button.addEventListener('click', () => {
      const sign = heading.ariaSort === 'ascending' ? -1 : 1;
      for (const each of headings) each.removeAttribute('aria-sort');
      heading.setAttribute('aria-sort', sign > 0 ? 'ascending' : 'descending');
      body.append(...[...body.rows].sort((a, b) => sign * before(value(a, column), value(b, column))));
    });
  });
}

// An enlarged picture shows its pixels; a reduced one is filtered.
function mark_enlarged() {
  for (const img of document.images) img.classList.toggle('enlarged', img.clientWidth > img.naturalWidth);
}
new ResizeObserver(mark_enlarged).observe(document.body);
addEventListener('load', mark_enlarged);
)js";

}  // namespace sidelight
