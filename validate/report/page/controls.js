// Mouse, touch and keys of the viewer, and the buttons A and B under every figure.
const still = window.matchMedia('(prefers-reduced-motion: reduce)');

function listen(viewer) {
  const {root, stage} = viewer;
  root.addEventListener('input', ({target}) => {
    const {name, value, checked} = target;
    if (name === 'scene') viewer.toScene(Number(value));
    if (name === 'a' || name === 'b') viewer.change({[name]: Number(value)});
    if (name === 'mode') viewer.change({mode: value, flipped: false});
    if (name === 'masks') viewer.change({masks: checked});
    if (name === 'wipe') viewer.change({wipe: value / 100});
  });
  const press = {
    swap: () => viewer.change({a: viewer.state.b, b: viewer.state.a}),
    in: () => viewer.zoomBy(1.5),
    out: () => viewer.zoomBy(1 / 1.5),
    fit: () => viewer.zoomBy(1e-9)
  };
  root.addEventListener('click', ({target}) => press[target.name]?.());
  stage.addEventListener('keydown', (event) => onKey(viewer, press, event));
  listenToPointers(viewer, stage);
  blinkByItself(viewer);
  for (const [index, scene] of viewer.scenes.entries()) addButtons(viewer, scene, index);
}

function onKey(viewer, press, event) {
  if (event.ctrlKey || event.altKey || event.metaKey) return;
  const {state, scene} = viewer;
  const pan = 0.1 / state.zoom;
  const back = event.shiftKey ? -1 : 1;
  const next = (side) => viewer.change({[side]: viewer.step(side, scene.pictures.length, back)});
  const wipeBy = (by) => viewer.change({mode: 'wipe', wipe: Math.min(1, Math.max(0, state.wipe + by))});
  const keys = {
    ' ': () => viewer.change(state.mode === 'blink' ? {flipped: !state.flipped} : {mode: 'blink', flipped: true}),
    w: () => viewer.change({mode: 'wipe'}),
    k: () => viewer.change({mode: 'blink', flipped: false}),
    s: () => viewer.change({mode: 'side'}),
    d: () => viewer.change({mode: 'difference'}),
    m: () => viewer.change({masks: !state.masks}),
    a: () => next('a'),
    b: () => next('b'),
    x: press.swap,
    n: () => viewer.toScene(viewer.step('scene', viewer.scenes.length, back)),
    '+': press.in, '=': press.in, '-': press.out, '0': press.fit,
    '[': () => wipeBy(-0.05), ']': () => wipeBy(0.05),
    ArrowLeft: () => viewer.move(-pan, 0), ArrowRight: () => viewer.move(pan, 0),
    ArrowUp: () => viewer.move(0, -pan), ArrowDown: () => viewer.move(0, pan)
  };
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
  if (!Object.hasOwn(keys, key)) return;
  // At full size the arrows still scroll the page.
  if (key.startsWith('Arrow') && state.zoom === 1) return;
  event.preventDefault();
  keys[key]();
}

/// One pointer pans, or moves the wipe where the view is whole or the line is near; two zoom.
function listenToPointers(viewer, stage) {
  const pointers = new Map();
  const placeOf = (event) => {
    const box = stage.getBoundingClientRect();
    return {x: (event.clientX - box.left) / box.width, y: (event.clientY - box.top) / box.height};
  };
  const spread = () => {
    const [p, q] = [...pointers.values()];
    return {x: (p.x + q.x) / 2, y: (p.y + q.y) / 2, size: Math.hypot(p.x - q.x, p.y - q.y)};
  };
  let wiping = false;
  stage.addEventListener('pointerdown', (event) => {
    const place = placeOf(event);
    const {mode, wipe, zoom} = viewer.state;
    pointers.set(event.pointerId, place);
    wiping = mode === 'wipe' && (zoom === 1 || Math.abs(place.x - wipe) < 0.03);
    if (wiping) viewer.change({wipe: place.x});
    if (mode === 'blink' && event.pointerType !== 'mouse') viewer.change({hovered: true});
    try { stage.setPointerCapture(event.pointerId); } catch { /* a pointer that is gone already */ }
  });
  stage.addEventListener('pointermove', (event) => {
    const last = pointers.get(event.pointerId);
    if (!last) return;
    const before = pointers.size === 2 && spread();
    const place = placeOf(event);
    pointers.set(event.pointerId, place);
    if (before) {
      const after = spread();
      if (before.size > 0) viewer.zoomBy(after.size / before.size, after.x, after.y);
    } else if (wiping) {
      viewer.change({wipe: Math.min(1, Math.max(0, place.x))});
    } else {
      viewer.move((last.x - place.x) / viewer.state.zoom, (last.y - place.y) / viewer.state.zoom);
    }
  });
  for (const name of ['pointerup', 'pointercancel']) {
    stage.addEventListener(name, (event) => {
      pointers.delete(event.pointerId);
      if (event.pointerType !== 'mouse') viewer.change({hovered: false});
    });
  }
  const hover = (hovered) => (event) => {
    if (event.pointerType === 'mouse') viewer.change({hovered});
  };
  stage.addEventListener('pointerenter', hover(true));
  stage.addEventListener('pointerleave', hover(false));
  stage.addEventListener('wheel', (event) => {
    // Without the focus the wheel scrolls the page; a pinch on a touchpad comes with ctrl.
    if (document.activeElement !== stage && !event.ctrlKey) return;
    event.preventDefault();
    const {x, y} = placeOf(event);
    viewer.zoomBy(Math.exp(-event.deltaY / 400), x, y);
  }, {passive: false});
}

/// Blinks while its box is ticked; not offered to whoever asked for less motion.
function blinkByItself(viewer) {
  const box = viewer.control('auto');
  box.disabled = still.matches;
  let timer;
  box.addEventListener('change', () => {
    clearInterval(timer);
    if (box.checked) timer = setInterval(() => viewer.change({flipped: !viewer.state.flipped}), 500);
  });
}

function addButtons(viewer, scene, index) {
  for (const [place, picture] of scene.pictures.entries()) {
    const buttons = document.createElement('span');
    buttons.className = 'pick';
    buttons.append(picture.letter.endsWith('′') ? 'Compare lower as' : 'Compare as');
    for (const side of ['a', 'b']) {
      const button = document.createElement('button');
      button.type = 'button';
      button.textContent = side.toUpperCase();
      button.title = `Show (${picture.letter}) ${picture.name} as ${side.toUpperCase()} in the comparison`;
      button.setAttribute('aria-label', button.title);
      button.addEventListener('click', () => {
        if (viewer.state.scene !== index) viewer.toScene(index);
        viewer.change({[side]: place});
        viewer.root.scrollIntoView({behavior: still.matches ? 'auto' : 'smooth', block: 'start'});
        viewer.stage.focus({preventScroll: true});
      });
      buttons.append(button);
    }
    picture.figure.querySelector('figcaption').append(buttons);
  }
}

const scenes = [...document.querySelectorAll('.panel')].map((panel) => new Scene(panel))
    .filter((scene) => scene.pictures.length > 0);
const root = document.querySelector('.viewer');
if (root && scenes.length > 0) new Viewer(root, scenes).start();
