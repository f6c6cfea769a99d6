// The comparison of any two pictures of a scene: wipe, blink, side by side, difference; zoom and pan
// are shared by both, and stay when the scene or a picture changes.
class Viewer {
  constructor(root, scenes) {
    this.root = root;
    this.scenes = scenes;
    this.stage = root.querySelector('.stage');
    this.canvas = root.querySelector('canvas');
    this.status = root.querySelector('[role=status]');
    this.state = {scene: 0, a: 0, b: 0, mode: 'wipe', masks: false, wipe: 0.5, flipped: false,
                  hovered: false, zoom: 1, x: 0.5, y: 0.5};
    this.drawn = {};
    this.turn = 0;
  }

  get scene() { return this.scenes[this.state.scene]; }
  picture(side) { return this.scene.pictures[this.state[side]]; }
  control(name) { return this.root.querySelector(`[name="${name}"]`); }

  start() {
    const option = (text, value) => new Option(text, value);
    this.control('scene').replaceChildren(...this.scenes.map((s, i) => option(s.title, i)));
    this.root.querySelector('.scene').hidden = this.scenes.length < 2;
    this.root.hidden = false;
    this.toScene(0);
    listen(this);
    new ResizeObserver(() => this.draw()).observe(this.stage);
  }

  /// Shows another scene; A and B stay the pictures of the same names where it has them. At first A
  /// is the best method, B the truth.
  toScene(index) {
    const names = this.started ? ['a', 'b'].map((side) => this.picture(side).name) : [];
    this.started = true;
    this.state.scene = index;
    const pictures = this.scene.pictures;
    const place = (name) => pictures.findIndex((picture) => picture.name === name);
    const truth = pictures.findIndex((picture) => picture.isTruth);
    const best = pictures.findIndex((picture) => picture.isBest);
    this.state.a = Math.max(0, place(names[0]) < 0 ? best : place(names[0]));
    this.state.b = Math.max(0, place(names[1]) < 0 ? truth : place(names[1]));
    for (const side of ['a', 'b']) {
      this.control(side).replaceChildren(
          ...pictures.map((p, i) => new Option(`(${p.letter}) ${p.name}`, i)));
    }
    this.update();
  }

  change(values) {
    Object.assign(this.state, values);
    return this.update();
  }

  /// The step to the next of `count` entries, or the one before.
  step(name, count, by) { return (this.state[name] + by + count) % count; }

  zoomBy(factor, x = 0.5, y = 0.5) {
    const {zoom} = this.state;
    const next = Math.min(32, Math.max(1, zoom * factor));
    // The picture's point under (x, y) stays there.
    this.move((x - 0.5) * (1 / zoom - 1 / next), (y - 0.5) * (1 / zoom - 1 / next), next);
  }

  /// Moves the middle of the view, in shares of the picture, and keeps the view inside it.
  move(dx, dy, zoom = this.state.zoom) {
    const inside = (middle) => Math.min(1 - 0.5 / zoom, Math.max(0.5 / zoom, middle));
    this.state.zoom = zoom;
    this.state.x = inside(this.state.x + dx);
    this.state.y = inside(this.state.y + dy);
    this.showState();
    this.draw();
  }

  /// Composes what the state asks for, then draws it; of several calls the last one wins.
  async update() {
    const turn = ++this.turn;
    this.root.dataset.asked = turn;
    this.showState();
    const {mode, masks} = this.state;
    const kind = masks ? 'shadows' : 'shading';
    try {
      const drawn = mode === 'difference'
          ? {difference: await this.scene.difference(this.picture('a'), this.picture('b'))}
          : {a: await this.scene[kind](this.picture('a')), b: await this.scene[kind](this.picture('b'))};
      if (turn !== this.turn) return;
      this.drawn = drawn;
    } catch (error) {
      this.status.textContent = `The pictures cannot be decoded: ${error.message}`;
      return;
    }
    this.draw();
    this.root.dataset.drawn = turn;
  }

  showState() {
    const {state} = this;
    for (const name of ['scene', 'a', 'b']) this.control(name).value = state[name];
    for (const radio of this.root.querySelectorAll('[name=mode]')) radio.checked = radio.value === state.mode;
    this.control('masks').checked = state.masks;
    this.control('masks').disabled = state.mode === 'difference';
    this.control('wipe').value = Math.round(100 * state.wipe);
    this.control('zoom').textContent = `${+state.zoom.toFixed(1)}×`;
    const ratio = (state.mode === 'side' ? 2 : 1) * this.scene.width / this.scene.height;
    this.stage.style.aspectRatio = ratio;
    this.stage.style.maxWidth = `calc(60vh * ${ratio})`;
    this.root.querySelector('.wipe').style.maxWidth = this.stage.style.maxWidth;
    this.root.querySelector('.wipe').hidden = state.mode !== 'wipe';
    this.root.querySelector('.auto').hidden = state.mode !== 'blink';
    this.root.querySelector('.legend').hidden = state.mode !== 'difference';
    this.root.querySelector('.legend .soft').hidden = !this.scene.isSoft;
    this.stage.classList.toggle('zoomed', state.zoom > 1);
    this.stage.style.cursor = state.zoom > 1 ? 'grab' : state.mode === 'wipe' ? 'col-resize' : 'default';
  }

  /// Which picture the blink shows.
  get shown() { return this.state.flipped !== this.state.hovered ? 'b' : 'a'; }

  draw() {
    const {width, height} = this.stage.getBoundingClientRect();
    const scale = window.devicePixelRatio || 1;
    this.canvas.width = Math.max(1, Math.round(width * scale));
    this.canvas.height = Math.max(1, Math.round(height * scale));
    const context = this.canvas.getContext('2d');
    const {mode, wipe} = this.state;
    const {width: w, height: h} = this.canvas;
    const {a, b, difference} = this.drawn;
    if (mode === 'difference') {
      if (difference) this.paint(context, difference.canvas, 0, 0, w, h);
    } else if (mode === 'blink') {
      this.paint(context, this.drawn[this.shown], 0, 0, w, h);
    } else if (mode === 'side') {
      this.paint(context, a, 0, 0, w / 2, h);
      this.paint(context, b, w / 2, 0, w / 2, h);
      this.line(context, w / 2, h, scale);
    } else {
      this.paint(context, b, 0, 0, w, h);
      this.paint(context, a, 0, 0, w, h, w * wipe);
      this.line(context, w * wipe, h, scale);
    }
    this.label();
  }

  /// Draws the visible part of a picture into a box, of which only the first `part` columns show.
  paint(context, source, left, top, width, height, part = width) {
    if (!source) return;
    const {zoom, x, y} = this.state;
    const w = width * zoom, h = height * zoom;
    context.save();
    context.beginPath();
    context.rect(left, top, part, height);
    context.clip();
    context.imageSmoothingEnabled = w < 2 * this.scene.width;
    context.imageSmoothingQuality = 'high';
    context.drawImage(source, left + width / 2 - x * w, top + height / 2 - y * h, w, h);
    context.restore();
  }

  line(context, x, height, scale) {
    context.fillStyle = '#ffffff';
    context.fillRect(x - 1.5 * scale, 0, 3 * scale, height);
    context.fillStyle = '#14171b';
    context.fillRect(x - 0.5 * scale, 0, scale, height);
  }

  label() {
    const {mode} = this.state;
    const text = (side) => {
      const {letter, name, rate} = this.picture(side);
      return `(${letter}) ${name}${rate ? ', ' + rate : ''}`;
    };
    const both = mode === 'wipe' || mode === 'side';
    const one = mode === 'blink' ? this.shown : '';
    for (const side of ['a', 'b']) {
      const tip = this.root.querySelector('.tip.' + side);
      tip.textContent = `${side.toUpperCase()} ${text(side)}`;
      tip.hidden = !both && side !== one;
    }
    const pair = `A ${text('a')}; B ${text('b')}. `;
    const percent = (share) => `${(100 * share).toFixed(2)} %`;
    const {difference} = this.drawn;
    const says = {
      wipe: () => `${pair}A left of the line.`,
      side: () => pair,
      blink: () => `${pair}${this.shown.toUpperCase()} is shown.`,
      difference: () => !difference
          ? pair + 'No difference: they draw different meshes, or are no shadow masks, so that their pixels show different points.'
          : this.scene.isSoft
          ? `${pair}Of the light, A sees ${percent(difference.darker)} less than B where it is darker, and ${percent(difference.lighter)} more where it is lighter: means over all pixels.`
          : `${pair}A is dark where B is lit at ${percent(difference.darker)} of the pixels, and lit where B is dark at ${percent(difference.lighter)}.`
    };
    const status = says[mode]();
    if (this.status.textContent !== status) this.status.textContent = status;
  }
}
