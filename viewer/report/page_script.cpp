// SPDX-License-Identifier: MIT
// What a report's widgets do. Without it the page shows every picture in its order; controls come with `hidden` and
// are shown here, since they do nothing without it.
#include "viewer/report/html.h"

namespace sidelight {

const std::string_view kPageScript = R"js(
'use strict';

// Two pictures: beside each other, under a slider, or flipped in place (the button, F, or a click on the picture).
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
  const swipe = () => pair.style.setProperty('--at', range.value / 10 + '%');

  for (const radio of modes) radio.addEventListener('change', () => show(radio.value, 'left'));
  range.addEventListener('input', swipe);
  pair.querySelector('.flip').addEventListener('click', flip);
  stage.addEventListener('click', () => { if (pair.dataset.mode === 'flip') flip(); });
  document.addEventListener('keydown', event => {
    if (event.key.toLowerCase() === 'f' && !event.ctrlKey && !event.metaKey && !event.altKey) flip();
  });
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

// An enlarged picture shows its pixels; a reduced one is filtered.
function mark_enlarged() {
  for (const img of document.images) img.classList.toggle('enlarged', img.clientWidth > img.naturalWidth);
}
new ResizeObserver(mark_enlarged).observe(document.body);
addEventListener('load', mark_enlarged);
)js";

}  // namespace sidelight
