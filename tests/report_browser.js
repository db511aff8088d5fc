// Runs in the report's page (report_browser.sh adds it, and the report's JSON as `report`): does the page do what it should?
// What is wrong goes into the document's title; nothing wrong: "good".
'use strict';
const wrong = [];
const check = (condition, words) => { if (!condition) wrong.push(words); };

// As many points as there are numbers, in each plot of each scene.
const measured = report.scenes.filter((s) => !s.failure);
for (const scene of measured) {
  const samples = report.samples.filter((s) => s.scene === scene.name && !s.failure);
  const plots = document.querySelectorAll(`#${scene.name} svg.plot`);
  check(plots.length === 6, `${scene.name}: ${plots.length} plots`);
  for (const plot of plots) {
    const { x, y } = plot.dataset, expected = samples.filter((s) => s[x] !== null && s[y] !== null).length;
    const points = plot.querySelectorAll('.point');
    check(points.length === expected && expected >= 5, `${scene.name} ${x} ${y}: ${points.length} points, not ${expected}`);
    const box = plot.viewBox.baseVal;
    for (const p of points) {
      const cx = p.cx.baseVal.value, cy = p.cy.baseVal.value;
      check(cx > 60 && cx < box.width && cy > 20 && cy < box.height - 40, `${scene.name} ${y}: a point at ${cx}, ${cy}`);
    }
    check(plot.querySelectorAll('.ring').length >= 1, `${scene.name} ${y}: no Pareto front`);
  }
  const rows = document.querySelectorAll(`#${scene.name} .settings tr`).length - 1;
  check(rows === report.samples.filter((s) => s.scene === scene.name).length, `${scene.name}: ${rows} rows`);
  check(document.querySelectorAll(`#${scene.name} .statistics tr`).length >= 2, `${scene.name}: no statistics`);
}
check(document.querySelectorAll('.failure').length >= report.scenes.length - measured.length, 'a failure is not shown');

// A point answers.
const point = document.querySelector('.point[tabindex]'), tip = document.getElementById('tip');
point.dispatchEvent(new Event('pointerenter'));
check(!tip.hidden && tip.textContent.includes('run time') && tip.offsetWidth > 50, `tip: ${tip.textContent}`);
point.dispatchEvent(new Event('pointerleave'));
check(tip.hidden, 'the tip stays');

// The slider uncovers, the choice chooses.
for (const compare of document.querySelectorAll('.compare')) {
  const slider = compare.querySelector('input'), select = compare.querySelector('select');
  const shown = () => [...compare.querySelectorAll('.stage')].filter((s) => s.offsetHeight > 0);
  select.selectedIndex = select.options.length - 1;
  select.dispatchEvent(new Event('change'));
  check(shown().length === 1 && shown()[0] === [...compare.querySelectorAll('.stage')].pop(), 'the choice does not choose');
  for (const value of ['10', '90']) {
    slider.value = value;
    slider.dispatchEvent(new Event('input'));
    const cut = getComputedStyle(shown()[0].querySelector('.above')).clipPath;
    check(cut.includes(`${value}%`), `slider at ${value}: ${cut}`);
  }
}
for (const image of document.images) check(image.naturalWidth === report.width, `picture ${image.alt}: ${image.naturalWidth}`);

// Nothing is wider than the window, nothing was asked of anyone.
check(document.documentElement.scrollWidth <= document.documentElement.clientWidth, 'the page is wider than the window');
const asked = performance.getEntriesByType('resource').map((e) => e.name).filter((name) => !name.startsWith('data:'));
check(asked.length === 0, `requests: ${asked}`);
document.title = wrong.length ? wrong.join('; ') : 'good';
