// The values of a plot under the pointer and by the arrow keys, and which methods are highlighted.
// Without this the plots, their legends and their tables are there all the same.

class Plot {
  constructor(svg, tip) {
    this.svg = svg;
    this.tip = tip;
    const [, , width, height] = svg.getAttribute('viewBox').split(' ').map(Number);
    this.size = {width, height};
    // Values of one curve follow one another in one group.
    this.values = [...svg.querySelectorAll('.value')].map((group) => {
      const [x, y] = group.querySelector('use').getAttribute('transform').match(/-?[\d.]+/g).map(Number);
      const title = group.querySelector('title');
      const words = title.textContent;
      title.remove();  // the tip replaces it
      return {group, x, y, words, curve: group.parentNode};
    });
    this.shown = null;
    svg.addEventListener('pointermove', (event) => this.showNearest(event));
    svg.addEventListener('pointerdown', (event) => this.showNearest(event));
    svg.addEventListener('pointerleave', () => this.show(null));
    svg.addEventListener('blur', () => this.show(null));
    svg.addEventListener('keydown', (event) => this.press(event));
  }

  showNearest(event) {
    const box = this.svg.getBoundingClientRect();
    const scale = this.size.width / box.width;
    const x = (event.clientX - box.left) * scale, y = (event.clientY - box.top) * scale;
    let nearest = null, least = 28 * scale;
    for (const value of this.values) {
      const distance = Math.hypot(value.x - x, value.y - y);
      if (distance < least) [nearest, least] = [value, distance];
    }
    this.show(nearest);
  }

  /// Left and right along a curve, up and down to the value above or below.
  press(event) {
    const step = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]}[event.key];
    if (event.key === 'Escape') return this.show(null);
    if (!step) return;
    event.preventDefault();
    if (!this.shown) return this.show(this.values[0]);
    const {x, y, curve} = this.shown;
    const away = ([dx, dy]) => (value) => dx ? (value.x - x) * dx : (value.y - y) * dy;
    const distance = away(step);
    const others = this.values.filter((value) => value !== this.shown && distance(value) > 0 &&
        (step[0] ? value.curve === curve : Math.abs(value.x - x) < 2));
    if (others.length) this.show(others.reduce((a, b) => distance(b) < distance(a) ? b : a));
  }

  show(value) {
    if (value === this.shown) return;
    this.shown?.group.classList.remove('shown');
    this.shown = value;
    this.tip.hidden = !value;
    if (!value) return;
    value.group.classList.add('shown');
    this.tip.textContent = value.words;
    const frame = this.tip.parentNode;
    const scale = this.svg.getBoundingClientRect().width / this.size.width;
    const x = value.x * scale, y = value.y * scale;
    const left = Math.min(x + 12, frame.clientWidth - this.tip.offsetWidth);
    this.tip.style.left = `${Math.max(0, left)}px`;
    const above = y - this.tip.offsetHeight - 10;
    this.tip.style.top = `${above > 0 ? above : y + 12}px`;
  }
}

/// Draws a method in its family's colour or in grey, in all plots of the page.
function highlight(method, isOn) {
  for (const figure of document.querySelectorAll('figure.plot')) {
    const families = new Map((figure.dataset.families || '').split(',').map((pair) => pair.split(' ')));
    if (!families.has(method)) continue;
    figure.style.setProperty(`--plot-${method}`, `var(--plot-${isOn ? families.get(method) : 'other'})`);
    for (const button of figure.querySelectorAll(`button[data-method=${method}]`)) {
      button.setAttribute('aria-pressed', isOn);
    }
    // On top of the others.
    if (!isOn) continue;
    for (const curve of figure.querySelectorAll(`g[data-method=${method}]`)) curve.parentNode.append(curve);
  }
}

for (const frame of document.querySelectorAll('figure.plot .fit')) {
  const svg = frame.querySelector('svg');
  if (!svg.querySelector('.value')) continue;
  const tip = document.createElement('output');
  tip.className = 'reading';
  tip.hidden = true;
  frame.append(tip);
  new Plot(svg, tip);
}
for (const button of document.querySelectorAll('.keys button')) {
  button.addEventListener('click', () =>
      highlight(button.dataset.method, button.getAttribute('aria-pressed') !== 'true'));
}
